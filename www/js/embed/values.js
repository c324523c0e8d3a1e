/** The state's values by the keys of links, for messages. Pure functions. */

import { KEYS } from '../state/link.js';
import { cleanField, problemOf } from '../state/state.js';
import { say } from '../base/words.js';

/** @typedef {import('../state/state.js').State} State */

/** The maximum number of reported problems. */
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
 * Reads untrusted values into fields, and lists problems in words. A string is read as in a link if possible, so that
 * `'25'` and `25` are the same angle.
 * @param {unknown} values by key
 * @returns {{fields: Partial<State>, problems: string[]}}
 */
export function fieldsOf(values) {
    if (typeof values !== 'object' || values === null)
        return { fields: {}, problems: [say`The values must be an object with the keys of links.`] };
    /** @type {string[]} */
    const problems = [];
    /** @type {Record<string, unknown>} */
    const given = {};
    for (const [key, value] of Object.entries(values)) {
        if (problems.length === MOST_PROBLEMS) break;
        const [, field, form] = KEYS.find(([known]) => known === key) ?? [];
        if (!field || !form) {
            problems.push(say`Unknown key “${key.slice(0, 20)}”.`);
            continue;
        }
        const read = typeof value === 'string' ? form.read(value) : undefined;
        const meant = cleanField(field, read) === undefined ? value : read;
        const [known, problem] = [cleanField(field, meant), problemOf(field, meant)];
        if (known !== undefined) given[field] = known;
        if (problem) problems.push(say`“${key}” ${problem}.`);
    }
    return { fields: /** @type {Partial<State>} */ (given), problems };
}
