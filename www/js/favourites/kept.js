/** The favourites that the browser keeps, and how many there are, on the button that shows them. */

import { html, setText } from '../dom.js';
import { readFavourites } from '../favourites.js';

/** @typedef {import('../favourites.js').Favourite} Favourite */

/** @param {import('../storage.js').Keeper} keeper */
export function createKept(keeper) {
    const list = () => readFavourites(keeper.read('favourites'));

    function showCount() {
        const count = list().length;
        setText(html('favourites-count'), count > 0 ? String(count) : '');
    }

    html('favourites-form').hidden = !keeper.available;
    html('favourites-refused').hidden = keeper.available;
    // Another tab may change them.
    addEventListener('storage', showCount);
    showCount();

    return {
        available: keeper.available,
        list,

        /** @param {Favourite[]} next @returns {boolean} whether it is kept */
        put(next) {
            const kept = keeper.write('favourites', next);
            showCount();
            return kept;
        },
    };
}
