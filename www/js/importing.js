/**
 * Systems in the notations of other programs and of papers: pasted, dropped or opened text is recognised and offered.
 * A dialog shows each system as a small picture, and what could not be carried over.
 */

import gallery from '../css/gallery.css';
import styles from '../css/importing.css';
import { showAccount } from './account.js';
import { toast } from './announce.js';
import { button, byId, closes, html, input, make, setText, withCode } from './dom.js';
import markup from './importing.html';
import { addElements } from './late.js';
import { setLayer } from './layers.js';
import { mayBeSystem } from './pasting.js';
import { emptyThumb, paintThumb } from './thumb.js';
import { createTool } from './tool.js';
import { counted, said, say } from './words.js';

/** @typedef {import('./protocol.js').Imported} Imported */
/** @typedef {Imported['entries'][number]} Entry */

/** The side of a picture, in CSS pixels. */
const SIDE = 168;
/** The most remarks shown for one system. */
const MOST_REMARKS = 40;

const UNKNOWN = say`No L-system was found in the pasted text. It needs an axiom and a rule, such as: axiom F, F -> F+F, angle 60.`;
/** The name of our own notation, whose files open without this dialog. */
const OURS = 'our own JSON';

/** @param {Entry} entry */
const nameOf = ({ name }) => name || say`Untitled system`;

/** @param {import('./dialogs.js').Page} page */
export function createImporting({ store, engine, restyle }) {
    addElements(markup, [gallery, styles]);
    /** @type {ReturnType<typeof createTool<import('./protocol.js').ImportCalls>>} */
    const tool = createTool('import');
    const dialog = byId('import', HTMLDialogElement);
    const note = html('import-offer');
    html('stage').append(note);
    const search = input('import-search');
    /** @type {{entry: Entry, card: HTMLButtonElement, item: HTMLElement, picture: HTMLCanvasElement, painted: boolean}[]} */
    let cards = [];
    /** @type {Entry | null} */
    let chosen = null;
    /** The text that is shown, and what became of its parts. */
    let text = '';
    /** @type {Imported['account']} */
    let account = [];
    /** @type {Entry[]} */
    let entries = [];
    /** What is offered after text was pasted into a field. @type {{found: Imported, text: string} | null} */
    let offered = null;

    const seen = new IntersectionObserver(
        (entries) => entries.forEach(({ isIntersecting, target }) => isIntersecting && paint(target)),
        { root: html('import-shelf'), rootMargin: '120px' },
    );

    /** @param {Element} target */
    async function paint(target) {
        const card = cards.find(({ picture }) => picture === target);
        if (!card || card.painted || !card.entry.definition) return;
        card.painted = true;
        try {
            const missing = await paintThumb(
                card.picture,
                engine,
                restyle(card.entry.definition),
                SIDE,
                () => dialog.open,
            );
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
        const { source, parts } = showAccount(text, account, entries.indexOf(entry));
        html('import-source').replaceChildren(...source);
        // What the text leaves open has no part of it.
        const open = entry.remarks.filter((remark) => remark.text === '').slice(0, MOST_REMARKS);
        html('import-parts').replaceChildren(
            ...open.map(({ message }) => make('li', { class: 'noted' }, ...withCode(message))),
            ...parts,
        );
        setText(
            html('import-note'),
            entry.definition === null
                ? say`This system cannot be opened:`
                : entry.remarks.length > 0
                  ? say`Carried over with remarks:`
                  : say`Everything was carried over.`,
        );
        button('import-open').disabled = entry.definition === null;
    }

    /** @param {Imported} found @param {string} pasted */
    function show(found, pasted) {
        const notation = said(found.notation);
        ({ account, entries } = found);
        text = pasted;
        hideOffer();
        seen.disconnect();
        const readable = entries.filter(({ definition }) => definition !== null);
        setText(
            html('h-import'),
            entries.length === 1
                ? say`Open from ${notation}`
                : counted(entries.length, '{} system from {}', '{} systems from {}', notation),
        );
        cards = entries.map((entry) => {
            const picture = emptyThumb();
            if (entry.definition) picture.style.background = restyle(entry.definition).background;
            const kind =
                entry.definition === null
                    ? say`cannot be opened`
                    : entry.remarks.length > 0
                      ? counted(entry.remarks.length, '{} remark', '{} remarks')
                      : '';
            const card = make(
                'button',
                { type: 'button', class: 'card', 'aria-pressed': 'false' },
                make('span', { class: 'card-picture' }, picture),
                make('span', { class: 'card-title' }, nameOf(entry)),
                make('span', { class: 'card-kind' }, kind),
            );
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
        take(chosen, chosen.definition);
    }

    /** @param {Entry} entry @param {import('./state.js').Definition} definition */
    function take(entry, definition) {
        store.open(restyle({ ...definition, title: definition.title || entry.name }));
        toast(say`Opened ${nameOf(entry)}. Undo to go back.`);
    }

    function hideOffer() {
        note.hidden = true;
        offered = null;
        document.documentElement.toggleAttribute('data-pasted', false);
        setLayer(hideOffer, false);
    }

    /** @param {string} text @returns {Promise<Imported | null | undefined>} null if there is no system, undefined if the readers did not load */
    async function read(text) {
        if (!mayBeSystem(text)) return null;
        try {
            return await tool.call('import', { text });
        } catch {
            toast(say`The readers of other notations did not load. Try again.`);
            return undefined;
        }
    }

    search.addEventListener('input', () => {
        const words = search.value.toLowerCase();
        for (const { entry, item } of cards) item.hidden = !entry.name.toLowerCase().includes(words);
    });
    button('import-open').addEventListener('click', accept);
    closes(dialog, 'close-import');
    button('import-cancel').addEventListener('click', () => dialog.close());
    button('import-accept').addEventListener('click', () => offered && show(offered.found, offered.text));
    button('import-dismiss').addEventListener('click', hideOffer);
    // What is edited afterwards is the reader's own text.
    store.subscribe((state, before) => {
        if (offered && (state.axiom !== before.axiom || state.rules !== before.rules)) hideOffer();
    });

    return {
        open: show,

        /** Offers the systems of a text in another notation than ours; returns whether there are any. @param {string} text */
        async offer(text) {
            const found = await read(text);
            if (!found || found.notation === OURS) return false;
            show(found, text);
            return true;
        },

        /** Opens our own text that was pasted outside of fields, and offers other ones. @param {string} text */
        async paste(text) {
            const found = await read(text);
            if (found === undefined) return;
            const [first] = found?.entries ?? [];
            if (!found || !first) toast(UNKNOWN);
            else if (found.notation === OURS && first.definition) take(first, first.definition);
            else show(found, text);
        },

        /**
         * Offers the systems of a text that was pasted into a field, where it stays if the reader wants it there. Returns
         * whether there are any.
         * @param {string} text
         */
        async offerPasted(text) {
            const found = await read(text);
            if (!found) return false;
            offered = { found, text };
            const [notation, many] = [said(found.notation), found.entries.length];
            setText(
                html('import-what'),
                many > 1
                    ? say`This looks like ${notation} (${counted(many, '{} system', '{} systems')}).`
                    : say`This looks like ${notation}.`,
            );
            note.hidden = false;
            setLayer(hideOffer, true);
            return true;
        },
    };
}
