/** Favourites: states saved by name, newest first. Pure functions. */

import { newestFirst } from '../state/rows.js';
import { writeLink } from '../state/link.js';
import { say } from '../base/words.js';

/** @typedef {import('../state/state.js').State} State */
/** A state under a name, as a readable link. `made` decides on the place: the latest comes first. @typedef {{id: string, name: string, link: string, made: number}} Favourite */

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
        .map((one, at) => ({
            ...one,
            name: one.name.slice(0, LONGEST_NAME),
            made: Number.isFinite(one.made) ? one.made : -at,
        }));
}

/** The order and the limit. @template {Favourite & import('../state/rows.js').Row} R @param {R[]} list */
export const tidyFavourites = (list) =>
    list.sort((a, b) => b.made - a.made || newestFirst(a, b)).slice(0, MOST_FAVOURITES);

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
        made: Date.now(),
    };
}

/** @param {Favourite} one @param {string} name @returns {Favourite} */
export const renamed = ({ id, link, made, ...one }, name) => ({ id, name: cleanName(name) || one.name, link, made });

/** @param {string} name */
function cleanName(name) {
    return name
        .replace(/\s+/g, ' ')
        .trim()
        .slice(0, LONGEST_NAME)
        .replace(/\p{Surrogate}/gu, '\ufffd');
}
