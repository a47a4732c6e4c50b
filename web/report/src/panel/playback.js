/** Play, pause and the slider of the motion. */

import { DURATION_S, phaseAt } from '../motion.js';

/** @param {{button: HTMLButtonElement, slider: HTMLInputElement, phase: HTMLElement}} parts */
export function playback({ button, slider, phase }, state) {
    let last = 0;
    const tick = (now) => {
        if (!state.playing) return;
        const time = Math.min(1, state.time + (now - last) / 1000 / DURATION_S);
        last = now;
        state.set(time >= 1 ? { time, playing: false } : { time });
        requestAnimationFrame(tick);
    };
    button.addEventListener('click', () => state.togglePlay());
    slider.addEventListener('input', () =>
        state.set({ time: slider.valueAsNumber, playing: false }));
    const show = () => {
        slider.value = String(state.time);
        const name = phaseAt(state.time).name;
        phase.textContent = name;
        slider.setAttribute('aria-valuetext', name);
        button.textContent = state.playing ? '❚❚' : '▶';
        button.setAttribute('aria-label', state.playing ? 'pause' : 'play');
    };
    state.subscribe((changed) => {
        if (changed.includes('playing') && state.playing) {
            last = performance.now();
            requestAnimationFrame(tick);
        }
        if (changed.includes('playing') || changed.includes('time')) show();
    });
    show();
}
