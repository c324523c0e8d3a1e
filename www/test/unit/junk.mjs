/** Random invalid values, texts and links; equal seeds give equal results. */

import { deflateSync } from 'node:zlib';
import { KEYS, writeFields, writeLink } from '../../js/state/link.js';
import { DAMAGED, SCRIPTS } from './hostile.mjs';
import { randomState } from './random.mjs';

/** @typedef {() => number} Roll in [0, 1) */

/** @template T @param {Roll} roll @param {readonly T[]} choices @returns {T} */
export const pick = (roll, choices) => /** @type {T} */ (choices[Math.floor(roll() * choices.length)]);

/** A whole number from 0 to `most` - 1. @param {Roll} roll @param {number} most */
export const whole = (roll, most) => Math.floor(roll() * most);

const NAMES = [
    '__proto__',
    'constructor',
    'toString',
    'id',
    'name',
    'link',
    'origin',
    'time',
    'hash',
    'favourites',
    'format',
    'lsystem',
    'values',
    'controls',
    'v',
    'z',
    ...KEYS.flatMap(([key, field]) => [key, field]),
];
const PIECES = [
    '&',
    '=',
    '%',
    '%2',
    '%25',
    '%zz',
    '%FF',
    '%F0%9F%8C%BF',
    '#',
    '#v=1',
    '&v=1',
    '&v=9',
    '&z=',
    '&z=eJ',
    '+',
    ',',
    ',,,,',
    '-',
    '.',
    'e',
    '1e999',
    '-1e-999',
    '0x1',
    'NaN',
    'Infinity',
    'null',
    '\0',
    '\n',
    '\r\n',
    ' ',
    '\u202e',
    '\ud800',
    '\udc00',
    '🌿',
    '٣',
    '−',
    '"',
    '{',
    '}',
    '[',
    ']',
    ':',
    '\\',
    '\\u0000',
    ...SCRIPTS,
];

/** A text of pieces with a special meaning somewhere. @param {Roll} roll @param {number} [most] pieces */
export const junkText = (roll, most = 12) =>
    Array.from({ length: whole(roll, most) }, () =>
        roll() < 0.6
            ? pick(roll, PIECES)
            : roll() < 0.5
              ? pick(roll, NAMES)
              : String.fromCharCode(whole(roll, 0x10000)),
    ).join('');

/** Any value that JSON or a message can carry. @param {Roll} roll @param {number} [depth] @returns {any} */
export function junk(roll, depth = 3) {
    const kind = whole(roll, depth > 0 ? 12 : 8);
    if (kind < 2)
        return pick(roll, [
            null,
            undefined,
            true,
            false,
            0,
            -0,
            1,
            -1,
            NaN,
            Infinity,
            -Infinity,
            1e308,
            5e-324,
            2 ** 53,
            1n,
        ]);
    if (kind < 4) return (roll() - 0.5) * 10 ** (whole(roll, 40) - 20);
    if (kind < 6) return junkText(roll);
    if (kind < 7)
        return pick(roll, [
            'abop',
            'level',
            'density',
            '#ff0000',
            '#FFF',
            'solid',
            '25',
            '1,2',
            '1,2,3',
            'F -> FF',
            'hello',
            'set',
            'open',
            'get',
        ]);
    if (kind < 8) return writeLink(randomState(roll)).slice(0, whole(roll, 400));
    if (kind < 10) return Array.from({ length: whole(roll, 6) }, () => junk(roll, depth - 1));
    return junkObject(roll, depth);
}

/** @param {Roll} roll @param {number} [depth] @returns {Record<string, any>} */
export function junkObject(roll, depth = 3) {
    /** @type {[string, any][]} */
    const entries = Array.from({ length: whole(roll, 8) }, () => [pick(roll, NAMES), junk(roll, depth - 1)]);
    return Object.fromEntries(entries);
}

/** Damages a text in a few places by cutting, swapping, doubling and overwriting. @param {Roll} roll @param {string} text @param {number} [most] */
export function damaged(roll, text, most = 4) {
    for (let times = 1 + whole(roll, most); times > 0; times--) {
        const [one, other] = [whole(roll, text.length + 1), whole(roll, text.length + 1)];
        const [from, to] = [Math.min(one, other), Math.max(one, other)];
        const part = text.slice(from, to);
        text = pick(roll, [
            () => text.slice(0, from) + text.slice(to),
            () => text.slice(0, to) + part.slice(0, 2000) + text.slice(to),
            () => text.slice(0, from) + junkText(roll, 4) + text.slice(from),
            () => text.slice(0, from) + pick(roll, PIECES) + text.slice(from + 1),
            () => text.slice(0, to),
        ])();
    }
    return text;
}

/** A random hash: of a random state, damaged before or after compression, or assembled at random. @param {Roll} roll @returns {string} */
export function junkLink(roll) {
    const kind = roll();
    const state = randomState(roll);
    if (kind < 0.3) return damaged(roll, writeLink(state));
    if (kind < 0.4)
        return `#${Array.from({ length: whole(roll, 8) }, () => `${pick(roll, NAMES)}=${junkText(roll)}`).join('&')}`;
    if (kind < 0.41) return damaged(roll, pick(roll, DAMAGED).hash, 1);
    const fields = writeFields(state, (text) => text.replace(/[%&]/g, encodeURIComponent)).join('&');
    const bytes = deflateSync(Buffer.from(roll() < 0.5 ? fields : damaged(roll, fields)), { level: whole(roll, 10) });
    for (let times = whole(roll, 3); times > 0 && kind < 0.8; times--)
        bytes[whole(roll, bytes.length)] = whole(roll, 256);
    const code = bytes.subarray(0, roll() < 0.8 ? bytes.length : whole(roll, bytes.length)).toString('base64url');
    return `#v=1&z=${roll() < 0.8 ? code : damaged(roll, code)}${roll() < 0.8 ? '' : `&${pick(roll, NAMES)}=${junkText(roll)}`}`;
}
