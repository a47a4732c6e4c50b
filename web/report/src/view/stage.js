/** The 3-D picture's frame: renderer, camera, lights, picking. Draws only when something changed. */

import {
    AmbientLight, Color, DirectionalLight, Group, PerspectiveCamera, Raycaster, Scene, Vector2,
    WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

const CLICK_PIXELS = 5; // a press that moved further is a turn of the camera

export class Stage {
    /**
     * Throws where there is no WebGL.
     * @param {HTMLCanvasElement} canvas
     * @param {{center: number[], radius: number}} bounds of what should be seen
     * @param {{from: Vector3, up: Vector3}} view unit vectors: where the viewer stands, what is up
     */
    constructor(canvas, bounds, view) {
        this.renderer = new WebGLRenderer({ canvas, antialias: true });
        this.canvas = canvas;
        this.scene = new Scene();
        this.camera = new PerspectiveCamera(35, 1, bounds.radius / 100, bounds.radius * 100);
        this.camera.up.copy(view.up);
        this.bounds = bounds;
        this.view = view;
        /** Everything that moves with the object. */
        this.carried = new Group();
        this.scene.add(this.carried);
        this.addLights();
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.addEventListener('change', () => this.invalidate());
        this.pickers = [];
        this.listenForClicks();
        this.home();
        this.watchSize();
        this.watchTheme();
    }

    addLights() {
        this.scene.add(new AmbientLight(0xffffff, 1.3));
        const sun = new DirectionalLight(0xffffff, 2.2);
        sun.position.set(0.6, 0.8, 1.2);
        this.camera.add(sun); // the viewer carries the lamp
        this.scene.add(this.camera);
    }

    /** Looks at everything. */
    home() {
        const { center, radius } = this.bounds;
        const half = ((this.camera.fov / 2) * Math.PI) / 180;
        const narrow = Math.min(1, this.camera.aspect);
        const distance = radius / Math.sin(half) / narrow;
        this.controls.target.set(...center);
        this.camera.position.set(...center).addScaledVector(this.view.from, distance);
        this.controls.update();
        this.invalidate();
    }

    watchSize() {
        new ResizeObserver(() => this.fit()).observe(this.canvas.parentElement);
        this.fit();
        this.home();
    }

    fit() {
        const { clientWidth, clientHeight } = this.canvas.parentElement;
        if (clientWidth === 0 || clientHeight === 0) return;
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
        this.renderer.setSize(clientWidth, clientHeight, false);
        this.camera.aspect = clientWidth / clientHeight;
        this.camera.updateProjectionMatrix();
        this.invalidate();
    }

    watchTheme() {
        const paint = () => {
            const style = getComputedStyle(document.documentElement);
            this.scene.background = new Color(style.getPropertyValue('--stage').trim());
            this.invalidate();
        };
        window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', paint);
        paint();
    }

    /** Asks for one picture; any number of calls before it give one. */
    invalidate() {
        if (this.pending) return;
        this.pending = true;
        requestAnimationFrame(() => {
            this.pending = false;
            this.renderer.render(this.scene, this.camera);
        });
    }

    /** @param {(ray: Raycaster) => {distance: number, act: () => void} | undefined} picker */
    addPicker(picker) {
        this.pickers.push(picker);
    }

    listenForClicks() {
        let pressed = null;
        this.canvas.addEventListener('pointerdown', (event) => {
            pressed = [event.clientX, event.clientY];
        });
        this.canvas.addEventListener('pointerup', (event) => {
            if (!pressed) return;
            const moved = Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]);
            pressed = null;
            if (moved <= CLICK_PIXELS) this.pick(event);
        });
    }

    pick(event) {
        const box = this.canvas.getBoundingClientRect();
        const ray = new Raycaster();
        const place = new Vector2(
            (2 * (event.clientX - box.left)) / box.width - 1,
            1 - (2 * (event.clientY - box.top)) / box.height,
        );
        ray.setFromCamera(place, this.camera);
        const hits = this.pickers.map((picker) => picker(ray)).filter(Boolean);
        hits.sort((a, b) => a.distance - b.distance);
        hits[0]?.act();
    }
}
