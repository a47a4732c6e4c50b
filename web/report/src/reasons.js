/** What the typed reasons mean to a person, and in which colour they are drawn. */

export const GROUPS = {
    ranked: { label: 'in the reply', colour: '#2a9d6f' },
    spare: { label: 'holds, not returned', colour: '#6fb7a4' },
    loose: { label: 'does not hold', colour: '#e09f1f' },
    collides: { label: 'collides', colour: '#d1495b' },
    wide: { label: 'too wide', colour: '#8a63c9' },
    unwanted: { label: 'kept out by the request', colour: '#3d7ebf' },
    untried: { label: 'axis not tried', colour: '#8b93a1' },
};

const KNOWN = {
    '': ['ranked', 'One of the grasps in the reply.'],
    duplicate: ['spare', 'Holds, but a better grasp stands for it.'],
    surplus: ['spare', 'Holds, but more grasps were found than wanted.'],
    slips: ['loose', 'The pads would slip: it needs more friction than the request allows.'],
    no_contact: ['loose', 'The closing pads do not meet the object.'],
    too_thin: ['loose', 'What lies between the pads is thinner than the closed hand.'],
    contact_too_small: ['loose', 'A pad touches too few points to judge the balance.'],
    side_not_straight: ['loose', 'A side under a pad is too rough to be a line.'],
    too_wide: ['wide', 'The hand does not open wide enough.'],
    axis_too_wide: ['wide', 'The object is wider there than the hand opens.'],
    clearance: ['unwanted', 'The hand comes nearer to something than the request allows.'],
    outside_approach_cones: ['unwanted', 'The hand would come from outside the approach cones.'],
    axis_source_unwanted: ['unwanted', 'The request does not ask for candidates of this source.'],
    palm_line_blocked: ['collides', 'The object stands in the way of the palm.'],
    finger_line_blocked: ['collides', 'The object stands in the way of a finger.'],
    axis_no_contact: ['untried', 'A line along the closing direction meets no two sides.'],
    axis_leans: ['untried', 'The surface leans too far from the closing direction.'],
    axis_similar: ['untried', 'Like an axis on which a grasp was found.'],
    axis_surplus: ['untried', 'The search had found enough before it came to this axis.'],
    pose_surplus: ['untried', 'Enough poses of its axis had given a grasp before it.'],
};

const MOVERS = { palm: 'The palm', finger: 'A finger', approach: 'The approaching hand',
    retreat: 'The hand or the object, on its way out,', open: 'The open hand', closing: 'A closing finger' };
const THINGS = { object: 'the object', plane: 'the support plane', obstacle: 'an obstacle',
    keep_out: 'a keep-out box' };

/** "palm_hits_object" in words; the reason itself where it is not of that form. */
function collisionText(reason) {
    const [mover, thing] = reason.split('_hits_');
    if (thing === undefined) return reason.replaceAll('_', ' ');
    return `${MOVERS[mover] ?? mover.replaceAll('_', ' ')} hits ${THINGS[thing] ?? thing}.`;
}

/** @returns {keyof typeof GROUPS} */
export function groupOf(reason) {
    if (KNOWN[reason]) return KNOWN[reason][0];
    return reason.startsWith('axis_') ? 'untried' : 'collides';
}

export function colourOf(reason) {
    return GROUPS[groupOf(reason)].colour;
}

/** One sentence for people. */
export function sentenceOf(reason) {
    return KNOWN[reason]?.[1] ?? collisionText(reason);
}
