/** Exports favourites to a file and imports files of favourites. */

import { button, input } from '../base/dom.js';
import { download } from '../base/download.js';
import { LARGEST_FILE } from './favourites.js';
import { counted, reasonOf, say } from '../base/words.js';
import { readFile, writeFile } from './file.js';
import { FULL } from './stored.js';

/**
 * @param {ReturnType<typeof import('./stored.js').createStored>} stored
 * @param {{tell: (words: string) => void, changed: () => void}} dialog
 */
export function createExchange(stored, { tell, changed }) {
    const chooser = input('favourites-file');

    button('export-favourites').addEventListener('click', () => {
        download(new Blob([writeFile(stored.list())], { type: 'application/json' }), 'favourites.json');
        tell(say`Exported all favourites to favourites.json.`);
    });
    button('import-favourites').addEventListener('click', () => chooser.click());
    chooser.addEventListener('change', async () => {
        const [file] = chooser.files ?? [];
        chooser.value = '';
        if (!file) return;
        try {
            tell(
                file.size > LARGEST_FILE
                    ? say`This file is too large. Files of favourites have at most 2 MB.`
                    : await take(await file.text()),
            );
        } catch (error) {
            tell(say`${file.name} could not be read: ${reasonOf(error)}`);
        }
    });

    /** Adds the favourites of a file. @param {string} text @returns {Promise<string>} a message about the result */
    async function take(text) {
        const read = await readFile(stored.list(), text);
        if (!read) return say`This file contains no favourites.`;
        const isStored = read.added === 0 || stored.put(read.list.slice(-read.added));
        changed();
        return isStored ? resultText(read) : FULL;
    }

    return { take };
}

/** @param {NonNullable<Awaited<ReturnType<typeof readFile>>>} read */
function resultText({ added, known, damaged, tooMany }) {
    const parts = [
        counted(added, 'Added {} favourite.', 'Added {} favourites.'),
        known > 0 && counted(known, '{} was already there.', '{} were already there.'),
        damaged > 0 && counted(damaged, '{} could not be read.', '{} could not be read.'),
        tooMany > 0 && counted(tooMany, 'There was no room for {} more.', 'There was no room for {} more.'),
    ];
    return parts.filter(Boolean).join(' ');
}
