/** Favourites: states saved by name, newest first. Pure functions. */

import { writeLink } from './link.js';
import { say } from './words.js';

/** @typedef {import('./state.js').State} State */
/** A state under a name, as a readable link. @typedef {{id: string, name: string, link: string}} Favourite */

export const MOST_FAVOURITES = 500;
export const LONGEST_NAME = 120;

/** Larger files of favourites are not read, in bytes. */
export const LARGEST_FILE = 2 << 20;
/** Marks a JSON file as favourites rather than a system. */
export const FORMAT = 'l-systems favourites';

/** @param {unknown} value of unknown origin @returns {Favourite[]} */
export function readFavourites(value) {
    const list = Array.isArray(value) ? value : [];
    return list
        .filter((one) => ['id', 'name', 'link'].every((key) => typeof one?.[key] === 'string'))
        .slice(0, MOST_FAVOURITES)
        .map((one) => ({ ...one, name: one.name.slice(0, LONGEST_NAME) }));
}

/**
 * @param {string} name
 * @param {Readonly<State>} state
 * @returns {Favourite}
 */
export function favourite(name, state) {
    return {
        id: Math.random().toString(36).slice(2),
        name: cleanName(name) || cleanName(state.title || state.name) || say`Untitled system`,
        link: writeLink(state),
    };
}

/** @param {readonly Favourite[]} list @param {string} id @param {string} name @returns {Favourite[]} */
export function rename(list, id, name) {
    return list.map((one) => (one.id === id ? { ...one, name: cleanName(name) || one.name } : one));
}

/** @param {string} name */
function cleanName(name) {
    return name
        .replace(/\s+/g, ' ')
        .trim()
        .slice(0, LONGEST_NAME)
        .replace(/\p{Surrogate}/gu, '\ufffd');
}
