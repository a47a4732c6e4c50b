/** What else the request tells of: support plane, obstacles, keep-out boxes; and contacts. */

import {
    ArrowHelper, BoxGeometry, BufferAttribute, BufferGeometry, CircleGeometry, DoubleSide, GridHelper,
    Group, Matrix4, Mesh, MeshBasicMaterial, MeshStandardMaterial, Quaternion, SphereGeometry, Vector3,
} from 'three';

const CONTACT = 0xe11d8f;

function planeGroup({ normal, offset }, origin, bounds) {
    const up = new Vector3(...normal);
    const height = offset - up.dot(new Vector3(...origin));
    const center = new Vector3(...bounds.center);
    const foot = center.clone().addScaledVector(up, height - up.dot(center));
    const group = new Group();
    const disc = new Mesh(
        new CircleGeometry(2.2 * bounds.radius, 64),
        new MeshStandardMaterial({ color: 0x9aa3b2, transparent: true, opacity: 0.35,
            side: DoubleSide, depthWrite: false }),
    );
    const grid = new GridHelper(4.4 * bounds.radius, 20, 0x7c8798, 0x9aa3b2);
    grid.rotateX(Math.PI / 2);
    group.add(disc, grid);
    group.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), up));
    group.position.copy(foot);
    return group;
}

function bodyMesh({ vertices, faces }) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(vertices, 3));
    geometry.setIndex(new BufferAttribute(faces, 1));
    return new Mesh(geometry, new MeshStandardMaterial({ color: 0x8a7a6a, flatShading: true,
        transparent: true, opacity: 0.6, side: DoubleSide }));
}

function boxMesh({ position, rotation, half_extent: half }, origin) {
    const mesh = new Mesh(new BoxGeometry(...half.map((value) => 2 * value)),
        new MeshBasicMaterial({ color: 0xd1495b, wireframe: true }));
    const r = rotation;
    const p = position.map((value, k) => value - origin[k]);
    mesh.applyMatrix4(new Matrix4().set(r[0], r[1], r[2], p[0], r[3], r[4], r[5], p[1], r[6], r[7],
        r[8], p[2], 0, 0, 0, 1));
    return mesh;
}

export function surroundingsGroup(report, bounds) {
    const { request, origin } = report;
    const group = new Group();
    if (request.support_plane) group.add(planeGroup(request.support_plane, origin, bounds));
    for (const obstacle of request.obstacles) group.add(bodyMesh(obstacle));
    for (const box of request.keep_out) group.add(boxMesh(box, origin));
    return group;
}

/** The places where the pads touch, with the surface's normals. */
export function contactsGroup(grasp, origin, radius) {
    const group = new Group();
    for (const { point, normal } of grasp.contacts) {
        const place = new Vector3(...point.map((value, k) => value - origin[k]));
        const ball = new Mesh(new SphereGeometry(radius * 0.028, 16, 12),
            new MeshBasicMaterial({ color: CONTACT, depthTest: false, transparent: true }));
        ball.position.copy(place);
        ball.renderOrder = 3;
        group.add(ball, new ArrowHelper(new Vector3(...normal), place, radius * 0.3, CONTACT,
            radius * 0.08, radius * 0.05));
    }
    return group;
}
