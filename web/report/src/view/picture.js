/** The whole 3-D picture of a report, kept in step with the state. */

import { Group, Vector3 } from 'three';
import { boundsOf, candidatesOf } from '../model.js';
import { motionAt } from '../motion.js';
import { CandidatesView } from './candidates.js';
import { Hand, cornersOf, graspMatrix } from './hand.js';
import { boundariesGroup, hullGroup, objectMesh, regionsGroup } from './object.js';
import { Stage } from './stage.js';
import { contactsGroup, surroundingsGroup } from './surroundings.js';

/** A ball around the object and the hand at the best grasp. */
function viewBounds({ object, hands, reply, origin }) {
    const [grasp] = reply.grasps;
    const hand = grasp ? cornersOf(hands[0].contact, graspMatrix(grasp, origin)) : [];
    const { low, high } = boundsOf(object.vertices);
    const { center, radius } = boundsOf([...low, ...high, ...hand]);
    return { center, radius: 0.9 * radius }; // its corners are empty
}

/** Up is away from the support plane, else z; the viewer sees both fingers of the best grasp. */
function viewOf({ request, reply, origin }) {
    const up = new Vector3(...(request.support_plane?.normal ?? [0, 0, 1]));
    const [grasp] = reply.grasps;
    const from = new Vector3(0.9, -1, 0.6);
    if (grasp) {
        const [x, y, z] = [new Vector3(), new Vector3(), new Vector3()];
        graspMatrix(grasp, origin).extractBasis(x, y, z);
        if (y.dot(up) < 0 || (Math.abs(y.dot(up)) < 0.1 && y.y > 0)) y.negate();
        from.copy(y).addScaledVector(x, 0.4).addScaledVector(z, -0.15);
        from.addScaledVector(up, Math.max(0.35 - from.dot(up), 0));
    }
    return { from: from.normalize(), up };
}

export class Picture {
    /** Throws where there is no WebGL. */
    constructor(canvas, report, state) {
        this.report = report;
        this.state = state;
        this.radius = boundsOf(report.object.vertices).radius;
        this.stage = new Stage(canvas, viewBounds(report), viewOf(report));
        this.object = objectMesh(report.object);
        this.candidates = new CandidatesView(report.candidates);
        this.stage.carried.add(this.object, this.candidates.group);
        this.stage.scene.add(surroundingsGroup(report, boundsOf(report.object.vertices)));
        this.made = {}; // layers that are made when they are first shown
        this.addPickers();
        this.update();
        state.subscribe((changed) => this.update(changed));
    }

    addPickers() {
        this.stage.addPicker((ray) => {
            const hit = this.candidates.pick(ray);
            return hit && { distance: hit.distance, act: () => this.choose(hit.index) };
        });
        this.stage.addPicker((ray) => {
            if (!this.state.layers.hands || !this.made.hands) return undefined;
            const hits = this.made.hands.children.flatMap((node, grasp) =>
                ray.intersectObject(node).map((hit) => ({ distance: hit.distance, grasp })));
            hits.sort((a, b) => a.distance - b.distance);
            return hits[0] && { distance: hits[0].distance,
                act: () => this.state.chooseGrasp(hits[0].grasp) };
        });
    }

    /** A candidate that became a grasp of the reply is chosen as that grasp. */
    choose(index) {
        const rank = candidatesOf(this.report.candidates, '').indexOf(index);
        if (rank >= 0) this.state.chooseGrasp(rank);
        else this.state.chooseCandidate(index);
    }

    layer(name, make) {
        if (this.state.layers[name] && !this.made[name]) {
            this.made[name] = make();
            this.stage.carried.add(this.made[name]);
        }
        if (this.made[name]) this.made[name].visible = this.state.layers[name];
    }

    update(changed = ['layers', 'grasp', 'candidate']) {
        const touches = (...fields) => fields.some((field) => changed.includes(field));
        if (touches('layers', 'hiddenReasons', 'candidate')) {
            this.candidates.update(this.state);
            this.object.visible = this.state.layers.object;
        }
        if (touches('grasp', 'layers')) {
            this.updateLayers();
            this.showGrasp();
        }
        this.showTime();
        this.stage.invalidate();
    }

    search() {
        const name = this.report.reply.grasps[this.state.grasp]?.gripper;
        const { searches } = this.report;
        return searches.find((search) => search.gripper === name) ?? searches[0];
    }

    updateLayers() {
        this.layer('hull', () => hullGroup(this.report.object));
        this.layer('regions', () => regionsGroup(this.search()));
        this.layer('boundaries', () => boundariesGroup(this.search()));
        this.layer('hands', () => this.allHands());
    }

    allHands() {
        const { reply, hands, origin } = this.report;
        const group = new Group();
        hands.forEach((parts, i) =>
            group.add(new Hand(parts, graspMatrix(reply.grasps[i], origin), true).group));
        return group;
    }

    showGrasp() {
        const { reply, hands, origin } = this.report;
        this.hand?.group.removeFromParent();
        this.contacts?.removeFromParent();
        this.hand = this.contacts = undefined;
        const grasp = reply.grasps[this.state.grasp];
        if (!grasp) return;
        this.hand = new Hand(hands[this.state.grasp], graspMatrix(grasp, origin));
        this.stage.scene.add(this.hand.group);
        this.contacts = contactsGroup(grasp, origin, this.radius);
        this.contacts.visible = this.state.layers.contacts;
        this.stage.carried.add(this.contacts);
    }

    showTime() {
        const grasp = this.report.reply.grasps[this.state.grasp];
        if (!grasp || !this.hand) return;
        const motion = motionAt(this.state.time, grasp);
        this.hand.group.position.set(...motion.hand);
        this.hand.close(motion.closed);
        this.stage.carried.position.set(...motion.object);
    }
}
