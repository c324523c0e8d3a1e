/** The favourites that the browser keeps, and how many there are, on the button that shows them. */

import { html, setText } from '../dom.js';
import { readFavourites } from '../favourites.js';

/** @typedef {import('../favourites.js').Favourite} Favourite */

/** @param {import('../storage.js').SafeStorage} storage */
export function createKept(storage) {
    const list = () => readFavourites(storage.read('favourites'));

    function showCount() {
        const count = list().length;
        setText(html('favourites-count'), count > 0 ? String(count) : '');
    }

    html('favourites-form').hidden = !storage.available;
    html('favourites-refused').hidden = storage.available;
    // Another tab may change them.
    addEventListener('storage', showCount);
    showCount();

    return {
        available: storage.available,
        list,

        /** @param {Favourite[]} next @returns {boolean} whether it is kept */
        put(next) {
            const kept = storage.write('favourites', next);
            showCount();
            return kept;
        },
    };
}
