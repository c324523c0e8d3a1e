/** The published exercises, in the order in which they are done. */

import { jsonOf } from '../base/files.js';
import { say } from '../base/words.js';

/** @typedef {{id: string, shelf: string, title: string, text: string | null, x: string}} Entry */

/** The groups of exercises, in order, with their words on the cards. @type {Readonly<Record<string, string>>} */
export const GROUPS = { rising: say`Rising difficulty`, assignment: say`From the assignment`, program: say`Program` };

/** @returns {Promise<Entry[]>} */
export async function exercises() {
    const all = /** @type {Entry[]} */ (await jsonOf('exercises.json'));
    return Object.keys(GROUPS).flatMap((group) => all.filter(({ shelf }) => shelf === group));
}
