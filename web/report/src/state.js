/** What is chosen and shown; views subscribe to changes. */

export const LAYERS = {
    object: { label: 'object', key: 'o', on: true },
    hull: { label: 'convex hull', key: 'u', on: false },
    regions: { label: 'concave regions', key: 'r', on: false },
    boundaries: { label: 'boundaries', key: 'b', on: false },
    candidates: { label: 'candidates', key: 'c', on: false },
    hands: { label: 'all hands', key: 'a', on: false },
    contacts: { label: 'contacts', key: 'n', on: true },
};

export class State {
    /** @param {number} grasps how many there are to choose from */
    constructor(grasps) {
        this.grasps = grasps;
        this.grasp = grasps > 0 ? 0 : -1;
        this.candidate = -1; // chosen candidate; -1: none
        this.time = 0.6; // in [0, 1] of the motion; 0.6: closed
        this.playing = false;
        this.layers = Object.fromEntries(Object.entries(LAYERS).map(([name, l]) => [name, l.on]));
        this.hiddenReasons = new Set();
        this.listeners = [];
    }

    subscribe(listener) {
        this.listeners.push(listener);
    }

    /** Sets some fields and tells everybody which. */
    set(changes) {
        Object.assign(this, changes);
        for (const listener of this.listeners) listener(Object.keys(changes));
    }

    chooseGrasp(index) {
        if (index < 0 || index >= this.grasps) return;
        this.set({ grasp: index, candidate: -1 });
    }

    /** The next grasp, or an earlier one; the list ends at both ends. */
    step(by) {
        if (this.grasps === 0) return;
        this.chooseGrasp(Math.min(Math.max(this.grasp + by, 0), this.grasps - 1));
    }

    chooseCandidate(index) {
        this.set({ candidate: index });
    }

    toggleLayer(name) {
        this.set({ layers: { ...this.layers, [name]: !this.layers[name] } });
    }

    toggleReason(reason) {
        const hidden = new Set(this.hiddenReasons);
        if (!hidden.delete(reason)) hidden.add(reason);
        this.set({ hiddenReasons: hidden });
    }

    /** Goes on playing, from the beginning where the end was reached. */
    togglePlay() {
        if (this.grasp < 0) return;
        const time = !this.playing && this.time >= 1 ? 0 : this.time;
        this.set({ playing: !this.playing, time });
    }
}
