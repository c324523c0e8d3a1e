/**
 * Holds on to the line under the pointer while zooming: a place on the line stays where it is, so that zooming in on a
 * line never ends beside the line. Zooming does not wait for the search for that line: a line that was near when the
 * search began is brought back afterwards.
 */

import { latest } from '../base/latest.js';

/** Lines this near the pointer are held, in CSS pixels. */
const NEAR = 24;
/** A held place farther from the pointer than this is let go, in CSS pixels. */
const FAR = 40;

/** Right of and below the canvas's centre, in CSS pixels. @typedef {[number, number]} Offset */

/**
 * @param {object} stage
 * @param {(at: Offset, reach: number) => Promise<number[] | null>} stage.grip finds a place on a line near another one, from the view's origin
 * @param {() => string | undefined} stage.origin of the view
 * @param {(place: number[]) => Offset} stage.seen projects a place of the drawing
 * @param {() => number} stage.zoom
 * @param {(dx: number, dy: number) => void} stage.shift moves the picture, in CSS pixels
 */
export function createHold({ grip, origin, seen, zoom, shift }) {
    /** The held place, from an origin: it means nothing from another. @type {{place: number[], from: string | undefined} | null} */
    let held = null;

    /** The search for the line that was clicked last. @type {Promise<void> | null} */
    let clicked = null;

    /** The held place, if it is within `reach` CSS pixels of `at`. @param {Offset} at @param {number} reach */
    function heldNear(at, reach) {
        if (held && (held.from !== origin() || apart(seen(held.place), at) > reach)) held = null;
        return held?.place ?? null;
    }

    /** @param {Offset} at @param {number} reach in CSS pixels */
    async function find(at, reach) {
        try {
            const place = await grip(at, reach);
            held = place && { place, from: origin() };
        } catch {
            // The worker was replaced; no line is held.
            held = null;
        }
    }

    /** Finds a line to hold while zooming at `at`. @param {Offset} at @param {number} from the zoom at which it is near */
    async function follow(at, from) {
        if (heldNear(at, FAR)) return;
        await find(at, NEAR);
        if (!held) return;
        const [x, y] = seen(held.place);
        const part = from / zoom();
        const away = apart([x, y], at);
        if (away > NEAR && away * part <= NEAR) shift((x - at[0]) * (part - 1), (y - at[1]) * (part - 1));
    }

    const ask = latest(follow, () => {});

    return {
        /** The place to hold while zooming at `at`; null while there is no line near. @param {Offset} at */
        at(at) {
            const place = heldNear(at, FAR);
            if (!place) ask(at, zoom());
            return place;
        },

        /** The place to hold while zooming in the middle; null if no line is within `reach` CSS pixels, or a held one a little farther away. @param {number} reach @returns {Promise<number[] | null>} */
        async inMiddle(reach) {
            await clicked;
            if (!heldNear([0, 0], 1.5 * reach)) await find([0, 0], reach);
            return held?.place ?? null;
        },

        /** Holds the line that was clicked, if one is near. @param {Offset} at */
        click: (at) => (clicked = find(at, NEAR)),

        /** Finds the held line again. Returns whether one is held. */
        async again() {
            const place = heldNear([0, 0], Infinity);
            if (place) await find(seen(place), NEAR);
            return held !== null;
        },

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
export function nearest({ fittedFrom, fittedTo }, at, { seen, pointBetween }) {
    const [[x, y], [toX, toY]] = [seen(fittedFrom), seen(fittedTo)];
    const [dx, dy] = [toX - x, toY - y];
    const length = dx * dx + dy * dy;
    const t = length > 0 ? ((at[0] - x) * dx + (at[1] - y) * dy) / length : 0;
    return pointBetween(fittedFrom, fittedTo, Math.max(0, Math.min(1, t)));
}

/** @param {Offset} a @param {Offset} b */
const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
