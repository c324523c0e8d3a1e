/**
 * Undo and redo as patches: a change remembers the fields it touched, before and after, so that undoing it leaves the
 * rest (where the reader looks, above all) as it is. Pure functions.
 */

import { same } from './state.js';

/** @typedef {import('./state.js').State} State */
/** What Reset returns to, where a change opens another system. @typedef {{before: Readonly<State>, after: Readonly<State>}} Origins */
/** @typedef {{before: Partial<State>, after: Partial<State>, label: string, time: number, origins?: Origins}} Change */
/** @typedef {{history: History, patch: Partial<State>, origin: Readonly<State> | undefined}} Step */
/** @typedef {{past: readonly Change[], future: readonly Change[]}} History */

/** @type {History} */
export const EMPTY = { past: [], future: [] };

/** Changes with the same label that follow each other within this time are one, in milliseconds. */
export const TOGETHER = 1000;

/** The oldest changes are forgotten beyond this number. */
const MOST = 500;

/**
 * @param {History} history
 * @param {Readonly<State>} before
 * @param {Partial<State>} patch what is new
 * @param {string} label names the control; changes with an empty label are never joined, and those of a drag always
 * @param {number} now in milliseconds
 * @param {Origins} [origins]
 * @returns {History}
 */
export function record(history, before, patch, label, now, origins) {
    const last = history.past.at(-1);
    const joins = last !== undefined && label !== '' && last.label === label && (now - last.time < TOGETHER || label.startsWith('drag '));
    /** @type {Partial<State>} */
    const was = {};
    for (const field of fieldsOf(patch)) put(was, field, before[field]);
    /** @type {Change} */
    const change = joins
        ? { before: { ...was, ...last.before }, after: { ...last.after, ...patch }, label, time: now }
        : { before: was, after: { ...patch }, label, time: now, ...(origins && { origins }) };
    const past = joins ? history.past.slice(0, -1) : history.past;
    const changed = fieldsOf(change.after).some((field) => !same(change.before[field], change.after[field]));
    return { past: changed ? [...past, change].slice(-MOST) : past, future: [] };
}

/**
 * Closes the last change: what comes next is a change of its own.
 * @param {History} history
 * @returns {History}
 */
export function settle(history) {
    const last = history.past.at(-1);
    return last && last.label !== '' ? { ...history, past: [...history.past.slice(0, -1), { ...last, label: '' }] } : history;
}

/** @param {History} history @returns {Step | null} null when there is nothing to undo */
export function undo({ past, future }) {
    const change = past.at(-1);
    return change ? { history: { past: past.slice(0, -1), future: [settled(change), ...future] }, patch: change.before, origin: change.origins?.before } : null;
}

/** @param {History} history @returns {Step | null} null when there is nothing to redo */
export function redo({ past, future }) {
    const [change, ...rest] = future;
    return change ? { history: { past: [...past, settled(change)], future: rest }, patch: change.after, origin: change.origins?.after } : null;
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
