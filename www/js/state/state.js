/**
 * The page's state: one flat value that controls, links, undo and the worker share. Its fields are defined in
 * tables.js. This module never touches the page.
 */

import { FIELDS as TABLE } from '../tables.js';
import { said, say } from '../base/words.js';

/** @typedef {import('../tables.js').Definition} Definition */
/** @typedef {import('../tables.js').FieldName} FieldName */
/** @typedef {import('../tables.js').NumberRange} NumberRange */
/** @typedef {import('../tables.js').Range} Range */
/** @typedef {Definition['dialect']} Dialect */
/** @typedef {Definition['colourBy']} ColourBy */
/** @typedef {Definition['ink']} Ink */
/** @typedef {import('../protocol.js').View} View */
/** @typedef {import('../protocol.js').Camera} Camera */
/** @typedef {Definition & {view: View | null, camera: Camera | null}} State `view` and `camera` are null until the reader moves them. */

/** The names of the state's fields. */
export const FIELDS = /** @type {FieldName[]} */ (Object.keys(TABLE));

/** @type {Readonly<State>} */
export const DEFAULTS = Object.freeze(
    /** @type {any} */ (Object.fromEntries(FIELDS.map((field) => [field, TABLE[field].default]))),
);

/**
 * The range of a number field, or of a number in a record or list field.
 * @param {FieldName} field
 * @param {string} [member]
 * @returns {NumberRange}
 */
export function rangeOf(field, member = '') {
    const { [field]: found } = TABLE;
    const range = found.kind === 'record' ? found.members[member] : found.kind === 'list' ? found.each : found;
    if (range?.kind !== 'number') throw new Error(`${field} ${member} is no number`);
    return range;
}

/** The maximum number of characters or colours in a field. @param {FieldName} field */
export function maxLengthOf(field) {
    const { [field]: found } = TABLE;
    return 'maxLength' in found ? found.maxLength : Infinity;
}

/**
 * The nearest valid value of a field, or undefined if there is none.
 * @param {FieldName} field
 * @param {unknown} value
 */
export function cleanField(field, value) {
    const { [field]: found } = TABLE;
    if (value === null && found.optional) return null;
    if (field === 'view')
        return viewOf(nearest(found, typeof value === 'object' ? { fx: 0, fy: 0, at: '', ...value } : value));
    return nearest(found, value);
}

/**
 * The problem with a value of a field, in words: the value is out of range and was replaced by the nearest valid one,
 * or the value is invalid.
 * @param {FieldName} field
 * @param {unknown} value
 * @returns {string | null}
 */
export function problemOf(field, value) {
    const taken = cleanField(field, value);
    const { expected } = TABLE[field];
    if (taken === undefined) return say`must be ${said(expected)}; it was left out`;
    return isAsGiven(value, taken) ? null : say`must be ${said(expected)}; the nearest value was taken`;
}

/**
 * A valid state from untrusted values: each field becomes its nearest valid value, or the value of `base` if there is
 * none. Unknown fields are ignored.
 * @param {object} values
 * @param {Readonly<State>} [base]
 * @returns {State}
 */
export function clean(values, base = DEFAULTS) {
    const given = /** @type {Record<string, unknown>} */ (values);
    /** @type {Record<string, unknown>} */
    const state = {};
    for (const field of FIELDS) {
        const value = Object.hasOwn(given, field) ? cleanField(field, given[field]) : undefined;
        state[field] = value === undefined ? structuredClone(base[field]) : value;
    }
    return /** @type {State} */ (state);
}

/**
 * The part of a state that the worker, files and the gallery use: everything but the view and the camera.
 * @param {Readonly<State>} state
 * @returns {Definition}
 */
export function definitionOf(state) {
    const { view: _, camera: __, ...definition } = state;
    return definition;
}

/**
 * Whether two values of one field are the same.
 * @param {unknown} a
 * @param {unknown} b
 */
export function same(a, b) {
    return (
        Object.is(a, b) || (typeof a === 'object' && typeof b === 'object' && JSON.stringify(a) === JSON.stringify(b))
    );
}

/**
 * Whether two states are equal but for their view and camera.
 * @param {Readonly<State>} a
 * @param {Readonly<State>} b
 */
export function sameSystem(a, b) {
    return FIELDS.every((field) => field === 'view' || field === 'camera' || same(a[field], b[field]));
}

/**
 * `theirs` with what `mine` has changed since `base`, or null if both have changed the same field.
 * @param {Readonly<State>} base
 * @param {Readonly<State>} mine
 * @param {Readonly<State>} theirs
 * @returns {State | null}
 */
export function merged(base, mine, theirs) {
    const changes = FIELDS.filter((field) => !same(mine[field], base[field]));
    const clashes = (/** @type {keyof State} */ field) =>
        !same(theirs[field], base[field]) && !same(theirs[field], mine[field]);
    if (changes.some((field) => field !== 'view' && field !== 'camera' && clashes(field))) return null;
    return { ...theirs, ...Object.fromEntries(changes.map((field) => [field, mine[field]])) };
}

/**
 * Whether two states draw the same segments.
 * @param {Readonly<State>} a
 * @param {Readonly<State>} b
 */
export function sameDrawing(a, b) {
    return FIELDS.every((field) => TABLE[field].affects !== 'drawing' || same(a[field], b[field]));
}

/**
 * The nearest value in a range, or undefined if there is none.
 * @param {Range} range
 * @param {unknown} value
 * @returns {any}
 */
function nearest(range, value) {
    switch (range.kind) {
        case 'text':
            // Half a surrogate pair cannot be written into a link or a file.
            return typeof value === 'string'
                ? value
                      .slice(0, range.maxLength)
                      .replace(/\r\n?/g, '\n')
                      .replace(/\p{Surrogate}/gu, '\ufffd')
                : undefined;
        case 'number':
            if (typeof value !== 'number' || !Number.isFinite(value)) return undefined;
            // Adding 0 turns -0 into 0, which links and files cannot tell apart.
            return Math.min(range.high, Math.max(range.low, range.whole ? Math.round(value) : value)) + 0;
        case 'word':
            return range.words.find((word) => word === value);
        case 'flag':
            return typeof value === 'boolean' ? value : undefined;
        case 'colour':
            return typeof value === 'string' && /^#[0-9a-f]{6}$/i.test(value) ? value.toLowerCase() : undefined;
        case 'colours':
            return Array.isArray(value) && value.length > 0
                ? all(value.slice(0, range.maxLength).map((one) => nearest({ kind: 'colour' }, one)))
                : undefined;
        case 'list':
            return Array.isArray(value) && value.length === range.count
                ? all(value.map((one) => nearest(range.each, one)))
                : undefined;
        case 'record': {
            if (typeof value !== 'object' || value === null) return undefined;
            const given = /** @type {Record<string, unknown>} */ (value);
            const members = Object.entries(range.members).map(([name, each]) => [name, nearest(each, given[name])]);
            return all(members.map(([, member]) => member)) && Object.fromEntries(members);
        }
    }
}

/** The list, or undefined if an element is undefined. @param {unknown[]} list */
function all(list) {
    return list.includes(undefined) ? undefined : list;
}

/** The largest zoom about the fitted centre: beyond, two numbers are too coarse for a place. */
export const DEEPEST = 1e25;

/** A view with only those members that say something. @param {Required<View> | undefined} view @returns {View | undefined} */
function viewOf(view) {
    if (view === undefined) return view;
    const { x, y, zoom, fx, fy, at } = view;
    const own = /^[1-9]\d*(\.\d{1,24})?$/.test(at) ? { at } : {};
    const rest = fx !== 0 || fy !== 0 ? { fx, fy } : {};
    return { x, y, zoom: own.at ? zoom : Math.min(zoom, DEEPEST), ...rest, ...own };
}

/**
 * Whether a value equals its cleaned value, apart from letter case and line ends.
 * @param {unknown} value
 * @param {unknown} taken
 * @returns {boolean}
 */
function isAsGiven(value, taken) {
    if (typeof value === 'string') return value.replace(/\r\n?/g, '\n').toLowerCase() === String(taken).toLowerCase();
    if (typeof value === 'number') return value === taken;
    if (typeof value !== 'object' || value === null || typeof taken !== 'object' || taken === null) return true;
    if (Array.isArray(value) && Array.isArray(taken) && value.length !== taken.length) return false;
    const given = /** @type {Record<string, unknown>} */ (value);
    return Object.entries(taken).every(([name, member]) => isAsGiven(given[name], member));
}
