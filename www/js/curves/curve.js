/** Curves in rules, such as `curve taper = (0, 1) (0.4, 0.8) (1, 0.1)`: found, drawn and changed. Pure functions. */

/** @typedef {readonly [number, number]} Point */
/** @typedef {{name: string, start: number, end: number, points: readonly Point[]}} Curve the points' place in the rules, in UTF-16 units */

/** The most points that the editor makes; the rules may have more. */
export const MOST_POINTS = 8;

const NUMBER = '[-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[eE][-+]?\\d+)?';
const POINT = new RegExp(`\\(\\s*(${NUMBER})\\s*,\\s*(${NUMBER})\\s*\\)`, 'g');
const LINE = /^([^\S\r\n]*curve[^\S\r\n]+([\p{L}_][\p{L}\p{N}_]*)[^\S\r\n]*=)([^\r\n]*)/gmu;

/** The curves whose points are plain numbers, in text order. @param {string} rules @returns {Curve[]} */
export function curvesIn(rules) {
    const found = [];
    for (const { index, 1: head = '', 2: name = '', 3: rest = '' } of rules.matchAll(LINE)) {
        const text = rest.split('/*')[0] ?? '';
        if (text.replace(POINT, '').replace(/[\s,]/g, '') !== '') continue;
        const points = [...text.matchAll(POINT)].map(({ 1: x, 2: y }) => /** @type {Point} */ ([Number(x), Number(y)]));
        const start = index + head.length + text.indexOf('(');
        if (isCurve(points)) found.push({ name, start, end: index + head.length + text.lastIndexOf(')') + 1, points });
    }
    return found;
}

/** Whether points are a curve: crates/lsystem-syntax/src/curve.rs. @param {readonly Point[]} points */
function isCurve(points) {
    const ordered = points.every(([x], at) => at === 0 || (points[at - 1]?.[0] ?? x) <= x);
    return ordered && points.length >= 2 && (points[0]?.[0] ?? 0) < (points.at(-1)?.[0] ?? 0);
}

/** Points in the notation. @param {readonly Point[]} points */
export const written = (points) => points.map(([x, y]) => `(${x}, ${y})`).join(' ');

/**
 * A point of the curve: the spline of curve.rs, by de Boor's algorithm.
 * @param {readonly Point[]} points
 * @param {number} u from 0 to the number of spans
 * @returns {Point}
 */
function splinePoint(points, u) {
    const degree = Math.min(3, points.length - 1);
    const spans = points.length - degree;
    const span = Math.min(Math.floor(u), spans - 1);
    const knot = (/** @type {number} */ at) => Math.min(Math.max(at - degree, 0), spans);
    const near = points.slice(span, span + degree + 1).map(([x, y]) => [x, y]);
    for (let round = 1; round <= degree; round++) {
        for (let at = degree; at >= round; at--) {
            const [from, to] = [knot(span + at), knot(span + at + 1 + degree - round)];
            const part = (u - from) / (to - from);
            const before = near[at - 1];
            near[at] = (near[at] ?? []).map((value, axis) => (1 - part) * (before?.[axis] ?? 0) + part * value);
        }
    }
    return /** @type {[number, number]} */ (near[degree]);
}

/** Points along the curve. @param {readonly Point[]} points @param {number} [pieces] for each span @returns {Point[]} */
export function along(points, pieces = 24) {
    const count = (points.length - Math.min(3, points.length - 1)) * pieces;
    return Array.from({ length: count + 1 }, (_, at) => splinePoint(points, at / pieces));
}

/** The extent of a plot: around the points, with y = 0 if it is near. @param {readonly Point[]} points */
export function extentOf(points) {
    const ys = points.map(([, y]) => y);
    const [low, high] = [Math.min(...ys), Math.max(...ys)];
    const size = high - low || Math.abs(high) || 1;
    const bottom = low >= 0 && low <= 2 * size ? 0 : low - size / 5;
    const top = high <= 0 && high >= -2 * size ? 0 : high + size / 5;
    return { left: points[0]?.[0] ?? 0, right: points.at(-1)?.[0] ?? 1, bottom, top };
}

/** A hundredth of an extent, as 1, 0.1, 0.01, ...: the step of the arrow keys. @param {number} extent */
export const stepOf = (extent) => 10 ** (Math.floor(Math.log10(extent) + 1e-9) - 2);

/** A number on steps. @param {number} value @param {number} step */
export const onSteps = (value, step) => Number((Math.round(value / step) * step).toPrecision(10));

/**
 * The points with one of them elsewhere: between its neighbours along x, and the ends apart.
 * @param {readonly Point[]} points
 * @param {number} at
 * @param {Point} to
 * @returns {Point[]}
 */
export function moved(points, at, [x, y]) {
    const [low, high] = [points[at - 1]?.[0] ?? -Infinity, points[at + 1]?.[0] ?? Infinity];
    const next = points.map((point, index) =>
        index === at ? /** @type {Point} */ ([Math.min(Math.max(x, low), high), y]) : point,
    );
    return isCurve(next) ? next : points.slice();
}

/**
 * The points with another one.
 * @param {readonly Point[]} points
 * @param {Point} point
 * @returns {{points: Point[], at: number}} and the place of the new point
 */
export function withPoint(points, point) {
    const behind = points.findIndex(([x], at) => at > 0 && x >= point[0]);
    const at = behind < 0 ? points.length : point[0] < (points[0]?.[0] ?? 0) ? 0 : behind;
    return { points: [...points.slice(0, at), point, ...points.slice(at)], at };
}

/** The points without one; the same if it is an end, or if only two are left. @param {readonly Point[]} points @param {number} at @returns {Point[]} */
export function withoutPoint(points, at) {
    return at > 0 && at < points.length - 1 ? points.filter((_, index) => index !== at) : points.slice();
}

/** The middle of the widest gap along x, on the curve. @param {readonly Point[]} points @returns {Point} */
export function widestGap(points) {
    let best = 0;
    const gap = (/** @type {number} */ at) => (points[at + 1]?.[0] ?? 0) - (points[at]?.[0] ?? 0);
    for (let at = 1; at < points.length - 1; at++) if (gap(at) > gap(best)) best = at;
    const x = (points[best]?.[0] ?? 0) + gap(best) / 2;
    const line = along(points, 96);
    const near = line.find(([own]) => own >= x) ?? line.at(-1);
    return [x, near?.[1] ?? 0];
}
