/** A text field for a number, with arrow keys: Shift ten steps, Alt a tenth. */

import { plain, readNumber } from '../numerals.js';
import { setValue } from '../dom.js';
import { wanting } from './wanted.js';

/**
 * `wanted` is the range in words; `step` is what an arrow key adds.
 * @typedef {{low: number, high: number, wanted: string, step: number | (() => number), whole?: boolean, change: (value: number) => void, settle: () => void}} Range
 */

/**
 * @param {HTMLInputElement} field
 * @param {Range} range
 * @returns {(value: number) => void} shows another value
 */
export function numberField(field, { low, high, wanted, step, whole = false, change, settle }) {
    let shown = 0;
    const wrong = wanting(field, wanted);
    field.setAttribute('role', 'spinbutton');
    if (isBound(low)) field.setAttribute('aria-valuemin', decimal(low));
    if (isBound(high)) field.setAttribute('aria-valuemax', decimal(high));

    /** @param {number} value */
    const fits = (value) => Math.min(high, Math.max(low, whole ? Math.round(value) : value));
    /** What the field says, or null where it says no number within the range. */
    const read = () => {
        const value = readNumber(field.value);
        return value === null || fits(value) !== value ? null : value;
    };

    field.addEventListener('input', () => {
        const value = read();
        wrong(value === null);
        if (value !== null) change((shown = value));
    });
    field.addEventListener('keydown', (event) => {
        if (event.key === 'Enter') return field.select();
        if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
        event.preventDefault();
        const next = fits(stepped(readNumber(field.value) ?? shown, event, typeof step === 'number' ? step : step(), whole));
        field.value = plain(next);
        wrong(false);
        change((shown = next));
    });
    field.addEventListener('focus', () => field.select());
    field.addEventListener('blur', () => {
        const value = readNumber(field.value);
        const beyond = value !== null && fits(value) !== value;
        if (beyond) change((shown = fits(value)));
        field.value = plain(shown);
        wrong(false, beyond);
        settle();
    });

    return (value) => {
        shown = value;
        field.setAttribute('aria-valuenow', decimal(value));
        // What is being typed stays as it is typed: "25." is not to become "25".
        if (document.activeElement === field && read() === value) return;
        wrong(false);
        setValue(field, plain(value));
    };
}

/**
 * A field for a number that may be left out, for what it has then; it stands there, faint.
 * @param {HTMLInputElement} field
 * @param {{low: number, high: number, wanted: string, step: number, change: (value: number | null) => void, settle: () => void}} range
 * @returns {(value: number | null, inherited: number) => void} shows another value, and what holds without one
 */
export function optionalField(field, { low, high, wanted, step, change, settle }) {
    /** @type {number | null} */
    let shown = null;
    let without = 0;
    const wrong = wanting(field, wanted);
    const written = (/** @type {number | null} */ value) => (value === null ? '' : plain(value));
    const fits = (/** @type {number} */ value) => Math.min(high, Math.max(low, value));
    /** What the field says; undefined where that is neither nothing nor a number within the range. */
    const read = () => {
        const value = readNumber(field.value);
        if (field.value.trim() === '') return null;
        return value === null || fits(value) !== value ? undefined : value;
    };

    field.addEventListener('input', () => {
        const value = read();
        wrong(value === undefined);
        if (value !== undefined) change((shown = value));
    });
    field.addEventListener('keydown', (event) => {
        if (event.key === 'Enter') return field.select();
        if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
        event.preventDefault();
        shown = fits(stepped(readNumber(field.value) ?? shown ?? without, event, step));
        field.value = plain(shown);
        wrong(false);
        change(shown);
    });
    field.addEventListener('focus', () => field.select());
    field.addEventListener('blur', () => {
        field.value = written(shown);
        wrong(false);
        settle();
    });

    return (value, inherited) => {
        shown = value;
        without = inherited;
        field.placeholder = plain(inherited);
        if (document.activeElement === field && read() === value) return;
        wrong(false);
        setValue(field, written(value));
    };
}

/**
 * What an arrow key makes of a number: Shift ten steps, Alt a tenth.
 * @param {number} from
 * @param {KeyboardEvent} event
 * @param {number} step
 * @param {boolean} [whole]
 */
function stepped(from, { key, shiftKey, altKey }, step, whole = false) {
    const size = step * (shiftKey ? 10 : altKey && !whole ? 0.1 : 1);
    return Number(plain(from + (key === 'ArrowUp' ? size : -size)));
}

/** Without an exponent, which ARIA does not know. @param {number} value */
function decimal(value) {
    const digits = String(value).includes('e') ? value.toFixed(12) : String(value);
    return digits.includes('e') ? BigInt(value).toString() : digits;
}

/** Whether a bound says something: the bounds of all numbers do not. @param {number} bound */
function isBound(bound) {
    return Math.abs(bound) < 1e21;
}
