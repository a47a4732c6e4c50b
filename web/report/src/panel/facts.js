/** The rest of the page: header, funnel, times, findings, the request. */

import { count, degrees, millimetres, milliseconds, number, vector } from '../format.js';
import { funnelPlot, funnelRows, stagesPlot } from '../plots.js';

export function headerTree(report, file) {
    const { reply } = report;
    const good = reply.grasps.length > 0;
    return [
        ['h1', {}, file || reply.request_id],
        ['span', { class: `status ${good ? 'good' : 'bad'}` }, reply.status.replaceAll('_', ' ')],
        ['span', { class: 'summary' }, summary(report)],
    ];
}

export function summary({ reply, object }) {
    const grasps = reply.grasps.length;
    const parts = [`${grasps} ${grasps === 1 ? 'grasp' : 'grasps'}`];
    if (reply.gripper) parts.push(reply.gripper.name);
    if (object.faces.length > 0) parts.push(`${count(object.faces.length / 3)} faces`);
    parts.push(milliseconds(reply.timings_ms.total));
    return parts.join(' · ');
}

export const funnelTree = (reply) => funnelPlot(funnelRows(reply));

export function stagesTree(reply) {
    const rows = reply.report.stages.map((stage) => ['tr', {},
        ['th', { scope: 'row' }, stage.name], ['td', { class: 'figure' }, milliseconds(stage.ms)],
        ['td', { class: 'figure' }, count(stage.in)], ['td', { class: 'figure' }, count(stage.out)]]);
    return [stagesPlot(reply.report.stages), ['details', {}, ['summary', {}, 'As a table'],
        ['table', {}, ['thead', {}, ['tr', {}, ['th', { scope: 'col' }, 'stage'],
            ['th', { scope: 'col' }, 'time'], ['th', { scope: 'col' }, 'in'],
            ['th', { scope: 'col' }, 'out']]], ['tbody', {}, rows]]]];
}

export function findingsTree(reply) {
    const { findings, suggestion } = reply.report;
    const list = findings.map((finding) =>
        ['li', {}, ['code', {}, finding.code], ' ', finding.detail || number(finding.value)]);
    return [
        suggestion ? ['p', { class: 'suggestion' }, ['strong', {}, 'Suggestion: '], suggestion]
            : ['p', { class: 'quiet' }, 'No suggestion was asked for.'],
        list.length > 0 ? ['ul', { class: 'findings' }, list]
            : ['p', { class: 'quiet' }, 'Nothing was noticed about the input.'],
    ];
}

function optionRows({ options }) {
    return [
        ['friction', number(options.friction)],
        ['grip force', `${number(options.grip_force_N)} N`],
        ['mass', options.mass_kg === null ? 'by volume' : `${number(options.mass_kg)} kg`],
        ['gravity', options.gravity === null ? 'not given' : vector(options.gravity, 1, 2)],
        ['least clearance', millimetres(options.min_clearance_m)],
        ['most grasps', count(options.max_grasps)],
        ['time budget', milliseconds(1e3 * options.time_budget_s)],
        ['sources', options.sources.join(', ').replaceAll('_', ' ')],
        ['seed', String(options.seed)],
    ];
}

export function requestTree(report) {
    const { request, reply } = report;
    const plane = request.support_plane;
    const rows = [
        ['request id', reply.request_id], ['frame', reply.frame_id],
        ['grippers', request.grippers.join(', ')],
        ...optionRows(request),
        ['support plane', plane ? `normal ${vector(plane.normal, 1, 2)}` : 'none'],
        ['obstacles', count(request.obstacles.length)],
        ['keep-out boxes', count(request.keep_out.length)],
        ['approach cones', request.approach_cones.map((cone) => degrees(cone.half_angle)).join(', ')
            || 'any direction'],
        ['pose convention', reply.convention],
        ['object key', reply.object_key || 'none'],
        ['graspd', reply.planner.version], ['configuration', reply.planner.config_hash],
    ];
    return ['dl', { class: 'facts' }, rows.map(([name, value]) =>
        ['div', {}, ['dt', {}, name], ['dd', {}, value]])];
}
