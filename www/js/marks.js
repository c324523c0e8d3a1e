/** Marks on the drawing: a segment or a polygon, the outline of a part, the turtle. Marks move with the view. */

import { seen as seenInSpace } from './camera.js';
import { byId } from './dom.js';
import { placeFrom } from './view.js';

/** @typedef {import('./state.js').View} View */
/** @typedef {import('./state.js').Camera} Camera */
/**
 * In fitted extents from the fitted centre. In the plane: x to the right, y upwards, and the rounding remainders of
 * both. In space: x, y and z of the model.
 * @typedef {number[]} Point
 */
/**
 * `scale` in CSS pixels per fitted extent at zoom 1; `camera` is null for drawings in the plane.
 * @typedef {{view: View, camera: Camera | null, scale: number, size: {width: number, height: number}}} Viewpoint
 */

/** `heading` in degrees counter-clockwise from the right, in space a vector. @typedef {{at: Point, heading: number | number[]}} FittedPose */

/** Marks are clipped at this distance from the frame, in CSS pixels. */
const FAR = 1e5;
/** A short way ahead of a turtle in space, to project its heading, in fitted extents. */
const STEP = 1e-6;
/** Shorter marks get a ring to make them visible, in CSS pixels. */
const SHORT = 9;

/**
 * Clips a line to {@link FAR} outside the frame; returns its ends if no part is inside.
 * @param {[number, number]} from
 * @param {[number, number]} to
 * @returns {[[number, number], [number, number]]}
 */
function within(from, to) {
    const direction = [to[0] - from[0], to[1] - from[1]];
    let [first, last] = [0, 1];
    for (const axis of [0, 1]) {
        const [start = 0, length = 0] = [from[axis], direction[axis]];
        if (length === 0) continue;
        const sides = [(-FAR - start) / length, (FAR - start) / length];
        first = Math.max(first, Math.min(...sides));
        last = Math.min(last, Math.max(...sides));
    }
    const at = (/** @type {number} */ part) =>
        /** @type {[number, number]} */ ([from[0] + part * (direction[0] ?? 0), from[1] + part * (direction[1] ?? 0)]);
    return first < last ? [at(first), at(last)] : [from, to];
}

export function createMarks() {
    const frame = byId('marks', SVGSVGElement);
    const found = byId('mark-found', SVGGElement);
    const part = byId('mark-part', SVGGElement);
    const turtle = byId('mark-turtle', SVGGElement);
    const dots = byId('mark-sounding', SVGPathElement);
    /** @type {Viewpoint | null} */
    let viewpoint = null;
    /** The ends of a segment, or the corners of a polygon. @type {Point[]} */
    let points = [];
    /** By owner, the outline of a part; the last owner's is shown. @type {Map<string, Point[]>} */
    const outlines = new Map();
    /** @type {Point[]} */
    let outline = [];
    /** @type {FittedPose | null} */
    let pose = null;
    /** @type {Point[]} */
    let places = [];

    /** @param {Point} point @returns {[number, number]} CSS pixels from the stage's upper left corner */
    function place(point) {
        const { view, camera, scale, size } = /** @type {Viewpoint} */ (viewpoint);
        const middle = /** @type {const} */ ([size.width / 2, size.height / 2]);
        if (camera) {
            const [x, y] = seenInSpace(camera, point, scale);
            return [middle[0] + x, middle[1] + y];
        }
        const [x = 0, y = 0, fx = 0, fy = 0] = point;
        const pixels = scale * view.zoom;
        return [
            middle[0] + (x - view.x + (fx - (view.fx ?? 0))) * pixels,
            middle[1] - (y - view.y + (fy - (view.fy ?? 0))) * pixels,
        ];
    }

    /** @param {Point} point */
    const seen = (point) => place(point).map((value) => Math.min(FAR, Math.max(-FAR, value)));

    /** The turtle's direction in the picture, in degrees clockwise from the right. @param {FittedPose} pose */
    function towards({ at, heading }) {
        if (typeof heading === 'number') return -heading;
        const ahead = at.map((value, axis) => value + STEP * (heading[axis] ?? 0));
        const [[x1, y1], [x2, y2]] = [place(at), place(ahead)];
        return (Math.atan2(y2 - y1, x2 - x1) * 180) / Math.PI;
    }

    /** @param {Element} group @param {boolean} shown */
    const show = (group, shown) => group.toggleAttribute('hidden', !shown);
    /** @param {Element} element @param {Record<string, number | string>} attributes */
    function set(element, attributes) {
        for (const [name, value] of Object.entries(attributes))
            element.setAttribute(name, typeof value === 'number' ? value.toFixed(2) : value);
    }

    /** @param {number[]} at */
    const pair = (at) => at.map((value) => value.toFixed(2)).join(' ');

    /** Puts the group's ring around a short mark. @param {Element} group @param {number[][]} corners @returns {boolean} whether the mark is short */
    function encircle(group, corners) {
        const [xs = [], ys = []] = [0, 1].map((axis) => corners.map((corner) => corner[axis] ?? 0));
        const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
        const ring = /** @type {SVGCircleElement} */ (group.querySelector('circle'));
        set(ring, { cx: (left + right) / 2, cy: (low + high) / 2 });
        const short = Math.hypot(right - left, high - low) < SHORT;
        show(ring, short);
        return short;
    }

    function draw() {
        show(frame, viewpoint !== null && (points.length + outline.length + places.length > 0 || pose !== null));
        if (!viewpoint) return;
        show(found, points.length > 0);
        if (points.length > 0) {
            const corners = points.map(place);
            const sides = corners.map((corner, at) => within(corner, corners[(at + 1) % corners.length] ?? corner));
            if (corners.length === 2) sides.pop();
            found.classList.toggle('outline', corners.length > 2);
            const d = sides.map(([from, to]) => `M${pair(from)}L${pair(to)}`).join('');
            for (const path of found.querySelectorAll('path')) set(path, { d });
            const short = encircle(found, sides.flat());
            show(/** @type {Element} */ (found.querySelector('.halo')), !short);
        }
        show(part, outline.length > 0);
        if (outline.length > 0) {
            const corners = outline.map(seen);
            const d = `M${corners.map(pair).join('L')}Z`;
            for (const path of part.querySelectorAll('path')) set(path, { d });
            const short = encircle(part, corners);
            for (const path of part.querySelectorAll('path')) show(path, !short);
        }
        // Lines without length have round ends.
        set(dots, { d: places.map((place) => `M${pair(seen(place))}h0`).join('') });
        show(turtle, pose !== null);
        if (pose) {
            const [x = 0, y = 0] = seen(pose.at);
            set(turtle, {
                transform: `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${towards(pose).toFixed(2)})`,
            });
        }
    }

    return {
        /** @param {Viewpoint | null} next */
        look(next) {
            viewpoint = next;
            draw();
        },
        /** Tells all marks from another origin. @param {Point} origin from the present one */
        from(origin) {
            const moved = (/** @type {Point} */ point) => placeFrom(point, origin);
            points = points.map(moved);
            outline = outline.map(moved);
            for (const [owner, own] of outlines) outlines.set(owner, own.map(moved));
            if (pose) pose = { ...pose, at: moved(pose.at) };
        },
        /** @param {Point[]} next the ends of a segment, or the corners of a polygon */
        found(next) {
            if (points.length === 0 && next.length === 0) return;
            points = next;
            draw();
        },
        /** A function that marks a part of the drawing for an owner; no points remove the owner's mark. @param {string} owner @returns {(next: Point[]) => void} */
        part: (owner) => (next) => {
            outlines.delete(owner);
            if (next.length > 0) outlines.set(owner, next);
            const last = [...outlines.values()].at(-1) ?? [];
            if (outline.length === 0 && last.length === 0) return;
            outline = last;
            draw();
        },
        /** @param {FittedPose | null} next */
        turtle(next) {
            if (pose === null && next === null) return;
            pose = next;
            draw();
        },
        /** Marks the places of notes that sound. @param {Point[]} next */
        sounding(next) {
            if (places.length === 0 && next.length === 0) return;
            places = next;
            draw();
        },
    };
}
