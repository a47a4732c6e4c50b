/** How a grasp is executed over time: pre-grasp, approach, closing, retreat with the object. */

export const PHASES = [
    { name: 'approach', begin: 0, end: 0.4 },
    { name: 'closing', begin: 0.4, end: 0.6 },
    { name: 'retreat', begin: 0.6, end: 1 },
];
export const DURATION_S = 5;

function smooth(share) {
    const s = Math.min(Math.max(share, 0), 1);
    return s * s * (3 - 2 * s);
}

export function phaseAt(time) {
    return PHASES.find((phase) => time <= phase.end) ?? PHASES[PHASES.length - 1];
}

/**
 * @param {number} time in [0, 1]
 * @param {{approach: {direction: number[], distance: number},
 *          retreat: {direction: number[], distance: number}}} grasp as in the reply
 * @returns {{phase: string, hand: number[], object: number[], closed: number}} shifts [m] of hand
 *     and object from where they are at the grasp; closed: 0 open, 1 pads touch
 */
export function motionAt(time, grasp) {
    const [approach, closing, retreat] = PHASES.map((phase) =>
        smooth((time - phase.begin) / (phase.end - phase.begin)),
    );
    const back = (1 - approach) * grasp.approach.distance;
    const away = retreat * grasp.retreat.distance;
    const object = grasp.retreat.direction.map((value) => away * value);
    const hand = grasp.approach.direction.map((value, k) => object[k] - back * value);
    return { phase: phaseAt(time).name, hand, object, closed: closing };
}
