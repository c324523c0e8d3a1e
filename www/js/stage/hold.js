/**
 * Holds on to the line under the pointer while zooming: a place on the line stays where it is, so that zooming in on a
 * line never ends beside the line.
 */

import { latest } from '../latest.js';

/** Lines this near the pointer are held, in CSS pixels. */
const NEAR = 24;
/** A held place farther from the pointer than this is let go, in CSS pixels. */
const FAR = 40;

/** Right of and below the canvas's centre, in CSS pixels. @typedef {[number, number]} Offset */

/**
 * @param {object} stage
 * @param {(at: Offset, reach: number) => Promise<import('../protocol.js').Picked>} stage.pick
 * @param {(place: number[]) => Offset} stage.seen projects a place of the drawing
 * @param {(from: number[], to: number[], t: number) => number[]} stage.pointBetween a place on a segment
 */
export function createHold({ pick, seen, pointBetween }) {
    /** The held place. @type {number[] | null} */
    let held = null;

    /** The search for the line that was clicked last. @type {Promise<void> | null} */
    let clicked = null;

    /** @param {Offset} at @param {number} reach in CSS pixels */
    async function find(at, reach) {
        try {
            const { stroke } = await pick(at, reach);
            held = stroke && nearest(stroke, at, { seen, pointBetween });
        } catch {
            // The worker was replaced; no line is held.
            held = null;
        }
    }

    const ask = latest(pick, ({ stroke }, at) => (held = stroke && nearest(stroke, at, { seen, pointBetween })));

    return {
        /** The place to hold while zooming at `at`; null while there is no line near. @param {Offset} at */
        at(at) {
            if (held && apart(seen(held), at) > FAR) held = null;
            if (!held) ask(at, NEAR);
            return held;
        },

        /** The place to hold while zooming in the middle; null if no line is within `reach` CSS pixels. @param {number} reach @returns {Promise<number[] | null>} */
        async inMiddle(reach) {
            await clicked;
            if (!held || apart(seen(held), [0, 0]) >= reach) await find([0, 0], reach);
            return held;
        },

        /** Holds the line that was clicked, if one is near. @param {Offset} at */
        click: (at) => (clicked = find(at, NEAR)),

        /** The drawing has changed. */
        forget: () => (held = null),
    };
}

/**
 * The place on a segment that is seen nearest to `at`.
 * @param {{fittedFrom: number[], fittedTo: number[]}} stroke
 * @param {Offset} at
 * @param {{seen: (place: number[]) => Offset, pointBetween: (from: number[], to: number[], t: number) => number[]}} stage
 */
function nearest({ fittedFrom, fittedTo }, at, { seen, pointBetween }) {
    const [[x, y], [toX, toY]] = [seen(fittedFrom), seen(fittedTo)];
    const [dx, dy] = [toX - x, toY - y];
    const length = dx * dx + dy * dy;
    const t = length > 0 ? ((at[0] - x) * dx + (at[1] - y) * dy) / length : 0;
    return pointBetween(fittedFrom, fittedTo, Math.max(0, Math.min(1, t)));
}

/** @param {Offset} a @param {Offset} b */
const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
