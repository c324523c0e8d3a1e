/**
 * How one moves about a drawing: by its view in the plane, by the camera in space. Gestures, keys and buttons of the stage
 * do it at once or smoothly.
 */

import { FRONT, isWhole, midway, orbit, slide, whole, zoomed } from '../camera.js';
import { calm } from '../dom.js';
import { FITTED, between, pan, zoomAt } from '../view.js';

/** @typedef {import('../state.js').View} View */
/** @typedef {import('../state.js').Camera} Camera */

const GLIDE_MS = 260;

/**
 * @param {import('../store.js').Store} store
 * @param {{readonly painted: boolean, readonly scale: number}} picture
 * @param {() => boolean} solid whether the drawing is one in space
 */
export function createMoves(store, picture, solid) {
    let glide = 0;
    const view = () => store.state.view ?? FITTED;
    const camera = () => store.state.camera ?? FRONT;

    /** @param {View} next */
    function look(next) {
        cancelAnimationFrame(glide);
        store.look(next);
    }

    /** @param {Camera} next */
    function aim(next) {
        cancelAnimationFrame(glide);
        store.aim(next);
    }

    /** Moves to a view smoothly; null is the fitted one. @param {View | null} target */
    function glideTo(target) {
        const from = view();
        const to = target ?? FITTED;
        glideBy((part) => store.look(part < 1 ? between(from, to, part) : target));
    }

    /** Moves the camera smoothly. @param {Camera} target */
    function glideRound(target) {
        const from = camera();
        glideBy((part) => store.aim(part < 1 ? midway(from, target, part) : target));
    }

    /** @param {(part: number) => void} move goes so much of its way, from 0 to 1 */
    function glideBy(move) {
        cancelAnimationFrame(glide);
        if (calm() || !picture.painted) return move(1);
        const start = performance.now();
        const tick = (/** @type {number} */ now) => {
            const t = Math.min(1, Math.max(0, (now - start) / GLIDE_MS));
            move(t < 1 ? 1 - (1 - t) ** 3 : 1);
            if (t < 1) glide = requestAnimationFrame(tick);
        };
        glide = requestAnimationFrame(tick);
    }

    return {
        view,
        camera,
        glideRound,

        /** Whether all of the drawing is in sight, as it is at first. */
        isFitted: () => (solid() ? isWhole(camera()) : store.state.view === null),

        fit: () => (solid() ? glideRound(whole(camera())) : glideTo(null)),

        /** Towards the middle, smoothly. @param {number} factor */
        zoom: (factor) => (solid() ? glideRound(zoomed(camera(), factor, 0, 0, picture.scale)) : glideTo(zoomAt(view(), factor, 0, 0, picture.scale))),

        /** @param {number} factor @param {number} x of the place that stays, in CSS pixels from the middle @param {number} y */
        zoomAt(factor, x, y) {
            if (solid()) aim(zoomed(camera(), factor, x, y, picture.scale));
            else look(zoomAt(view(), factor, x, y, picture.scale));
        },

        /** @param {number} dx in CSS pixels @param {number} dy @param {boolean} aside moves the camera rather than turning it */
        drag(dx, dy, aside) {
            if (!solid()) look(pan(view(), dx, dy, picture.scale));
            else aim(aside ? slide(camera(), dx, dy, picture.scale) : orbit(camera(), dx, dy));
        },
    };
}
