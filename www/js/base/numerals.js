/** Writing numbers in the reader's language, and reading them. Pure functions. */

import { language } from './words.js';

const THIN_SPACE = '\u2009';

const parts = new Intl.NumberFormat(language).formatToParts(1234567.5);
const markOf = (/** @type {string} */ kind) => parts.find(({ type }) => type === kind)?.value ?? '';
/** What stands between groups of digits, and before decimals. */
const [GROUP, DECIMAL] = [markOf('group'), markOf('decimal')];

/** The digits of a number with the language's mark before decimals. @param {string} digits with a point */
export const marked = (digits) => digits.replace('.', DECIMAL);

/** A number as `toFixed` writes it, with the language's mark. @param {number} value @param {number} digits after the mark */
export const decimal = (value, digits) => marked(value.toFixed(digits));

/** Numbers in a row, apart from the marks in them. @param {readonly string[]} numbers */
export const listed = (numbers) => numbers.join(DECIMAL === ',' ? '; ' : ', ');

/** A number with the marks of English, from one in the reader's language. @param {string} text */
export function unmarked(text) {
    if (DECIMAL === '.') return text;
    const whole = GROUP === '.' ? text.replace(/\.(?=\d{3}(?!\d))/g, '') : text;
    // Several commas are those between groups.
    return whole.split(',').length === 2 ? whole.replace(',', '.') : whole;
}

/**
 * Digits in groups of three.
 * @param {string} digits of a whole number
 */
export function grouped(digits) {
    return digits.replace(/\B(?=(\d{3})+$)/g, GROUP);
}

/**
 * A whole number in short form: up to nine digits in full, more as mantissa and exponent.
 * @param {string} digits
 * @returns {{mantissa: string, exponent: number | null}}
 */
export function short(digits) {
    if (digits.length <= 9) return { mantissa: grouped(digits), exponent: null };
    let hundredths = Math.round(Number(digits.slice(0, 4)) / 10);
    let exponent = digits.length - 1;
    if (hundredths === 1000) {
        hundredths = 100;
        exponent += 1;
    }
    return { mantissa: marked((hundredths / 100).toFixed(2)), exponent };
}

/**
 * A whole number in short form as plain text, such as `1.23 × 10⁴⁵`.
 * @param {string} digits
 */
export function shortText(digits) {
    const { mantissa, exponent } = short(digits);
    return exponent === null ? mantissa : `${mantissa}${THIN_SPACE}×${THIN_SPACE}10${raised(exponent)}`;
}

/** A whole number in superscript digits. @param {number} value */
export function raised(value) {
    return [...String(value)].map((digit) => (digit === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(digit)])).join('');
}

/**
 * A zoom factor for the toolbar: `100 %`, `×12`, `×1.5·10⁶`.
 * @param {number} zoom
 */
export function zoomText(zoom) {
    if (zoom < 10) return `${zoom < 0.1 ? marked((zoom * 100).toFixed(1)) : Math.round(zoom * 100)}${THIN_SPACE}%`;
    if (zoom < 10_000) return `×${grouped(String(Math.round(zoom)))}`;
    const exponent = Math.floor(Math.log10(zoom));
    return `×${marked((zoom / 10 ** exponent).toFixed(1))}·10${raised(exponent)}`;
}

/**
 * Reads a typed number: decimal comma or point, any minus sign, an optional unit.
 * @param {string} text
 * @returns {number | null}
 */
export function readNumber(text) {
    const plain = text
        .trim()
        .replace(/[−–]/g, '-')
        .replace(',', '.')
        .replace(/\s*(°|px|%|steps?)$/, '');
    return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) ? Number(plain) : null;
}

/**
 * A number for a field, with at most twelve digits.
 * @param {number} value
 */
export function plain(value) {
    return String(Number(value.toPrecision(12)));
}
