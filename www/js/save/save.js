/** Saving: the dialog, and files saved at once with the options last chosen. */

import { toast } from '../base/announce.js';
import { download, fileName } from '../base/download.js';
import { reasonOf, say } from '../base/words.js';
import { rememberedChoices, savedName, valuesFor } from './choices.js';
import { createExports } from './exports.js';
import { createSaveDialog } from './save-dialog.js';
import { createSaveFile } from './save-file.js';

/** @typedef {import('../protocol.js').Format} Format */

/** @param {import('../dialogs/dialogs.js').Page} page */
export function createSave({ store, engine, storage, stage }) {
    const canvas = stage.resolution;
    const remembered = rememberedChoices(storage);
    const exports = createExports();
    const files = createSaveFile({ store, engine, exports, canvas });
    const dialog = createSaveDialog({ store, remembered, exports, files, canvas });

    return {
        open: dialog.open,

        /** Saves a file at once. @param {Format} format */
        async save(format) {
            const name = savedName(fileName(store.state), format);
            try {
                const { blob, diagnostics } = await files.make({
                    format,
                    values: valuesFor(format, remembered.choices),
                });
                const [first] = diagnostics;
                const words = [first?.message, first?.hint].filter(Boolean).join(' ');
                if (!blob) return toast(words ? say`Not saved: ${words}` : say`Not saved: the file could not be made.`);
                download(blob, name);
                // A remark about the file, such as that it opens slowly.
                if (words) toast(words);
            } catch (error) {
                toast(say`Not saved: ${reasonOf(error)}.`);
            } finally {
                exports.leave();
            }
        },
    };
}
