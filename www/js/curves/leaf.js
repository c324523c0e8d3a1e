/**
 * Leaves: surfaces of one Bezier patch that three curves describe, each by four points along the midrib. The outline is half
 * of the width, the others are heights: of the midrib, and of the margins. Pure functions.
 */

/** @typedef {import('./curve.js').Point} Point */
/** A curve for each of `PARTS`; `start` and `end` are the place of the numbers in the surfaces. @typedef {{name: string, start: number, end: number, curves: Point[][]}} Leaf */

export const PARTS = Object.freeze(['outline', 'midrib', 'margins']);

/** A leaf that is gently folded and bent. @type {readonly (readonly Point[])[]} */
export const FRESH = [
    [0.03, 0.4, 0.3, 0],
    [0, -0.04, 0.02, -0.1],
    [0, 0.08, 0.1, -0.1],
].map((heights) => heights.map((y, at) => /** @type {Point} */ ([[0, 0.3, 0.7, 1][at] ?? 0, y])));

const LINE = /^([^\S\r\n]*(\p{L})[^\S\r\n]*:[^\S\r\n]*)([^\r\n]*)/gmu;
const USE = /\bsurface\s+(\p{L})(?!\p{L})/giu;
/** Numbers of files are rounded: coordinates are as good as equal within this part of the surface's size. */
const ROUNDED = 1 / 500;

/** The surfaces that are leaves, in text order. @param {string} surfaces @returns {Leaf[]} */
export function leavesIn(surfaces) {
    const found = [];
    for (const { index, 1: head = '', 2: name = '', 3: text = '' } of surfaces.matchAll(LINE)) {
        const curves = curvesOf(
            text
                .split(/[\s,]+/)
                .filter(Boolean)
                .map(Number),
        );
        const start = index + head.length;
        if (curves) found.push({ name, start, end: start + text.length, curves });
    }
    return found;
}

/** @param {number[]} numbers @returns {Point[][] | null} */
function curvesOf(numbers) {
    if (numbers.length !== 48 || !numbers.every(Number.isFinite)) return null;
    const near = Math.max(...numbers.map(Math.abs)) * ROUNDED;
    const rows = [0, 1, 2, 3].map((row) => {
        const [ahead = 0, width = 0, margin = 0, , , midrib = 0] = numbers.slice(12 * row);
        return { ahead, width, margin, midrib };
    });
    const leaf = rows.flatMap(pointsOf);
    const isLeaf = numbers.every((number, at) => Math.abs(number - (leaf[at] ?? 0)) <= near);
    const ordered = rows.every(({ ahead }, at) => at === 0 || (rows[at - 1]?.ahead ?? ahead) <= ahead);
    if (!isLeaf || !ordered || (rows[0]?.ahead ?? 0) >= (rows[3]?.ahead ?? 0)) return null;
    return [
        rows.map(({ ahead, width }) => [ahead, width]),
        rows.map(({ ahead, midrib }) => [ahead, midrib]),
        rows.map(({ ahead, margin }) => [ahead, margin]),
    ];
}

/** A row of control points, from left to right. @param {{ahead: number, width: number, margin: number, midrib: number}} row */
const pointsOf = ({ ahead, width, margin, midrib }) =>
    [
        [ahead, width, margin],
        [ahead, width / 3, midrib],
        [ahead, -width / 3, midrib],
        [ahead, -width, margin],
    ].flat();

/** The numbers of a leaf. @param {readonly (readonly Point[])[]} curves */
export function numbersOf([outline = [], midrib = [], margins = []]) {
    const rows = outline.map(([ahead, width], at) =>
        pointsOf({ ahead, width, midrib: midrib[at]?.[1] ?? 0, margin: margins[at]?.[1] ?? 0 }),
    );
    return rows
        .flat()
        .map((number) => Number(number.toPrecision(6)) || 0)
        .join(' ');
}

/** The curves with another one: the points of all lie at the same places along the midrib. @param {readonly (readonly Point[])[]} curves @param {number} part @param {readonly Point[]} points @returns {Point[][]} */
export const withCurve = (curves, part, points) =>
    curves.map((curve, at) =>
        curve.map(([x, y], row) => [points[row]?.[0] ?? x, (at === part ? points[row]?.[1] : null) ?? y]),
    );

/** The surfaces that custom symbols draw and that are not there. @param {string} overrides @param {string} surfaces */
export function missingFrom(overrides, surfaces) {
    const used = new Set([...overrides.matchAll(USE)].map(([, name = '']) => name));
    for (const [, , name = ''] of surfaces.matchAll(LINE)) used.delete(name);
    return [...used];
}
