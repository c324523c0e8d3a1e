/** The gallery: all systems of the collection with thumbnails, to search and open. */

import { button, byId, closes, html, input, make, setText } from './dom.js';
import { jsonOf } from './files.js';
import { Stopped } from './engine/questions.js';
import { clean, definitionOf } from './state.js';
import { TAGS, choose, count, makingOf, tagsOf } from './tags.js';
import { emptyThumb, paintThumb } from './thumb.js';

/** @typedef {import('./state.js').Definition} Definition */
/** @typedef {{path: string, folder: string, definition: Definition} & import('./tags.js').Facts} Entry */
/** @typedef {{entry: Entry, card: HTMLButtonElement, picture: HTMLCanvasElement, words: string, tags: string[], painted: string}} Card */

/** The side of a thumbnail, in CSS pixels. */
const SIDE = 168;

/** The first shelves, with their names. Others follow, named after their folders. */
const SHELVES = new Map([
    ['garden', 'Garden'],
    ['abop', 'The Algorithmic Beauty of Plants'],
    ['curves', 'Famous curves'],
]);

/**
 * @param {import('./engine.js').Engine} engine
 * @param {{pick: (definition: Definition) => void, restyle: (definition: Definition) => Definition, theme: () => string}} page
 *   `restyle` gives a system with default colours the theme's colours; `theme` names the theme
 */
export function createGallery(engine, { pick, restyle, theme }) {
    const dialog = byId('gallery', HTMLDialogElement);
    const shelves = html('shelves');
    const search = input('search');
    const nothing = html('nothing-found');
    /** @type {Map<Element, Card>} */
    const cards = new Map();
    /** @type {Promise<void> | null} */
    let filled = null;
    /** @type {Set<string>} */
    let chosen = new Set();
    const chips = new Map(Object.entries(TAGS).map(([tag, meaning]) => [tag, newChip(tag, meaning)]));

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

    /** @param {string} tag @param {string} meaning */
    function newChip(tag, meaning) {
        const many = make('span', { class: 'chip-count' });
        const chip = make('button', { type: 'button', class: 'chip', title: meaning, 'aria-pressed': 'false' }, tag, ' ', many);
        chip.addEventListener('click', () => {
            chosen = choose(chosen, tag);
            filter();
        });
        html('chips').append(chip);
        return { chip, many };
    }

    /** @param {Entry} entry @returns {Card} */
    function newCard(entry) {
        const definition = definitionOf(clean(entry.definition));
        const picture = emptyThumb();
        const title = definition.title || definition.name;
        const kind = `${[...entry.kinds, ...(entry.solid ? ['3D'] : [])].join(', ')}, n\u00a0=\u00a0${definition.iterations}`;
        const card = make(
            'button',
            { type: 'button', class: 'card', 'aria-describedby': 'gallery-about' },
            picture,
            make('span', { class: 'card-title' }, title),
            make('span', { class: 'card-kind' }, kind),
            make('span', { class: 'card-kind' }, makingOf(entry)),
        );
        const tags = tagsOf(entry);
        const words = [title, definition.name, definition.source, definition.notes, entry.folder, folderTitle(entry.folder), ...tags].join(' ').toLowerCase();
        const made = { entry: { ...entry, definition }, card, picture, painted: '', tags, words };
        for (const event of ['focus', 'pointerenter']) card.addEventListener(event, () => tell(definition));
        card.addEventListener('click', () => {
            dialog.close();
            pick(restyle(definition));
        });
        cards.set(card, made);
        seen.observe(card);
        return made;
    }

    /** @param {Card} card */
    async function paint(card) {
        const wanted = theme();
        if (card.painted === wanted) return;
        card.painted = wanted;
        const definition = restyle(card.entry.definition);
        card.picture.style.background = definition.background;
        try {
            await paintThumb(card.picture, engine, definition, SIDE);
        } catch (error) {
            // A system that stopped the worker has no picture; others are drawn when the gallery is next opened.
            if (!(error instanceof Stopped)) card.painted = '';
        }
    }

    /** Shows the source and notes of a system. @param {Definition} definition */
    function tell({ title, name, source, notes }) {
        setText(html('about-title'), title || name);
        setText(html('about-source'), source);
        setText(html('about-notes'), notes);
    }

    function filter() {
        const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
        const worded = [...cards.values()].filter(({ words: own }) => words.every((word) => own.includes(word)));
        const tagged = worded.map(({ tags }) => tags);
        for (const [tag, { chip, many }] of chips) {
            const pressed = chosen.has(tag);
            chip.setAttribute('aria-pressed', String(pressed));
            const number = count(tagged, pressed ? chosen : choose(chosen, tag));
            chip.classList.toggle('no-match', number === 0);
            chip.hidden = ![...cards.values()].some(({ tags }) => tags.includes(tag));
            setText(many, String(number));
        }
        const shown = new Set(worded.filter(({ tags }) => [...chosen].every((tag) => tags.includes(tag))));
        for (const card of cards.values()) card.card.hidden = !shown.has(card);
        const found = shown.size;
        setText(html('found'), found === cards.size ? `${found} systems` : `${found} of ${cards.size} systems`);
        for (const shelf of shelves.children) {
            if (shelf instanceof HTMLElement) shelf.hidden = !shelf.querySelector('.card:not([hidden])');
        }
        nothing.hidden = found > 0;
        setText(nothing, found > 0 ? '' : 'No results.');
    }

    async function open() {
        dialog.showModal();
        // A focused search field would raise the keyboard of a phone.
        if (matchMedia('(pointer: coarse)').matches) button('close-gallery').focus();
        try {
            await (filled ??= fill());
            filter();
            for (const [card] of cards) {
                // Repaint the visible thumbnails, because the theme may have changed.
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
    closes(dialog, 'close-gallery');
    search.addEventListener('input', filter);
}

/** The systems by folder, the folders of SHELVES first. @param {Entry[]} entries */
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
