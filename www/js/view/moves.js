/**
 * Moves the view of a drawing in the plane, or the camera of a drawing in space. Gestures, keys and buttons of the
 * stage use these moves, at once or smoothly.
 */

import { isWhole, midway, orbit, seen as seenInSpace, slide, whole, zoomed, zoomedOn } from './camera.js';
import { reducedMotion } from '../base/dom.js';
import { along, between, centredOn, pan, seen, zoomAt } from './view.js';

/** @typedef {import('../state/state.js').View} View */
/** @typedef {import('../state/state.js').Camera} Camera */

const GLIDE_MS = 260;
/** @type {[number, number]} */
const MIDDLE = [0, 0];
/** A line that is looked for fills at most this part of the stage's smaller side. */
const LARGEST = 0.6;

/**
 * @param {import('../state/store.js').Store} store
 * @param {{readonly painted: boolean, readonly scale: number}} picture
 * @param {() => boolean} space whether the drawing is in space
 * @param {() => View} fitted the view that shows the whole drawing in the plane
 * @param {() => Camera} front the camera until the reader moves it
 */
export function createMoves(store, picture, space, fitted, front) {
    let glide = 0;
    const view = () => store.state.view ?? fitted();
    const camera = () => store.state.camera ?? front();

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
        const to = target ?? fitted();
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

        /** Zooms smoothly about a place of the drawing, or about the middle. @param {number} factor @param {number[] | null} place */
        zoom(factor, place) {
            if (space())
                glideToCamera(
                    place
                        ? zoomedOn(camera(), factor, place, picture.scale)
                        : zoomed(camera(), factor, 0, 0, picture.scale),
                );
            else
                glideTo(
                    zoomAt(view(), factor, ...(place ? seen(view(), place, picture.scale) : MIDDLE), picture.scale),
                );
        },

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

        /** Shows a line or a polygon in the middle, smoothly, and farther away if it is larger than the stage. @param {number[][]} corners @param {{width: number, height: number}} size of the stage */
        goTo(corners, size) {
            const [first] = corners;
            if (!first) return;
            const farthest = corners.reduce(
                (most, corner) => (extentOf(space, first, corner) > extentOf(space, first, most) ? corner : most),
                first,
            );
            const pixels = extentOf(space, first, farthest) * picture.scale * (space() ? camera() : view()).zoom;
            const smaller = Math.min(1, (LARGEST * Math.min(size.width, size.height)) / pixels);
            const middle = pointBetween(space, first, farthest, 0.5);
            const [x = 0, y = 0, z = 0] = middle;
            if (space()) glideToCamera({ ...camera(), x, y, z, zoom: camera().zoom * smaller });
            else glideTo(centredOn({ ...view(), zoom: view().zoom * smaller }, middle));
        },

        /** Where a place of the drawing is seen, in CSS pixels from the middle. @param {number[]} place */
        seen: (place) => (space() ? seenInSpace(camera(), place, picture.scale) : seen(view(), place, picture.scale)),

        pointBetween: (/** @type {number[]} */ from, /** @type {number[]} */ to, /** @type {number} */ t) =>
            pointBetween(space, from, to, t),

        /** @param {number} dx in CSS pixels @param {number} dy @param {boolean} aside moves the camera instead of turning it */
        drag(dx, dy, aside) {
            if (!space()) look(pan(view(), dx, dy, picture.scale));
            else aim(aside ? slide(camera(), dx, dy, picture.scale) : orbit(camera(), dx, dy));
        },
    };
}

/**
 * A place on a segment, at `t` from 0 to 1.
 * @param {() => boolean} space
 * @param {number[]} from
 * @param {number[]} to
 * @param {number} t
 */
function pointBetween(space, from, to, t) {
    return space() ? from.map((value, axis) => value + ((to[axis] ?? 0) - value) * t) : along(from, to, t);
}

/**
 * The distance of two places, in fitted extents.
 * @param {() => boolean} space
 * @param {number[]} a
 * @param {number[]} b
 */
function extentOf(space, [x1 = 0, y1 = 0, z1 = 0, w1 = 0], [x2 = 0, y2 = 0, z2 = 0, w2 = 0]) {
    return space() ? Math.hypot(x2 - x1, y2 - y1, z2 - z1) : Math.hypot(x2 - x1 + (z2 - z1), y2 - y1 + (w2 - w1));
}
