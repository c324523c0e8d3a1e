/** The stored favourites, and their number on the button that opens them. */

import { html, setText } from '../base/dom.js';
import { readFavourites, tidyFavourites } from './favourites.js';
import { createRows } from '../state/rows.js';
import { say } from '../base/words.js';

/** The message when the storage is full. */
export const FULL = say`The browser’s storage for this page is full. Export the favourites to a file, then delete some.`;

/** @typedef {import('./favourites.js').Favourite} Favourite */

/** @param {import('../state/storage.js').SafeStorage} storage */
export function createStored(storage) {
    /** @type {(() => void)[]} */
    const listeners = [];
    /** @type {ReturnType<typeof createRows<Favourite & import('../state/rows.js').Row>>} */
    const rows = createRows(storage, 'favourites', { read: readFavourites, tidy: tidyFavourites, changed });

    function showCount() {
        const count = rows.list().length;
        setText(html('favourites-count'), count > 0 ? String(count) : '');
    }

    /** Another tab has changed the favourites. */
    function changed() {
        showCount();
        for (const listener of listeners) listener();
    }

    html('favourites-form').hidden = !storage.available;
    html('favourites-refused').hidden = storage.available;
    showCount();

    return {
        available: storage.available,
        /** @returns {Favourite[]} */
        list: rows.list,
        /** @param {() => void} listener another tab has changed the favourites */
        follow: (listener) => listeners.push(listener),

        /** Adds favourites or changes them; those with `gone` are deleted. @param {(Favourite & {gone?: boolean})[]} changes @returns {boolean} whether that was stored */
        put(changes) {
            const isStored = rows.put(
                changes.map(({ id, name, link, made, gone }) => (gone ? { id, gone } : { id, name, link, made })),
            );
            showCount();
            return isStored;
        },
    };
}
