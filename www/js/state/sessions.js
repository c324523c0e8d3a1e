/**
 * The last few visits, newest first. A visit is saved from its first change on, under its own id, so that opening a
 * link or another tab overwrites no visit. Pure functions.
 */

import { readLink, writeLink, writePlain } from './link.js';
import { newestFirst } from './rows.js';

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

/** A visit. @param {string} id @param {Readonly<State>} state @param {Readonly<State>} origin */
export function sessionOf(id, state, origin) {
    const link = writePlain(state);
    const reset = writePlain(origin);
    return { id, link, origin: link.length + reset.length > MOST_STORED ? '' : reset };
}

/** The visits that are kept: the newest ones, each state once. @param {Session[]} list */
export function tidySessions(list) {
    const links = new Set();
    let stored = 0;
    return list
        .sort(newestFirst)
        .filter(({ link }) => !links.has(link) && links.add(link))
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

/** The names of states that stopped the drawing. @param {unknown} value of unknown origin @returns {{id: string}[]} */
export function readSuspects(value) {
    return (Array.isArray(value) ? value : [])
        .map((one) => (typeof one === 'string' ? { id: one } : one))
        .filter((one) => typeof one?.id === 'string' && one.id.length < 40 && !one.gone);
}

/** @param {import('./rows.js').Row[]} list */
export const tidySuspects = (list) => list.sort(newestFirst).slice(0, MOST_SUSPECTS);
