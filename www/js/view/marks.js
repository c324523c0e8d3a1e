/** Marks on the drawing: a segment or a polygon, the outline of a part, the turtle. Marks move with the view. */

import { seen as seenInSpace } from './camera.js';
import { byId } from '../base/dom.js';
import { placeFrom } from './view.js';

/** @typedef {import('../state/state.js').View} View */
/** @typedef {import('../state/state.js').Camera} Camera */
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

/**
 * The elements of the marks and what they mark.
 * @typedef {object} Marks
 * @property {SVGSVGElement} frame
 * @property {SVGGElement} found
 * @property {SVGGElement} part
 * @property {SVGGElement} turtle
 * @property {SVGPathElement} dots
 * @property {Viewpoint | null} viewpoint
 * @property {Point[]} points The ends of a segment, or the corners of a polygon
 * @property {Point[]} outline
 * @property {FittedPose | null} pose
 * @property {Point[]} places
 */

export function createMarks() {
    /** @type {Marks} */
    const self = {
        frame: byId('marks', SVGSVGElement),
        found: byId('mark-found', SVGGElement),
        part: byId('mark-part', SVGGElement),
        turtle: byId('mark-turtle', SVGGElement),
        dots: byId('mark-sounding', SVGPathElement),
        viewpoint: null,
        points: [],
        outline: [],
        pose: null,
        places: [],
    };

    /** By owner, the outline of a part; the last owner's is shown. @type {Map<string, Point[]>} */
    const outlines = new Map();
    const setter = (/** @type {'points' | 'places'} */ name) => (/** @type {Point[]} */ next) => {
        if (self[name].length === 0 && next.length === 0) return;
        self[name] = next;
        draw(self);
    };

    return {
        /** @param {Viewpoint | null} next */
        look(next) {
            self.viewpoint = next;
            draw(self);
        },
        /** Tells all marks from another origin. @param {Point} origin from the present one */
        from(origin) {
            const moved = (/** @type {Point} */ point) => placeFrom(point, origin);
            self.points = self.points.map(moved);
            self.outline = self.outline.map(moved);
            for (const [owner, own] of outlines) outlines.set(owner, own.map(moved));
            if (self.pose) self.pose = { ...self.pose, at: moved(self.pose.at) };
        },
        /** The ends of a segment, or the corners of a polygon. */
        found: setter('points'),
        /** A function that marks a part of the drawing for an owner; no points remove the owner's mark. @param {string} owner @returns {(next: Point[]) => void} */
        part: (owner) => (next) => {
            outlines.delete(owner);
            if (next.length > 0) outlines.set(owner, next);
            const last = [...outlines.values()].at(-1) ?? [];
            if (self.outline.length === 0 && last.length === 0) return;
            self.outline = last;
            draw(self);
        },
        /** @param {FittedPose | null} next */
        turtle(next) {
            if (self.pose === null && next === null) return;
            self.pose = next;
            draw(self);
        },
        /** Marks the places of notes that sound. */
        sounding: setter('places'),
    };
}

/**
 * @param {Marks} self
 * @param {Point} point
 * @returns {[number, number]} CSS pixels from the stage's upper left corner
 */
function place(self, point) {
    const { view, camera, scale, size } = /** @type {Viewpoint} */ (self.viewpoint);
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

/** @param {Marks} self @param {Point} point */
const seen = (self, point) => place(self, point).map((value) => Math.min(FAR, Math.max(-FAR, value)));

/**
 * The turtle's direction in the picture, in degrees clockwise from the right.
 * @param {Marks} self
 * @param {FittedPose} pose
 */
function towards(self, { at, heading }) {
    if (typeof heading === 'number') return -heading;
    const ahead = at.map((value, axis) => value + STEP * (heading[axis] ?? 0));
    const [[x1, y1], [x2, y2]] = [place(self, at), place(self, ahead)];
    return (Math.atan2(y2 - y1, x2 - x1) * 180) / Math.PI;
}

/** @param {Element} group @param {boolean} shown */
const show = (group, shown) => group.toggleAttribute('hidden', !shown);

/** @param {Element | null} element @param {Record<string, number | string>} attributes */
export function setPlaces(element, attributes) {
    for (const [name, value] of Object.entries(attributes))
        element?.setAttribute(name, typeof value === 'number' ? value.toFixed(2) : value);
}

/** @param {number[]} at */
const pair = (at) => at.map((value) => value.toFixed(2)).join(' ');

/** Puts the group's ring around a short mark. @param {Element} group @param {number[][]} corners @returns {boolean} whether the mark is short */
function encircle(group, corners) {
    const [xs = [], ys = []] = [0, 1].map((axis) => corners.map((corner) => corner[axis] ?? 0));
    const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    const ring = /** @type {SVGCircleElement} */ (group.querySelector('circle'));
    setPlaces(ring, { cx: (left + right) / 2, cy: (low + high) / 2 });
    const short = Math.hypot(right - left, high - low) < SHORT;
    show(ring, short);
    return short;
}

/** @param {Marks} self */
function draw(self) {
    show(
        self.frame,
        self.viewpoint !== null &&
            (self.points.length + self.outline.length + self.places.length > 0 || self.pose !== null),
    );
    if (!self.viewpoint) return;
    show(self.found, self.points.length > 0);
    if (self.points.length > 0) {
        const corners = self.points.map((point) => place(self, point));
        const sides = corners.map((corner, at) => within(corner, corners[(at + 1) % corners.length] ?? corner));
        if (corners.length === 2) sides.pop();
        self.found.classList.toggle('outline', corners.length > 2);
        const d = sides.map(([from, to]) => `M${pair(from)}L${pair(to)}`).join('');
        for (const path of self.found.querySelectorAll('path')) setPlaces(path, { d });
        const short = encircle(self.found, sides.flat());
        show(/** @type {Element} */ (self.found.querySelector('.halo')), !short);
    }
    show(self.part, self.outline.length > 0);
    if (self.outline.length > 0) {
        const corners = self.outline.map((point) => seen(self, point));
        const d = `M${corners.map(pair).join('L')}Z`;
        for (const path of self.part.querySelectorAll('path')) setPlaces(path, { d });
        const short = encircle(self.part, corners);
        for (const path of self.part.querySelectorAll('path')) show(path, !short);
    }
    // Lines without length have round ends.
    setPlaces(self.dots, { d: self.places.map((place) => `M${pair(seen(self, place))}h0`).join('') });
    show(self.turtle, self.pose !== null);
    if (self.pose) {
        const [x = 0, y = 0] = seen(self, self.pose.at);
        setPlaces(self.turtle, {
            transform: `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${towards(self, self.pose).toFixed(2)})`,
        });
    }
}
