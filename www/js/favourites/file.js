/** Files of favourites. Pure functions. */

import { FORMAT, MOST_FAVOURITES, favourite } from './favourites.js';
import { openLink } from '../state/packed.js';
import { say } from '../base/words.js';

/** @typedef {import('./favourites.js').Favourite} Favourite */

/** Files with more entries are not read. */
export const MOST_ENTRIES = 10_000;
/** The most that all links take, in UTF-16 units: browsers store five million per site. */
const MOST_STORED = 4_000_000;
/** A file with more damaged links is rejected, because short links may take long to unpack. */
const MOST_DAMAGED = 50;

/** Reading a file pauses after this time to keep the page responsive, in milliseconds. */
const PAUSE_AFTER = 12;

/** The text of a file of favourites. @param {readonly Favourite[]} list */
export function writeFile(list) {
    return `${JSON.stringify({ format: FORMAT, version: 1, favourites: list.map(({ name, link }) => ({ name, link })) }, null, 2)}\n`;
}

/** Whether a text is a file of favourites. @param {string} text */
export function isFavouritesFile(text) {
    return text.includes(FORMAT) && Array.isArray(parse(text)?.favourites);
}

/**
 * Adds the favourites of a file to a list. Known favourites are skipped and damaged links are counted. Reading pauses to
 * keep the page responsive.
 * @param {readonly Favourite[]} list
 * @param {string} text
 * @returns {Promise<{list: Favourite[], added: number, known: number, damaged: number, tooMany: number} | null>} null if the text is no file of favourites
 * @throws {RangeError} with a message, if the file exceeds a limit
 */
export async function readFile(list, text) {
    const given = parse(text)?.favourites;
    if (!Array.isArray(given)) return null;
    if (given.length > MOST_ENTRIES) throw new RangeError(say`it has more than ${MOST_ENTRIES} entries`);
    let sliceStart = performance.now();
    const same = (/** @type {Favourite} */ { name, link }) => `${name}\n${link}`;
    const there = new Set(list.map(same));
    let stored = list.reduce((sum, { link }) => sum + link.length, 0);
    const result = { list: [...list], added: 0, known: 0, damaged: 0, tooMany: 0 };
    for (const one of given) {
        if (result.list.length >= MOST_FAVOURITES) {
            // The rest of the file is not read.
            result.tooMany = given.length - result.added - result.known - result.damaged;
            break;
        }
        if (performance.now() - sliceStart > PAUSE_AFTER) {
            await new Promise((resolve) => setTimeout(resolve));
            sliceStart = performance.now();
        }
        const link = typeof one?.link === 'string' ? await openLink(one.link.slice(one.link.indexOf('#') + 1)) : null;
        if (!link || link.problems.length > 0) {
            result.damaged += 1;
            if (result.damaged > MOST_DAMAGED)
                throw new RangeError(say`more than ${MOST_DAMAGED} of its links are damaged`);
            continue;
        }
        const read = favourite(typeof one.name === 'string' ? one.name : '', link.state);
        if (there.has(same(read))) {
            result.known += 1;
            continue;
        }
        stored += read.link.length;
        if (stored > MOST_STORED) {
            result.tooMany = given.length - result.added - result.known - result.damaged;
            break;
        }
        there.add(same(read));
        // In the order of the file, after the existing favourites.
        result.list.push({ ...read, made: Math.min(0, result.list.at(-1)?.made ?? 0) - 1 });
        result.added += 1;
    }
    return result;
}

/** @param {string} text @returns {any} null if the text is no JSON */
function parse(text) {
    try {
        return JSON.parse(text);
    } catch {
        return null;
    }
}
