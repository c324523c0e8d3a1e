/** Text fields for numbers and arithmetic. Arrow keys change the number by a step, with Shift by ten steps, with Alt by a tenth. */

import { valueOf } from './arithmetic.js';
import { plain, readNumber } from '../base/numerals.js';
import { setValue } from '../base/dom.js';
import { rangeNote } from './range-note.js';

/**
 * `expected` is the range in words; `step` is the change of an arrow key.
 * @typedef {{low: number, high: number, expected: string, step: number | (() => number), whole?: boolean, change: (value: number) => void, settle: () => void}} NumberOptions
 */

/**
 * @param {HTMLInputElement} field
 * @param {NumberOptions} range
 * @returns {(value: number) => void} shows a value
 */
export function numberField(field, { low, high, expected, step, whole = false, change, settle }) {
    let shown = 0;
    field.setAttribute('role', 'spinbutton');
    if (isBound(low)) field.setAttribute('aria-valuemin', decimal(low));
    if (isBound(high)) field.setAttribute('aria-valuemax', decimal(high));

    /** @param {number} value */
    const fits = (value) => Math.min(high, Math.max(low, whole ? Math.round(value) : value));
    const show = typedField(field, expected, {
        read() {
            const value = numberIn(field);
            return value === null || fits(value) !== value ? undefined : value;
        },
        next: (event) =>
            fits(stepped(numberIn(field) ?? shown, event, typeof step === 'number' ? step : step(), whole)),
        change: (value) => change((shown = value)),
        leave() {
            const value = numberIn(field);
            const outside = value !== null && fits(value) !== value;
            if (outside) change((shown = fits(value)));
            field.value = plain(shown);
            return outside;
        },
        settle,
    });

    return (value) => {
        shown = value;
        field.setAttribute('aria-valuenow', decimal(value));
        show(value, plain(value));
    };
}

/**
 * A field for an optional number. An empty field shows the inherited number as a placeholder.
 * @param {HTMLInputElement} field
 * @param {{low: number, high: number, expected: string, step: number, change: (value: number | null) => void, settle: () => void}} range
 * @returns {(value: number | null, inherited: number) => void} shows a value and the inherited one
 */
export function optionalField(field, { low, high, expected, step, change, settle }) {
    /** @type {number | null} */
    let shown = null;
    let fallback = 0;
    const written = (/** @type {number | null} */ value) => (value === null ? '' : plain(value));
    const fits = (/** @type {number} */ value) => Math.min(high, Math.max(low, value));
    const show = typedField(field, expected, {
        read() {
            const value = numberIn(field);
            if (field.value.trim() === '') return null;
            return value === null || fits(value) !== value ? undefined : value;
        },
        next: (event) => fits(stepped(numberIn(field) ?? shown ?? fallback, event, step)),
        change: (/** @type {number | null} */ value) => change((shown = value)),
        leave() {
            field.value = written(shown);
            return false;
        },
        settle,
    });

    return (value, inherited) => {
        shown = value;
        fallback = inherited;
        field.placeholder = plain(inherited);
        show(value, written(value));
    };
}

/**
 * What fields for numbers share.
 * @template {number | null} T
 * @param {HTMLInputElement} field
 * @param {string} expected
 * @param {object} on
 * @param {() => T | undefined} on.read the field's value, or undefined if the text is no number within the range
 * @param {(event: KeyboardEvent) => T & number} on.next the number after an arrow key
 * @param {(value: T) => void} on.change
 * @param {() => boolean} on.leave the focus goes; returns whether the number was outside the range
 * @param {() => void} on.settle
 */
function typedField(field, expected, { read, next, change, leave, settle }) {
    const setWrong = rangeNote(field, expected);
    field.addEventListener('input', () => {
        const value = read();
        setWrong(value === undefined);
        if (value !== undefined) change(value);
    });
    field.addEventListener('keydown', (event) => {
        if (event.key === 'Enter') return field.select();
        if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
        event.preventDefault();
        const value = next(event);
        field.value = plain(value);
        setWrong(false);
        change(value);
    });
    field.addEventListener('focus', () => field.select());
    field.addEventListener('blur', () => {
        setWrong(false, leave());
        settle();
    });

    return (/** @type {T} */ value, /** @type {string} */ text) => {
        // Keep the text being typed: "25." must not become "25".
        if (document.activeElement === field && read() === value) return;
        setWrong(false);
        setValue(field, text);
    };
}

/** The number that is written in a field, or the value of its arithmetic. @param {HTMLInputElement} field */
const numberIn = (field) => readNumber(field.value) ?? valueOf(field.value);

/**
 * The number after an arrow key.
 * @param {number} from
 * @param {KeyboardEvent} event
 * @param {number} step
 * @param {boolean} [whole]
 */
function stepped(from, { key, shiftKey, altKey }, step, whole = false) {
    const size = step * (shiftKey ? 10 : altKey && !whole ? 0.1 : 1);
    return Number(plain(from + (key === 'ArrowUp' ? size : -size)));
}

/** A number without an exponent, which ARIA does not support. @param {number} value */
function decimal(value) {
    const digits = String(value).includes('e') ? value.toFixed(12) : String(value);
    return digits.includes('e') ? BigInt(value).toString() : digits;
}

/** Whether a bound limits the number. @param {number} bound */
function isBound(bound) {
    return Math.abs(bound) < 1e21;
}
