/** The stored favourites, and their number on the button that opens them. */

import { html, setText } from '../dom.js';
import { readFavourites } from '../favourites.js';
import { say } from '../words.js';

/** The message when the storage is full. */
export const FULL = say`The browser’s storage for this page is full. Export the favourites to a file, then delete some.`;

/** @typedef {import('../favourites.js').Favourite} Favourite */

/** @param {import('../storage.js').SafeStorage} storage */
export function createStored(storage) {
    const list = () => readFavourites(storage.read('favourites'));

    function showCount() {
        const count = list().length;
        setText(html('favourites-count'), count > 0 ? String(count) : '');
    }

    html('favourites-form').hidden = !storage.available;
    html('favourites-refused').hidden = storage.available;
    // Another tab may change the favourites.
    addEventListener('storage', showCount);
    showCount();

    return {
        available: storage.available,
        list,

        /** @param {Favourite[]} next @returns {boolean} whether the list was stored */
        put(next) {
            const isStored = storage.write('favourites', next);
            showCount();
            return isStored;
        },
    };
}
