/** What a number field wants, in words below its row, while it holds something else. */

import { make } from '../dom.js';
import { grouped, plain } from '../numerals.js';

/**
 * @param {HTMLInputElement} field
 * @param {string} words
 * @returns {(wrong: boolean) => void} to be told whether the field holds something else
 */
export function wanting(field, words) {
    const id = `${field.id}-wanted`;
    const note = make('p', { id, class: 'wanted' }, words);
    return (wrong) => {
        field.toggleAttribute('data-wrong', wrong);
        field.setAttribute('aria-invalid', String(wrong));
        // Who has emptied a field is about to write.
        if (wrong && field.value.trim() !== '') {
            if (note.isConnected) return;
            (field.closest('.dial, .quad, .seed') ?? field).after(note);
            field.setAttribute('aria-errormessage', id);
        } else {
            note.remove();
            field.removeAttribute('aria-errormessage');
        }
    };
}

/** @param {{low: number, high: number, whole?: boolean}} range */
export function wordsOf({ low, high, whole = false }) {
    const sort = whole ? 'a whole number' : 'a number';
    return isBound(low) && isBound(high) ? `Write ${sort} from ${written(low)} to ${written(high)}` : `Write ${sort}`;
}

/** Bounds that only numbers as such have say nothing. @param {number} bound */
export function isBound(bound) {
    return Math.abs(bound) < 1e21;
}

/** @param {number} value */
function written(value) {
    const text = plain(Math.abs(value));
    return (value < 0 ? '−' : '') + (/^\d+$/.test(text) ? grouped(text) : text);
}
