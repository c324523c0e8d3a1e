/** A text field for a number, with arrow keys: Shift ten steps, Alt a tenth. */

import { plain, readNumber } from '../numerals.js';
import { setValue } from '../dom.js';

/** @typedef {{low: number, high: number, step: number | (() => number), whole?: boolean, change: (value: number) => void, settle: () => void}} Range */

/**
 * @param {HTMLInputElement} field
 * @param {Range} range
 * @returns {(value: number) => void} shows another value
 */
export function numberField(field, { low, high, step, whole = false, change, settle }) {
    let shown = 0;
    field.setAttribute('role', 'spinbutton');
    // Bounds that only numbers as such have say nothing.
    if (Math.abs(low) < 1e21) field.setAttribute('aria-valuemin', decimal(low));
    if (Math.abs(high) < 1e21) field.setAttribute('aria-valuemax', decimal(high));

    /** @param {number} value */
    const fits = (value) => Math.min(high, Math.max(low, whole ? Math.round(value) : value));
    /** What the field says, or null where it says no number within the range. */
    const read = () => {
        const value = readNumber(field.value);
        return value === null || fits(value) !== value ? null : value;
    };

    field.addEventListener('input', () => {
        const value = read();
        field.toggleAttribute('data-wrong', value === null);
        if (value !== null) change((shown = value));
    });
    field.addEventListener('keydown', (event) => {
        if (event.key === 'Enter') return field.select();
        if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
        event.preventDefault();
        const size = (typeof step === 'number' ? step : step()) * (event.shiftKey ? 10 : event.altKey && !whole ? 0.1 : 1);
        const from = readNumber(field.value) ?? shown;
        const next = fits(Number(plain(from + (event.key === 'ArrowUp' ? size : -size))));
        field.value = plain(next);
        field.removeAttribute('data-wrong');
        change((shown = next));
    });
    field.addEventListener('focus', () => field.select());
    field.addEventListener('blur', () => {
        const value = readNumber(field.value);
        if (value !== null && fits(value) !== value) change((shown = fits(value)));
        field.value = plain(shown);
        field.removeAttribute('data-wrong');
        settle();
    });

    return (value) => {
        shown = value;
        field.setAttribute('aria-valuenow', decimal(value));
        // What is being typed stays as it is typed: "25." is not to become "25".
        if (document.activeElement === field && read() === value) return;
        field.removeAttribute('data-wrong');
        setValue(field, plain(value));
    };
}

/** Without an exponent, which ARIA does not know. @param {number} value */
function decimal(value) {
    const digits = String(value).includes('e') ? value.toFixed(12) : String(value);
    return digits.includes('e') ? BigInt(value).toString() : digits;
}
