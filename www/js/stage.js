/**
 * The drawing: shows what the worker has painted, and moves that picture at once when the reader pans or zooms, until
 * the worker has painted anew.
 */

import { FRONT, isWhole, midway, orbit, slide, whole, zoomed } from './camera.js';
import { calm, button, byId, html, setText } from './dom.js';
import { zoomText } from './numerals.js';
import { FITTED, between, pan, placement, zoomAt } from './view.js';

/** @typedef {import('./state.js').View} View */
/** @typedef {import('./state.js').Camera} Camera */
/** @typedef {import('./engine.js').Drawn} Drawn */
/** @typedef {import('./protocol.js').Canvas} Canvas */

const MOST_RATIO = 3;
/** One press of a zoom key or button. */
const ZOOM_STEP = 1.5;
/** One press of an arrow, as a part of the drawing's shorter side. */
const PAN_STEP = 0.1;
/** One press of an arrow in space, in CSS pixels of dragging. */
const ORBIT_STEP = 25;
const GLIDE_MS = 260;
/** What takes longer is shown to be under way. */
const SLOW_MS = 300;

/**
 * @param {import('./store.js').Store} store
 * @param {import('./engine.js').Engine} engine
 * @param {{look: (sight: import('./marks.js').Sight | null) => void}} marks what moves with the picture
 * @param {{takes?: (event: Event) => boolean, keys?: () => readonly ('angle' | 'iterations')[]}} [page]
 *   `takes` tells which gestures are the drawing's, rather than of the page it stands in; `keys` what arrows change
 */
export function createStage(store, engine, marks, { takes = () => true, keys = () => ['angle', 'iterations'] } = {}) {
    const frame = html('stage');
    const canvas = byId('drawing', HTMLCanvasElement);
    const context = /** @type {ImageBitmapRenderingContext} */ (canvas.getContext('bitmaprenderer', { alpha: false }));
    /** CSS pixels. */
    let size = { width: 0, height: 0 };
    let ratio = 1;
    /** What the canvas shows; its size in CSS pixels, its scale in CSS pixels per fitted extent. @type {{view: View, scale: number, size: {width: number, height: number}} | null} */
    let drawn = null;
    let glide = 0;
    let slow = 0;
    /** Whether the drawing is one in space. */
    let solid = false;

    const view = () => store.state.view ?? FITTED;
    const camera = () => store.state.camera ?? FRONT;
    const scale = () => drawn?.scale ?? 1;
    /** @returns {Canvas} */
    const resolution = () => ({ width: Math.max(1, Math.round(size.width * ratio)), height: Math.max(1, Math.round(size.height * ratio)), ratio });

    new ResizeObserver(measure).observe(frame);
    watchRatio();
    measure();

    function measure() {
        size = { width: frame.clientWidth, height: frame.clientHeight };
        ratio = Math.min(MOST_RATIO, devicePixelRatio || 1);
        if (size.width === 0 || size.height === 0) return;
        place();
        engine.look(resolution(), view(), camera());
    }

    function watchRatio() {
        matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener(
            'change',
            () => {
                measure();
                watchRatio();
            },
            { once: true },
        );
    }

    /** Puts the picture where the present view has it. */
    function place() {
        if (!drawn) return;
        if (solid) {
            // No other picture stands for one from another side.
            marks.look({ view: view(), camera: camera(), scale: drawn.scale, size });
            canvas.style.transform = 'none';
            return;
        }
        marks.look({ view: view(), camera: null, scale: drawn.scale, size });
        const at = placement(drawn.view, view(), drawn.scale);
        const x = size.width / 2 + at.x - (drawn.size.width / 2) * at.factor;
        const y = size.height / 2 + at.y - (drawn.size.height / 2) * at.factor;
        const still = Math.abs(x) < 0.01 && Math.abs(y) < 0.01 && Math.abs(at.factor - 1) < 1e-6;
        canvas.style.transform = still ? 'none' : `translate(${x}px, ${y}px) scale(${at.factor})`;
    }

    /** @param {View} next */
    function look(next) {
        cancelAnimationFrame(glide);
        store.look(next);
    }

    /** Moves to a view smoothly; null is the fitted one. @param {View | null} target */
    function glideTo(target) {
        const from = view();
        const to = target ?? FITTED;
        glideBy((part) => store.look(part < 1 ? between(from, to, part) : target));
    }

    /** @param {Camera} next */
    function aim(next) {
        cancelAnimationFrame(glide);
        store.aim(next);
    }

    /** Moves the camera smoothly. @param {Camera} target */
    function glideRound(target) {
        const from = camera();
        glideBy((part) => store.aim(part < 1 ? midway(from, target, part) : target));
    }

    /** @param {(part: number) => void} move goes so much of its way, from 0 to 1 */
    function glideBy(move) {
        cancelAnimationFrame(glide);
        if (calm() || !drawn) return move(1);
        const start = performance.now();
        const tick = (/** @type {number} */ now) => {
            const t = Math.min(1, Math.max(0, (now - start) / GLIDE_MS));
            move(t < 1 ? 1 - (1 - t) ** 3 : 1);
            if (t < 1) glide = requestAnimationFrame(tick);
        };
        glide = requestAnimationFrame(tick);
    }

    const fit = () => (solid ? glideRound(whole(camera())) : glideTo(null));
    /** @param {number} factor */
    const zoom = (factor) => (solid ? glideRound(zoomed(camera(), factor, 0, 0, scale())) : glideTo(zoomAt(view(), factor, 0, 0, scale())));

    button('fit').addEventListener('click', fit);
    button('zoom-in').addEventListener('click', () => zoom(ZOOM_STEP));
    button('zoom-out').addEventListener('click', () => zoom(1 / ZOOM_STEP));

    gestures(canvas, {
        takes,
        drag: (dx, dy, aside) => {
            if (!solid) look(pan(view(), dx, dy, scale()));
            else aim(aside ? slide(camera(), dx, dy, scale()) : orbit(camera(), dx, dy));
        },
        zoom: (factor, x, y) => {
            const box = frame.getBoundingClientRect();
            const [px, py] = [x - box.left - size.width / 2, y - box.top - size.height / 2];
            if (solid) aim(zoomed(camera(), factor, px, py, scale()));
            else look(zoomAt(view(), factor, px, py, scale()));
        },
        fit,
    });

    canvas.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.metaKey) return;
        const act = keyAction(event);
        if (!act) return;
        event.preventDefault();
        act();
    });

    /** @param {KeyboardEvent} event @returns {(() => void) | undefined} */
    function keyAction({ key, shiftKey, altKey }) {
        const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key];
        const by = PAN_STEP * Math.min(size.width, size.height);
        if (arrow && shiftKey && solid) return () => aim(orbit(camera(), -(arrow[0] ?? 0) * ORBIT_STEP, (arrow[1] ?? 0) * ORBIT_STEP));
        if (arrow && shiftKey) return () => look(pan(view(), -(arrow[0] ?? 0) * by, (arrow[1] ?? 0) * by, scale()));
        const turn = altKey ? 0.1 : 1;
        if (arrow && !keys().includes(arrow[0] ? 'angle' : 'iterations')) return undefined;
        const { angle, iterations } = store.state;
        switch (key) {
            case 'ArrowLeft':
                return () => store.change({ angle: Number((angle - turn).toFixed(6)) }, 'angle');
            case 'ArrowRight':
                return () => store.change({ angle: Number((angle + turn).toFixed(6)) }, 'angle');
            case 'ArrowUp':
                return () => store.change({ iterations: iterations + 1 }, 'iterations');
            case 'ArrowDown':
                return () => store.change({ iterations: iterations - 1 }, 'iterations');
            case '+':
            case '=':
                return () => zoom(ZOOM_STEP);
            case '-':
                return () => zoom(1 / ZOOM_STEP);
            case '0':
                return fit;
            default:
                return undefined;
        }
    }

    /** @param {boolean} under whether a drawing or its fine picture is being made */
    function growing(under) {
        clearTimeout(slow);
        if (under) slow = window.setTimeout(() => (html('busy').hidden = false), SLOW_MS);
        else html('busy').hidden = true;
    }

    return {
        resolution,

        /** @param {import('./state.js').State} state @param {import('./state.js').State | null} before */
        show(state, before) {
            setText(html('zoom'), zoomText((solid ? camera() : view()).zoom));
            button('fit').setAttribute('aria-pressed', String(solid ? isWhole(camera()) : state.view === null));
            if (before && before.view === state.view && before.camera === state.camera) return;
            place();
            engine.look(resolution(), view(), camera());
        },

        /** Learns whether the drawing is one in space. @param {import('./protocol.js').Report} report */
        report(report) {
            if (!report.ok || solid === report.solid) return;
            solid = report.solid;
            frame.classList.toggle('solid', solid);
            this.show(store.state, null);
        },

        /** Goes round a drawing in space. @param {Camera} target */
        glide: glideRound,

        growing,

        /** @param {Drawn} picture */
        drawn({ bitmap, scale: deviceScale, view: from, canvas: made, complete }) {
            if (canvas.width !== bitmap.width) canvas.width = bitmap.width;
            if (canvas.height !== bitmap.height) canvas.height = bitmap.height;
            // While a drawing in space moves there may be fewer pixels than asked for.
            const { width, height } = solid ? made : bitmap;
            drawn = { view: from, scale: deviceScale / made.ratio, size: { width: width / made.ratio, height: height / made.ratio } };
            context.transferFromImageBitmap(bitmap);
            canvas.style.width = `${drawn.size.width}px`;
            canvas.style.height = `${drawn.size.height}px`;
            frame.classList.add('inked');
            growing(!complete);
            place();
        },
    };
}

/**
 * Pointer, wheel and pinch, as drags and zooms in client coordinates.
 * @param {HTMLElement} element
 * @param {{takes: (event: Event) => boolean, drag: (dx: number, dy: number, aside: boolean) => void, zoom: (factor: number, x: number, y: number) => void, fit: () => void}} act
 */
function gestures(element, { takes, drag, zoom, fit }) {
    /** @type {Map<number, {x: number, y: number}>} */
    const pointers = new Map();

    element.addEventListener('pointerdown', (event) => {
        if (event.button !== 0 || !takes(event)) return;
        element.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        element.classList.add('held');
    });
    element.addEventListener('pointermove', (event) => {
        const was = pointers.get(event.pointerId);
        if (!was) return;
        const now = { x: event.clientX, y: event.clientY };
        pointers.set(event.pointerId, now);
        const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
        if (!other) return drag(now.x - was.x, now.y - was.y, event.shiftKey);
        const apart = (/** @type {{x: number, y: number}} */ a) => Math.hypot(a.x - other.x, a.y - other.y);
        const middle = (/** @type {{x: number, y: number}} */ a) => ({ x: (a.x + other.x) / 2, y: (a.y + other.y) / 2 });
        drag(middle(now).x - middle(was).x, middle(now).y - middle(was).y, true);
        if (apart(was) > 1 && apart(now) > 1) zoom(apart(now) / apart(was), middle(now).x, middle(now).y);
    });
    /** @param {PointerEvent} event */
    const release = (event) => {
        pointers.delete(event.pointerId);
        element.classList.toggle('held', pointers.size > 0);
    };
    element.addEventListener('pointerup', release);
    element.addEventListener('pointercancel', release);
    element.addEventListener('dblclick', fit);
    element.addEventListener(
        'wheel',
        (event) => {
            if (!takes(event)) return;
            event.preventDefault();
            const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1);
            // A pinch on a track pad arrives as a wheel with Ctrl held, in much smaller steps.
            const speed = event.ctrlKey ? 0.01 : 0.0018;
            zoom(Math.exp(-Math.max(-400, Math.min(400, pixels)) * speed), event.clientX, event.clientY);
        },
        { passive: false },
    );
    // In Safari a pinch on a track pad has events of its own; one on the screen is in the pointers already.
    let pinched = 1;
    /** @param {Event} event */
    const pinch = (event) => {
        if (pointers.size > 0 || !takes(event)) return;
        event.preventDefault();
        const { scale, clientX, clientY } = /** @type {MouseEvent & {scale: number}} */ (event);
        if (event.type === 'gesturechange') zoom(scale / pinched, clientX, clientY);
        pinched = scale;
    };
    element.addEventListener('gesturestart', pinch);
    element.addEventListener('gesturechange', pinch);
}
