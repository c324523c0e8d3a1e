/**
 * The ways to the search for rules: its buttons, and a picture in the clipboard. The dialog is loaded when it is first
 * needed.
 */

import { toast } from '../announce.js';
import { pictureIn } from './files.js';

/** @typedef {import('../state.js').Definition} Definition */

/**
 * @param {import('../engine.js').Engine} engine
 * @param {{open: (definition: Definition) => void, restyle: (definition: Definition) => Definition}} page
 *   `restyle` gives a system with default colours the theme's colours
 * @returns {(picture?: File) => void} opens the dialog, with a picture if there is one
 */
export function createFind(engine, page) {
    /** @type {Promise<(picture?: File) => void> | null} */
    let loading = null;

    /** @param {File} [picture] */
    async function find(picture) {
        // A load that failed is tried again.
        loading ??= import('./finding.js').then(({ createFinding }) => createFinding(engine, page));
        try {
            (await loading)(picture);
        } catch (error) {
            loading = null;
            toast(`This part of the page could not be loaded (${error instanceof Error ? error.message : error}).`);
        }
    }

    for (const button of document.querySelectorAll('[data-find]')) {
        button.addEventListener('click', () => {
            button.closest('dialog')?.close();
            void find();
        });
    }
    document.addEventListener('paste', (event) => {
        const picture = pictureIn(event.clipboardData);
        // Office programs add a picture to the text that they copy.
        if (!picture || event.defaultPrevented || event.clipboardData?.getData('text/plain') || document.querySelector('dialog[open]')) return;
        event.preventDefault();
        void find(picture);
    });
    return find;
}
