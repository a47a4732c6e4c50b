import assert from 'node:assert/strict';
import test from 'node:test';
import { readReport } from '../../src/model.js';
import { balanced, betaPlot, betaTop, candidateNear, funnelPlot, funnelRows, stagesPlot, termsPlot } from '../../src/plots.js';
import { groupOf } from '../../src/reasons.js';
import { reply, report } from '../fixture.js';

/** All nodes of a tree with a tag. */
function nodes(tree, tag) {
    if (!Array.isArray(tree)) return [];
    const here = tree[0] === tag ? [tree] : [];
    return [...here, ...tree.slice(1).flatMap((child) => nodes(child, tag))];
}

test('terms are bars to either side of zero, as long as they weigh', () => {
    const bars = nodes(termsPlot({ a: 2, b: -1 }), 'rect').map(([, attributes]) => attributes);
    const zero = nodes(termsPlot({ a: 2, b: -1 }), 'line')[0][1].x1;
    assert.equal(bars[0].x, zero);
    assert.equal(bars[1].x + bars[1].width, zero);
    assert.equal(bars[0].width, 2 * bars[1].width);
});

test('terms that are all zero can be drawn', () => {
    for (const [, { width }] of nodes(termsPlot({ a: 0, b: 0 }), 'rect')) assert.ok(width > 0 && width < 2);
});

test('only candidates that were balanced are in the plot of beta', () => {
    const { candidates } = readReport(report());
    assert.deepEqual(balanced(candidates), [1, 2]);
    // 0.5 rad are 28.6 degrees; the scale ends at the next ten.
    assert.ok(Math.abs(betaTop(candidates, [1, 2]) - Math.PI / 6) < 1e-9);
});

test('the plot of beta has one dot a candidate, by group, and marks the chosen one', () => {
    const { candidates } = readReport(report());
    const groupAt = (i) => groupOf(candidates.reasons[candidates.reason[i]]);
    const plot = betaPlot(candidates, groupAt, 1);
    assert.equal(nodes(plot, 'path').length, 2);
    const [mark] = nodes(plot, 'circle');
    assert.equal(candidateNear(candidates, mark[1].cx, mark[1].cy), 1);
    assert.equal(nodes(betaPlot(candidates, groupAt), 'circle').length, 0);
});

test('a click far from every dot chooses none', () => {
    assert.equal(candidateNear(readReport(report()).candidates, 330, 10), undefined);
});

test('the funnel tells what was left after each step', () => {
    assert.deepEqual(funnelRows(reply()).map((row) => row.value), [40, 10, 2, 12, 6, 3, 2, 2, 1]);
});

test('the funnel of a plan that ended early leaves out what there was not', () => {
    const early = reply();
    early.report.stages = early.report.stages.slice(0, 2);
    early.grasps = [];
    assert.deepEqual(funnelRows(early).map((row) => row.value), [40, 10, 0]);
    const widths = nodes(funnelPlot(funnelRows(early)), 'rect').map(([, { width }]) => width);
    assert.ok(widths[0] > widths[1] && widths[1] > 0 && widths[2] === 0);
});

test('stages are as long as they took', () => {
    const plot = stagesPlot([{ name: 'a/one', ms: 4 }, { name: 'a/two', ms: 2 }]);
    const widths = nodes(plot, 'rect').map(([, { width }]) => width);
    assert.equal(widths[0], 2 * widths[1]);
});
