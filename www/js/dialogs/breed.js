/** The dialog that shows nine relatives of the system: children, to go on with or to cross, or other seeds. */

import styles from '../../css/gallery.css';
import { toast } from '../base/announce.js';
import { button, byId, closes, html, make, setText } from '../base/dom.js';
import { download, fileName } from '../base/download.js';
import { SEEDS, Stopped } from '../engine/questions.js';
import { addElements } from '../base/late.js';
import markup from './breed.html';
import { clean, definitionOf, sameSystem } from '../state/state.js';
import { emptyThumb, paintThumb } from './thumb.js';
import { createTool } from '../engine/tool.js';
import { reasonOf, say } from '../base/words.js';

/** @typedef {import('../state/state.js').Definition} Definition */

/** The number of pictures. */
const COUNT = 9;
/** The sides of a picture, of a picture in the line of descent, and of the film in CSS pixels. */
const SIDE = 200;
const SMALL = 56;
const FILM = 480;
/** The most systems of the line of descent; the oldest are forgotten. */
const LONGEST = 40;

/**
 * The dialog and what it shows.
 * @typedef {object} Breeding
 * @property {import('./dialogs.js').Page['store']} store
 * @property {import('./dialogs.js').Page['engine']} engine
 * @property {HTMLDialogElement} dialog
 * @property {ReturnType<typeof createTool<import('../protocol.js').InventCalls>>} tool
 * @property {Definition[]} shown The systems on the cards
 * @property {Definition[]} kept Systems that are kept to be crossed: at most two
 * @property {Definition[]} line The line of descent, oldest first; the last is the present system
 * @property {boolean} isSeeds
 * @property {number} set The number of the current set of cards; pictures of older sets are dropped
 * @property {{card: HTMLButtonElement, label: HTMLElement, picture: HTMLCanvasElement, keep: HTMLElement, box: HTMLInputElement, slot: HTMLElement}[]} cards
 */

/** @param {import('./dialogs.js').Page} page */
export function createBreed({ store, engine }) {
    addElements(markup, [styles]);

    const cards = Array.from({ length: COUNT }, (_, index) => {
        const picture = emptyThumb();
        const label = make('span', { class: 'card-kind' });
        const card = make('button', { class: 'card' }, picture, label);
        const box = make('input', { type: 'checkbox', 'aria-label': say`Keep child ${index + 1} to cross it` });
        const keep = make('label', { class: 'keep', title: say`Keep two to cross them` }, box, say`keep`);
        const slot = make('div', { class: 'breed-slot' }, card, keep);
        card.addEventListener('click', () => choose(self, index));
        box.addEventListener('change', () => keepCard(self, index, box.checked));
        html('breed-cards').append(slot);
        return { picture, label, card, box, keep, slot };
    });
    /** @type {Breeding} */
    const self = {
        store,
        engine,
        dialog: byId('breed', HTMLDialogElement),
        tool: createTool('invent'),
        shown: [],
        kept: [],
        line: [],
        isSeeds: false,
        set: 0,
        cards,
    };

    button('more-cards').addEventListener('click', () => void fill(self));
    button('show-children').addEventListener('click', () => turnTo(self, false));
    button('show-seeds').addEventListener('click', () => turnTo(self, true));
    button('save-descent').addEventListener('click', () => save(self));
    closes(self.dialog, 'close-breed');
    html('breed-cards').addEventListener('keydown', (event) => {
        const at = cards.findIndex(({ card }) => card === document.activeElement);
        const by = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -3, ArrowDown: 3 }[event.key];
        if (at < 0 || by === undefined) return;
        event.preventDefault();
        cards[at + by]?.card.focus();
    });

    return {
        /** @param {boolean} [seeds] whether to compare seeds */
        open(seeds = false) {
            // Only where chance plays a part.
            html('breed-kinds').hidden = html('seed-row').hidden;
            self.isSeeds = seeds;
            self.kept = [];
            // A system that came otherwise begins a line of its own.
            const last = self.line.at(-1);
            if (!last || !sameSystem(clean(last), store.state)) self.line = [definitionOf(store.state)];
            self.shown = [];
            self.dialog.showModal();
            cards[self.isSeeds ? 4 : 0]?.card.focus();
            void fill(self);
        },
    };
}

/** @param {Breeding} self @param {number} index */
function choose(self, index) {
    const chosen = self.shown[index];
    if (!chosen) return;
    if (self.isSeeds) {
        self.dialog.close();
        if (chosen.seed !== self.store.state.seed) self.store.change({ seed: chosen.seed }, '');
        return;
    }
    self.kept = [];
    goOn(self, chosen);
}

/** Opens a system, and shows its children. @param {Breeding} self @param {Definition} definition */
function goOn(self, definition) {
    self.store.open(definition);
    self.line = [...self.line, definitionOf(self.store.state)].slice(-LONGEST);
    void fill(self);
}

/** @param {Breeding} self @param {number} index @param {boolean} keeps */
function keepCard(self, index, keeps) {
    const own = /** @type {Definition} */ (self.shown[index]);
    self.kept = keeps ? [...self.kept, own] : self.kept.filter((each) => each !== own);
    if (self.kept.length === 2) void fill(self);
    else showNote(self);
}

/** @param {Breeding} self */
function showNote(self) {
    setText(
        html('breed-note'),
        self.isSeeds
            ? say`Click one to take its seed.`
            : self.kept.length === 1
              ? say`Keep another one to cross both.`
              : say`Click one to go on with it, or keep two to cross them.`,
    );
}

/** The systems for the cards. @param {Breeding} self @returns {Promise<Definition[]>} */
async function relatives(self) {
    const definition = definitionOf(self.store.state);
    const seed = await self.engine.seed();
    if (self.isSeeds) {
        // Consecutive seeds from a random start, which all differ, around the current one.
        const others = Array.from({ length: COUNT }, (_, index) => (seed + index) % SEEDS).filter(
            (other) => other !== definition.seed,
        );
        const seeds = [...others.slice(0, 4), definition.seed, ...others.slice(4, 8)];
        return seeds.map((own) => ({ ...definition, seed: own }));
    }
    const parents = self.kept.length === 2 ? self.kept : [definition];
    const children = await self.tool.call('breed', { parents, seed, count: COUNT });
    return children.map((child) => definitionOf(clean(child)));
}

/** Fills the cards. @param {Breeding} self */
async function fill(self) {
    const own = ++self.set;
    const wanted = () => own === self.set && self.dialog.open;
    try {
        const found = await relatives(self);
        if (!wanted()) return;
        // Both parents have done their part.
        if (self.kept.length === 2) self.kept = [];
        self.shown = found;
        show(self);
        for (const [index, { picture }] of self.cards.entries()) {
            const definition = self.shown[index];
            if (!definition) continue;
            try {
                await paintThumb(picture, self.engine, definition, SIDE, wanted);
                if (!wanted()) return;
            } catch (error) {
                // A system that stopped the worker has no picture; the stage reports all other failures.
                if (!(error instanceof Stopped)) return;
            }
        }
    } catch (error) {
        if (wanted()) setText(html('breed-note'), say`No relatives: ${reasonOf(error)}`);
    }
}

/** Shows what the cards stand for, and the line of descent. @param {Breeding} self */
function show(self) {
    setText(html('h-breed'), self.isSeeds ? say`Seeds` : say`Breed`);
    for (const [index, { picture, label, card, box, keep, slot }] of self.cards.entries()) {
        const definition = self.shown[index];
        slot.hidden = !definition;
        if (!definition) continue;
        const present = self.isSeeds && definition.seed === self.store.state.seed;
        const own = String(definition.seed);
        const seed = present ? say`Seed ${own}, current` : say`Seed ${own}`;
        card.value = String(self.isSeeds ? definition.seed : index);
        card.setAttribute('aria-label', self.isSeeds ? seed : say`Go on with child ${index + 1}`);
        card.title = self.isSeeds ? '' : definition.rules;
        card.classList.toggle('present', present);
        setText(label, !self.isSeeds ? '' : present ? say`${own} (current)` : own);
        keep.hidden = self.isSeeds;
        box.checked = self.kept.includes(definition);
        picture.style.background = definition.background;
        picture.classList.remove('inked');
    }
    showNote(self);
    showLine(self);
    button('show-children').setAttribute('aria-pressed', String(!self.isSeeds));
    button('show-seeds').setAttribute('aria-pressed', String(self.isSeeds));
}

/** @param {Breeding} self */
function showLine(self) {
    const strip = html('descent');
    strip.hidden = self.isSeeds || self.line.length < 2;
    button('save-descent').hidden = strip.hidden;
    if (strip.hidden) return strip.replaceChildren();
    const former = strip.childElementCount;
    // Ancestors keep their pictures.
    while (strip.childElementCount > self.line.length) strip.lastElementChild?.remove();
    for (const [index, definition] of self.line.entries()) {
        if (index < former && index < self.line.length - 1) continue;
        const picture = emptyThumb();
        picture.style.background = definition.background;
        const step = make('button', { class: 'card', 'aria-label': say`Go back to ancestor ${index + 1}` }, picture);
        step.addEventListener('click', () => {
            const chosen = self.line[index];
            if (!chosen) return;
            self.kept = [];
            self.line = self.line.slice(0, index);
            goOn(self, chosen);
        });
        const old = strip.children[index];
        if (old) old.replaceWith(step);
        else strip.append(step);
        void paintThumb(picture, self.engine, definition, SMALL).catch(() => {});
    }
    strip.scrollLeft = strip.scrollWidth;
}

/** @param {Breeding} self */
async function save(self) {
    const save = button('save-descent');
    save.disabled = true;
    try {
        const file = await self.tool.call('descent', { definitions: self.line, side: FILM });
        download(new Blob([file], { type: 'image/gif' }), `${fileName(self.store.state)}_descent.gif`);
    } catch (error) {
        toast(say`No film: ${reasonOf(error)}`);
    } finally {
        save.disabled = false;
    }
}

/** @param {Breeding} self @param {boolean} seeds */
function turnTo(self, seeds) {
    self.isSeeds = seeds;
    self.kept = [];
    void fill(self);
}

/** Opens the same dialog with other seeds. @param {import('./dialogs.js').Page} page */
export const createSeeds = ({ open }) => ({ open: () => open('breed', true) });
