/** The dialog that shows nine relatives of the system: children, to go on with or to cross, or other seeds. */

import styles from '../css/gallery.css';
import { toast } from './announce.js';
import { button, byId, closes, html, make, setText } from './dom.js';
import { download, fileName } from './download.js';
import { SEEDS, Stopped } from './engine/questions.js';
import { addElements } from './late.js';
import markup from './breed.html';
import { clean, definitionOf, sameSystem } from './state.js';
import { emptyThumb, paintThumb } from './thumb.js';
import { createTool } from './tool.js';
import { say } from './words.js';

/** @typedef {import('./state.js').Definition} Definition */

/** The number of pictures. */
const COUNT = 9;
/** The sides of a picture, of a picture in the line of descent, and of the film in CSS pixels. */
const SIDE = 200;
const SMALL = 56;
const FILM = 480;
/** The most systems of the line of descent; the oldest are forgotten. */
const LONGEST = 40;

/** @param {import('./dialogs.js').Page} page */
export function createBreed({ store, engine }) {
    addElements(markup, [styles]);
    const dialog = byId('breed', HTMLDialogElement);
    /** @type {ReturnType<typeof createTool<import('./protocol.js').InventCalls>>} */
    const tool = createTool('invent');
    /** The systems on the cards. @type {Definition[]} */
    let shown = [];
    /** Systems that are kept to be crossed: at most two. @type {Definition[]} */
    let kept = [];
    /** The line of descent, oldest first; the last is the present system. @type {Definition[]} */
    let line = [];
    let isSeeds = false;
    /** The number of the current set of cards; pictures of older sets are dropped. */
    let set = 0;

    const cards = Array.from({ length: COUNT }, (_, index) => {
        const picture = emptyThumb();
        const label = make('span', { class: 'card-kind' });
        const card = make('button', { type: 'button', class: 'card' }, picture, label);
        const box = make('input', { type: 'checkbox', 'aria-label': say`Keep child ${index + 1} to cross it` });
        const keep = make('label', { class: 'keep', title: say`Keep two to cross them` }, box, say`keep`);
        const slot = make('div', { class: 'breed-slot' }, card, keep);
        card.addEventListener('click', () => choose(index));
        box.addEventListener('change', () => keepCard(index, box.checked));
        html('breed-cards').append(slot);
        return { picture, label, card, box, keep, slot };
    });

    /** @param {number} index */
    function choose(index) {
        const chosen = shown[index];
        if (!chosen) return;
        if (isSeeds) {
            dialog.close();
            if (chosen.seed !== store.state.seed) store.change({ seed: chosen.seed }, '');
            return;
        }
        kept = [];
        goOn(chosen);
    }

    /** Opens a system, and shows its children. @param {Definition} definition */
    function goOn(definition) {
        store.open(definition);
        line = [...line, definitionOf(store.state)].slice(-LONGEST);
        void fill();
    }

    /** @param {number} index @param {boolean} keeps */
    function keepCard(index, keeps) {
        const own = /** @type {Definition} */ (shown[index]);
        kept = keeps ? [...kept, own] : kept.filter((each) => each !== own);
        if (kept.length === 2) void fill();
        else showNote();
    }

    function showNote() {
        setText(
            html('breed-note'),
            isSeeds
                ? say`Click one to take its seed.`
                : kept.length === 1
                  ? say`Keep another one to cross both.`
                  : say`Click one to go on with it, or keep two to cross them.`,
        );
    }

    /** The systems for the cards. @returns {Promise<Definition[]>} */
    async function relatives() {
        const definition = definitionOf(store.state);
        const seed = await engine.seed();
        if (isSeeds) {
            // Consecutive seeds from a random start, which all differ, around the current one.
            const others = Array.from({ length: COUNT }, (_, index) => (seed + index) % SEEDS).filter(
                (other) => other !== definition.seed,
            );
            const seeds = [...others.slice(0, 4), definition.seed, ...others.slice(4, 8)];
            return seeds.map((own) => ({ ...definition, seed: own }));
        }
        const parents = kept.length === 2 ? kept : [definition];
        const children = await tool.call('breed', { parents, seed, count: COUNT });
        return children.map((child) => definitionOf(clean(child)));
    }

    /** Fills the cards. */
    async function fill() {
        const own = ++set;
        const wanted = () => own === set && dialog.open;
        try {
            const found = await relatives();
            if (!wanted()) return;
            // Both parents have done their part.
            if (kept.length === 2) kept = [];
            shown = found;
            show();
            for (const [index, { picture }] of cards.entries()) {
                const definition = shown[index];
                if (!definition) continue;
                try {
                    await paintThumb(picture, engine, definition, SIDE, wanted);
                    if (!wanted()) return;
                } catch (error) {
                    // A system that stopped the worker has no picture; the stage reports all other failures.
                    if (!(error instanceof Stopped)) return;
                }
            }
        } catch (error) {
            if (wanted())
                setText(
                    html('breed-note'),
                    say`No relatives: ${String(error instanceof Error ? error.message : error)}`,
                );
        }
    }

    /** Shows what the cards stand for, and the line of descent. */
    function show() {
        for (const [index, { picture, label, card, box, keep, slot }] of cards.entries()) {
            const definition = shown[index];
            slot.hidden = !definition;
            if (!definition) continue;
            const present = isSeeds && definition.seed === store.state.seed;
            const own = String(definition.seed);
            const seed = present ? say`Seed ${own}, current` : say`Seed ${own}`;
            card.value = String(isSeeds ? definition.seed : index);
            card.setAttribute('aria-label', isSeeds ? seed : say`Go on with child ${index + 1}`);
            card.title = isSeeds ? '' : definition.rules;
            card.classList.toggle('present', present);
            setText(label, !isSeeds ? '' : present ? say`${own} (current)` : own);
            keep.hidden = isSeeds;
            box.checked = kept.includes(definition);
            picture.style.background = definition.background;
            picture.classList.remove('inked');
        }
        showNote();
        showLine();
        button('show-children').setAttribute('aria-pressed', String(!isSeeds));
        button('show-seeds').setAttribute('aria-pressed', String(isSeeds));
    }

    function showLine() {
        const strip = html('descent');
        strip.hidden = isSeeds || line.length < 2;
        button('save-descent').hidden = strip.hidden;
        if (strip.hidden) return strip.replaceChildren();
        const former = strip.childElementCount;
        // Ancestors keep their pictures.
        while (strip.childElementCount > line.length) strip.lastElementChild?.remove();
        for (const [index, definition] of line.entries()) {
            if (index < former && index < line.length - 1) continue;
            const picture = emptyThumb();
            picture.style.background = definition.background;
            const step = make(
                'button',
                { type: 'button', class: 'card', 'aria-label': say`Go back to ancestor ${index + 1}` },
                picture,
            );
            step.addEventListener('click', () => {
                const chosen = line[index];
                if (!chosen) return;
                kept = [];
                line = line.slice(0, index);
                goOn(chosen);
            });
            const old = strip.children[index];
            if (old) old.replaceWith(step);
            else strip.append(step);
            void paintThumb(picture, engine, definition, SMALL).catch(() => {});
        }
        strip.scrollLeft = strip.scrollWidth;
    }

    async function save() {
        const save = button('save-descent');
        save.disabled = true;
        try {
            const file = await tool.call('descent', { definitions: line, side: FILM });
            download(new Blob([file], { type: 'image/gif' }), `${fileName(store.state)}_descent.gif`);
        } catch (error) {
            toast(say`No film: ${String(error instanceof Error ? error.message : error)}`);
        } finally {
            save.disabled = false;
        }
    }

    /** @param {boolean} seeds */
    function turnTo(seeds) {
        isSeeds = seeds;
        kept = [];
        void fill();
    }

    button('more-cards').addEventListener('click', () => void fill());
    button('show-children').addEventListener('click', () => turnTo(false));
    button('show-seeds').addEventListener('click', () => turnTo(true));
    button('save-descent').addEventListener('click', save);
    closes(dialog, 'close-breed');
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
            isSeeds = seeds;
            kept = [];
            // A system that came otherwise begins a line of its own.
            const last = line.at(-1);
            if (!last || !sameSystem(clean(last), store.state)) line = [definitionOf(store.state)];
            shown = [];
            dialog.showModal();
            cards[isSeeds ? 4 : 0]?.card.focus();
            void fill();
        },
    };
}

/** Opens the same dialog with other seeds. @param {import('./dialogs.js').Page} page */
export const createSeeds = ({ open }) => ({ open: () => open('breed', true) });
