/** Cameras for drawings in space: orbit, pan, zoom. Pure functions. */

import { rangeOf } from '../state/state.js';

/** @typedef {import('../state/state.js').Camera} Camera */
/** @typedef {[number, number, number]} Vector */

const ZOOM = rangeOf('camera', 'zoom');

/** The camera until the reader moves it; equal to the core's default. @type {Readonly<Camera>} */
export const FRONT = Object.freeze({
    azimuth: 25,
    elevation: 12,
    zoom: 1,
    x: 0,
    y: 0,
    z: 0,
    perspective: true,
    fade: 0.2,
});

/** Degrees per CSS pixel of dragging. */
const SPEED = 0.4;

/** Rounded to a millionth, so that links do not contain rounding errors. @param {number} degrees */
const rounded = (degrees) => Math.round(degrees * 1e6) / 1e6;

/** @param {number} degrees @returns {number} from -180 to 180 */
const wrapped = (degrees) => rounded(((((degrees + 180) % 360) + 360) % 360) - 180);

/**
 * The camera moved around its target by a drag, so that the drawing turns with the pointer.
 * @param {Camera} camera
 * @param {number} dx CSS pixels to the right
 * @param {number} dy CSS pixels down
 * @returns {Camera}
 */
export function orbit(camera, dx, dy) {
    return turned(camera, camera.azimuth - dx * SPEED, camera.elevation + dy * SPEED);
}

/**
 * The camera looking from another direction.
 * @param {Camera} camera
 * @param {number} azimuth
 * @param {number} elevation
 * @returns {Camera}
 */
export function turned(camera, azimuth, elevation) {
    return { ...camera, azimuth: wrapped(azimuth), elevation: rounded(Math.max(-90, Math.min(90, elevation))) };
}

/**
 * The directions right, up and towards the eye, in the model's coordinates.
 * @param {Camera} camera
 * @returns {[Vector, Vector, Vector]}
 */
export function axes({ azimuth, elevation }) {
    const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
    const [sa, ca, se, ce] = [Math.sin(a), Math.cos(a), Math.sin(e), Math.cos(e)];
    return [
        [ca, 0, -sa],
        [-se * sa, ce, -se * ca],
        [ce * sa, se, ce * ca],
    ];
}

/**
 * The camera moved by a drag in the picture's plane.
 * @param {Camera} camera
 * @param {number} dx CSS pixels to the right
 * @param {number} dy CSS pixels down
 * @param {number} scale CSS pixels per fitted extent at zoom 1
 * @returns {Camera}
 */
export function slide(camera, dx, dy, scale) {
    const pixels = scale * camera.zoom;
    return shifted(camera, -dx / pixels, dy / pixels);
}

/**
 * The camera after zooming about a fixed point.
 * @param {Camera} camera
 * @param {number} factor
 * @param {number} px CSS pixels right of the canvas's centre
 * @param {number} py CSS pixels below the canvas's centre
 * @param {number} scale CSS pixels per fitted extent at zoom 1
 * @returns {Camera}
 */
export function zoomed(camera, factor, px, py, scale) {
    const zoom = Math.min(ZOOM.high, Math.max(ZOOM.low, camera.zoom * factor));
    const by = (1 / camera.zoom - 1 / zoom) / scale;
    return { ...shifted(camera, px * by, -py * by), zoom };
}

/**
 * The camera with its target moved to the right and up in the picture, in fitted extents.
 * @param {Camera} camera
 * @param {number} right
 * @param {number} up
 * @returns {Camera}
 */
function shifted(camera, right, up) {
    const [r, u] = axes(camera);
    return {
        ...camera,
        x: camera.x + right * r[0] + up * u[0],
        y: camera.y + right * r[1] + up * u[1],
        z: camera.z + right * r[2] + up * u[2],
    };
}

/** The eye's distance from the target, in fitted extents. */
const DISTANCE = 2;
/** The near limit of perspective, as a fraction of that distance. */
const NEAR = 0.05;

/**
 * Projects a place to the picture: CSS pixels right of and below the canvas's centre.
 * @param {Camera} camera
 * @param {number[]} place from the fitted centre, in fitted extents, in the model's coordinates
 * @param {number} scale CSS pixels per fitted extent at zoom 1
 * @returns {[number, number]}
 */
export function seen(camera, place, scale) {
    const [right, up, back] = axes(camera);
    const pixels =
        (scale * camera.zoom) / (camera.perspective ? Math.max(NEAR, 1 - towards(camera, back, place) / DISTANCE) : 1);
    return [towards(camera, right, place) * pixels, -towards(camera, up, place) * pixels];
}

/**
 * The camera after zooming so that a place of the drawing stays where it is seen.
 * @param {Camera} camera
 * @param {number} factor
 * @param {number[]} place as for {@link seen}
 * @param {number} scale CSS pixels per fitted extent at zoom 1
 * @returns {Camera}
 */
export function zoomedOn(camera, factor, place, scale) {
    const next = zoomed(camera, factor, 0, 0, scale);
    const [[x, y], [nextX, nextY]] = [seen(camera, place, scale), seen(next, place, scale)];
    // A move in the picture's plane keeps the depth.
    const [, , back] = axes(camera);
    const depth = camera.perspective ? Math.max(NEAR, 1 - towards(next, back, place) / DISTANCE) : 1;
    return slide(next, (x - nextX) * depth, (y - nextY) * depth, scale);
}

/** The distance of a place from the camera's target along an axis. @param {Camera} camera @param {Vector} axis @param {number[]} place */
function towards(camera, axis, [x = 0, y = 0, z = 0]) {
    return axis[0] * (x - camera.x) + axis[1] * (y - camera.y) + axis[2] * (z - camera.z);
}

/**
 * Interpolates between two cameras, at `t` from 0 to 1, turning the shorter way.
 * @param {Camera} from
 * @param {Camera} to
 * @param {number} t
 * @returns {Camera}
 */
export function midway(from, to, t) {
    const mix = (/** @type {number} */ a, /** @type {number} */ b) => a + (b - a) * t;
    return {
        ...turned(to, from.azimuth + wrapped(to.azimuth - from.azimuth) * t, mix(from.elevation, to.elevation)),
        zoom: from.zoom * (to.zoom / from.zoom) ** t,
        x: mix(from.x, to.x),
        y: mix(from.y, to.y),
        z: mix(from.z, to.z),
        fade: mix(from.fade, to.fade),
    };
}

/** The camera that shows the whole drawing from the same direction. @param {Camera} camera @returns {Camera} */
export const whole = (camera) => ({ ...camera, zoom: 1, x: 0, y: 0, z: 0 });

/** Whether the camera shows the whole drawing. @param {Camera} camera */
export const isWhole = ({ zoom, x, y, z }) => zoom === 1 && x === 0 && y === 0 && z === 0;
