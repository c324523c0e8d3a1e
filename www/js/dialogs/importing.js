/**
 * Systems in the notations of other programs and of papers: pasted, dropped or opened text is recognised and offered.
 * A dialog shows each system as a small picture, and what could not be carried over.
 */

import gallery from '../../css/gallery.css';
import styles from '../../css/importing.css';
import { showAccount } from './account.js';
import { toast } from '../base/announce.js';
import { button, byId, closes, html, input, make, setText, withCode, watchSight } from '../base/dom.js';
import markup from './importing.html';
import { addElements } from '../base/late.js';
import { setLayer } from '../base/layers.js';
import { mayBeSystem } from './pasting.js';
import { emptyThumb, paintThumb } from './thumb.js';
import { createTool } from '../engine/tool.js';
import { counted, said, say } from '../base/words.js';

/** @typedef {import('../protocol.js').Imported} Imported */
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

/**
 * The dialog and what was read.
 * @typedef {object} Importing
 * @property {() => void} close hides the note: the same function each time, as layers want it
 * @property {import('./dialogs.js').Page['store']} store
 * @property {import('./dialogs.js').Page['engine']} engine
 * @property {import('./dialogs.js').Page['restyle']} restyle
 * @property {ReturnType<typeof createTool<import('../protocol.js').ImportCalls>>} tool
 * @property {HTMLDialogElement} dialog
 * @property {HTMLElement} note
 * @property {HTMLInputElement} search
 * @property {{entry: Entry, card: HTMLButtonElement, item: HTMLElement, picture: HTMLCanvasElement, painted: boolean}[]} cards
 * @property {Entry | null} chosen
 * @property {string} text The text that is shown, and what became of its parts
 * @property {Imported['account']} account
 * @property {Entry[]} entries
 * @property {{found: Imported, text: string} | null} offered What is offered after text was pasted into a field
 * @property {IntersectionObserver} seen
 */

/** @param {import('./dialogs.js').Page} page */
export function createImporting({ store, engine, restyle }) {
    addElements(markup, [gallery, styles]);

    const note = html('import-offer');
    html('stage').append(note);
    const search = input('import-search');

    const seen = watchSight(html('import-shelf'), (target) => paint(self, target));
    /** @type {Importing} */
    const self = {
        close: () => hideOffer(self),
        store,
        engine,
        restyle,
        tool: createTool('import'),
        dialog: byId('import', HTMLDialogElement),
        note,
        search,
        cards: [],
        chosen: null,
        text: '',
        account: [],
        entries: [],
        offered: null,
        seen,
    };

    search.addEventListener('input', () => {
        const words = search.value.toLowerCase();
        for (const { entry, item } of self.cards) item.hidden = !entry.name.toLowerCase().includes(words);
    });
    button('import-open').addEventListener('click', () => accept(self));
    closes(self.dialog, 'close-import');
    button('import-cancel').addEventListener('click', () => self.dialog.close());
    button('import-accept').addEventListener(
        'click',
        () => self.offered && show(self, self.offered.found, self.offered.text),
    );
    button('import-dismiss').addEventListener('click', () => hideOffer(self));
    // What is edited afterwards is the reader's own text.
    store.subscribe((state, before) => {
        if (self.offered && (state.axiom !== before.axiom || state.rules !== before.rules)) hideOffer(self);
    });

    return {
        open: (/** @type {Imported} */ found, /** @type {string} */ pasted) => show(self, found, pasted),

        /** Offers the systems of a text in another notation than ours; returns whether there are any. @param {string} text */
        async offer(text) {
            const found = await read(self, text);
            if (!found || found.notation === OURS) return false;
            show(self, found, text);
            return true;
        },

        /** Opens our own text that was pasted outside of fields, and offers other ones. @param {string} text */
        async paste(text) {
            const found = await read(self, text);
            if (found === undefined) return;
            const [first] = found?.entries ?? [];
            if (!found || !first) toast(UNKNOWN);
            else if (found.notation === OURS && first.definition) take(self, first, first.definition);
            else show(self, found, text);
        },

        /**
         * Offers the systems of a text that was pasted into a field, where it stays if the reader wants it there. Returns
         * whether there are any.
         * @param {string} text
         */
        offerPasted: (text) => offerPasted(self, text),
    };
}

/** @param {Importing} self @param {Element} target */
async function paint(self, target) {
    const card = self.cards.find(({ picture }) => picture === target);
    if (!card || card.painted || !card.entry.definition) return;
    card.painted = true;
    try {
        const missing = await paintThumb(
            card.picture,
            self.engine,
            self.restyle(card.entry.definition),
            SIDE,
            () => self.dialog.open,
        );
        if (missing) card.picture.replaceWith(make('span', { class: 'card-missing' }, missing));
    } catch {
        // The worker was replaced; the card stays without a picture.
    }
}

/** @param {Importing} self @param {Entry} entry */
function choose(self, entry) {
    self.chosen = entry;
    for (const { entry: own, card } of self.cards) card.setAttribute('aria-pressed', String(own === entry));
    setText(html('import-name'), nameOf(entry));
    const { source, parts } = showAccount(self.text, self.account, self.entries.indexOf(entry));
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

/** @param {Importing} self @param {Imported} found @param {string} pasted */
function show(self, found, pasted) {
    const notation = said(found.notation);
    ({ account: self.account, entries: self.entries } = found);
    self.text = pasted;
    hideOffer(self);
    self.seen.disconnect();
    const readable = self.entries.filter(({ definition }) => definition !== null);
    setText(
        html('h-import'),
        self.entries.length === 1
            ? say`Open from ${notation}`
            : counted(self.entries.length, '{} system from {}', '{} systems from {}', notation),
    );
    self.cards = self.entries.map((entry) => {
        const picture = emptyThumb();
        if (entry.definition) picture.style.background = self.restyle(entry.definition).background;
        const kind =
            entry.definition === null
                ? say`cannot be opened`
                : entry.remarks.length > 0
                  ? counted(entry.remarks.length, '{} remark', '{} remarks')
                  : '';
        const card = make(
            'button',
            { class: 'card', 'aria-pressed': 'false' },
            make('span', { class: 'card-picture' }, picture),
            make('span', { class: 'card-title' }, nameOf(entry)),
            make('span', { class: 'card-kind' }, kind),
        );
        card.addEventListener('click', () => choose(self, entry));
        card.addEventListener('dblclick', () => accept(self));
        return { entry, card, item: make('li', {}, card), picture, painted: false };
    });
    // Systems that cannot be opened stand last.
    self.cards.sort((a, b) => Number(a.entry.definition === null) - Number(b.entry.definition === null));
    html('import-cards').replaceChildren(...self.cards.map(({ item }) => item));
    self.search.value = '';
    html('import-search-row').hidden = self.entries.length < 9;
    self.dialog.classList.toggle('fitted', self.entries.length < 10);
    const first = readable[0] ?? self.entries[0];
    if (first) choose(self, first);
    self.dialog.showModal();
    for (const { picture } of self.cards) self.seen.observe(picture);
    button('import-open').focus();
}

/** @param {Importing} self */
function accept(self) {
    if (!self.chosen?.definition) return;
    self.dialog.close();
    take(self, self.chosen, self.chosen.definition);
}

/** @param {Importing} self @param {Entry} entry @param {import('../state/state.js').Definition} definition */
function take(self, entry, definition) {
    self.store.open(self.restyle({ ...definition, title: definition.title || entry.name }));
    toast(say`Opened ${nameOf(entry)}. Undo to go back.`);
}

/** @param {Importing} self */
function hideOffer(self) {
    self.note.hidden = true;
    self.offered = null;
    document.documentElement.toggleAttribute('data-pasted', false);
    setLayer(self.close, false);
}

/**
 * @param {Importing} self
 * @param {string} text
 * @returns {Promise<Imported | null | undefined>} null if there is no system, undefined if the readers did not load
 */
async function read(self, text) {
    if (!mayBeSystem(text)) return null;
    try {
        return await self.tool.call('import', { text });
    } catch {
        toast(say`The readers of other notations did not load. Try again.`);
        return undefined;
    }
}

/** @param {Importing} self @param {string} text */
async function offerPasted(self, text) {
    const found = await read(self, text);
    if (!found) return false;
    self.offered = { found, text };
    const [notation, many] = [said(found.notation), found.entries.length];
    setText(
        html('import-what'),
        many > 1
            ? say`This looks like ${notation} (${counted(many, '{} system', '{} systems')}).`
            : say`This looks like ${notation}.`,
    );
    self.note.hidden = false;
    setLayer(self.close, true);
    return true;
}
