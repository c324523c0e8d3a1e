/** Exports favourites to a file and imports files of favourites. */

import { button, input } from '../dom.js';
import { download } from '../download.js';
import { LARGEST_FILE } from '../favourites.js';
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
        tell('Exported all favourites to favourites.json.');
    });
    button('import-favourites').addEventListener('click', () => chooser.click());
    chooser.addEventListener('change', async () => {
        const [file] = chooser.files ?? [];
        chooser.value = '';
        if (!file) return;
        try {
            tell(
                file.size > LARGEST_FILE
                    ? 'This file is too large. Files of favourites have at most 2 MB.'
                    : await take(await file.text()),
            );
        } catch (error) {
            tell(`${file.name} could not be read: ${error instanceof Error ? error.message : error}`);
        }
    });

    /** Adds the favourites of a file. @param {string} text @returns {Promise<string>} a message about the result */
    async function take(text) {
        const read = await readFile(stored.list(), text);
        if (!read) return 'This file contains no favourites.';
        const isStored = read.added === 0 || stored.put(read.list);
        changed();
        return isStored ? resultText(read) : FULL;
    }

    return { take };
}

/** @param {NonNullable<Awaited<ReturnType<typeof readFile>>>} read */
function resultText({ added, known, damaged, tooMany }) {
    const parts = [
        added === 1 ? 'Added 1 favourite.' : `Added ${added} favourites.`,
        known > 0 && `${known} ${known === 1 ? 'was' : 'were'} already there.`,
        damaged > 0 && `${damaged} could not be read.`,
        tooMany > 0 && `There was no room for ${tooMany} more.`,
    ];
    return parts.filter(Boolean).join(' ');
}
