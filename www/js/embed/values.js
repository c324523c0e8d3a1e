/** The state under the keys of links, as messages carry it. Pure functions. */

import { KEYS } from '../link.js';
import { cleanField, problemOf } from '../state.js';

/** @typedef {import('../state.js').State} State */

/** More problems than these are not told. */
const MOST_PROBLEMS = 20;

/**
 * Every value of a state, by its key.
 * @param {Readonly<State>} state
 * @returns {Record<string, unknown>}
 */
export function valuesOf(state) {
    return Object.fromEntries(KEYS.map(([key, field]) => [key, structuredClone(state[field])]));
}

/**
 * The fields that values of unknown origin stand for, and in words which of them mean nothing. A string is read as in a
 * link where it can be, so that `'25'` and `25` are the same angle.
 * @param {unknown} values by key
 * @returns {{fields: Partial<State>, problems: string[]}}
 */
export function fieldsOf(values) {
    if (typeof values !== 'object' || values === null) return { fields: {}, problems: ['What is set has to be an object of values by their keys.'] };
    /** @type {string[]} */
    const problems = [];
    /** @type {Record<string, unknown>} */
    const given = {};
    for (const [key, value] of Object.entries(values)) {
        if (problems.length === MOST_PROBLEMS) break;
        const [, field, form] = KEYS.find(([known]) => known === key) ?? [];
        if (!field || !form) {
            problems.push(`There is nothing called “${key.slice(0, 20)}” to set.`);
            continue;
        }
        const read = typeof value === 'string' ? form.read(value) : undefined;
        const meant = cleanField(field, read) === undefined ? value : read;
        const [known, problem] = [cleanField(field, meant), problemOf(field, meant)];
        if (known !== undefined) given[field] = known;
        if (problem) problems.push(`“${key}” ${problem}.`);
    }
    return { fields: /** @type {Partial<State>} */ (given), problems };
}
