/**
 * The last few visits, newest first. A visit is saved from its first change on, under its own id, so that opening a
 * link or another tab overwrites no visit. Pure functions.
 */

import { readLink, writeLink, writePlain } from './link.js';

/** @typedef {import('./state.js').State} State */
/** `link` is the state and `origin` the state that Reset returns to, both as plain links. @typedef {{id: string, time: number, link: string, origin: string}} Session */

/** The maximum number of remembered states that stopped the drawing. */
const MOST_SUSPECTS = 32;

/** The maximum number of visits; older ones are dropped. */
export const MOST_SESSIONS = 8;

/** The most that is stored of all visits, in UTF-16 units: browsers store five million per site. */
const MOST_STORED = 4_000_000;

/** @param {unknown} value of unknown origin @returns {Session[]} */
export function readSessions(value) {
    const list = Array.isArray(value) ? value : [];
    return list
        .filter(
            (one) =>
                ['id', 'link', 'origin'].every((key) => typeof one?.[key] === 'string') && typeof one.time === 'number',
        )
        .slice(0, MOST_SESSIONS);
}

/**
 * The list with a visit updated; a former visit with the same state is dropped.
 * @param {readonly Session[]} list
 * @param {string} id
 * @param {Readonly<State>} state
 * @param {Readonly<State>} origin
 * @param {number} time
 * @returns {Session[]}
 */
export function keepSession(list, id, state, origin, time) {
    const link = writePlain(state);
    const others = list.filter((one) => one.id !== id && one.link !== link);
    const reset = writePlain(origin);
    const own = { id, time, link, origin: link.length + reset.length > MOST_STORED ? '' : reset };
    let stored = 0;
    return [own, ...others]
        .slice(0, MOST_SESSIONS)
        .filter((one, at) => (stored += one.link.length + one.origin.length) <= MOST_STORED || at === 0);
}

/** @param {Session} session @returns {{state: State, origin: State} | null} */
export function openSession({ link, origin }) {
    const state = readLink(link)?.state;
    return state ? { state, origin: readLink(origin)?.state ?? state } : null;
}

/**
 * A short name for a state: equal states have equal names. Without a view, the name stands for the system in all views.
 * @param {Readonly<State>} state
 * @param {boolean} withView
 */
export function nameOf(state, withView) {
    const text = writeLink(withView ? state : { ...state, view: null, camera: null });
    // Two FNV-1a hashes; the names need not resist attacks.
    let [low, high] = [0x811c9dc5, 0x1b873593];
    for (let at = 0; at < text.length; at++) {
        low = Math.imul(low ^ text.charCodeAt(at), 0x01000193);
        high = Math.imul(high ^ text.charCodeAt(at), 0x85ebca6b);
    }
    return `${withView ? 'v' : 's'}${(low >>> 0).toString(36)}${(high >>> 0).toString(36)}`;
}

/** The names of states that stopped the drawing. @param {unknown} value of unknown origin @returns {string[]} */
export function readSuspects(value) {
    return Array.isArray(value)
        ? value.filter((one) => typeof one === 'string' && one.length < 40).slice(0, MOST_SUSPECTS)
        : [];
}

/** @param {readonly string[]} list newest first @param {string} name @param {boolean} doubtful @returns {string[]} */
export function withSuspect(list, name, doubtful) {
    const others = list.filter((one) => one !== name);
    return doubtful ? [name, ...others].slice(0, MOST_SUSPECTS) : others;
}
