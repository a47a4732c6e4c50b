/** Plots as plain trees (dom.js), so that what they show can be tested without a browser. */

import { count, degrees, milliseconds, number } from './format.js';
import { GROUPS } from './reasons.js';

const WIDTH = 360;

function svg(height, label, children, width = WIDTH) {
    return ['svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': label,
        class: 'plot' }, ...children];
}

const text = (x, y, words, attributes = {}) => ['text', { x, y, ...attributes }, words];

/** Terms of a score: bars to either side of zero. @param {Record<string, number>} terms */
export function termsPlot(terms) {
    const rows = Object.entries(terms);
    const most = Math.max(...rows.map(([, value]) => Math.abs(value)), 1e-9);
    const [left, right, row] = [74, WIDTH - 46, 20];
    const middle = (left + right) / 2;
    const scale = (right - left) / 2 / most;
    const bars = rows.map(([name, value], i) => {
        const length = Math.max(Math.abs(value) * scale, 0.5);
        const x = value < 0 ? middle - length : middle;
        return ['g', {},
            text(left - 8, i * row + 14, name, { 'text-anchor': 'end' }),
            ['rect', { x, y: i * row + 4, width: length, height: 12, rx: 2,
                class: value < 0 ? 'bar minus' : 'bar plus' }],
            text(WIDTH, i * row + 14, (value > 0 ? '+' : '') + number(value),
                { 'text-anchor': 'end', class: 'figure' })];
    });
    const line = ['line', { x1: middle, x2: middle, y1: 0, y2: rows.length * row, class: 'axis' }];
    const words = rows.map(([name, value]) => `${name} ${number(value)}`).join(', ');
    return svg(rows.length * row + 4, `Terms of the score: ${words}`, [line, ...bars]);
}

const BETA = { left: 30, right: WIDTH - 6, top: 8, bottom: 138, height: 160 };

/** Where a candidate stands in betaPlot(). */
function betaPlace(place, beta, n, most) {
    const x = BETA.left + ((place + 0.5) / Math.max(n, 1)) * (BETA.right - BETA.left);
    const y = BETA.bottom - (Math.min(beta, most) / most) * (BETA.bottom - BETA.top);
    return [x, y];
}

/** Indices of the candidates whose balance was computed, in the order of the search. */
export function balanced(candidates) {
    const indices = [];
    for (let i = 0; i < candidates.count; ++i) {
        if (!Number.isNaN(candidates.beta[i])) indices.push(i);
    }
    return indices;
}

/** The top of the scale of betaPlot() [rad]. */
export function betaTop(candidates, indices) {
    const most = indices.reduce((top, i) => Math.max(top, candidates.beta[i]), 0);
    const step = Math.PI / 18;
    return Math.max(step, Math.ceil(most / step) * step);
}

/**
 * Force balance of all candidates that came so far (the paper's Fig. 20): beta over the order of the
 * search, coloured by what became of each.
 * @param {(i: number) => string} groupAt  group of a candidate
 * @param {number} [chosen]  index of the candidate to mark
 */
export function betaPlot(candidates, groupAt, chosen) {
    const indices = balanced(candidates);
    const top = betaTop(candidates, indices);
    const paths = new Map();
    let mark = null;
    indices.forEach((i, place) => {
        const [x, y] = betaPlace(place, candidates.beta[i], indices.length, top);
        const dot = `M${x.toFixed(1)} ${y.toFixed(1)}h0`;
        const group = groupAt(i);
        paths.set(group, (paths.get(group) ?? '') + dot);
        if (i === chosen) mark = ['circle', { cx: x, cy: y, r: 5, class: 'mark' }];
    });
    const ranked = [...Object.keys(GROUPS)].reverse().filter((group) => paths.has(group));
    const dots = ranked.map((group) => ['path', { d: paths.get(group), stroke: GROUPS[group].colour,
        'stroke-width': group === 'ranked' ? 6 : 3.5, 'stroke-linecap': 'round', fill: 'none' }]);
    const lines = [0, 0.5, 1].map((share) => {
        const y = BETA.bottom - share * (BETA.bottom - BETA.top);
        return ['g', {}, ['line', { x1: BETA.left, x2: BETA.right, y1: y, y2: y, class: 'grid' }],
            text(BETA.left - 5, y + 4, degrees(share * top), { 'text-anchor': 'end' })];
    });
    const foot = text((BETA.left + BETA.right) / 2, BETA.height - 4,
        `${count(indices.length)} candidates in the order of the search`, { 'text-anchor': 'middle' });
    return svg(BETA.height, `Force balance angle of ${indices.length} candidates`,
        [...lines, ...dots, mark ?? ['g', {}], foot]);
}

/** The candidate nearest to a place of betaPlot(), in its own coordinates; undefined if none is near. */
export function candidateNear(candidates, x, y, reach = 12) {
    const indices = balanced(candidates);
    const top = betaTop(candidates, indices);
    let best;
    let least = reach;
    indices.forEach((i, place) => {
        const [px, py] = betaPlace(place, candidates.beta[i], indices.length, top);
        const distance = Math.hypot(px - x, py - y);
        if (distance < least) [best, least] = [i, distance];
    });
    return best;
}

const stageOf = (stages, name) => stages.find((stage) => stage.name === name);

/** How many candidates were left after each step. @returns {{label: string, value: number}[]} */
export function funnelRows(reply) {
    const { stages } = reply.report;
    const at = (name, side) => stageOf(stages, name)?.[side];
    const found = (at('grasp/grasp_candidates', 'out') ?? 0) +
        (at('grasp/opposite_candidates', 'out') ?? 0);
    return [
        { label: 'closing axes found', value: found },
        { label: 'that a line can close on', value: at('planner/order_axes', 'out') },
        { label: 'axes tried', value: at('planner/find_poses', 'in') },
        { label: 'poses with free lines', value: at('planner/find_poses', 'out') },
        { label: 'both pads touch', value: at('grasp/local_cloud', 'out') },
        { label: 'held by friction', value: at('grasp/force_balance', 'out') },
        { label: 'whole motion free', value: at('collision/manipulability', 'out') },
        { label: 'grasps found', value: at('grasp/contact_patch', 'out') },
        { label: 'in the reply', value: reply.grasps.length },
    ].filter((row) => row.value !== undefined);
}

/** Bars whose length grows with the logarithm, so that ten of ten thousand can be seen. */
export function funnelPlot(rows) {
    const most = Math.max(...rows.map((row) => row.value), 1);
    const [left, row] = [152, 22];
    const room = WIDTH - left - 52;
    const bars = rows.map(({ label, value }, i) => {
        const width = value > 0 ? Math.max((Math.log10(value + 1) / Math.log10(most + 1)) * room, 2) : 0;
        return ['g', {},
            text(left - 8, i * row + 15, label, { 'text-anchor': 'end' }),
            ['rect', { x: left, y: i * row + 4, width, height: 14, rx: 2, class: 'bar' }],
            text(left + width + 6, i * row + 15, count(value), { class: 'figure' })];
    });
    const words = rows.map(({ label, value }) => `${label} ${value}`).join(', ');
    return svg(rows.length * row + 4, `Candidates left: ${words}`, bars);
}

/** Milliseconds per stage, in the order of the work. */
export function stagesPlot(stages) {
    const most = Math.max(...stages.map((stage) => stage.ms), 1e-9);
    const [left, row] = [152, 20];
    const room = WIDTH - left - 60;
    const bars = stages.map(({ name, ms }, i) => {
        const width = Math.max((ms / most) * room, 1);
        return ['g', {}, ['title', {}, name],
            text(left - 8, i * row + 14, name.split('/').pop().replaceAll('_', ' '),
                { 'text-anchor': 'end' }),
            ['rect', { x: left, y: i * row + 4, width, height: 12, rx: 2, class: 'bar' }],
            text(left + width + 6, i * row + 14, milliseconds(ms), { class: 'figure' })];
    });
    return svg(stages.length * row + 4, 'Time of each stage', bars);
}
