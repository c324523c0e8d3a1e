/** The dialog that compares nine seeds. */

import styles from '../css/gallery.css';
import { button, byId, closes, html, make } from './dom.js';
import { SEEDS, Stopped } from './engine/questions.js';
import { addElements } from './late.js';
import markup from './seeds.html';
import { definitionOf } from './state.js';
import { emptyThumb, paintThumb } from './thumb.js';

/** The number of pictures. */
const COUNT = 9;
/** The side of a picture, in CSS pixels. */
const SIDE = 200;

/** @param {import('./dialogs.js').Page} page */
export function createSeeds({ store, engine }) {
    addElements(markup, [styles]);
    const dialog = byId('seeds', HTMLDialogElement);
    const cards = Array.from({ length: COUNT }, () => {
        const picture = emptyThumb();
        const label = make('span', { class: 'card-kind' });
        const card = make('button', { type: 'button', class: 'card', 'aria-label': 'Another seed' }, picture, label);
        card.addEventListener('click', () => {
            const seed = Number(card.value);
            dialog.close();
            if (seed !== store.state.seed) store.change({ seed }, '');
        });
        html('seed-cards').append(card);
        return { picture, label, card };
    });
    /** The number of the current set of seeds; pictures of older sets are dropped. */
    let set = 0;

    /** @param {number[]} seeds */
    async function show(seeds) {
        const own = ++set;
        const wanted = () => own === set && dialog.open;
        const definition = definitionOf(store.state);
        cards.forEach(({ picture, label, card }, index) => {
            const seed = /** @type {number} */ (seeds[index]);
            const present = seed === definition.seed;
            card.value = String(seed);
            card.setAttribute('aria-label', present ? `Seed ${seed}, current` : `Seed ${seed}`);
            card.classList.toggle('present', present);
            label.textContent = present ? `${seed} (current)` : String(seed);
            picture.style.background = definition.background;
            picture.classList.remove('inked');
        });
        for (const [index, { picture }] of cards.entries()) {
            const seed = /** @type {number} */ (seeds[index]);
            try {
                await paintThumb(picture, engine, { ...definition, seed }, SIDE, wanted);
                if (!wanted()) return;
            } catch (error) {
                // A seed that stopped the worker has no picture; the stage reports all other failures.
                if (!(error instanceof Stopped)) return;
            }
        }
    }

    /** Shows the current seed among eight others. */
    async function fill() {
        try {
            const fresh = await engine.seed();
            // Consecutive seeds from a random start, which all differ, without the current one.
            const others = Array.from({ length: COUNT }, (_, index) => (fresh + index) % SEEDS).filter(
                (seed) => seed !== store.state.seed,
            );
            await show([...others.slice(0, 4), store.state.seed, ...others.slice(4, 8)]);
        } catch {
            // The stage reports the failure.
        }
    }

    button('more-seeds').addEventListener('click', fill);
    closes(dialog, 'close-seeds');
    html('seed-cards').addEventListener('keydown', (event) => {
        const at = cards.findIndex(({ card }) => card === document.activeElement);
        const by = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -3, ArrowDown: 3 }[event.key];
        if (at < 0 || by === undefined) return;
        event.preventDefault();
        cards[at + by]?.card.focus();
    });

    return {
        open() {
            dialog.showModal();
            cards[4]?.card.focus();
            void fill();
        },
    };
}
