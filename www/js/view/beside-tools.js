/** The view in which a fitted drawing lies beside the tools on the stage. Pure. */

import { FITTED } from './view.js';

/** @typedef {import('../state/state.js').View} View */
/** Sides in CSS pixels from the stage's upper left corner. @typedef {{left: number, top: number, right: number, bottom: number}} Box */

/** The empty space around a fitted drawing, as a part of the stage's smaller side: as the renderer has it. */
const MARGIN = 0.06;
/** The space between a drawing and the tools, in CSS pixels. */
const GAP = 6;
/** The drawing is moved in steps of this many CSS pixels, and made smaller in steps of this part, so that it rests while a value changes. */
const STEP = 8;
const PART = 0.05;
/** A drawing that would be smaller than this part of its fitted size stays behind the tools. */
const SMALLEST = 0.55;

/**
 * @param {{width: number, height: number}} size of the stage, in CSS pixels
 * @param {number | null | undefined} aspect the drawing's width over its height
 * @param {readonly Box[]} tools
 * @returns {Readonly<View>}
 */
export function viewBeside({ width, height }, aspect, tools) {
    const edge = MARGIN * Math.min(width, height);
    const [across, down] = [width - 2 * edge, height - 2 * edge];
    if (!aspect || !(across > 0) || !(down > 0)) return FITTED;
    const wide = Math.min(across, down * aspect);
    const high = wide / aspect;

    /** Places the drawing within a part of the stage, as near to the middle as it fits. @param {Box} room */
    function placed(room) {
        const fits = Math.min((room.right - room.left) / wide, (room.bottom - room.top) / high);
        const zoom = fits >= 1 ? 1 : Math.floor(fits / PART) * PART;
        const near = (
            /** @type {number} */ middle,
            /** @type {number} */ low,
            /** @type {number} */ most,
            /** @type {number} */ side,
        ) => Math.max(low + side / 2, Math.min(most - side / 2, middle)) - middle;
        const x = near(width / 2, room.left, room.right, wide * zoom);
        const y = near(height / 2, room.top, room.bottom, high * zoom);
        const away = (/** @type {number} */ by) => Math.sign(by) * Math.ceil(Math.abs(by) / STEP) * STEP;
        return { zoom, x: away(x), y: away(y) };
    }

    /** @param {{zoom: number, x: number, y: number}} place */
    const isFree = ({ zoom, x, y }) =>
        tools.every(
            (tool) =>
                Math.abs((tool.left + tool.right) / 2 - width / 2 - x) >= (tool.right - tool.left + wide * zoom) / 2 ||
                Math.abs((tool.top + tool.bottom) / 2 - height / 2 - y) >= (tool.bottom - tool.top + high * zoom) / 2,
        );

    // Each tool is passed at its side, above or below it, or not at all.
    let rooms = [{ left: edge, top: edge, right: width - edge, bottom: height - edge }];
    for (const { left, top, right, bottom } of tools) {
        rooms = rooms.flatMap((room) => [
            room,
            left + right > width
                ? { ...room, right: Math.min(room.right, left - GAP) }
                : { ...room, left: Math.max(room.left, right + GAP) },
            top + bottom > height
                ? { ...room, bottom: Math.min(room.bottom, top - GAP) }
                : { ...room, top: Math.max(room.top, bottom + GAP) },
        ]);
    }
    const [best] = rooms
        .map(placed)
        .filter((place) => place.zoom >= SMALLEST && isFree(place))
        .sort((a, b) => b.zoom - a.zoom || Math.hypot(a.x, a.y) - Math.hypot(b.x, b.y));
    if (!best || (best.zoom === 1 && best.x === 0 && best.y === 0)) return FITTED;
    const extent = Math.max(wide, high) * best.zoom;
    return { x: -best.x / extent, y: best.y / extent, zoom: best.zoom };
}
