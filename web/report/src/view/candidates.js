/** All candidates as instances of two small shapes: a bar for a closing axis, a fork for a hand. */

import {
    BoxGeometry, Color, DynamicDrawUsage, Group, InstancedMesh, Matrix4, MeshStandardMaterial,
    Quaternion, Vector3,
} from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import { pointAt } from '../arrays.js';
import { colourOf } from '../reasons.js';

const THICK_M = 0.0011;
const CHOSEN = new Color(0xff00c8);

const bar = () => new BoxGeometry(1, THICK_M, THICK_M);

/** Fingers at +-1/2 along x (scaled by the width), a bridge behind them, a stem. Lengths in m. */
function fork() {
    const finger = (side) => new BoxGeometry(0.04, THICK_M, 0.02).translate(side * 0.5, 0, -0.008);
    const bridge = new BoxGeometry(1.04, THICK_M, THICK_M).translate(0, 0, -0.018);
    const stem = new BoxGeometry(0.04, THICK_M, 0.014).translate(0, 0, -0.025);
    return mergeGeometries([finger(-1), finger(1), bridge, stem]);
}

/** Whether a reason is that of an axis on which no hand was tried. */
export const isAxis = (reason) => reason.startsWith('axis_');

/** Instances of one shape. */
class Swarm {
    constructor(geometry, indices, candidates) {
        this.candidates = candidates;
        this.indices = indices;
        this.shown = [];
        const material = new MeshStandardMaterial({ roughness: 0.8 });
        this.mesh = new InstancedMesh(geometry, material, Math.max(indices.length, 1));
        this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
        this.mesh.frustumCulled = false;
        this.mesh.count = 0;
    }

    matrixOf(i, matrix) {
        const q = this.candidates.quaternion.subarray(4 * i, 4 * i + 4);
        const width = Math.max(this.candidates.width[i], 0.002);
        return matrix.compose(new Vector3(...pointAt(this.candidates.position, i)),
            new Quaternion(...q), new Vector3(width, 1, 1));
    }

    /** @param {(i: number) => boolean} wanted @param {number} chosen */
    show(wanted, chosen, colours) {
        this.shown = this.indices.filter((i) => i === chosen || wanted(i));
        const matrix = new Matrix4();
        this.shown.forEach((i, place) => {
            this.mesh.setMatrixAt(place, this.matrixOf(i, matrix));
            this.mesh.setColorAt(place, i === chosen ? CHOSEN : colours[this.candidates.reason[i]]);
        });
        this.mesh.count = this.shown.length;
        this.mesh.instanceMatrix.needsUpdate = true;
        if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
        this.mesh.computeBoundingSphere();
    }
}

export class CandidatesView {
    constructor(candidates) {
        this.candidates = candidates;
        this.colours = candidates.reasons.map((reason) => new Color(colourOf(reason)));
        const axis = candidates.reasons.map(isAxis);
        const all = Array.from({ length: candidates.count }, (_, i) => i);
        this.swarms = [
            new Swarm(bar(), all.filter((i) => axis[candidates.reason[i]]), candidates),
            new Swarm(fork(), all.filter((i) => !axis[candidates.reason[i]]), candidates),
        ];
        this.group = new Group();
        this.group.add(...this.swarms.map((swarm) => swarm.mesh));
    }

    /** Shows the candidates of a layer that is on, less the hidden reasons, and the chosen one. */
    update({ layers, hiddenReasons, candidate }) {
        const hidden = this.candidates.reasons.map((reason) => hiddenReasons.has(reason));
        const wanted = (i) => layers.candidates && !hidden[this.candidates.reason[i]];
        for (const swarm of this.swarms) swarm.show(wanted, candidate, this.colours);
    }

    /** The candidate that a ray meets first. */
    pick(ray) {
        let nearest;
        for (const swarm of this.swarms) {
            for (const hit of ray.intersectObject(swarm.mesh)) {
                if (nearest && nearest.distance <= hit.distance) continue;
                nearest = { distance: hit.distance, index: swarm.shown[hit.instanceId] };
            }
        }
        return nearest;
    }
}
