/** Buttons that show and hide layers, and the scale of concavity. */

import { cssGradient, scaleMarks } from '../colours.js';
import { mount } from '../dom.js';
import { number } from '../format.js';
import { largestConcavity } from '../model.js';
import { LAYERS } from '../state.js';

export function layerButtons(element, state) {
    const buttons = Object.entries(LAYERS).map(([name, layer]) => {
        const button = mount(['button', { type: 'button', title: `key ${layer.key.toUpperCase()}`,
            onclick: () => state.toggleLayer(name) }, layer.label]);
        return [name, button];
    });
    const show = () => buttons.forEach(([name, button]) =>
        button.setAttribute('aria-pressed', String(state.layers[name])));
    element.append(...buttons.map(([, button]) => button));
    state.subscribe((changed) => changed.includes('layers') && show());
    show();
}

/** The scale in mm, and in which colour enclosed vertices are, if there are any. */
export function scaleTree(object) {
    const largest = largestConcavity(object.concavity);
    const marks = largest > 0 ? scaleMarks(largest) : [];
    const enclosed = object.concavity.includes(Infinity);
    return ['div', { class: 'scale', role: 'img',
        'aria-label': `Concavity from 0 (blue) to ${number(1e3 * largest)} mm (red)` },
    ['span', { class: 'title' }, largest > 0 ? 'concavity [mm]' : 'convex: no concavity'],
    largest > 0 && ['span', { class: 'ramp', style: `background:${cssGradient()}` }],
    largest > 0 && ['span', { class: 'marks' }, marks.map((mark) =>
        ['span', { style: `left:${((100 * mark) / largest).toFixed(2)}%` }, number(1e3 * mark, 2)])],
    enclosed && ['span', { class: 'title' }, 'purple: enclosed']];
}
