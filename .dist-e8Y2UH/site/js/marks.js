/** What is marked upon the drawing: a segment, the outline of a part, the turtle. They move with the view. */

import { byId } from './dom.js';

/** @typedef {import('./state.js').View} View */
/** Right of and above the fitted centre, in fitted extents. @typedef {[number, number]} Point */
/** `scale` in CSS pixels per fitted extent at zoom 1. @typedef {{view: View, scale: number, size: {width: number, height: number}}} Sight */

/** Farther outside the frame nothing is drawn exactly, in CSS pixels. */
const FAR = 1e5;
/** At larger zooms a number has no digits left for a place, and nothing is marked. */
export const DEEPEST = 1e12;
/** A shorter mark gets a ring, so that it is found, in CSS pixels. */
const SHORT = 9;

export function createMarks() {
    const frame = byId('marks', SVGSVGElement);
    const segment = byId('mark-segment', SVGGElement);
    const part = byId('mark-part', SVGGElement);
    const turtle = byId('mark-turtle', SVGGElement);
    /** @type {Sight | null} */
    let sight = null;
    /** @type {[Point, Point] | null} */
    let ends = null;
    /** @type {Point[]} */
    let outline = [];
    /** @type {{at: Point, heading: number} | null} */
    let pose = null;

    /** @param {Point} point */
    function seen([x, y]) {
        const { view, scale, size } = /** @type {Sight} */ (sight);
        const pixels = scale * view.zoom;
        const clamp = (/** @type {number} */ value) => Math.min(FAR, Math.max(-FAR, value));
        return [clamp(size.width / 2 + (x - view.x) * pixels), clamp(size.height / 2 - (y - view.y) * pixels)];
    }

    /** @param {Element} group @param {boolean} shown */
    const show = (group, shown) => group.toggleAttribute('hidden', !shown);
    /** @param {Element} element @param {Record<string, number | string>} attributes */
    function set(element, attributes) {
        for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, typeof value === 'number' ? value.toFixed(2) : value);
    }

    function place() {
        show(frame, sight !== null && sight.view.zoom <= DEEPEST && (ends !== null || outline.length > 0 || pose !== null));
        if (!sight) return;
        show(segment, ends !== null);
        if (ends) {
            const [[x1, y1], [x2, y2]] = /** @type {[[number, number], [number, number]]} */ (ends.map(seen));
            for (const line of segment.querySelectorAll('line')) set(line, { x1, y1, x2, y2 });
            const ring = /** @type {SVGCircleElement} */ (segment.querySelector('circle'));
            set(ring, { cx: (x1 + x2) / 2, cy: (y1 + y2) / 2 });
            const short = Math.hypot(x2 - x1, y2 - y1) < SHORT;
            show(ring, short);
            show(/** @type {Element} */ (segment.querySelector('.halo')), !short);
        }
        show(part, outline.length > 0);
        if (outline.length > 0) {
            const corners = outline.map(seen);
            const d = `M${corners.map((corner) => corner.map((value) => value?.toFixed(2)).join(' ')).join('L')}Z`;
            for (const path of part.querySelectorAll('path')) set(path, { d });
            const [xs, ys] = [0, 1].map((axis) => corners.map((corner) => corner[axis] ?? 0));
            const [left, right, low, high] = [Math.min(...(xs ?? [])), Math.max(...(xs ?? [])), Math.min(...(ys ?? [])), Math.max(...(ys ?? []))];
            const ring = /** @type {SVGCircleElement} */ (part.querySelector('circle'));
            set(ring, { cx: (left + right) / 2, cy: (low + high) / 2 });
            const short = Math.max(right - left, high - low) < SHORT;
            show(ring, short);
            for (const path of part.querySelectorAll('path')) show(path, !short);
        }
        show(turtle, pose !== null);
        if (pose) {
            const [x, y] = seen(pose.at);
            set(turtle, { transform: `translate(${x?.toFixed(2)} ${y?.toFixed(2)}) rotate(${(-pose.heading).toFixed(2)})` });
        }
    }

    return {
        /** @param {Sight | null} next */
        look(next) {
            sight = next;
            place();
        },
        /** @param {[Point, Point] | null} next from and to */
        segment(next) {
            if (ends === null && next === null) return;
            ends = next;
            place();
        },
        /** @param {Point[]} next */
        part(next) {
            if (outline.length === 0 && next.length === 0) return;
            outline = next;
            place();
        },
        /** @param {{at: Point, heading: number} | null} next heading in degrees counter-clockwise from the right */
        turtle(next) {
            if (pose === null && next === null) return;
            pose = next;
            place();
        },
    };
}
