/** Numbers with a fixed number of decimals. */

import { language } from './words.js';

/**
 * A number as `toFixed` writes it, with the marks of the reader's language.
 * @param {number} value
 * @param {number} digits after the mark
 */
export const decimal = (value, digits) =>
    value.toLocaleString(language, {
        minimumFractionDigits: digits,
        maximumFractionDigits: digits,
        useGrouping: false,
    });
