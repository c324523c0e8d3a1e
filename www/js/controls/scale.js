/** Slider scales for unlimited values: the range follows the value. Pure functions. */

import { plain } from '../base/numerals.js';

/** The minimum number of stops between zero and twice the value, except for whole values. */
const FEWEST = 200;
/** A value below this fraction of the scale needs a finer scale. */
const SMALL = 1 / 20;

/**
 * Stops from zero to twice a value, or from -1 to 1 if the value is zero. Steps are 1, 2 or 5 times a power of ten, and
 * at least 1 for whole values from 20 on.
 * @param {number} value finite
 * @returns {number[]} ascending
 */
export function scaleAbout(value) {
    const size = Math.min(Math.abs(value) || 1, Number.MAX_VALUE / 4);
    const span = 2 * size;
    const fine = stepBelow(span / FEWEST);
    const step = Number.isInteger(value) && size >= 20 ? Math.max(1, fine) : fine;
    const most = Math.ceil(Number((span / step).toPrecision(12)));
    const up = Array.from({ length: most + 1 }, (_, at) => Number((at * step).toPrecision(12)));
    if (value > 0) return up;
    const down = up.map((stop) => 0 - stop).reverse();
    return value < 0 ? down : [...down.slice(most / 2, -1), ...up.slice(0, most / 2 + 1)];
}

/** The largest 1, 2 or 5 times a power of ten up to `most`. @param {number} most above 0 */
function stepBelow(most) {
    const power = 10 ** Math.floor(Math.log10(most));
    const times = [5, 2, 1].find((factor) => factor * power <= most * (1 + 1e-9)) ?? 1;
    return Number((times * power).toPrecision(3)) || Number.MIN_VALUE;
}

/**
 * Whether a value needs a new scale: the value is outside the scale, at its end, or too small for its steps.
 * @param {readonly number[]} stops ascending
 * @param {number} value
 */
export function needsNewScale(stops, value) {
    const [low = 0, high = 0] = [stops[0], stops.at(-1)];
    const size = Math.max(-low, high);
    return value < low || value > high || Math.abs(value) >= size || (value !== 0 && Math.abs(value) < size * SMALL);
}

/**
 * Writes a number like the former one: without a zero before the point if the former had none.
 * @param {number} value
 * @param {string} former
 */
export function writtenAs(value, former) {
    const written = plain(value);
    return /^\s*[-+−]?\./.test(former) ? written.replace(/^(-?)0\./, '$1.') : written;
}
