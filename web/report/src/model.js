/** The report's data as the page uses them. Lengths in metres, in F less `origin`. */

import { decode, pointAt } from './arrays.js';
import { groupOf } from './reasons.js';

export const SCHEMA = 'graspd-report/1';

const SOURCES = { 1: 'boundary', 2: 'wall', 4: 'whole_object' };
const FLAGS = ['exact', 'path', 'enclosed', 'unreferenced'];

function readObject(object) {
    return {
        vertices: decode(object.vertices, Float32Array),
        faces: decode(object.faces, Uint32Array),
        concavity: decode(object.concavity, Float32Array),
        flags: decode(object.flags, Uint8Array),
        hull: decode(object.hull, Uint32Array),
        centerOfMass: object.center_of_mass,
        volume: object.volume,
    };
}

function readSearch(search) {
    return {
        gripper: search.gripper,
        points: decode(search.points, Float32Array),
        spacing: search.spacing,
        concavities: search.concavities.map((region) => ({
            depth: region.depth,
            salient: decode(region.salient, Uint32Array),
            enlarged: decode(region.enlarged, Uint32Array),
        })),
        boundaries: search.boundaries.map((boundary) => ({
            concavity: boundary.concavity,
            points: decode(boundary.points, Float32Array),
            steps: decode(boundary.steps, Float32Array),
        })),
    };
}

function readCandidates(candidates) {
    return {
        count: candidates.count,
        reasons: candidates.reasons,
        units: candidates.units,
        grippers: candidates.grippers,
        reason: decode(candidates.reason, Uint8Array),
        gripper: decode(candidates.gripper, Uint8Array),
        source: decode(candidates.source, Uint8Array),
        concavity: decode(candidates.concavity, Int32Array),
        position: decode(candidates.position, Float32Array),
        quaternion: decode(candidates.quaternion, Float32Array),
        width: decode(candidates.width, Float32Array),
        margin: decode(candidates.margin, Float32Array),
        beta: decode(candidates.beta, Float32Array),
        minFriction: decode(candidates.min_friction, Float32Array),
        score: decode(candidates.score, Float32Array),
    };
}

function readPart(part) {
    if (part.points === undefined) return part;
    return { ...part, points: decode(part.points, Float32Array) };
}

function readBody(body) {
    return {
        vertices: decode(body.vertices, Float32Array),
        faces: decode(body.faces, Uint32Array),
    };
}

/** @param {object} data the parsed JSON of the page; throws an Error that a person can read */
export function readReport(data) {
    if (data?.schema !== SCHEMA) {
        throw new Error(`this page reads ${SCHEMA}, its data are ${data?.schema ?? 'missing'}`);
    }
    return {
        origin: data.origin,
        reply: data.reply,
        request: { ...data.request, obstacles: data.request.obstacles.map(readBody) },
        object: readObject(data.object),
        searches: data.searches.map(readSearch),
        candidates: readCandidates(data.candidates),
        hands: data.hands.map((hand) => ({
            open: hand.open.map(readPart),
            contact: hand.contact.map(readPart),
        })),
    };
}

const known = (value) => (Number.isNaN(value) ? undefined : value);

/** One candidate as an object; what it did not come to is undefined. */
export function candidateAt(candidates, i) {
    const reason = candidates.reasons[candidates.reason[i]];
    return {
        index: i,
        reason,
        group: groupOf(reason),
        gripper: candidates.grippers[candidates.gripper[i]],
        source: SOURCES[candidates.source[i]],
        concavity: candidates.concavity[i],
        position: pointAt(candidates.position, i),
        width: candidates.width[i],
        margin: known(candidates.margin[i]),
        unit: candidates.units[candidates.reason[i]],
        beta: known(candidates.beta[i]),
        minFriction: known(candidates.minFriction[i]),
        score: known(candidates.score[i]),
    };
}

/** Indices of the candidates with a given reason; '' are the grasps of the reply, best first. */
export function candidatesOf(candidates, reason) {
    const wanted = candidates.reasons.indexOf(reason);
    const found = [];
    if (wanted < 0) return found;
    for (let i = 0; i < candidates.count; ++i) if (candidates.reason[i] === wanted) found.push(i);
    return found;
}

/** The name of a vertex's flag. */
export function flagName(flag) {
    return FLAGS[flag] ?? 'unknown';
}

/** The largest finite concavity [m]; 0 where there is none. */
export function largestConcavity(concavity) {
    let largest = 0;
    for (const value of concavity) if (Number.isFinite(value) && value > largest) largest = value;
    return largest;
}

/** Centre and radius [m] of a ball around points. */
export function boundsOf(flat) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < flat.length; ++i) {
        low[i % 3] = Math.min(low[i % 3], flat[i]);
        high[i % 3] = Math.max(high[i % 3], flat[i]);
    }
    if (flat.length < 3) return { center: [0, 0, 0], radius: 0.1 };
    const center = low.map((value, k) => (value + high[k]) / 2);
    return { center, radius: Math.hypot(...low.map((value, k) => high[k] - value)) / 2, low, high };
}
