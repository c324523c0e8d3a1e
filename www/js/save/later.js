/** Saving: the dialog, loaded when it is first opened by its button or by Ctrl+S, and files saved at once. */

import { toast } from '../announce.js';
import { button } from '../dom.js';
import { download, fileName } from '../download.js';
import { rememberedChoices, savedName, valuesFor } from './choices.js';
import { createExports } from './exports.js';
import { createSaveFile } from './save-file.js';

/** @typedef {import('../protocol.js').Format} Format */

/**
 * @param {import('../store.js').Store} store
 * @param {import('../engine.js').Engine} engine
 * @param {{storage: import('../storage.js').SafeStorage, canvas: () => import('../protocol.js').Canvas, custom: readonly import('./choices.js').CustomRow[]}} page
 *   `custom` lists dialogs of their own, such as for films, that appear among the formats
 */
export function createSave(store, engine, { storage, canvas, custom }) {
    const remembered = rememberedChoices(storage, custom);
    const exports = createExports();
    const files = createSaveFile({ store, engine, exports, canvas });
    /** @type {Promise<ReturnType<typeof import('./save-dialog.js').createSaveDialog>> | null} */
    let loading = null;

    async function open() {
        try {
            loading ??= import('./save-dialog.js').then(({ createSaveDialog }) => createSaveDialog({ store, remembered, exports, files, canvas, custom }));
            (await loading).open();
        } catch (error) {
            // A load that failed is tried again.
            loading = null;
            toast(`This part of the page could not be loaded (${error instanceof Error ? error.message : error}).`);
        }
    }

    button('open-save').addEventListener('click', open);
    addEventListener('keydown', (event) => {
        if (event.key.toLowerCase() !== 's' || !(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey) return;
        event.preventDefault();
        if (!document.querySelector('dialog[open]')) open();
    });

    /** Saves a file at once, with the options last chosen. @param {Format} format */
    return async function save(format) {
        const name = savedName(fileName(store.state), format);
        try {
            const { blob, diagnostics } = await files.make({ format, values: valuesFor(format, remembered.choices) });
            const [first] = diagnostics;
            const words = [first?.message, first?.hint].filter(Boolean).join(' ');
            if (!blob) return toast(`Not saved: ${words || 'the file could not be made.'}`);
            download(blob, name);
            // A remark about the file, such as that it opens slowly.
            if (words) toast(words);
        } catch (error) {
            toast(`Not saved: ${error instanceof Error ? error.message : error}.`);
        } finally {
            exports.leave();
        }
    };
}
