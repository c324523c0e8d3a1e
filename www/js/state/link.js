/**
 * The state as a link, version 1: `#v=1&axiom=X&rules=X%20-%3E%20F%5B%2BX%5D&n=5&angle=25`. docs/links.md describes the
 * format.
 *
 * `&` separates fields; the first `=` separates key and value; `+` means plus. Fields with default values are omitted,
 * and unknown fields are ignored. URLSearchParams is not used, because it turns `+` into a space and escapes more
 * characters than necessary.
 */

import { DEFAULTS, clean, maxLengthOf, problemOf, same } from './state.js';
import { FIELDS } from '../tables.js';
import { say } from '../base/words.js';

/** @typedef {import('./state.js').State} State */
/** @typedef {{state: State, problems: string[]}} Link the state in a link, and the problems found while reading */
/** @typedef {{write: (value: any) => string, read: (text: string) => unknown}} Form */

/** Longer links are not read, in characters. No browser has longer addresses. */
export const LONGEST = 2_000_000;
/** The key of the compressed part (packed.js). */
export const PACKED = 'z';

const VERSION = 1;
/** Longer numbers are not read, in characters. */
const LONGEST_NUMBER = 40;

/** @type {Form} */
const text = { write: String, read: (value) => value.replace(/\r\n?/g, '\n') };
/** @type {Form} */
const number = {
    write: String,
    // Adding 0 turns -0 into 0.
    read: (value) =>
        value.length <= LONGEST_NUMBER && /^[+-]?(\d+(\.\d*)?|\.\d+)(e[+-]?\d+)?$/i.test(value)
            ? Number(value) + 0
            : undefined,
};
/** A list of `count` numbers. One more is read, so that the list is rejected if there are too many. @type {(count: number) => Form} */
const list = (count) => ({
    write: (value) => value.join(),
    read: (value) => value.split(',', count + 1).map(number.read),
});
/** @type {Form} */
const colour = { write: (value) => value.slice(1), read: (value) => `#${value.toLowerCase()}` };
/** @type {Form} */
const colours = {
    write: (value) => value.map(colour.write).join(),
    read: (value) => value.split(',', maxLengthOf('palette') + 1).map(colour.read),
};
/** @type {Form} */
const flag = { write: (value) => (value ? '1' : '0'), read: (value) => ({ 0: false, 1: true })[value] };
/** @type {Form} */
const view = {
    write: ({ x, y, zoom, fx = 0, fy = 0, at }) =>
        [x, y, zoom, ...(at || fx !== 0 || fy !== 0 ? [fx, fy] : []), ...(at ? [at] : [])].join(),
    read: (value) => {
        const parts = value.split(',', 7);
        const numbers = parts.slice(0, 5).map(number.read);
        if (![3, 5, 6].includes(parts.length) || numbers.includes(undefined)) return undefined;
        const [x, y, zoom, fx = 0, fy = 0] = numbers;
        return { x, y, zoom, ...(fx === 0 && fy === 0 ? {} : { fx, fy }), ...(parts[5] ? { at: parts[5] } : {}) };
    },
};

/** Azimuth, elevation, zoom, target, fading, and `flat` for no perspective. @type {Form} */
const camera = {
    write: ({ azimuth, elevation, zoom, x, y, z, perspective, fade }) =>
        [azimuth, elevation, zoom, x, y, z, fade, ...(perspective ? [] : ['flat'])].join(),
    read: (value) => {
        const parts = value.split(',', 9);
        const perspective = parts[7] !== 'flat';
        const numbers = parts.slice(0, 7).map(number.read);
        if (parts.length !== (perspective ? 7 : 8) || numbers.includes(undefined)) return undefined;
        const [azimuth, elevation, zoom, x, y, z, fade] = numbers;
        return { azimuth, elevation, zoom, x, y, z, perspective, fade };
    },
};

/** @type {Record<string, Form>} */
const FORMS = { text, word: text, number, colour, colours, flag };

/** @param {keyof State} name @returns {Form} */
function formOf(name) {
    if (name === 'view') return view;
    if (name === 'camera') return camera;
    const field = FIELDS[name];
    return /** @type {Form} */ (field.kind === 'list' ? list(field.count) : FORMS[field.kind]);
}

/** Key in the link, field of the state, form of the value; in the order of writing. @type {[string, keyof State, Form][]} */
export const KEYS = /** @type {(keyof State)[]} */ (Object.keys(FIELDS)).map((name) => [
    FIELDS[name].link,
    name,
    formOf(name),
]);

/** All keys of links. */
const KNOWN = new Set(['v', PACKED, ...KEYS.map(([key]) => key)]);

/**
 * Writes a state as a readable link, with its `#`.
 * @param {Readonly<State>} state
 */
export function writeLink(state) {
    return [`#v=${VERSION}`, ...writeFields(state, escape)].join('&');
}

/**
 * Writes a state as a link for this page's own reading, with its `#`: not every program passes it on as it is, but a
 * character of a text takes one character.
 * @param {Readonly<State>} state
 */
export function writePlain(state) {
    return [`#v=${VERSION}`, ...writeFields(state, escapeLeast)].join('&');
}

/**
 * Writes the fields of a state that differ from their defaults, as `key=value`.
 * @param {Readonly<State>} state
 * @param {(value: string) => string} guard escapes `%`, `&` and other characters
 */
export function writeFields(state, guard) {
    const fields = KEYS.filter(([, field]) => !same(state[field], DEFAULTS[field]));
    return fields.map(([key, field, form]) => `${key}=${guard(form.write(state[field]))}`);
}

/**
 * Reads a hash, with or without its `#`.
 * @param {string} hash
 * @param {string | null} [unpacked] the fields of its compressed part; uncompressed fields take precedence
 * @returns {Link | null} null if the hash has neither a version nor a known field
 */
export function readLink(hash, unpacked = null) {
    if (hash.length > LONGEST)
        return {
            state: clean({}),
            problems: [say`The link is longer than ${String(LONGEST)} characters and was not read.`],
        };
    // Repeated keys are decoded only once, so that the time is linear in the length.
    /** @type {Map<string, string>} */
    const parts = new Map();
    for (const part of `${unpacked ?? ''}&${hash.replace(/^#/, '')}`.split('&')) {
        const at = part.indexOf('=');
        const key = part.slice(0, Math.max(0, at));
        if (KNOWN.has(key)) parts.set(key, part.slice(at + 1));
    }
    if (parts.size === 0) return null;
    /** @type {Map<string, string>} */
    const given = new Map();
    /** @type {string[]} */
    const problems = [];
    for (const [key, value] of parts) {
        try {
            given.set(key, decodeURIComponent(value));
        } catch {
            problems.push(say`“${key}” in the link is damaged and was left out.`);
        }
    }
    const version = given.get('v');
    if (version !== undefined && Number(version) !== VERSION)
        problems.push(say`The link was made by another version of this page; parts of the drawing may be missing.`);
    if (given.has(PACKED) && unpacked === null) problems.push(say`The compressed part of the link was not read.`);
    /** @type {Partial<Record<keyof State, unknown>>} */
    const values = {};
    for (const [key, field, form] of KEYS) {
        const value = given.get(key);
        if (value !== undefined) values[field] = form.read(value);
    }
    const state = clean(values);
    for (const [key, field] of KEYS) {
        const wrong = given.has(key) && problemOf(field, values[field]);
        if (wrong) problems.push(say`“${key}” in the link ${wrong}.`);
    }
    return { state, problems };
}

/** Escapes what a link cannot hold in any case. @param {string} value */
export const escapeLeast = (value) => value.replace(/[%&]/g, (sign) => (sign === '%' ? '%25' : '%26'));

/** @param {string} value */
function escape(value) {
    // encodeURIComponent leaves A-Za-z0-9 - _ . ! ~ * ' ( ) as they are; chat programs cut links at a parenthesis.
    return encodeURIComponent(value)
        .replace(/[()]/g, (character) => (character === '(' ? '%28' : '%29'))
        .replace(/%(2B|2C|2F|3A|3B|3D|40)/g, (code) => decodeURIComponent(code));
}
