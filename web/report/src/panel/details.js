/** What is known about the chosen grasp, or the chosen candidate that fell. */

import { fill } from '../dom.js';
import { degrees, margin, millimetres, number, vector } from '../format.js';
import { candidateAt } from '../model.js';
import { termsPlot } from '../plots.js';
import { GROUPS, sentenceOf } from '../reasons.js';

function facts(rows) {
    return ['dl', { class: 'facts' }, rows.filter(Boolean).map(([name, value, hint]) =>
        ['div', { title: hint }, ['dt', {}, name], ['dd', {}, value]])];
}

function tolerance(grasp) {
    if (!grasp.tolerance) return 'not measured';
    const { shift, turn } = grasp.tolerance;
    return `±${millimetres(shift)}, ±${degrees(turn)}`;
}

function contactsTable(grasp) {
    const rows = grasp.contacts.map(({ point, normal }, i) =>
        ['tr', {}, ['th', { scope: 'row' }, i === 0 ? 'left' : 'right'],
            ['td', {}, vector(point, 1e3)], ['td', {}, vector(normal, 1, 2)]]);
    return ['table', { class: 'contacts' },
        ['caption', {}, 'Contacts in the request’s frame'],
        ['thead', {}, ['tr', {}, ['td', {}], ['th', { scope: 'col' }, 'point [mm]'],
            ['th', { scope: 'col' }, 'outward normal']]],
        ['tbody', {}, rows]];
}

function depthText({ index, depth }) {
    return index < 0 ? 'none' : `${index + 1}, ${millimetres(depth)} deep`;
}

/** @param {object} grasp of the reply */
export function graspTrees(grasp) {
    const rows = [
        ['gripper', grasp.gripper],
        ['width at contact', millimetres(grasp.width)],
        ['open width', millimetres(grasp.open_width)],
        ['clearance', millimetres(grasp.clearance), 'least distance of the hand on its way'],
        ['force balance β', degrees(grasp.beta_rad), 'angle between the two sides; 0 is best'],
        ['least friction', number(grasp.min_friction), 'coefficient that holds it'],
        ['least grip force', grasp.min_force === null ? '∞' : `${number(grasp.min_force)} N`,
            'per finger, to carry the weight'],
        ['stands errors of', tolerance(grasp), 'of the hand’s pose, along and about every axis'],
        ['concavity', depthText(grasp.concavity)],
        ['approach', `${millimetres(grasp.approach.distance)} along ${vector(grasp.approach.direction, 1, 2)}`],
        ['retreat', `${millimetres(grasp.retreat.distance)} along ${vector(grasp.retreat.direction, 1, 2)}`],
        ['TCP [mm]', vector(grasp.position, 1e3)],
    ];
    return [
        ['h2', {}, `Grasp #${grasp.rank}`, ['span', { class: 'tag' },
            grasp.source.replaceAll('_', ' ')], ['span', { class: 'big' }, grasp.score.toFixed(3)]],
        facts(rows),
        ['h3', {}, 'Terms of the score'],
        termsPlot(grasp.terms),
        contactsTable(grasp),
    ];
}

/** @param {ReturnType<typeof candidateAt>} candidate @param {number[]} origin */
export function candidateTrees(candidate, origin) {
    const known = (value, show) => (value === undefined ? undefined : show(value));
    const rows = [
        ['reason', candidate.reason || 'in the reply'],
        candidate.margin !== undefined && ['misses by', margin(candidate.margin, candidate.unit)],
        ['gripper', candidate.gripper],
        ['source', candidate.source?.replaceAll('_', ' ')],
        ['width', millimetres(candidate.width)],
        ['force balance β', known(candidate.beta, degrees) ?? 'not reached'],
        ['least friction', known(candidate.minFriction, number) ?? 'not reached'],
        candidate.score !== undefined && ['score', candidate.score.toFixed(3)],
        ['concavity', candidate.concavity < 0 ? 'none' : String(candidate.concavity + 1)],
        ['TCP [mm]', vector(candidate.position.map((value, k) => value + origin[k]), 1e3)],
    ];
    return [
        ['h2', {}, `Candidate ${candidate.index + 1}`, ['span', { class: 'tag',
            style: `--tag:${GROUPS[candidate.group].colour}` }, GROUPS[candidate.group].label]],
        ['p', { class: 'sentence' }, sentenceOf(candidate.reason)],
        facts(rows),
    ];
}

/** Keeps an element in step with the state. */
export function details(element, report, state) {
    const show = () => {
        if (state.candidate >= 0) {
            const candidate = candidateAt(report.candidates, state.candidate);
            const back = ['button', { class: 'back', onclick: () => state.chooseCandidate(-1) },
                state.grasp < 0 ? 'Close' : `Back to grasp #${state.grasp + 1}`];
            return fill(element, ...candidateTrees(candidate, report.origin), back);
        }
        const grasp = report.reply.grasps[state.grasp];
        if (grasp) return fill(element, ...graspTrees(grasp));
        const { status, message } = report.reply;
        return fill(element, ['h2', {}, 'No grasp'], ['p', { class: 'sentence' }, message || status]);
    };
    state.subscribe((changed) => {
        if (changed.includes('grasp') || changed.includes('candidate')) show();
    });
    show();
}
