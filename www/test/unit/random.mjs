/** Random states for tests; equal seeds give equal states. */

import { clean } from '../../js/state/state.js';
import { FIELDS } from '../../js/tables.js';

/** A small generator of random numbers in [0, 1) (mulberry32). @param {number} seed */
export function dice(seed) {
    let state = seed >>> 0;
    return () => {
        state = (state + 0x6d2b79f5) >>> 0;
        let t = Math.imul(state ^ (state >>> 15), state | 1);
        t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
        return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
    };
}

/** A valid state. @param {() => number} roll */
export function randomState(roll) {
    return clean(Object.fromEntries(Object.entries(FIELDS).map(([name, field]) => [name, valueOf(roll, field)])));
}

/**
 * A value of a field, seldom out of its range.
 * @param {() => number} roll
 * @param {import('../../js/tables.js').FieldSpec} field
 */
function valueOf(roll, field) {
    return field.optional && roll() < 0.5 ? null : valueIn(roll, field);
}

/** The most characters of a text. */
const LONGEST = 120;
const CHARACTERS = [...'FGXYfgAB+-[]{}()<>|!#%&\\/^$\'",;:.=* \n\t?~`@→ε−🌿é'];

/**
 * @param {() => number} roll
 * @param {import('../../js/tables.js').Range} range
 * @returns {unknown}
 */
function valueIn(roll, range) {
    const below = (/** @type {number} */ count) => Math.floor(roll() * count);
    const list = (/** @type {number} */ length, /** @type {() => unknown} */ member) => Array.from({ length }, member);
    const colour = () =>
        `#${below(2 ** 24)
            .toString(16)
            .padStart(6, '0')}`;
    switch (range.kind) {
        case 'number':
            return numberIn(roll, range);
        case 'flag':
            return roll() < 0.5;
        case 'word':
            return range.words[below(range.words.length)];
        case 'colour':
            return colour();
        case 'colours':
            return list(1 + below(6), colour);
        case 'text':
            return list(below(Math.min(range.maxLength, LONGEST)), () => CHARACTERS[below(CHARACTERS.length)]).join('');
        case 'list':
            return list(range.count, () => valueIn(roll, range.each));
        case 'record':
            return Object.fromEntries(
                Object.entries(range.members).map(([name, member]) => [name, valueIn(roll, member)]),
            );
    }
}

/**
 * @param {() => number} roll
 * @param {import('../../js/tables.js').NumberRange} range
 */
function numberIn(roll, { low, high, whole }) {
    const usual = [0, 1, -1, 25.7, 22.5, 1 / 3, 1e-7, 123456.789];
    const any = [
        () => usual[Math.floor(roll() * usual.length)] ?? 0,
        () => (roll() - 0.5) * 10 ** Math.floor(roll() * 12),
        () => low + roll() * (high - low),
        // Of any size, where the range spans many.
        () => (low > 0 ? low * (high / low) ** roll() : low + (high - low) * 10 ** (-20 * roll())),
    ];
    const number = (any[Math.floor(roll() * any.length)] ?? (() => 0))();
    return whole ? Math.round(number) : number;
}
