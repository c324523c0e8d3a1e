/**
 * Moves the view of a drawing in the plane, or the camera of a drawing in space. Gestures, keys and buttons of the
 * stage use these moves, at once or smoothly.
 */

import { FRONT, isWhole, midway, orbit, seen as seenInSpace, slide, whole, zoomed, zoomedOn } from '../camera.js';
import { reducedMotion } from '../dom.js';
import { FITTED, along, between, centredOn, pan, seen, zoomAt } from '../view.js';

/** @typedef {import('../state.js').View} View */
/** @typedef {import('../state.js').Camera} Camera */

const GLIDE_MS = 260;

/**
 * @param {import('../store.js').Store} store
 * @param {{readonly painted: boolean, readonly scale: number}} picture
 * @param {() => boolean} space whether the drawing is in space
 */
export function createMoves(store, picture, space) {
    let glide = 0;
    const view = () => store.state.view ?? FITTED;
    const camera = () => store.state.camera ?? FRONT;

    /** @param {View} next */
    function look(next) {
        cancelAnimationFrame(glide);
        store.setView(next);
    }

    /** @param {Camera} next */
    function aim(next) {
        cancelAnimationFrame(glide);
        store.setCamera(next);
    }

    /** Moves smoothly to a view; null is the fitted view. @param {View | null} target */
    function glideTo(target) {
        const from = view();
        const to = target ?? FITTED;
        animate((part) => store.setView(part < 1 ? between(from, to, part) : target));
    }

    /** Moves the camera smoothly. @param {Camera} target */
    function glideToCamera(target) {
        const from = camera();
        animate((part) => store.setCamera(part < 1 ? midway(from, target, part) : target));
    }

    /** @param {(part: number) => void} move makes a part of the movement, from 0 to 1 */
    function animate(move) {
        cancelAnimationFrame(glide);
        if (reducedMotion() || !picture.painted) return move(1);
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
        glideToCamera,

        /** Whether the view is the initial one, which shows the whole drawing. */
        isFitted: () => (space() ? isWhole(camera()) : store.state.view === null),

        fit: () => (space() ? glideToCamera(whole(camera())) : glideTo(null)),

        /** Zooms smoothly about the middle. @param {number} factor */
        zoom: (factor) => (space() ? glideToCamera(zoomed(camera(), factor, 0, 0, picture.scale)) : glideTo(zoomAt(view(), factor, 0, 0, picture.scale))),

        /** @param {number} factor @param {number} x of the fixed point, in CSS pixels from the middle @param {number} y */
        zoomAt(factor, x, y) {
            if (space()) aim(zoomed(camera(), factor, x, y, picture.scale));
            else look(zoomAt(view(), factor, x, y, picture.scale));
        },

        /** Zooms about a place of the drawing. @param {number} factor @param {number[]} place */
        zoomOn(factor, place) {
            if (space()) aim(zoomedOn(camera(), factor, place, picture.scale));
            else look(zoomAt(view(), factor, ...seen(view(), place, picture.scale), picture.scale));
        },

        /** Moves a place of the drawing to the middle, smoothly. @param {number[]} place */
        goTo(place) {
            const [x = 0, y = 0, z = 0] = place;
            if (space()) glideToCamera({ ...camera(), x, y, z });
            else glideTo(centredOn(view(), place));
        },

        /** Where a place of the drawing is seen, in CSS pixels from the middle. @param {number[]} place */
        seen: (place) => (space() ? seenInSpace(camera(), place, picture.scale) : seen(view(), place, picture.scale)),

        /** A place on a segment, at `t` from 0 to 1. @param {number[]} from @param {number[]} to @param {number} t */
        along: (from, to, t) => (space() ? from.map((value, axis) => value + ((to[axis] ?? 0) - value) * t) : along(from, to, t)),

        /** @param {number} dx in CSS pixels @param {number} dy @param {boolean} aside moves the camera instead of turning it */
        drag(dx, dy, aside) {
            if (!space()) look(pan(view(), dx, dy, picture.scale));
            else aim(aside ? slide(camera(), dx, dy, picture.scale) : orbit(camera(), dx, dy));
        },
    };
}
