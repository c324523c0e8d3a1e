/**
 * The state as a link, version 1: `#v=1&axiom=X&rules=X%20-%3E%20F%5B%2BX%5D&n=5&angle=25`.
 *
 * `&` parts the fields, the first `=` a name from its value; `+` is plus. Fields at their default are left out, unknown
 * ones are ignored, and a link is only ever read as text and numbers. URLSearchParams would turn `+` into a space and
 * escape what makes links readable.
 */

import { DEFAULTS, clean, same } from './state.js';

/** @typedef {import('./state.js').State} State */
/** @typedef {{write: (value: any) => string, read: (text: string) => unknown}} Form */

/** Longer links are not read, in characters. */
export const LONGEST = 100_000;

const VERSION = 1;

/** @type {Form} */
const text = { write: String, read: (value) => value };
/** @type {Form} */
const number = {
    write: String,
    read: (value) => (/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(value) ? Number(value) : undefined),
};
/** @type {Form} */
const numbers = { write: (value) => value.join(), read: (value) => value.split(',').map(number.read) };
/** @type {Form} */
const colour = { write: (value) => value.slice(1), read: (value) => `#${value}` };
/** @type {Form} */
const colours = { write: (value) => value.map(colour.write).join(), read: (value) => value.split(',').map(colour.read) };
/** @type {Form} */
const view = {
    write: ({ x, y, zoom, fx = 0, fy = 0 }) => (fx === 0 && fy === 0 ? [x, y, zoom] : [x, y, zoom, fx, fy]).join(),
    read: (value) => {
        const [x, y, zoom, fx = 0, fy = 0, ...more] = value.split(',').map(number.read);
        return more.length === 0 ? { x, y, zoom, fx, fy } : undefined;
    },
};

/** Key in the link, field of the state, form of its value; in the order of writing. @type {[string, keyof State, Form][]} */
const KEYS = [
    ['title', 'title', text],
    ['axiom', 'axiom', text],
    ['rules', 'rules', text],
    ['n', 'iterations', number],
    ['angle', 'angle', number],
    ['right', 'rightAngle', number],
    ['heading', 'heading', number],
    ['step', 'step', number],
    ['start', 'start', numbers],
    ['turtle', 'dialect', text],
    ['do', 'overrides', text],
    ['seed', 'seed', number],
    ['palette', 'palette', colours],
    ['colour', 'colourBy', text],
    ['bg', 'background', colour],
    ['width', 'width', number],
    ['thin', 'minWidth', number],
    ['name', 'name', text],
    ['source', 'source', text],
    ['notes', 'notes', text],
    ['view', 'view', view],
];

/**
 * The hash, with its `#`.
 * @param {Readonly<State>} state
 */
export function writeLink(state) {
    const fields = KEYS.filter(([, field]) => !same(state[field], DEFAULTS[field]));
    return [`#v=${VERSION}`, ...fields.map(([key, field, form]) => `${key}=${escape(form.write(state[field]))}`)].join('&');
}

/**
 * Reads a hash, with or without its `#`.
 * @param {string} hash
 * @returns {{state: State, problems: string[]} | null} null where the hash holds no state of ours: neither a version nor a field
 */
export function readLink(hash) {
    const body = hash.replace(/^#/, '');
    if (body.length > LONGEST) return { state: clean({}), problems: [`The link is longer than ${LONGEST} characters and was not read.`] };
    /** @type {Map<string, string>} */
    const given = new Map();
    /** @type {string[]} */
    const problems = [];
    for (const part of body.split('&')) {
        const at = part.indexOf('=');
        if (at < 1) continue;
        try {
            given.set(part.slice(0, at), decodeURIComponent(part.slice(at + 1)));
        } catch {
            problems.push(`“${part.slice(0, at).slice(0, 20)}” in the link is damaged and was left out.`);
        }
    }
    const version = given.get('v');
    if (version === undefined && !KEYS.some(([key]) => given.has(key))) return null;
    if (version !== undefined && Number(version) !== VERSION) problems.push('The link was made by another version of this page; some of it may be missing.');
    /** @type {Record<string, unknown>} */
    const values = {};
    for (const [key, field, form] of KEYS) {
        const value = given.get(key);
        if (value === undefined) continue;
        values[field] = form.read(value);
        if (values[field] === undefined) problems.push(`“${key}” in the link is not understood and was left out.`);
    }
    return { state: clean(values), problems };
}

/** @param {string} value */
function escape(value) {
    // encodeURIComponent leaves A-Za-z0-9 - _ . ! ~ * ' ( ) as they are; chat programs cut links at a parenthesis.
    return encodeURIComponent(value)
        .replace(/[()]/g, (character) => (character === '(' ? '%28' : '%29'))
        .replace(/%(2B|2C|2F|3A|3B|3D|40)/g, (code) => decodeURIComponent(code));
}
