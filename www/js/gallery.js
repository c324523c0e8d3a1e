/** Every system of the collection, with a small picture of each, to search and pick. */

import { button, byId, html, input, make, setText } from './dom.js';
import { jsonOf } from './files.js';
import { clean, definitionOf } from './state.js';

/** @typedef {import('./state.js').Definition} Definition */
/** @typedef {{path: string, folder: string, definition: Definition}} Entry */
/** @typedef {{entry: Entry, card: HTMLButtonElement, picture: HTMLCanvasElement, words: string, painted: string}} Card */

/** The side of a small picture, in CSS pixels. */
const SIDE = 168;

/** Shelves that come first, with their names; the others follow under the names of their folders. */
const SHELVES = new Map([
    ['garden', 'Garden'],
    ['abop', 'The Algorithmic Beauty of Plants'],
    ['curves', 'Famous curves'],
]);

/**
 * @param {import('./engine.js').Engine} engine
 * @param {{pick: (definition: Definition) => void, dress: (definition: Definition) => Definition, look: () => string}} page
 *   `dress` gives a system that says nothing of its look the page's; `look` names that look
 */
export function createGallery(engine, { pick, dress, look }) {
    const dialog = byId('gallery', HTMLDialogElement);
    const shelves = html('shelves');
    const search = input('search');
    const nothing = html('nothing-found');
    /** @type {Map<Element, Card>} */
    const cards = new Map();
    /** @type {Promise<void> | null} */
    let filled = null;

    const seen = new IntersectionObserver(
        (entries) => {
            for (const { isIntersecting, target } of entries) {
                const card = cards.get(target);
                if (isIntersecting && card) paint(card);
            }
        },
        { root: shelves, rootMargin: '120px' },
    );

    async function fill() {
        const entries = /** @type {Entry[]} */ (await jsonOf('gallery.json'));
        for (const [folder, inside] of groups(entries)) {
            const shelf = make('div', { class: 'cards' });
            for (const entry of inside) shelf.append(newCard(entry).card);
            shelves.append(make('section', { class: 'shelf' }, make('h3', {}, folderTitle(folder)), shelf));
        }
    }

    /** @param {Entry} entry @returns {Card} */
    function newCard(entry) {
        const definition = definitionOf(clean(entry.definition));
        const picture = make('canvas', { class: 'thumb', width: '1', height: '1', 'aria-hidden': 'true' });
        const title = definition.title || definition.name;
        const card = make('button', { type: 'button', class: 'card' }, picture, make('span', { class: 'card-title' }, title), make('span', { class: 'card-kind' }, kindOf(definition)));
        const made = { entry: { ...entry, definition }, card, picture, painted: '', words: [title, definition.name, definition.source, definition.notes, entry.folder, kindOf(definition)].join(' ').toLowerCase() };
        card.title = [title, definition.source].filter(Boolean).join('\n');
        card.addEventListener('click', () => {
            dialog.close();
            pick(dress(definition));
        });
        cards.set(card, made);
        seen.observe(card);
        return made;
    }

    /** @param {Card} card */
    async function paint(card) {
        const wanted = look();
        if (card.painted === wanted) return;
        card.painted = wanted;
        const side = Math.round(SIDE * Math.min(2, devicePixelRatio || 1));
        const definition = dress(card.entry.definition);
        card.picture.style.background = definition.background;
        try {
            const bitmap = await engine.thumb({ ...definition, minWidth: Math.min(definition.minWidth, 1) }, side, side);
            if (!bitmap) return;
            card.picture.width = bitmap.width;
            card.picture.height = bitmap.height;
            card.picture.getContext('bitmaprenderer')?.transferFromImageBitmap(bitmap);
            card.picture.classList.add('inked');
        } catch {
            // The worker was replaced meanwhile; the picture comes when the gallery is next opened.
            card.painted = '';
        }
    }

    function filter() {
        const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
        let found = 0;
        for (const { card, words: own } of cards.values()) {
            card.hidden = !words.every((word) => own.includes(word));
            if (!card.hidden) found += 1;
        }
        for (const shelf of shelves.children) {
            if (shelf instanceof HTMLElement) shelf.hidden = !shelf.querySelector('.card:not([hidden])');
        }
        nothing.hidden = found > 0;
        setText(nothing, found > 0 ? '' : 'Nothing in the gallery has these words.');
    }

    async function open() {
        dialog.showModal();
        // A focused search field would raise the keyboard of a phone.
        if (matchMedia('(pointer: coarse)').matches) button('close-gallery').focus();
        try {
            await (filled ??= fill());
            filter();
            for (const [card] of cards) {
                // Asks again for those in sight: the look may be another one by now.
                seen.unobserve(card);
                seen.observe(card);
            }
        } catch (error) {
            filled = null;
            nothing.hidden = false;
            setText(nothing, `The gallery could not be loaded (${error instanceof Error ? error.message : error}).`);
        }
    }

    button('open-gallery').addEventListener('click', open);
    button('close-gallery').addEventListener('click', () => dialog.close());
    search.addEventListener('input', filter);
    // A click beside the sheet closes it.
    dialog.addEventListener('click', (event) => {
        if (event.target === dialog) dialog.close();
    });
}

/** The systems by folder, those of SHELVES first. @param {Entry[]} entries */
function groups(entries) {
    /** @type {Map<string, Entry[]>} */
    const folders = new Map([...SHELVES.keys()].map((folder) => [folder, []]));
    for (const entry of entries) folders.set(entry.folder, [...(folders.get(entry.folder) ?? []), entry]);
    return [...folders].filter(([, inside]) => inside.length > 0);
}

/** `practical-1` is shown as `Practical 1`. @param {string} folder */
function folderTitle(folder) {
    const words = folder.replaceAll(/[-_/]+/g, ' ').trim();
    return SHELVES.get(folder) ?? (words ? words.charAt(0).toUpperCase() + words.slice(1) : 'More');
}

/** @param {Definition} definition */
function kindOf({ rules, iterations }) {
    const stochastic = rules.split('\n').some((line) => /(->|→|=>).*:\s*[\d.]+\s*$/.test(line));
    return `${stochastic ? 'stochastic, ' : ''}n\u00a0=\u00a0${iterations}`;
}
