/**
 * Systems in the notations of other programs and of papers: pasted, dropped or opened text is recognised and offered.
 * A dialog shows each system as a small picture, and what could not be carried over.
 */

import { toast } from './announce.js';
import { button, byId, closes, html, input, make, setText, withCode } from './dom.js';
import { setLayer } from './layers.js';
import { emptyThumb, paintThumb } from './thumb.js';
import { createTool } from './tool.js';

/** @typedef {import('./protocol.js').Imported} Imported */
/** @typedef {Imported['entries'][number]} Entry */

/** Shorter pasted text is no whole system, and longer text is not read, in characters. */
const SHORTEST = 8;
const LONGEST = 1 << 20;
/** The side of a picture, in CSS pixels. */
const SIDE = 168;
/** The most remarks shown for one system. */
const MOST_REMARKS = 40;

/** The name of our own notation, whose files open without this dialog. */
const OURS = 'our own JSON';

/** @param {Entry} entry */
const nameOf = ({ name }) => name || 'Untitled system';

/**
 * @param {import('./engine.js').Engine} engine
 * @param {{open: (definition: import('./state.js').Definition) => void, restyle: (definition: import('./state.js').Definition) => import('./state.js').Definition}} page
 */
export function createImporting(engine, { open, restyle }) {
    /** @type {ReturnType<typeof createTool<import('./protocol.js').ImportCalls>>} */
    const tool = createTool('import');
    const dialog = byId('import', HTMLDialogElement);
    const note = html('import-offer');
    const search = input('import-search');
    /** @type {{entry: Entry, card: HTMLButtonElement, item: HTMLElement, picture: HTMLCanvasElement, painted: boolean}[]} */
    let cards = [];
    /** @type {Entry | null} */
    let chosen = null;
    /** What is offered after text was pasted into a field. @type {Imported | null} */
    let offered = null;

    const seen = new IntersectionObserver((entries) => entries.forEach(({ isIntersecting, target }) => isIntersecting && paint(target)), { root: html('import-shelf'), rootMargin: '120px' });

    /** @param {Element} target */
    async function paint(target) {
        const card = cards.find(({ picture }) => picture === target);
        if (!card || card.painted || !card.entry.definition) return;
        card.painted = true;
        try {
            const missing = await paintThumb(card.picture, engine, restyle(card.entry.definition), SIDE, () => dialog.open);
            if (missing) card.picture.replaceWith(make('span', { class: 'card-missing' }, missing));
        } catch {
            // The worker was replaced; the card stays without a picture.
        }
    }

    /** @param {Entry} entry */
    function choose(entry) {
        chosen = entry;
        for (const { entry: own, card } of cards) card.setAttribute('aria-pressed', String(own === entry));
        setText(html('import-name'), nameOf(entry));
        html('import-remarks').replaceChildren(
            ...entry.remarks.slice(0, MOST_REMARKS).map(({ line, text, message }) =>
                make('li', {}, make('span', { class: 'place' }, `Line ${line}`), ' ', ...(text ? [make('code', {}, text), ' '] : []), ...withCode(message)),
            ),
        );
        const more = entry.remarks.length - MOST_REMARKS;
        if (more > 0) html('import-remarks').append(make('li', {}, `And ${more} more.`));
        setText(html('import-note'), entry.definition === null ? 'This system cannot be opened:' : entry.remarks.length > 0 ? 'Not carried over, or changed:' : 'Everything was carried over.');
        button('import-open').disabled = entry.definition === null;
    }

    /** @param {Imported} found */
    function show({ notation, entries }) {
        hideOffer();
        seen.disconnect();
        const readable = entries.filter(({ definition }) => definition !== null);
        setText(html('h-import'), entries.length === 1 ? `Open from ${notation}` : `${entries.length} systems from ${notation}`);
        cards = entries.map((entry) => {
            const picture = emptyThumb();
            if (entry.definition) picture.style.background = restyle(entry.definition).background;
            const kind = entry.definition === null ? 'cannot be opened' : entry.remarks.length > 0 ? `${entry.remarks.length} ${entry.remarks.length === 1 ? 'remark' : 'remarks'}` : '';
            const card = make('button', { type: 'button', class: 'card', 'aria-pressed': 'false' }, make('span', { class: 'card-picture' }, picture), make('span', { class: 'card-title' }, nameOf(entry)), make('span', { class: 'card-kind' }, kind));
            card.addEventListener('click', () => choose(entry));
            card.addEventListener('dblclick', accept);
            return { entry, card, item: make('li', {}, card), picture, painted: false };
        });
        // Systems that cannot be opened stand last.
        cards.sort((a, b) => Number(a.entry.definition === null) - Number(b.entry.definition === null));
        html('import-cards').replaceChildren(...cards.map(({ item }) => item));
        search.value = '';
        html('import-search-row').hidden = entries.length < 9;
        dialog.classList.toggle('fitted', entries.length < 10);
        const first = readable[0] ?? entries[0];
        if (first) choose(first);
        dialog.showModal();
        for (const { picture } of cards) seen.observe(picture);
        button('import-open').focus();
    }

    function accept() {
        if (!chosen?.definition) return;
        dialog.close();
        open(restyle({ ...chosen.definition, title: chosen.definition.title || chosen.name }));
        toast(`Opened ${nameOf(chosen)}. Undo to go back.`);
    }

    function hideOffer() {
        note.hidden = true;
        offered = null;
        setLayer(hideOffer, false);
    }

    /** @param {string} text @returns {Promise<Imported | null>} */
    async function read(text) {
        if (text.length < SHORTEST || text.length > LONGEST) return null;
        try {
            return await tool.call('import', { text });
        } catch {
            toast('The readers of other notations did not load. Try again.');
            return null;
        }
    }

    search.addEventListener('input', () => {
        const words = search.value.toLowerCase();
        for (const { entry, item } of cards) item.hidden = !entry.name.toLowerCase().includes(words);
    });
    button('import-open').addEventListener('click', accept);
    closes(dialog, 'close-import');
    button('import-cancel').addEventListener('click', () => dialog.close());
    button('import-accept').addEventListener('click', () => offered && show(offered));
    button('import-dismiss').addEventListener('click', hideOffer);

    document.addEventListener('paste', async (event) => {
        if (document.querySelector('dialog[open]')) return;
        const field = event.target instanceof HTMLTextAreaElement || event.target instanceof HTMLInputElement;
        if (field && !['axiom', 'rules'].includes(/** @type {HTMLElement} */ (event.target).id)) return;
        const found = await read(event.clipboardData?.getData('text/plain') ?? '');
        if (!found) return;
        if (!field) return show(found);
        // The text is in the field, and stays there if the reader wants it there.
        offered = found;
        setText(html('import-what'), `This looks like ${found.notation}${found.entries.length > 1 ? ` (${found.entries.length} systems)` : ''}.`);
        note.hidden = false;
        setLayer(hideOffer, true);
    });

    return {
        /** Offers the systems of a text in another notation than ours; returns whether there are any. @param {string} text */
        async offer(text) {
            const found = await read(text);
            if (found === null || found.notation === OURS) return false;
            show(found);
            return true;
        },
    };
}
