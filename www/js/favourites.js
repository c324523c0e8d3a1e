/** Systems that the reader keeps by name: a list, newest first, and its file. Pure functions. */

import { writeLink } from './link.js';
import { openLink } from './packed.js';

/** @typedef {import('./state.js').State} State */
/** A state under a name, as a readable link. @typedef {{id: string, name: string, link: string}} Favourite */

export const MOST_FAVOURITES = 500;
export const LONGEST_NAME = 120;

/** Larger files of favourites are not read, in bytes. */
export const LARGEST_FILE = 2 << 20;
/** Nor are those with more entries. */
export const MOST_ENTRIES = 10_000;
/** A file with more damaged links is given up: short ones may take long to unpack. */
const MOST_DAMAGED = 200;

/** Tells a file of favourites from one of a system. */
const FORMAT = 'l-systems favourites';

/** A list is read for so long before the page gets its turn, in milliseconds. */
const TURN = 12;

/** @param {unknown} value of unknown origin @returns {Favourite[]} */
export function readFavourites(value) {
    const list = Array.isArray(value) ? value : [];
    return list.filter((one) => ['id', 'name', 'link'].every((key) => typeof one?.[key] === 'string')).slice(0, MOST_FAVOURITES).map((one) => ({ ...one, name: one.name.slice(0, LONGEST_NAME) }));
}

/**
 * @param {string} name
 * @param {Readonly<State>} state
 * @returns {Favourite}
 */
export function favourite(name, state) {
    return { id: Math.random().toString(36).slice(2), name: cleanName(name) || cleanName(state.title || state.name) || 'Untitled system', link: writeLink(state) };
}

/** @param {readonly Favourite[]} list @param {string} id @param {string} name @returns {Favourite[]} */
export function rename(list, id, name) {
    return list.map((one) => (one.id === id ? { ...one, name: cleanName(name) || one.name } : one));
}

/** All of them as a file. @param {readonly Favourite[]} list */
export function writeFile(list) {
    return `${JSON.stringify({ format: FORMAT, version: 1, favourites: list.map(({ name, link }) => ({ name, link })) }, null, 2)}\n`;
}

/** Whether a text is a file of favourites. @param {string} text */
export function isFavouritesFile(text) {
    return text.includes(FORMAT) && Array.isArray(parse(text)?.favourites);
}

/**
 * What a file adds to a list: those that are in it already are not added again, and links that cannot be read are
 * counted. The page stays free meanwhile.
 * @param {readonly Favourite[]} list
 * @param {string} text
 * @returns {Promise<{list: Favourite[], added: number, known: number, damaged: number, tooMany: number} | null>} null where the text is no such file
 * @throws {RangeError} in words, where it holds more than is read
 */
export async function readFile(list, text) {
    const given = parse(text)?.favourites;
    if (!Array.isArray(given)) return null;
    if (given.length > MOST_ENTRIES) throw new RangeError(`it has more than ${MOST_ENTRIES.toLocaleString('en')} entries`);
    let turn = performance.now();
    const same = (/** @type {Favourite} */ { name, link }) => `${name}\n${link}`;
    const there = new Set(list.map(same));
    const result = { list: [...list], added: 0, known: 0, damaged: 0, tooMany: 0 };
    for (const one of given) {
        if (result.list.length >= MOST_FAVOURITES) {
            // What is left is not read.
            result.tooMany = given.length - result.added - result.known - result.damaged;
            break;
        }
        if (performance.now() - turn > TURN) {
            await new Promise((resolve) => setTimeout(resolve));
            turn = performance.now();
        }
        const link = typeof one?.link === 'string' ? await openLink(one.link.slice(one.link.indexOf('#') + 1)) : null;
        if (!link || link.problems.length > 0) {
            result.damaged += 1;
            if (result.damaged > MOST_DAMAGED) throw new RangeError(`more than ${MOST_DAMAGED} of its links are damaged`);
            continue;
        }
        const read = favourite(typeof one.name === 'string' ? one.name : '', link.state);
        if (there.has(same(read))) {
            result.known += 1;
            continue;
        }
        there.add(same(read));
        // In the order of the file, behind what was there.
        result.list.push(read);
        result.added += 1;
    }
    return result;
}

/** @param {string} text @returns {any} null where it is no JSON */
function parse(text) {
    try {
        return JSON.parse(text);
    } catch {
        return null;
    }
}

/** @param {string} name */
function cleanName(name) {
    return name.replace(/\s+/g, ' ').trim().slice(0, LONGEST_NAME).replace(/\p{Surrogate}/gu, '\ufffd');
}
