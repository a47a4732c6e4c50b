/** A gripper's real parts at a grasp, from open to closed. */

import {
    BoxGeometry, BufferGeometry, DoubleSide, EdgesGeometry, Float32BufferAttribute, Group,
    LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshStandardMaterial, Vector3,
} from 'three';
import { ConvexGeometry } from 'three/addons/geometries/ConvexGeometry.js';
import { pointAt } from '../arrays.js';

const PALM = 0x5a6170;
const FINGER = 0xdb9e33;

/** Matrix of the grasp frame from the reply's row-major rotation and position. */
export function graspMatrix(grasp, origin) {
    const r = grasp.rotation;
    const p = grasp.position.map((value, k) => value - origin[k]);
    return new Matrix4().set(r[0], r[1], r[2], p[0], r[3], r[4], r[5], p[1], r[6], r[7], r[8], p[2],
        0, 0, 0, 1);
}

/** Corners of all parts in the frame of the matrix, flat. */
export function cornersOf(parts, matrix) {
    const flat = [];
    const add = (x, y, z) => flat.push(...new Vector3(x, y, z).applyMatrix4(matrix));
    for (const { box, points } of parts) {
        if (points) for (let i = 0; i < points.length; i += 3) add(...points.slice(i, i + 3));
        else for (let k = 0; k < 8; ++k) {
            add(...[0, 1, 2].map((axis) => ((k >> axis) & 1 ? box.max : box.min)[axis]));
        }
    }
    return flat;
}

const mix = (a, b, share) => a + share * (b - a);

/** A box between its places when open and at contact. */
class BoxPart {
    constructor(open, contact, material) {
        this.open = open.box;
        this.contact = contact.box;
        this.node = new Mesh(new BoxGeometry(1, 1, 1), material);
        const edges = new LineBasicMaterial({ color: 0x22262e, transparent: true, opacity: 0.5 });
        this.node.add(new LineSegments(new EdgesGeometry(this.node.geometry), edges));
    }

    close(share) {
        const low = this.open.min.map((value, k) => mix(value, this.contact.min[k], share));
        const high = this.open.max.map((value, k) => mix(value, this.contact.max[k], share));
        this.node.position.set(...low.map((value, k) => (value + high[k]) / 2));
        this.node.scale.set(...low.map((value, k) => high[k] - value));
    }
}

const keyOf = (x, y, z) => [x, y, z].map((value) => Math.round(value * 1e7)).join();

/** A convex part: the hull of its points, each of which moves straight. */
class ConvexPart {
    constructor(open, contact, material) {
        const count = contact.points.length / 3;
        const points = [];
        const index = new Map();
        for (let i = 0; i < count; ++i) {
            points.push(new Vector3(...pointAt(contact.points, i)));
            index.set(keyOf(...pointAt(contact.points, i)), i);
        }
        const corners = new ConvexGeometry(points).getAttribute('position');
        this.source = Array.from({ length: corners.count }, (_, i) =>
            index.get(keyOf(corners.getX(i), corners.getY(i), corners.getZ(i))));
        this.open = open.points;
        this.contact = contact.points;
        const geometry = new BufferGeometry();
        geometry.setAttribute('position', new Float32BufferAttribute(corners.array.slice(), 3));
        this.node = new Mesh(geometry, material);
        this.node.frustumCulled = false; // its points move
    }

    close(share) {
        const positions = this.node.geometry.getAttribute('position');
        this.source.forEach((from, i) => {
            const at = (k) => mix(this.open[3 * from + k], this.contact[3 * from + k], share);
            positions.setXYZ(i, at(0), at(1), at(2));
        });
        positions.needsUpdate = true;
    }
}

export class Hand {
    /**
     * @param {{open: object[], contact: object[]}} parts in G
     * @param {Matrix4} X_FG
     * @param {boolean} pale one of many
     */
    constructor(parts, X_FG, pale = false) {
        this.group = new Group();
        this.frame = new Group();
        this.frame.applyMatrix4(X_FG);
        this.group.add(this.frame);
        this.parts = parts.contact.map((contact, i) => {
            const material = new MeshStandardMaterial({
                color: contact.member === 'palm' ? PALM : FINGER, roughness: 0.6, flatShading: true,
                transparent: true, opacity: pale ? 0.16 : contact.member === 'palm' ? 0.5 : 0.88, depthWrite: !pale, side: DoubleSide,
            });
            const Part = contact.points ? ConvexPart : BoxPart;
            const part = new Part(parts.open[i], contact, material);
            this.frame.add(part.node);
            return part;
        });
        this.close(1);
    }

    /** @param {number} share 0: pre-shape, 1: pads touch */
    close(share) {
        for (const part of this.parts) part.close(share);
    }
}
