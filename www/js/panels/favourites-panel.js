/** Systems kept by name, and where earlier visits ended: a form in Save, and a dialog of small pictures. */

import { toast } from '../announce.js';
import { button, byId, closes, html, input, make, setText } from '../dom.js';
import { download } from '../download.js';
import { LARGEST_FILE, LONGEST_NAME, MOST_FAVOURITES, favourite, readFavourites, readFile, rename, writeFile } from '../favourites.js';
import { readLink } from '../link.js';
import { openSession } from '../sessions.js';
import { definitionOf } from '../state.js';
import { emptyThumb, paintThumb } from '../thumb.js';

/** @typedef {import('../favourites.js').Favourite} Favourite */
/** @typedef {import('../sessions.js').Session} Session */
/** @typedef {import('../state.js').State} State */

/** The side of a small picture, in CSS pixels. */
const SIDE = 168;
const FULL = 'The browser has no more room for this page: export the favourites as a file, and delete some.';

/**
 * @param {import('../store.js').Store} store
 * @param {import('../engine.js').Engine} engine
 * @param {{keeper: import('../storage.js').Keeper, session: ReturnType<typeof import('../session.js').createSession>}} kept
 */
export function favouritesPanel(store, engine, { keeper, session }) {
    const dialog = byId('favourites', HTMLDialogElement);
    const name = input('favourite-name');
    const chooser = input('favourites-file');
    const shelf = html('favourite-cards');
    const visits = html('visit-cards');
    const status = html('favourites-status');
    const undo = button('favourites-undo');
    /** The list before the last deletion. @type {Favourite[] | null} */
    let before = null;
    /** What is not painted yet. @type {Map<Element, State>} */
    const unpainted = new Map();

    const seen = new IntersectionObserver(
        (entries) => {
            for (const { isIntersecting, target } of entries) if (isIntersecting && target instanceof HTMLCanvasElement) paint(target);
        },
        { root: html('favourites-shelves'), rootMargin: '120px' },
    );

    const list = () => readFavourites(keeper.read('favourites'));

    html('favourites-form').hidden = !keeper.available;
    html('favourites-refused').hidden = keeper.available;

    /** @param {Favourite[]} next @returns {boolean} whether it is kept */
    function put(next) {
        const kept = keeper.write('favourites', next);
        showCount();
        return kept;
    }

    function showCount() {
        const count = list().length;
        setText(html('favourites-count'), count > 0 ? String(count) : '');
    }

    /** @param {string} words @param {boolean} [undoable] */
    function tell(words, undoable = false) {
        setText(status, words);
        undo.hidden = !undoable;
        if (!undoable) before = null;
    }

    html('favourites-form').addEventListener('submit', (event) => {
        event.preventDefault();
        const added = favourite(name.value, store.state);
        const former = list();
        if (former.some((one) => one.name === added.name && one.link === added.link)) return toast(`“${added.name}” is already in favourites.`);
        if (former.length >= MOST_FAVOURITES) return toast(`At most ${MOST_FAVOURITES} favourites: delete some first.`);
        if (!put([added, ...former])) return toast(FULL);
        name.value = '';
        toast(`Added “${added.name}” to favourites.`);
    });

    function open() {
        tell('');
        fill();
        dialog.showModal();
        button('close-favourites').focus();
    }

    function fill() {
        unpainted.clear();
        seen.disconnect();
        const favourites = list();
        shelf.replaceChildren(...favourites.map(favouriteCard));
        const sessions = session.others().flatMap((one) => {
            const opened = openSession(one);
            return opened ? [visitCard(one, opened.state)] : [];
        });
        visits.replaceChildren(...sessions);
        html('no-favourites').hidden = favourites.length > 0;
        html('visits').hidden = sessions.length === 0;
        button('export-favourites').disabled = favourites.length === 0;
    }

    /** @param {State} state */
    function canvasOf(state) {
        const picture = emptyThumb();
        unpainted.set(picture, state);
        seen.observe(picture);
        return picture;
    }

    /** @param {HTMLCanvasElement} picture */
    async function paint(picture) {
        const state = unpainted.get(picture);
        if (!state) return;
        unpainted.delete(picture);
        try {
            await paintThumb(picture, engine, definitionOf(state), SIDE);
        } catch {
            // The worker was replaced meanwhile; the picture comes when the dialog is next opened.
        }
    }

    /** @param {Favourite} one */
    function favouriteCard(one) {
        const state = readLink(one.link)?.state;
        const opener = make('button', { type: 'button', class: 'card', 'data-id': one.id }, ...(state ? [canvasOf(state)] : []), make('span', { class: 'card-title' }, one.name));
        opener.addEventListener('click', () => {
            dialog.close();
            if (state) session.visit(state);
        });
        const renamer = make('button', { type: 'button', class: 'card-act', 'aria-label': `Rename ${one.name}` }, 'Rename');
        renamer.addEventListener('click', () => startRenaming(one.id));
        const remover = make('button', { type: 'button', class: 'card-act', 'aria-label': `Delete ${one.name}` }, 'Delete');
        remover.addEventListener('click', () => remove(one.id));
        return make('li', { class: 'kept', 'data-favourite': one.id }, opener, make('div', { class: 'card-acts' }, renamer, remover));
    }

    /** @param {Session} one @param {State} state */
    function visitCard(one, state) {
        const when = new Date(one.time).toLocaleString([], { dateStyle: 'medium', timeStyle: 'short' });
        const opener = make('button', { type: 'button', class: 'card' }, canvasOf(state), make('span', { class: 'card-title' }, state.title || state.name || 'Untitled system'), make('span', { class: 'card-kind' }, when));
        opener.addEventListener('click', () => {
            dialog.close();
            session.resume(one);
        });
        return make('li', { class: 'kept' }, opener);
    }

    /** @param {string} id */
    const itemOf = (id) => shelf.querySelector(`[data-favourite="${CSS.escape(id)}"]`);

    /** @param {string} id */
    function startRenaming(id) {
        const acts = itemOf(id)?.querySelector('.card-acts');
        const one = list().find((each) => each.id === id);
        if (!acts || !one) return fill();
        const field = make('input', { type: 'text', class: 'number', maxlength: String(LONGEST_NAME), value: one.name, 'aria-label': `New name of ${one.name}`, autocomplete: 'off' });
        acts.replaceChildren(field);
        field.focus();
        field.select();
        let done = false;
        /** @param {boolean} keep */
        const finish = (keep) => {
            if (done) return;
            done = true;
            const next = rename(list(), id, field.value);
            const name = next.find((each) => each.id === id)?.name ?? one.name;
            if (keep && name !== one.name) tell(put(next) ? `Renamed to “${name}”.` : FULL);
            const held = document.activeElement === field;
            fill();
            if (held) /** @type {HTMLElement | null} */ (itemOf(id)?.querySelector('.card-act'))?.focus();
        };
        field.addEventListener('keydown', (event) => {
            if (event.key !== 'Enter' && event.key !== 'Escape') return;
            // Escape would close the dialog as well.
            event.preventDefault();
            event.stopPropagation();
            finish(event.key === 'Enter');
        });
        field.addEventListener('blur', () => finish(true));
    }

    /** @param {string} id */
    function remove(id) {
        const former = list();
        const at = former.findIndex((one) => one.id === id);
        const gone = former[at];
        if (!gone) return fill();
        put(former.filter((one) => one.id !== id));
        fill();
        before = former;
        tell(`Deleted “${gone.name}”.`, true);
        // The keyboard stays where it was, on the card that took the place.
        const next = list()[Math.min(at, former.length - 2)];
        const place = next ? itemOf(next.id)?.querySelector('.card-acts button:last-child') : button('close-favourites');
        if (place instanceof HTMLElement) place.focus();
    }

    undo.addEventListener('click', () => {
        const former = before;
        if (!former) return;
        // What came in meanwhile stays.
        const now = list();
        put([...now.filter((one) => !former.some(({ id }) => id === one.id)), ...former]);
        fill();
        tell('It is back.');
        button('close-favourites').focus();
    });

    button('export-favourites').addEventListener('click', () => {
        download(new Blob([writeFile(list())], { type: 'application/json' }), 'favourites.json');
        tell('All favourites are saved in favourites.json.');
    });

    /** @param {string} text @returns {Promise<string>} what came of it, in words */
    async function importText(text) {
        const read = await readFile(list(), text);
        if (!read) return 'This file holds no favourites.';
        const kept = read.added === 0 || put(read.list);
        fill();
        if (!kept) return FULL;
        const parts = [
            read.added === 1 ? 'Added 1 favourite.' : `Added ${read.added} favourites.`,
            read.known > 0 && `${read.known} ${read.known === 1 ? 'was' : 'were'} there already.`,
            read.damaged > 0 && `${read.damaged} could not be read.`,
            read.tooMany > 0 && `There was no room for ${read.tooMany} more.`,
        ];
        return parts.filter(Boolean).join(' ');
    }

    button('import-favourites').addEventListener('click', () => chooser.click());
    chooser.addEventListener('change', async () => {
        const [file] = chooser.files ?? [];
        chooser.value = '';
        if (!file) return;
        try {
            tell(file.size > LARGEST_FILE ? 'This file is too large: a file of favourites has at most 2 MB.' : await importText(await file.text()));
        } catch (error) {
            tell(`${file.name} could not be read: ${error instanceof Error ? error.message : error}`);
        }
    });

    button('open-favourites').addEventListener('click', open);
    closes(dialog, 'close-favourites');
    addEventListener('storage', showCount);
    store.subscribe(showName);
    showCount();
    showName();

    /** The name a system would be kept by. */
    function showName() {
        name.placeholder = store.state.title || store.state.name || 'Untitled system';
    }

    return {
        /** A file of favourites that was opened like a system. @param {string} text */
        async take(text) {
            if (!keeper.available) return toast('This browser keeps no favourites here.');
            try {
                toast(await importText(text));
            } catch (error) {
                toast(`The favourites could not be read: ${error instanceof Error ? error.message : error}.`);
            }
        },
    };
}
