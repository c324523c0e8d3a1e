/** The dialog of favourites and earlier visits, with thumbnails. */

import styles from '../../css/favourites.css';
import gallery from '../../css/gallery.css';
import { toast } from '../base/announce.js';
import { button, byId, closes, html, setText } from '../base/dom.js';
import { renamed } from './favourites.js';
import { addElements } from '../base/late.js';
import { readLink } from '../state/link.js';
import { openSession } from '../state/sessions.js';
import { reasonOf, say } from '../base/words.js';
import { favouriteCard, visitCard } from './cards.js';
import markup from './dialog.html';
import { createExchange } from './exchange.js';
import { isFavouritesFile } from './file.js';
import { createLazyThumbs } from './lazy-thumbs.js';
import { showNameField } from './name-field.js';
import { FULL } from './stored.js';

/**
 * The dialog and its cards.
 * @typedef {object} Shelves
 * @property {import('../dialogs/dialogs.js').Page['favourites']} stored
 * @property {import('../dialogs/dialogs.js').Page['session']} session
 * @property {HTMLDialogElement} dialog
 * @property {HTMLElement} shelf
 * @property {HTMLButtonElement} undo
 * @property {ReturnType<typeof createLazyThumbs>} thumbs
 * @property {Favourite | null} before What was deleted last
 * @property {ReturnType<typeof createExchange>} exchange
 */

/** @typedef {import('./favourites.js').Favourite} Favourite */

/** @param {import('../dialogs/dialogs.js').Page} page */
export function createFavourites({ engine, favourites: stored, session }) {
    addElements(markup, [gallery, styles]);
    const dialog = byId('favourites', HTMLDialogElement);

    const undo = button('favourites-undo');

    undo.addEventListener('click', () => {
        if (!self.before) return;
        stored.put([self.before]);
        fill(self);
        tell(self, say`Restored.`);
        button('close-favourites').focus();
    });
    closes(dialog, 'close-favourites');
    stored.follow(() => dialog.open && !dialog.querySelector('.card-acts input') && fill(self));
    const exchange = createExchange(stored, { tell: (words) => tell(self, words), changed: () => fill(self) });
    /** @type {Shelves} */
    const self = {
        stored,
        session,
        dialog,
        shelf: html('favourite-cards'),
        undo,
        thumbs: createLazyThumbs(engine, html('favourites-shelves')),
        before: null,
        exchange,
    };

    return {
        open() {
            tell(self, '');
            fill(self);
            dialog.showModal();
            button('close-favourites').focus();
        },

        /** Imports a file of favourites that was opened like a system; whether it is one. @param {string} text */
        async take(text) {
            if (!isFavouritesFile(text)) return false;
            if (!stored.available) toast(say`This browser cannot store favourites here.`);
            else await add(self, text);
            return true;
        },
    };
}

/** @param {Shelves} self @param {string} words @param {boolean} [undoable] */
function tell(self, words, undoable = false) {
    setText(html('favourites-status'), words);
    self.undo.hidden = !undoable;
    if (!undoable) self.before = null;
}

/** @param {Shelves} self */
function fill(self) {
    self.thumbs.clear();
    const favourites = self.stored.list();
    self.shelf.replaceChildren(...favourites.map((one) => cardOf(self, one)));
    const visits = self.session.others().flatMap((one) => {
        const state = openSession(one)?.state;
        return state
            ? [
                  visitCard(
                      one.time,
                      state,
                      self.thumbs.of(state),
                      closeAndThen(self, () => self.session.resume(one)),
                  ),
              ]
            : [];
    });
    html('visit-cards').replaceChildren(...visits);
    html('no-favourites').hidden = favourites.length > 0;
    html('visits').hidden = visits.length === 0;
    button('export-favourites').disabled = favourites.length === 0;
}

/** Closes the dialog and then acts. @param {Shelves} self @param {() => void} act */
const closeAndThen = (self, act) => () => {
    self.dialog.close();
    act();
};

/** @param {Shelves} self @param {Favourite} one */
function cardOf(self, one) {
    const state = readLink(one.link)?.state;
    return favouriteCard(one, state ? self.thumbs.of(state) : null, {
        open: closeAndThen(self, () => state && self.session.visit(state)),
        rename: () => startRenaming(self, one.id),
        remove: () => remove(self, one.id),
    });
}

/** A part of a favourite's card. @param {Shelves} self @param {string} id @param {string} selector */
const partOf = (self, id, selector) =>
    /** @type {HTMLElement | null | undefined} */ (
        self.shelf.querySelector(`[data-favourite="${CSS.escape(id)}"]`)?.querySelector(selector)
    );

/** @param {Shelves} self @param {string} id */
function startRenaming(self, id) {
    const acts = partOf(self, id, '.card-acts');
    const one = self.stored.list().find((each) => each.id === id);
    if (!acts || !one) return fill(self);
    showNameField(acts, one.name, (name, focused) => {
        const next = renamed(self.stored.list().find((each) => each.id === id) ?? one, name ?? '');
        if (next.name !== one.name) tell(self, self.stored.put([next]) ? say`Renamed to “${next.name}”.` : FULL);
        fill(self);
        if (focused) partOf(self, id, '.card-act')?.focus();
    });
}

/** @param {Shelves} self @param {string} id */
function remove(self, id) {
    const former = self.stored.list();
    const at = former.findIndex((one) => one.id === id);
    const gone = former[at];
    if (!gone) return fill(self);
    self.stored.put([{ ...gone, gone: true }]);
    fill(self);
    self.before = gone;
    tell(self, say`Deleted “${gone.name}”.`, true);
    // Focus the card that took the place of the deleted one.
    const next = self.stored.list()[Math.min(at, former.length - 2)];
    (next ? partOf(self, next.id, '.card-acts button:last-child') : button('close-favourites'))?.focus();
}

/** @param {Shelves} self @param {string} text */
async function add(self, text) {
    try {
        toast(await self.exchange.take(text));
    } catch (error) {
        toast(say`The favourites could not be read: ${reasonOf(error)}.`);
    }
}
