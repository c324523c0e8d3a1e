/** Controls for drawings in space: the axis gizmo, perspective, fading with distance, and the turntable. */

import { axes, turned } from './camera.js';
import { setPlaces } from './marks.js';
import { button, byId, reducedMotion, html, input } from '../base/dom.js';

/** @typedef {import('../state/state.js').State} State */
/** @typedef {import('../state/state.js').Camera} Camera */

/** Speed of the turntable, in degrees per second: a full turn takes 15 s. */
const PACE = 24;
/** One step of the turntable with reduced motion, in degrees. */
const STEP = 30;
/** The azimuth and elevation from which each axis points at the viewer. @type {Record<string, [number, number]>} */
const SIDES = { x: [90, 0], y: [0, 90], z: [0, 0] };
/** Length of the gizmo's axes, in SVG units. */
const ARM = 21;

/**
 * @param {import('../state/store.js').Store} store
 * @param {{glideTo: (camera: Camera) => void, camera: () => Camera}} stage
 */
export function createOrbit(store, stage) {
    const tools = html('space-tools');
    const gizmo = byId('gizmo', SVGSVGElement);
    const turntable = button('turntable');
    const perspective = button('perspective');
    const fade = input('fade');
    let turning = 0;
    let last = 0;

    const { camera } = stage;

    function stop() {
        cancelAnimationFrame(turning);
        turning = 0;
        turntable.setAttribute('aria-pressed', 'false');
    }

    /** @param {number} now */
    function turn(now) {
        const passed = Math.min(100, now - last) / 1000;
        last = now;
        store.setCamera(turned(camera(), camera().azimuth - PACE * passed, camera().elevation));
        turning = requestAnimationFrame(turn);
    }

    turntable.addEventListener('click', () => {
        if (turning) return stop();
        if (reducedMotion()) return store.setCamera(turned(camera(), camera().azimuth - STEP, camera().elevation));
        turntable.setAttribute('aria-pressed', 'true');
        last = performance.now();
        turning = requestAnimationFrame(turn);
    });
    perspective.addEventListener('click', () => store.setCamera({ ...camera(), perspective: !camera().perspective }));
    fade.addEventListener('input', () => store.setCamera({ ...camera(), fade: fade.valueAsNumber / 100 }));
    for (const knob of gizmo.querySelectorAll('g')) {
        const side = SIDES[knob.dataset.axis ?? ''];
        knob.addEventListener('click', () => {
            if (!side) return;
            stop();
            stage.glideTo(turned(camera(), side[0], side[1]));
        });
    }

    /** Turns the gizmo with the drawing, the nearest axis on top. */
    function draw() {
        const [right, up, back] = axes(camera());
        const knobs = [...gizmo.querySelectorAll('g')].map((knob) => {
            const axis = 'xyz'.indexOf(knob.dataset.axis ?? 'x');
            return { knob, x: (right[axis] ?? 0) * ARM, y: -(up[axis] ?? 0) * ARM, near: back[axis] ?? 0 };
        });
        knobs.sort((a, b) => a.near - b.near);
        for (const [place, { knob, x, y, near }] of knobs.entries()) {
            setPlaces(knob.querySelector('line'), { x2: x, y2: y });
            setPlaces(knob.querySelector('circle'), { cx: x, cy: y });
            setPlaces(knob.querySelector('text'), { x, y });
            knob.setAttribute('opacity', (0.7 + 0.3 * near).toFixed(2));
            if (gizmo.children[place] !== knob) gizmo.insertBefore(knob, gizmo.children[place] ?? null);
        }
    }

    return {
        /** @param {import('../protocol.js').Report} report */
        report({ ok, space }) {
            if (!ok) return;
            tools.hidden = !space;
            if (!space) stop();
            else draw();
        },
        /** @param {Readonly<State>} state @param {Readonly<State> | null} before */
        show(state, before) {
            perspective.setAttribute('aria-pressed', String(camera().perspective));
            const percent = String(Math.round(camera().fade * 100));
            if (fade.value !== percent) fade.value = percent;
            if (!tools.hidden && before?.camera !== state.camera) draw();
        },
    };
}
