/** Why candidates fell: reasons with counts, the force balance plot. */

import { fill, mount } from '../dom.js';
import { count } from '../format.js';
import { candidatesOf } from '../model.js';
import { betaPlot, candidateNear } from '../plots.js';
import { GROUPS, colourOf, groupOf, sentenceOf } from '../reasons.js';

/** Rows of the table: the reply's grasps first, then reasons as the reply has them. */
export function reasonRows(reply) {
    return [{ reason: '', count: reply.grasps.length },
        ...Object.entries(reply.report.rejections).map(([reason, n]) => ({ reason, count: n }))];
}

function rowTree({ reason, count: n }, state, traced, next) {
    const box = ['input', { type: 'checkbox', checked: !state.hiddenReasons.has(reason),
        'aria-label': `draw candidates with the verdict ${reason || 'in the reply'}`,
        onchange: () => state.toggleReason(reason) }];
    return ['tr', {}, ['td', {}, box],
        ['td', {}, ['span', { class: 'dot', style: `background:${colourOf(reason)}` }]],
        ['td', {}, ['button', { class: 'reason', title: sentenceOf(reason), disabled: traced === 0,
            onclick: next }, reason || 'in the reply']],
        ['td', { class: 'figure' }, count(n)]];
}

/** The table: a tick draws candidates, a click on a reason walks through its candidates. */
export function reasonTable(element, report, state) {
    const rows = reasonRows(report.reply).map((row) => {
        const indices = candidatesOf(report.candidates, row.reason);
        const next = () => {
            const place = indices.indexOf(state.candidate);
            state.chooseCandidate(indices[(place + 1) % indices.length]);
        };
        return mount(rowTree(row, state, indices.length, next));
    });
    fill(element, ['table', { class: 'reasons' },
        ['caption', {}, 'Each candidate ends once. A click on a reason shows its candidates in turn.'],
        ['tbody', {}, ...rows]]);
    return rows;
}

/** The plot; a click chooses the nearest candidate. */
export function balancePlot(element, report, state) {
    const { candidates } = report;
    const ranked = candidatesOf(candidates, '');
    const groupAt = (i) => groupOf(candidates.reasons[candidates.reason[i]]);
    const choose = (event) => {
        const box = event.currentTarget.getBoundingClientRect();
        const scale = 360 / box.width;
        const index = candidateNear(candidates, (event.clientX - box.left) * scale,
            (event.clientY - box.top) * scale);
        if (index === undefined) return;
        const rank = ranked.indexOf(index);
        if (rank >= 0) state.chooseGrasp(rank);
        else state.chooseCandidate(index);
    };
    const show = () => {
        const chosen = state.candidate >= 0 ? state.candidate : ranked[state.grasp];
        const plot = mount(betaPlot(candidates, groupAt, chosen));
        plot.addEventListener('click', choose);
        fill(element, plot);
    };
    state.subscribe((changed) => {
        if (changed.includes('grasp') || changed.includes('candidate')) show();
    });
    show();
}

/** Colours and what they mean. */
export function groupLegend(report) {
    const used = new Set(report.candidates.reasons.map(groupOf));
    const items = Object.entries(GROUPS).filter(([name]) => used.has(name));
    return ['ul', { class: 'legend' }, items.map(([, group]) =>
        ['li', {}, ['span', { class: 'dot', style: `background:${group.colour}` }], group.label])];
}
