/**
 * Undo and redo as patches: a change stores the fields that it touched, before and after. So undo leaves other fields,
 * such as the view, as they are. Pure functions.
 */

import { same } from './state.js';

/** @typedef {import('./state.js').State} State */
/** What Reset returns to before and after a change that opens another system. @typedef {{before: Readonly<State>, after: Readonly<State>}} Origins */
/** @typedef {{before: Partial<State>, after: Partial<State>, label: string, time: number, origins?: Origins}} Change */
/** @typedef {{history: History, patch: Partial<State>, origin: Readonly<State> | undefined}} Step */
/** @typedef {{past: readonly Change[], future: readonly Change[]}} History */

/** @type {History} */
export const EMPTY = { past: [], future: [] };

/** Changes with the same label within this time are merged, in milliseconds. */
export const MERGE_MS = 1000;

/** The maximum number of changes, and of UTF-16 units in their texts; older ones are dropped. */
const MAX_CHANGES = 500;
const MAX_UNITS = 50_000_000;

/**
 * @param {History} history
 * @param {Readonly<State>} before
 * @param {Partial<State>} patch the new values
 * @param {string} label names the control; changes with an empty label are never merged, and changes of a drag always
 * @param {number} now in milliseconds
 * @param {Origins} [origins]
 * @returns {History}
 */
export function record(history, before, patch, label, now, origins) {
    const last = history.past.at(-1);
    const joins =
        last !== undefined &&
        label !== '' &&
        last.label === label &&
        (now - last.time < MERGE_MS || label.startsWith('drag '));
    /** @type {Partial<State>} */
    const was = {};
    for (const field of fieldsOf(patch)) put(was, field, before[field]);
    /** @type {Change} */
    const change = joins
        ? { before: { ...was, ...last.before }, after: { ...last.after, ...patch }, label, time: now }
        : { before: was, after: { ...patch }, label, time: now, ...(origins && { origins }) };
    const past = joins ? history.past.slice(0, -1) : history.past;
    const changed = fieldsOf(change.after).some((field) => !same(change.before[field], change.after[field]));
    return { past: changed ? newest([...past, change]) : past, future: [] };
}

/** The newest changes that are kept; the last one always is. @param {readonly Change[]} past */
function newest(past) {
    let room = MAX_UNITS;
    const from = past.findLastIndex(({ after }, at) => {
        for (const value of Object.values(after)) if (typeof value === 'string') room -= value.length;
        return at < past.length - 1 && room < 0;
    });
    return past.slice(Math.max(from + 1, past.length - MAX_CHANGES));
}

/**
 * Closes the last change, so that the next change is not merged with it.
 * @param {History} history
 * @returns {History}
 */
export function settle(history) {
    const last = history.past.at(-1);
    return last && last.label !== ''
        ? { ...history, past: [...history.past.slice(0, -1), { ...last, label: '' }] }
        : history;
}

/** @param {History} history @returns {Step | null} null when there is nothing to undo */
export function undo({ past, future }) {
    const change = past.at(-1);
    return change
        ? {
              history: { past: past.slice(0, -1), future: [settled(change), ...future] },
              patch: change.before,
              origin: change.origins?.before,
          }
        : null;
}

/** @param {History} history @returns {Step | null} null when there is nothing to redo */
export function redo({ past, future }) {
    const [change, ...rest] = future;
    return change
        ? {
              history: { past: [...past, settled(change)], future: rest },
              patch: change.after,
              origin: change.origins?.after,
          }
        : null;
}

/** @param {Change} change @returns {Change} */
function settled(change) {
    return { ...change, label: '' };
}

/** @param {Partial<State>} patch */
function fieldsOf(patch) {
    return /** @type {(keyof State)[]} */ (Object.keys(patch));
}

/** @template {keyof State} F @param {Partial<State>} patch @param {F} field @param {State[F]} value */
function put(patch, field, value) {
    patch[field] = value;
}
