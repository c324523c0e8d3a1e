/** The gallery: all systems of the collection with thumbnails, to search and open. */

import styles from '../css/gallery.css';
import { exercises } from './course/published.js';
import { EXERCISES, exerciseCard, paintExercise } from './course/shelf.js';
import { button, byId, closes, html, input, make, setText } from './dom.js';
import { jsonOf } from './files.js';
import markup from './gallery.html';
import { addElements } from './late.js';
import { Stopped } from './engine/questions.js';
import { enliven } from './lively.js';
import { LABELS, NAMES, choose, count, filtersOf, matches, searchText, shelved, shortSource } from './shelves.js';
import { clean, definitionOf } from './state.js';
import { emptyThumb, paintThumb } from './thumb.js';
import { counted, said, say } from './words.js';

/** @typedef {import('./state.js').Definition} Definition */
/** @typedef {import('./shelves.js').Entry} Entry */
/** @typedef {{definition: Definition, card: HTMLElement, picture: HTMLCanvasElement, missing: HTMLElement, text: string, filters: string[], painted: string}} SystemCard */
/** A card with an exercise in place of a system. @typedef {Omit<SystemCard, 'definition'> & {exercise: string}} ExerciseCard */
/** @typedef {SystemCard | ExerciseCard} Card */

/** The side of a thumbnail, in CSS pixels. */
const SIDE = 168;

/** @param {import('./dialogs.js').Page} page */
export function createGallery({ store, engine, restyle, theme }) {
    addElements(markup, [styles]);
    const dialog = byId('gallery', HTMLDialogElement);
    const shelves = html('shelves');
    const search = input('search');
    const nothing = html('nothing-found');
    const clear = button('clear-search');
    /** @type {Map<Element, Card>} */
    const cards = new Map();
    /** @type {Promise<void> | null} */
    let filled = null;
    /** @type {Set<string>} */
    let chosen = new Set();
    const chips = new Map([...NAMES, EXERCISES].map((filter) => [filter, newChip(filter)]));

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
        for (const [name, inside] of shelved(entries)) {
            const shelf = make('div', { class: 'cards' }, ...inside.map((entry) => newCard(entry, name === NAMES[0])));
            shelves.append(make('section', { class: 'shelf' }, make('h3', {}, LABELS[name] ?? name), shelf));
        }
        const course = make('div', { class: 'cards' }, ...(await exercises()).map(newExercise));
        shelves.append(make('section', { class: 'shelf' }, make('h3', {}, EXERCISES), course));
    }

    /** @param {string} filter */
    function newChip(filter) {
        const many = make('span', { class: 'chip-count' });
        const chip = make(
            'button',
            { type: 'button', class: 'chip', 'aria-pressed': 'false' },
            LABELS[filter] ?? filter,
            ' ',
            many,
        );
        chip.addEventListener('click', () => {
            chosen = choose(chosen, filter, found());
            show();
            shelves.scrollTop = 0;
        });
        html('chips').append(chip);
        return { chip, many };
    }

    /** @param {Entry} entry @param {boolean} isLively whether it moves under the pointer */
    function newCard(entry, isLively) {
        const definition = definitionOf(clean(entry.definition));
        const picture = emptyThumb();
        const missing = make('span', { class: 'card-missing', hidden: true });
        const place = make('span', { class: 'card-picture' }, picture, missing);
        const card = make(
            'button',
            { type: 'button', class: 'card', 'data-path': entry.path, 'aria-describedby': 'gallery-about' },
            place,
            make('span', { class: 'card-title' }, said(definition.title || definition.name)),
            make('span', { class: 'card-kind', lang: '' }, shortSource(said(definition.source))),
        );
        for (const event of ['focus', 'pointerenter']) card.addEventListener(event, () => tell(definition));
        for (const event of ['blur', 'pointerleave'])
            card.addEventListener(event, () => (html('gallery-about').hidden = true));
        card.addEventListener('click', () => {
            dialog.close();
            store.open(restyle(definition));
        });
        if (isLively) enliven(card, place, engine, () => restyle(definition), SIDE);
        cards.set(card, {
            definition,
            card,
            picture,
            missing,
            painted: '',
            text: searchText(definition),
            filters: filtersOf(entry),
        });
        seen.observe(card);
        return card;
    }

    /** @param {import('./course/published.js').Entry} entry */
    function newExercise(entry) {
        const made = exerciseCard(entry);
        cards.set(made.card, {
            ...made,
            exercise: entry.x,
            painted: '',
            text: `${EXERCISES} ${entry.title} ${said(entry.title)}`.toLowerCase(),
            filters: [EXERCISES],
        });
        seen.observe(made.card);
        return made.card;
    }

    /** @param {Card} card */
    async function paint(card) {
        if ('exercise' in card) {
            if (card.painted !== '' || !card.missing.hidden) return;
            card.painted = 'once';
            return paintExercise(card.picture, card.exercise, SIDE).catch(() => void (card.painted = ''));
        }
        const wanted = theme();
        if (card.painted === wanted) return;
        card.painted = wanted;
        const definition = restyle(card.definition);
        card.picture.style.background = definition.background;
        let reason = '';
        try {
            // After a colon stands advice for editing, which a card does not need.
            reason = ((await paintThumb(card.picture, engine, definition, SIDE)) ?? '').replace(/:.*$/s, '.');
        } catch (error) {
            reason = error instanceof Stopped ? say`Drawing this system took too long.` : say`Drawing was interrupted.`;
            // A system that stopped the worker has no picture; others are drawn when the gallery is next opened.
            if (!(error instanceof Stopped)) card.painted = '';
        }
        card.missing.hidden = reason === '';
        setText(card.missing, reason);
    }

    /** Shows the notes and source of a system. @param {Definition} definition */
    function tell({ title, name, source, notes }) {
        setText(html('about-title'), said(title || name));
        setText(html('about-notes'), said(notes));
        setText(html('about-source'), said(source));
        html('gallery-about').hidden = notes === '' && source === '';
    }

    /** Gives each shelf as many columns as fit, or other ones if a card would be alone in the last row. */
    function arrange() {
        for (const shelf of shelves.querySelectorAll('.cards')) {
            if (!(shelf instanceof HTMLElement) || shelf.clientWidth === 0) continue;
            shelf.style.gridTemplateColumns = '';
            const most = getComputedStyle(shelf).gridTemplateColumns.split(' ').length;
            const many = shelf.querySelectorAll('.card:not([hidden])').length;
            const fine = [most, most - 1, most - 2, most + 1].find(
                (columns) => columns > 1 && (many <= columns || many % columns !== 1),
            );
            if (fine && fine !== most) shelf.style.gridTemplateColumns = `repeat(${fine}, minmax(0, 1fr))`;
        }
    }

    /** The cards that the search finds. */
    const searched = () => [...cards.values()].filter(({ text }) => matches(text, search.value));
    /** The filters of each of them. */
    const found = () => searched().map(({ filters }) => filters);

    function show() {
        const worded = found();
        for (const [filter, { chip, many }] of chips) {
            const pressed = chosen.has(filter);
            const number = count(worded, pressed ? chosen : choose(chosen, filter, worded));
            chip.setAttribute('aria-pressed', String(pressed));
            chip.classList.toggle('no-match', number === 0);
            setText(many, String(number));
        }
        const shown = new Set(
            searched().filter(({ filters }) => [...chosen].every((filter) => filters.includes(filter))),
        );
        for (const card of cards.values()) card.card.hidden = !shown.has(card);
        setText(
            html('found'),
            shown.size === cards.size
                ? counted(shown.size, '{} system', '{} systems')
                : say`${shown.size} of ${cards.size} systems`,
        );
        for (const shelf of shelves.children) {
            if (shelf instanceof HTMLElement) shelf.hidden = !shelf.querySelector('.card:not([hidden])');
        }
        arrange();
        setText(nothing, say`No results.`);
        html('no-results').hidden = shown.size > 0;
        clear.hidden = false;
    }

    async function open() {
        dialog.showModal();
        // A focused search field would raise the keyboard of a phone.
        if (matchMedia('(pointer: coarse)').matches) button('close-gallery').focus();
        try {
            await (filled ??= fill());
            show();
            for (const [card] of cards) {
                // Repaint the visible thumbnails, because the theme may have changed.
                seen.unobserve(card);
                seen.observe(card);
            }
        } catch (error) {
            filled = null;
            html('no-results').hidden = false;
            clear.hidden = true;
            setText(
                nothing,
                say`The gallery could not be loaded (${String(error instanceof Error ? error.message : error)}).`,
            );
        }
    }

    closes(dialog, 'close-gallery');
    search.addEventListener('input', () => {
        // A search that finds nothing on the chosen shelves looks on all.
        if (count(found(), chosen) === 0 && found().length > 0) chosen = new Set();
        show();
    });
    new ResizeObserver(arrange).observe(shelves);
    clear.addEventListener('click', () => {
        search.value = '';
        chosen = new Set();
        show();
        search.focus();
    });
    return { open };
}
