/** The object with its concavity, its hull, its regions and their boundaries. */

import {
    BufferAttribute, BufferGeometry, DataTexture, DoubleSide, Group, LineBasicMaterial, LineSegments,
    LinearFilter, Mesh, MeshStandardMaterial, Points, PointsMaterial, SRGBColorSpace, EdgesGeometry,
    Vector3,
} from 'three';
import { ConvexGeometry } from 'three/addons/geometries/ConvexGeometry.js';
import { pointAt } from '../arrays.js';
import { textureBytes, textureU } from '../colours.js';
import { largestConcavity } from '../model.js';

const SALIENT = 0xd8202a;
const ENLARGED = 0xf2b632;
const BOUNDARY = 0x111827;
const STEP = 0xffffff;

function concavityTexture() {
    const bytes = textureBytes();
    const texture = new DataTexture(bytes, bytes.length / 4, 1);
    texture.colorSpace = SRGBColorSpace;
    texture.magFilter = LinearFilter;
    texture.needsUpdate = true;
    return texture;
}

/** @returns {Mesh} coloured by concavity; whether it shows the colours can be changed */
export function objectMesh({ vertices, faces, concavity }) {
    const geometry = new BufferGeometry();
    const largest = largestConcavity(concavity);
    const uv = new Float32Array(2 * concavity.length).fill(0.5);
    concavity.forEach((value, i) => (uv[2 * i] = textureU(value, largest)));
    geometry.setAttribute('position', new BufferAttribute(vertices, 3));
    geometry.setAttribute('uv', new BufferAttribute(uv, 2));
    geometry.setIndex(new BufferAttribute(faces, 1));
    const material = new MeshStandardMaterial({
        map: concavityTexture(), roughness: 0.75, flatShading: true, side: DoubleSide,
        polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    });
    return new Mesh(geometry, material);
}

/** The convex hull as a veil with its edges. */
export function hullGroup({ vertices, hull }) {
    const points = Array.from(hull, (i) => new Vector3(...pointAt(vertices, i)));
    const group = new Group();
    if (points.length < 4) return group;
    const geometry = new ConvexGeometry(points);
    const veil = new MeshStandardMaterial({
        color: 0x7aa2d6, transparent: true, opacity: 0.16, side: DoubleSide, depthWrite: false,
    });
    const edges = new LineBasicMaterial({ color: 0x5b83b8, transparent: true, opacity: 0.55 });
    group.add(new Mesh(geometry, veil), new LineSegments(new EdgesGeometry(geometry, 8), edges));
    return group;
}

function cloud(positions, color, size) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    return new Points(geometry, new PointsMaterial({ color, size }));
}

function gather(points, indices) {
    const out = new Float32Array(3 * indices.length);
    indices.forEach((index, i) => out.set(pointAt(points, index), 3 * i));
    return out;
}

/** Salient samples (red) and their surroundings (yellow) of all concavities of a search. */
export function regionsGroup(search) {
    const group = new Group();
    if (!search) return group;
    for (const { salient, enlarged } of search.concavities) {
        const inner = new Set(salient);
        const around = enlarged.filter((i) => !inner.has(i));
        group.add(cloud(gather(search.points, around), ENLARGED, 0.45 * search.spacing));
        group.add(cloud(gather(search.points, salient), SALIENT, 0.6 * search.spacing));
    }
    return group;
}

/** Pairs of neighbours of an ordered boundary; where it jumps there is no line. */
export function segmentsOf(points, longest) {
    const segments = [];
    for (let i = 3; i < points.length; i += 3) {
        const length = Math.hypot(points[i] - points[i - 3], points[i + 1] - points[i - 2],
            points[i + 2] - points[i - 1]);
        if (length <= longest) segments.push(...points.slice(i - 3, i + 3));
    }
    return new Float32Array(segments);
}

/** Ordered boundaries (lines) and their step points. */
export function boundariesGroup(search) {
    const group = new Group();
    if (!search) return group;
    for (const { points, steps } of search.boundaries) {
        const geometry = new BufferGeometry();
        const segments = segmentsOf(points, 4 * search.spacing);
        geometry.setAttribute('position', new BufferAttribute(segments, 3));
        const line = new LineBasicMaterial({ color: BOUNDARY, depthTest: false });
        const dots = cloud(steps, STEP, 0.9 * search.spacing);
        dots.material.depthTest = false;
        group.add(new LineSegments(geometry, line), dots);
    }
    group.renderOrder = 2;
    return group;
}
