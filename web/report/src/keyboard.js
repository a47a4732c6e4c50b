/** Keys. A pure table first, so that the help and the handler say the same. */

import { LAYERS } from './state.js';

export const KEYS = [
    { keys: ['ArrowDown', 'ArrowRight'], shown: '↓ →', help: 'next grasp', act: (s) => s.step(1) },
    { keys: ['ArrowUp', 'ArrowLeft'], shown: '↑ ←', help: 'previous grasp', act: (s) => s.step(-1) },
    { keys: ['Home'], shown: 'Home', help: 'best grasp', act: (s) => s.chooseGrasp(0) },
    { keys: [' '], shown: 'Space', help: 'play or pause', act: (s) => s.togglePlay() },
    ...Object.entries(LAYERS).map(([name, layer]) => ({
        keys: [layer.key],
        shown: layer.key.toUpperCase(),
        help: `show or hide ${layer.label}`,
        act: (s) => s.toggleLayer(name),
    })),
];

/** What a key does; undefined: nothing. */
export function actionOf(key) {
    return KEYS.find((entry) => entry.keys.includes(key.length === 1 ? key.toLowerCase() : key));
}

/** Whether a focused element needs the key for itself. */
function wantsKey(element, key) {
    if (element.closest('dialog:not([open])')) return false; // keeps the focus for a moment
    if (element.matches('input[type=range]')) return key.startsWith('Arrow') || key === 'Home';
    if (element.matches('input, select, textarea')) return true;
    return key === ' ' && element.matches('button, summary, a, label');
}

/** @param {import('./state.js').State} state @param {HTMLDialogElement} help */
export function listen(state, help) {
    document.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        if (help.open || wantsKey(event.target, event.key)) return;
        if (event.key === '?') return help.showModal();
        if (event.key === 'Escape') return state.chooseCandidate(-1);
        const action = actionOf(event.key);
        if (!action) return;
        event.preventDefault();
        action.act(state);
    });
}
