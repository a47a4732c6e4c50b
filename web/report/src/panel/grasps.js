/** The list of grasps. */

import { mount } from '../dom.js';
import { millimetres, number } from '../format.js';

function row(grasp, i, state) {
    return ['li', { role: 'option', id: `grasp-${i}`, 'aria-selected': 'false', tabindex: '-1',
        onclick: () => state.chooseGrasp(i) },
    ['span', { class: 'rank' }, `#${grasp.rank}`],
    ['span', { class: 'meter', 'aria-hidden': 'true' },
        ['span', { style: `width:${(100 * grasp.score).toFixed(1)}%` }]],
    ['span', { class: 'score' }, grasp.score.toFixed(3)],
    ['span', { class: 'source' }, grasp.source.replaceAll('_', ' ')],
    ['span', { class: 'width' }, millimetres(grasp.width)]];
}

/** Fills a list element and keeps its selection in step with the state. */
export function graspList(element, reply, state) {
    const rows = reply.grasps.map((grasp, i) => mount(row(grasp, i, state)));
    element.append(...rows);
    const select = () => {
        rows.forEach((node, i) => {
            const chosen = i === state.grasp && state.candidate < 0;
            node.setAttribute('aria-selected', String(chosen));
        });
        if (state.grasp < 0) return;
        element.setAttribute('aria-activedescendant', `grasp-${state.grasp}`);
        const node = rows[state.grasp];
        const [top, bottom] = [node.offsetTop, node.offsetTop + node.offsetHeight];
        if (top < element.scrollTop) element.scrollTop = top;
        else if (bottom > element.scrollTop + element.clientHeight) {
            element.scrollTop = bottom - element.clientHeight;
        }
    };
    state.subscribe((changed) => {
        if (changed.includes('grasp') || changed.includes('candidate')) select();
    });
    select();
    element.setAttribute('aria-label',
        `${reply.grasps.length} grasps, the best scores ${number(reply.grasps[0]?.score ?? 0)}`);
}
