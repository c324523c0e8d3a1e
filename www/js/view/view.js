/** Views in the plane: pan, zoom, and the position of an old picture in a new view. Pure functions. */

import { DEEPEST, rangeOf } from '../state/state.js';

/** @typedef {import('../state/state.js').View} View */

const ZOOM = rangeOf('view', 'zoom');

/** Below this zoom the rounding remainders are far less than a pixel and are dropped. */
const COARSE = 1e6;

/** @type {Readonly<View>} */
export const FITTED = Object.freeze({ x: 0, y: 0, zoom: 1 });

/**
 * The view after the picture was dragged.
 * @param {View} view
 * @param {number} dx CSS pixels to the right
 * @param {number} dy CSS pixels down
 * @param {number} scale CSS pixels per fitted extent at zoom 1
 * @returns {View}
 */
export function pan(view, dx, dy, scale) {
    const pixels = scale * view.zoom;
    return moved(view, -dx / pixels, dy / pixels, view.zoom);
}

/**
 * The view after zooming about a fixed point.
 * @param {View} view
 * @param {number} factor
 * @param {number} px CSS pixels right of the canvas's centre
 * @param {number} py CSS pixels below the canvas's centre
 * @param {number} scale CSS pixels per fitted extent at zoom 1
 * @returns {View}
 */
export function zoomAt(view, factor, px, py, scale) {
    const zoom = Math.min(view.at ? ZOOM.high : DEEPEST, Math.max(ZOOM.low, view.zoom * factor));
    const shift = (1 / view.zoom - 1 / zoom) / scale;
    return moved(view, px * shift, -py * shift, zoom);
}

/**
 * The view with its centre moved. A centre is the sum of two numbers, `x + fx` and `y + fy`: in a drawing 10^19 steps
 * wide, one number is too coarse for a single step.
 * @param {View} view
 * @param {number} dx
 * @param {number} dy
 * @param {number} zoom
 * @returns {View}
 */
function moved({ x, y, fx = 0, fy = 0, at }, dx, dy, zoom) {
    const [nextX, fineX] = sum(x, fx, dx);
    const [nextY, fineY] = sum(y, fy, dy);
    const next = { x: nextX, y: nextY, zoom, ...(at ? { at } : {}) };
    return zoom < COARSE ? next : { ...next, fx: fineX, fy: fineY };
}

/**
 * `high + low + value` as a number and its rounding remainder (Knuth's two-sum).
 * @param {number} high
 * @param {number} low
 * @param {number} value
 * @returns {[number, number]}
 */
function sum(high, low, value) {
    const whole = high + value;
    const rest = whole - high;
    const fine = low + (high - (whole - rest) + (value - rest));
    return [whole + fine, fine - (whole + fine - whole)];
}

/**
 * A place on a segment, at `t` from 0 to 1. Places have the rounding remainders of marks.js.
 * @param {number[]} from
 * @param {number[]} to
 * @param {number} t
 * @returns {number[]}
 */
export function along([x1 = 0, y1 = 0, fx1 = 0, fy1 = 0], [x2 = 0, y2 = 0, fx2 = 0, fy2 = 0], t) {
    const [x, fx] = sum(x1, fx1, (x2 - x1 + (fx2 - fx1)) * t);
    const [y, fy] = sum(y1, fy1, (y2 - y1 + (fy2 - fy1)) * t);
    return [x, y, fx, fy];
}

/**
 * Projects a place to the picture: CSS pixels right of and below the canvas's centre.
 * @param {View} view
 * @param {number[]} place
 * @param {number} scale CSS pixels per fitted extent at zoom 1
 * @returns {[number, number]}
 */
export function seen(view, [x = 0, y = 0, fx = 0, fy = 0], scale) {
    const pixels = scale * view.zoom;
    const [dx, dy] = offset(view, { x, y, fx, fy, zoom: 1 });
    return [dx * pixels, -dy * pixels];
}

/** The view with a place in the middle. @param {View} view @param {number[]} place @returns {View} */
export const centredOn = ({ zoom, at }, [x = 0, y = 0, fx = 0, fy = 0]) => ({
    ...(zoom < COARSE ? { x: x + fx, y: y + fy, zoom } : { x, y, fx, fy, zoom }),
    ...(at ? { at } : {}),
});

/** A place from another origin, which is given from the old one. @param {number[]} place @param {number[]} origin */
export const placeFrom = (place, origin) => place.map((value, at) => value - (origin[at] ?? 0));

/** Beyond this zoom, views are about a segment; at once where a drawing has more than 2^128 segments, of which only those in a small part have numbers. */
const DEEP = 1e12;
const DEEP_IN_ENORMOUS = 1;
/** A view's centre is at most this many pictures away from its segment: in a number, that is a hundredth of a pixel. */
const ASIDE = 1e10;

/** Whether lines are held by origins rather than by numbers. @param {View} view @param {boolean} [enormous] as in {@link isFarOff} */
export const isDeep = ({ zoom, at }, enormous = false) =>
    at !== undefined || zoom > (enormous ? DEEP_IN_ENORMOUS : DEEP);

/** Whether a view should be about a segment nearby. @param {View} view @param {boolean} [enormous] whether the drawing has more than 2^128 segments */
export const isFarOff = ({ x, y, zoom, at }, enormous = false) =>
    isDeep({ x, y, zoom }, enormous) && (!at || Math.hypot(x, y) * zoom > ASIDE);

/**
 * The same view from another origin.
 * @param {View} view
 * @param {number[]} place of the new origin, from the old one
 * @param {string} at the segment there, as in a view
 * @returns {View}
 */
export function viewFrom(view, [x = 0, y = 0, fx = 0, fy = 0], at) {
    const { x: nextX, y: nextY, fx: fineX, fy: fineY } = moved(moved(view, -x, -y, view.zoom), -fx, -fy, view.zoom);
    return { x: nextX, y: nextY, zoom: view.zoom, ...(fineX || fineY ? { fx: fineX, fy: fineY } : {}), at };
}

/**
 * Interpolates between two views, at `t` from 0 to 1: a zoom about the point that both views share, or a pan.
 * @param {View} from
 * @param {View} to
 * @param {number} t
 * @returns {View}
 */
export function between(from, to, t) {
    if (from.at !== to.at) return to;
    const zoom = from.zoom * (to.zoom / from.zoom) ** t;
    const whole = 1 / from.zoom - 1 / to.zoom;
    const left = Math.abs(whole) < 1e-9 / from.zoom ? 1 - t : (1 / zoom - 1 / to.zoom) / whole;
    const [dx, dy] = offset(to, from);
    return moved(to, dx * left, dy * left, zoom);
}

/**
 * The position of a picture, drawn for one view, in another view: CSS pixels right and down, and a scale factor about
 * the canvas's centre.
 * @param {View} drawn
 * @param {View} view
 * @param {number} scale CSS pixels per fitted extent at zoom 1
 */
export function placement(drawn, view, scale) {
    if (drawn.at !== view.at) return { x: 0, y: 0, factor: 1 };
    const pixels = scale * view.zoom;
    const [dx, dy] = offset(view, drawn);
    return { x: dx * pixels, y: -dy * pixels, factor: view.zoom / drawn.zoom };
}

/**
 * The offset from one centre to another.
 * @param {View} from
 * @param {View} to
 * @returns {[number, number]}
 */
function offset(from, to) {
    return [to.x - from.x + ((to.fx ?? 0) - (from.fx ?? 0)), to.y - from.y + ((to.fy ?? 0) - (from.fy ?? 0))];
}
