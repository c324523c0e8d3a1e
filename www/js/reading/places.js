/**
 * Places in strings and drawings of any length, as big integers counted from 0, and the rows of a window that scrolls
 * through them. Pure functions.
 */

import { grouped, marked, raised, shortText, unmarked } from '../base/numerals.js';
import { say } from '../base/words.js';

/** The last place that can be reached, because the core counts in 128 bits. */
export const REACH = 2n ** 128n - 1n;
export const REACH_TEXT = `${marked('3.4')} × 10³⁸`;

/** Fractions are rounded to this denominator. */
const STEPS = 2 ** 53;

/**
 * A fraction of a whole, rounded down; exact at 0 and 1.
 * @param {bigint} whole
 * @param {number} part from 0 to 1
 */
export function portion(whole, part) {
    return (whole * BigInt(Math.round(Math.min(1, Math.max(0, part)) * STEPS))) / BigInt(STEPS);
}

/**
 * The fraction of a whole that a place is at, from 0 to 1.
 * @param {bigint} place
 * @param {bigint} whole
 */
export function ratio(place, whole) {
    return whole <= 0n ? 0 : Number((place * BigInt(STEPS)) / whole) / STEPS;
}

/** @param {bigint} value @param {bigint} low @param {bigint} high */
export function within(value, low, high) {
    return value > high ? (high < low ? low : high) : value < low ? low : value;
}

/**
 * The number of rows of a string.
 * @param {bigint} length
 * @param {number} columns
 */
export function rowsOf(length, columns) {
    return (length + BigInt(columns) - 1n) / BigInt(columns);
}

/**
 * The position of the window: its top row, and how far this row is scrolled out, in CSS pixels (less than a row's height).
 * @typedef {{row: bigint, offset: number}} Top
 */

/**
 * The position after scrolling, kept within the string: the last row stays at the window's lower edge.
 * @param {Top} top
 * @param {number} pixels down
 * @param {{rows: bigint, rowHeight: number, height: number}} page
 * @returns {Top}
 */
export function scrolled(top, pixels, { rows, rowHeight, height }) {
    const moved = top.offset + pixels;
    const whole = Math.floor(moved / rowHeight);
    const next = { row: top.row + BigInt(whole), offset: moved - whole * rowHeight };
    const last = lastTop({ rows, rowHeight, height });
    if (next.row < 0n) return { row: 0n, offset: 0 };
    if (next.row > last.row || (next.row === last.row && next.offset > last.offset)) return last;
    return next;
}

/**
 * The lowest position of the window.
 * @param {{rows: bigint, rowHeight: number, height: number}} page
 * @returns {Top}
 */
export function lastTop({ rows, rowHeight, height }) {
    const fitting = Math.ceil(height / rowHeight);
    const row = rows - BigInt(fitting);
    return row < 0n ? { row: 0n, offset: 0 } : { row, offset: fitting * rowHeight - height };
}

/**
 * A position that shows a row: unchanged if the row is visible, else with the row in the middle.
 * @param {Top} top
 * @param {bigint} row
 * @param {{rows: bigint, rowHeight: number, height: number}} page
 * @returns {Top}
 */
export function revealed(top, row, page) {
    const fitting = BigInt(Math.max(1, Math.floor(page.height / page.rowHeight)));
    if (row > top.row && row < top.row + fitting - 1n) return top;
    if (row === top.row && top.offset === 0) return top;
    const to = row - fitting / 2n;
    return scrolled({ row: to < 0n ? 0n : to, offset: 0 }, 0, page);
}

/**
 * Reads a typed position, counted from 1: `1,234`, `10^12`, `1e12`, `2.5e6`, `2·10^30`, `50 %`, `end`.
 * @param {string} text
 * @param {bigint} length of the whole
 * @returns {bigint | null} counted from 0 and within the whole; null if the text is no position
 */
export function readPlace(text, length) {
    const last = length > 0n ? length - 1n : 0n;
    const words = unmarked(text.trim().toLowerCase());
    if (words === 'end' || words === 'last') return last;
    if (words === 'start' || words === 'first') return 0n;
    const percent = /^(\d+(?:\.\d+)?|\.\d+)\s*%$/.exec(words.replace(/(\d),(\d{1,2})(?=\s*%)/, '$1.$2'));
    if (percent) return within(portion(length, Number(percent[1]) / 100), 0n, last);
    const plain = words
        .replace(/[\s_,’']/g, '')
        .replace(/[·*]/g, '×')
        .replace(/×10(\^|(?=[⁰¹²³⁴-⁹]))/, 'e')
        .replace(/^10(\^|(?=[⁰¹²³⁴-⁹]))/, '1e');
    const digits = plain.replace(/[⁰¹²³⁴-⁹]/g, (digit) => String('⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(digit)));
    const number = /^(\d+)(?:\.(\d*))?(?:e\+?(\d{1,4}))?$/.exec(digits);
    if (!number) return null;
    const [, whole = '', fraction = '', exponent = '0'] = number;
    const shift = Number(exponent) - fraction.length;
    const mantissa = BigInt(whole + fraction);
    const value = shift >= 0 ? mantissa * 10n ** BigInt(shift) : mantissa / 10n ** BigInt(-shift);
    return within(value - 1n, 0n, last);
}

/**
 * A place for the margin, counted from 1; of a long number only the last digits.
 * @param {bigint} place counted from 0
 */
export function marginText(place) {
    const digits = String(place + 1n);
    return digits.length <= 7 ? grouped(digits) : `…${grouped(digits.slice(-6))}`;
}

/**
 * The speed that covers the whole in a number of seconds, at least 1 per second.
 * @param {bigint} whole
 * @param {number} seconds
 */
export const pace = (whole, seconds) => Math.max(1, Number(whole) / seconds);

/**
 * A speed in words: `1,200 a second`, `3.1 × 10²⁶ a second`.
 * @param {number} perSecond
 */
export function paceText(perSecond) {
    if (perSecond < 10) return say`${marked(perSecond.toFixed(perSecond < 2 ? 1 : 0).replace(/\.0$/, ''))} a second`;
    if (perSecond < 1e9) return say`${Math.round(perSecond)} a second`;
    const exponent = Math.floor(Math.log10(perSecond));
    const number = `${marked((perSecond / 10 ** exponent).toFixed(1))}\u2009×\u200910${raised(exponent)}`;
    return say`${number} a second`;
}

/** A count in short form. @param {bigint} count */
export const countText = (count) => shortText(String(count));

/**
 * A position: in full up to `most` digits, else in short form.
 * @param {bigint} place
 * @param {number} [most]
 */
export function placeText(place, most = 12) {
    const digits = String(place);
    return digits.length > most ? shortText(digits) : grouped(digits);
}
