/** A small report, worked by hand: a block of 60 x 40 x 80 mm, gripped across its 40 mm. */

const base64 = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString('base64');
export const floats = (...values) => base64(Float32Array.from(values.flat(Infinity)));
export const words = (...values) => base64(Uint32Array.from(values.flat(Infinity)));
export const ints = (...values) => base64(Int32Array.from(values.flat(Infinity)));
export const bytes = (...values) => base64(Uint8Array.from(values.flat(Infinity)));

const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) =>
    [k & 1 ? 0.03 : -0.03, k & 2 ? 0.02 : -0.02, k & 4 ? 0.04 : -0.04]);
const faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7],
    [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]];

const half = Math.SQRT1_2;

export function reply() {
    return {
        schema: 'graspd/1', request_id: 'block', status: 'OK', message: '', frame_id: 'table',
        strategy: 'whole_object', convention: 'tcp_z_approach_x_closing', object_key: '00ff',
        gripper: { name: 'parallel_85', max_width: 0.085 },
        grasps: [{
            rank: 1, position: [1, 2, 3], rotation: [0, 1, 0, 1, 0, 0, 0, 0, -1],
            quaternion: [half, half, 0, 0], width: 0.04, open_width: 0.05, score: 0.9,
            terms: { bias: 0.15, torque: 2.3, balance: -0.25 },
            approach: { direction: [0, 0, -1], distance: 0.1 },
            retreat: { direction: [0, 0, 1], distance: 0.1 },
            contacts: [{ point: [1, 1.98, 3], normal: [0, -1, 0] }, { point: [1, 2.02, 3], normal: [0, 1, 0] }],
            clearance: 0.005, concavity: { index: -1, depth: 0 }, beta_rad: 0, min_friction: 0,
            min_force: 0.8, tolerance: { shift: 0.004, turn: 0.1 }, source: 'whole_object',
            gripper: 'parallel_85',
        }],
        report: {
            stages: [
                { name: 'grasp/opposite_candidates', ms: 2, in: 800, out: 40 },
                { name: 'planner/order_axes', ms: 1, in: 40, out: 10 },
                { name: 'planner/find_poses', ms: 1, in: 2, out: 12 },
                { name: 'grasp/local_cloud', ms: 3, in: 12, out: 6 },
                { name: 'grasp/force_balance', ms: 1, in: 6, out: 3 },
                { name: 'collision/manipulability', ms: 4, in: 20, out: 2 },
                { name: 'grasp/contact_patch', ms: 1, in: 2, out: 2 },
            ],
            rejections: { slips: 1, axis_too_wide: 1 },
            near_misses: [], findings: [{ code: 'holes_filled', value: 1, detail: 'one hole' }],
            suggestion: '',
        },
        planner: { version: '0.1.0', config_hash: 'abcd' }, timings_ms: { total: 13.5 },
    };
}

const box = (min, max) => ({ box: { min, max } });
const hand = (gap) => [
    { member: 'palm', ...box([-0.06, -0.02, -0.115], [0.06, 0.02, -0.035]) },
    { member: 'finger_left', ...box([-gap / 2 - 0.01, -0.01, -0.035], [-gap / 2, 0.01, 0.01]) },
    { member: 'finger_right', ...box([gap / 2, -0.01, -0.035], [gap / 2 + 0.01, 0.01, 0.01]) },
];

/** The page's data; frame F is 1, 2, 3 m off the block's middle. */
export function report() {
    return {
        schema: 'graspd-report/1', file: 'block.stl', origin: [1, 2, 3],
        request: {
            options: { max_grasps: 10, time_budget_s: 10, friction: 0.6, min_clearance_m: 0,
                mass_kg: null, gravity: [0, 0, -1], grip_force_N: 20, sources: ['boundary', 'wall'],
                suggestion: false, seed: 0 },
            grippers: ['parallel_85'], support_plane: { normal: [0, 0, 1], offset: 2.96 },
            obstacles: [], approach_cones: [], keep_out: [],
        },
        object: { vertices: floats(corners), faces: words(faces), concavity: floats(Array(8).fill(0)),
            flags: bytes(Array(8).fill(0)), hull: words([0, 1, 2, 3, 4, 5, 6, 7]), volume: 1.92e-4,
            center_of_mass: [0, 0, 0] },
        searches: [{ gripper: 'parallel_85', points: floats([0, 0.02, 0], [0, -0.02, 0]),
            spacing: 0.003, concavities: [], boundaries: [] }],
        candidates: {
            count: 3, reasons: ['axis_too_wide', 'slips', ''], units: ['m', '1', ''],
            grippers: ['parallel_85'], reason: bytes(0, 1, 2), gripper: bytes(0, 0, 0),
            source: bytes(4, 4, 4), concavity: ints(-1, -1, -1),
            position: floats([0, 0, 0], [0.01, 0, 0], [0, 0, 0]),
            quaternion: floats([0, 0, 0, 1], [half, half, 0, 0], [half, half, 0, 0]),
            width: floats(0.1, 0.04, 0.04), margin: floats(0.015, 0.1, NaN),
            beta: floats(NaN, 0.5, 0), min_friction: floats(NaN, 0.7, 0),
            score: floats(NaN, NaN, 0.9),
        },
        hands: [{ open: hand(0.05), contact: hand(0.04) }],
        reply: reply(),
    };
}
