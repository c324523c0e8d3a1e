/** Arithmetic of looking: pan, zoom, and where an old picture stands in a new view. Pure functions. */

import { MAX_ZOOM, MIN_ZOOM } from './state.js';

/** @typedef {import('./state.js').View} View */

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
    return { x: view.x - dx / pixels, y: view.y + dy / pixels, zoom: view.zoom };
}

/**
 * The view after zooming about a point that stays where it is.
 * @param {View} view
 * @param {number} factor
 * @param {number} px CSS pixels right of the canvas's centre
 * @param {number} py CSS pixels below the canvas's centre
 * @param {number} scale CSS pixels per fitted extent at zoom 1
 * @returns {View}
 */
export function zoomAt(view, factor, px, py, scale) {
    const zoom = Math.min(MAX_ZOOM, Math.max(MIN_ZOOM, view.zoom * factor));
    const shift = (1 / view.zoom - 1 / zoom) / scale;
    return { x: view.x + px * shift, y: view.y - py * shift, zoom };
}

/**
 * The view on the way from one to another, at `t` from 0 to 1: a zoom about the point that both share, or a pan.
 * @param {View} from
 * @param {View} to
 * @param {number} t
 * @returns {View}
 */
export function between(from, to, t) {
    const zoom = from.zoom * (to.zoom / from.zoom) ** t;
    const whole = 1 / from.zoom - 1 / to.zoom;
    const left = Math.abs(whole) < 1e-9 / from.zoom ? 1 - t : (1 / zoom - 1 / to.zoom) / whole;
    return { x: to.x + (from.x - to.x) * left, y: to.y + (from.y - to.y) * left, zoom };
}

/**
 * Where a picture that was drawn for one view stands in another: CSS pixels right and down, and a factor, about the
 * canvas's centre.
 * @param {View} drawn
 * @param {View} view
 * @param {number} scale CSS pixels per fitted extent at zoom 1
 */
export function placement(drawn, view, scale) {
    const pixels = scale * view.zoom;
    return { x: (drawn.x - view.x) * pixels, y: (view.y - drawn.y) * pixels, factor: view.zoom / drawn.zoom };
}
