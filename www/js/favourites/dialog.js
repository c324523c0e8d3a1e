/** The dialog of favourites and earlier visits, with thumbnails. */

import styles from '../../css/favourites.css';
import gallery from '../../css/gallery.css';
import { toast } from '../announce.js';
import { button, byId, closes, html, setText } from '../dom.js';
import { rename } from '../favourites.js';
import { addElements } from '../late.js';
import { readLink } from '../link.js';
import { openSession } from '../sessions.js';
import { say } from '../words.js';
import { favouriteCard, visitCard } from './cards.js';
import markup from './dialog.html';
import { createExchange } from './exchange.js';
import { isFavouritesFile } from './file.js';
import { createLazyThumbs } from './lazy-thumbs.js';
import { showNameField } from './name-field.js';
import { FULL } from './stored.js';

/** @typedef {import('../favourites.js').Favourite} Favourite */

/** @param {import('../dialogs.js').Page} page */
export function createFavourites({ engine, favourites: stored, session }) {
    addElements(markup, [gallery, styles]);
    const dialog = byId('favourites', HTMLDialogElement);
    const shelf = html('favourite-cards');
    const undo = button('favourites-undo');
    const thumbs = createLazyThumbs(engine, html('favourites-shelves'));
    /** The list before the last deletion. @type {Favourite[] | null} */
    let before = null;

    /** @param {string} words @param {boolean} [undoable] */
    function tell(words, undoable = false) {
        setText(html('favourites-status'), words);
        undo.hidden = !undoable;
        if (!undoable) before = null;
    }

    function fill() {
        thumbs.clear();
        const favourites = stored.list();
        shelf.replaceChildren(...favourites.map(cardOf));
        const visits = session.others().flatMap((one) => {
            const state = openSession(one)?.state;
            return state
                ? [
                      visitCard(
                          one.time,
                          state,
                          thumbs.of(state),
                          closeAndThen(() => session.resume(one)),
                      ),
                  ]
                : [];
        });
        html('visit-cards').replaceChildren(...visits);
        html('no-favourites').hidden = favourites.length > 0;
        html('visits').hidden = visits.length === 0;
        button('export-favourites').disabled = favourites.length === 0;
    }

    /** Closes the dialog and then acts. @param {() => void} act */
    const closeAndThen = (act) => () => {
        dialog.close();
        act();
    };

    /** @param {Favourite} one */
    function cardOf(one) {
        const state = readLink(one.link)?.state;
        return favouriteCard(one, state ? thumbs.of(state) : null, {
            open: closeAndThen(() => state && session.visit(state)),
            rename: () => startRenaming(one.id),
            remove: () => remove(one.id),
        });
    }

    /** A part of a favourite's card. @param {string} id @param {string} selector */
    const partOf = (id, selector) =>
        /** @type {HTMLElement | null | undefined} */ (
            shelf.querySelector(`[data-favourite="${CSS.escape(id)}"]`)?.querySelector(selector)
        );

    /** @param {string} id */
    function startRenaming(id) {
        const acts = partOf(id, '.card-acts');
        const one = stored.list().find((each) => each.id === id);
        if (!acts || !one) return fill();
        showNameField(acts, one.name, (name, focused) => {
            const next = name === null ? [] : rename(stored.list(), id, name);
            const given = next.find((each) => each.id === id)?.name ?? one.name;
            if (given !== one.name) tell(stored.put(next) ? say`Renamed to “${given}”.` : FULL);
            fill();
            if (focused) partOf(id, '.card-act')?.focus();
        });
    }

    /** @param {string} id */
    function remove(id) {
        const former = stored.list();
        const at = former.findIndex((one) => one.id === id);
        const gone = former[at];
        if (!gone) return fill();
        stored.put(former.filter((one) => one.id !== id));
        fill();
        before = former;
        tell(say`Deleted “${gone.name}”.`, true);
        // Focus the card that took the place of the deleted one.
        const next = stored.list()[Math.min(at, former.length - 2)];
        (next ? partOf(next.id, '.card-acts button:last-child') : button('close-favourites'))?.focus();
    }

    undo.addEventListener('click', () => {
        const former = before;
        if (!former) return;
        // Favourites added since then stay.
        const now = stored.list();
        stored.put([...now.filter((one) => !former.some(({ id }) => id === one.id)), ...former]);
        fill();
        tell(say`Restored.`);
        button('close-favourites').focus();
    });
    closes(dialog, 'close-favourites');
    const exchange = createExchange(stored, { tell, changed: fill });

    return {
        open() {
            tell('');
            fill();
            dialog.showModal();
            button('close-favourites').focus();
        },

        /** Imports a file of favourites that was opened like a system; whether it is one. @param {string} text */
        async take(text) {
            if (!isFavouritesFile(text)) return false;
            if (!stored.available) toast(say`This browser cannot store favourites here.`);
            else await add(text);
            return true;
        },
    };

    /** @param {string} text */
    async function add(text) {
        try {
            toast(await exchange.take(text));
        } catch (error) {
            toast(say`The favourites could not be read: ${String(error instanceof Error ? error.message : error)}.`);
        }
    }
}
