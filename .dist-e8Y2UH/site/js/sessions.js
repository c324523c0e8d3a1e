/**
 * Where a reader left off: the last few visits, newest first. A visit is kept from its first change on, under its own
 * id, so that opening a link or another tab destroys none of them. Pure functions.
 */

import { readLink, writeLink } from './link.js';

/** @typedef {import('./state.js').State} State */
/** `origin` is what Reset returns to; both are readable links. @typedef {{id: string, time: number, link: string, origin: string}} Session */

/** Older visits are forgotten. */
export const MOST_SESSIONS = 8;

/** @param {unknown} value of unknown origin @returns {Session[]} */
export function readSessions(value) {
    const list = Array.isArray(value) ? value : [];
    return list.filter((one) => ['id', 'link', 'origin'].every((key) => typeof one?.[key] === 'string') && typeof one.time === 'number').slice(0, MOST_SESSIONS);
}

/**
 * The list with a visit as it is now; a former one that was left at the same place says no more.
 * @param {readonly Session[]} list
 * @param {string} id
 * @param {Readonly<State>} state
 * @param {Readonly<State>} origin
 * @param {number} time
 * @returns {Session[]}
 */
export function keepSession(list, id, state, origin, time) {
    const link = writeLink(state);
    const others = list.filter((one) => one.id !== id && one.link !== link);
    return [{ id, time, link, origin: writeLink(origin) }, ...others].slice(0, MOST_SESSIONS);
}

/** @param {Session} session @returns {{state: State, origin: State} | null} */
export function openSession({ link, origin }) {
    const state = readLink(link)?.state;
    return state ? { state, origin: readLink(origin)?.state ?? state } : null;
}
