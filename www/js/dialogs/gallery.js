/** The gallery: all systems of the collection with thumbnails, to search and open. */

import styles from '../../css/gallery.css';
import { exercises } from '../course/published.js';
import { EXERCISES, exerciseCard, paintExercise } from '../course/shelf.js';
import { button, byId, closes, html, input, make, setText, watchSight } from '../base/dom.js';
import { jsonOf } from '../base/files.js';
import markup from './gallery.html';
import { addElements } from '../base/late.js';
import { Stopped } from '../engine/questions.js';
import { enliven } from '../motion/lively.js';
import { LABELS, NAMES, choose, count, filtersOf, matches, searchText, shelved, shortSource } from './shelves.js';
import { clean, definitionOf } from '../state/state.js';
import { emptyThumb, paintThumb } from './thumb.js';
import { counted, reasonOf, said, say } from '../base/words.js';

/** @typedef {import('../state/state.js').Definition} Definition */
/** @typedef {import('./shelves.js').Entry} Entry */
/** @typedef {{definition: Definition, card: HTMLElement, picture: HTMLCanvasElement, missing: HTMLElement, text: string, filters: string[], painted: string}} SystemCard */
/** A card with an exercise in place of a system. @typedef {Omit<SystemCard, 'definition'> & {exercise: string}} ExerciseCard */
/** @typedef {SystemCard | ExerciseCard} Card */

/** The side of a thumbnail, in CSS pixels. */
const SIDE = 168;

/**
 * The dialog and its cards.
 * @typedef {object} Gallery
 * @property {import('./dialogs.js').Page['store']} store
 * @property {import('./dialogs.js').Page['engine']} engine
 * @property {import('./dialogs.js').Page['restyle']} restyle
 * @property {import('./dialogs.js').Page['theme']} theme
 * @property {HTMLDialogElement} dialog
 * @property {HTMLElement} shelves
 * @property {HTMLInputElement} search
 * @property {HTMLElement} nothing
 * @property {HTMLButtonElement} clear
 * @property {Map<Element, Card>} cards
 * @property {Promise<void> | null} filled
 * @property {Set<string>} chosen
 * @property {Map<string, ReturnType<typeof newChip>>} chips
 * @property {IntersectionObserver} seen
 */

/** @param {import('./dialogs.js').Page} page */
export function createGallery(page) {
    addElements(markup, [styles]);

    const shelves = html('shelves');

    const seen = watchSight(shelves, (target) => paint(self, /** @type {Card} */ (self.cards.get(target))));
    /** @type {Gallery} */
    const self = {
        ...page,
        dialog: byId('gallery', HTMLDialogElement),
        shelves,
        search: input('search'),
        nothing: html('nothing-found'),
        clear: button('clear-search'),
        cards: new Map(),
        filled: null,
        chosen: new Set(),
        chips: new Map(),
        seen,
    };

    for (const filter of [...NAMES, EXERCISES]) self.chips.set(filter, newChip(self, filter));
    closes(self.dialog, 'close-gallery');
    self.search.addEventListener('input', () => {
        // A search that finds nothing on the chosen shelves looks on all.
        if (count(found(self), self.chosen) === 0 && found(self).length > 0) self.chosen = new Set();
        show(self);
    });
    new ResizeObserver(() => arrange(self)).observe(shelves);
    self.clear.addEventListener('click', () => {
        self.search.value = '';
        self.chosen = new Set();
        show(self);
        self.search.focus();
    });
    return { open: () => open(self) };
}

/** @param {Gallery} self */
async function fill(self) {
    const entries = /** @type {Entry[]} */ (await jsonOf('gallery.json'));
    for (const [name, inside] of shelved(entries)) {
        const shelf = make(
            'div',
            { class: 'cards' },
            ...inside.map((entry) => newCard(self, entry, name === NAMES[0])),
        );
        self.shelves.append(make('section', { class: 'shelf' }, make('h3', {}, LABELS[name] ?? name), shelf));
    }
    const course = make('div', { class: 'cards' }, ...(await exercises()).map((entry) => newExercise(self, entry)));
    self.shelves.append(make('section', { class: 'shelf' }, make('h3', {}, EXERCISES), course));
}

/** @param {Gallery} self @param {string} filter */
function newChip(self, filter) {
    const many = make('span', { class: 'chip-count' });
    const chip = make('button', { class: 'chip', 'aria-pressed': 'false' }, LABELS[filter] ?? filter, ' ', many);
    chip.addEventListener('click', () => {
        self.chosen = choose(self.chosen, filter, found(self));
        show(self);
        self.shelves.scrollTop = 0;
    });
    html('chips').append(chip);
    return { chip, many };
}

/** @param {Gallery} self @param {Entry} entry @param {boolean} isLively whether it moves under the pointer */
function newCard(self, entry, isLively) {
    const definition = definitionOf(clean(entry.definition));
    const picture = emptyThumb();
    const missing = make('span', { class: 'card-missing', hidden: true });
    const place = make('span', { class: 'card-picture' }, picture, missing);
    const card = make(
        'button',
        { class: 'card', 'data-path': entry.path, 'aria-describedby': 'gallery-about' },
        place,
        make('span', { class: 'card-title' }, said(definition.title || definition.name)),
        make('span', { class: 'card-kind', lang: '' }, shortSource(said(definition.source))),
    );
    for (const event of ['focus', 'pointerenter']) card.addEventListener(event, () => tell(definition));
    for (const event of ['blur', 'pointerleave'])
        card.addEventListener(event, () => (html('gallery-about').hidden = true));
    card.addEventListener('click', () => {
        self.dialog.close();
        self.store.open(self.restyle(definition));
    });
    if (isLively) enliven(card, place, self.engine, () => self.restyle(definition), SIDE);
    self.cards.set(card, {
        definition,
        card,
        picture,
        missing,
        painted: '',
        text: searchText(definition),
        filters: filtersOf(entry),
    });
    self.seen.observe(card);
    return card;
}

/** @param {Gallery} self @param {import('../course/published.js').Entry} entry */
function newExercise(self, entry) {
    const made = exerciseCard(entry);
    self.cards.set(made.card, {
        ...made,
        exercise: entry.x,
        painted: '',
        text: `${EXERCISES} ${entry.title} ${said(entry.title)}`.toLowerCase(),
        filters: [EXERCISES],
    });
    self.seen.observe(made.card);
    return made.card;
}

/** @param {Gallery} self @param {Card} card */
async function paint(self, card) {
    if ('exercise' in card) {
        if (card.painted !== '' || !card.missing.hidden) return;
        card.painted = 'once';
        return paintExercise(card.picture, card.exercise, SIDE).catch(() => void (card.painted = ''));
    }
    const wanted = self.theme();
    if (card.painted === wanted) return;
    card.painted = wanted;
    const definition = self.restyle(card.definition);
    card.picture.style.background = definition.background;
    let reason = '';
    try {
        // After a colon stands advice for editing, which a card does not need.
        reason = ((await paintThumb(card.picture, self.engine, definition, SIDE)) ?? '').replace(/:.*$/s, '.');
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

/**
 * Gives each shelf as many columns as fit, or other ones if a card would be alone in the last row.
 * @param {Gallery} self
 */
function arrange(self) {
    for (const shelf of self.shelves.querySelectorAll('.cards')) {
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

/** The cards that the search finds. @param {Gallery} self */
const searched = (self) => [...self.cards.values()].filter(({ text }) => matches(text, self.search.value));

/** The filters of each of them. @param {Gallery} self */
const found = (self) => searched(self).map(({ filters }) => filters);

/** @param {Gallery} self */
function show(self) {
    const worded = found(self);
    for (const [filter, { chip, many }] of self.chips) {
        const pressed = self.chosen.has(filter);
        const number = count(worded, pressed ? self.chosen : choose(self.chosen, filter, worded));
        chip.setAttribute('aria-pressed', String(pressed));
        chip.classList.toggle('no-match', number === 0);
        setText(many, String(number));
    }
    const shown = new Set(
        searched(self).filter(({ filters }) => [...self.chosen].every((filter) => filters.includes(filter))),
    );
    for (const card of self.cards.values()) card.card.hidden = !shown.has(card);
    setText(
        html('found'),
        shown.size === self.cards.size
            ? counted(shown.size, '{} system', '{} systems')
            : say`${shown.size} of ${self.cards.size} systems`,
    );
    for (const shelf of self.shelves.children) {
        if (shelf instanceof HTMLElement) shelf.hidden = !shelf.querySelector('.card:not([hidden])');
    }
    arrange(self);
    setText(self.nothing, say`No results.`);
    html('no-results').hidden = shown.size > 0;
    self.clear.hidden = false;
}

/** @param {Gallery} self */
async function open(self) {
    self.dialog.showModal();
    // A focused search field would raise the keyboard of a phone.
    if (matchMedia('(pointer: coarse)').matches) button('close-gallery').focus();
    try {
        await (self.filled ??= fill(self));
        show(self);
        for (const [card] of self.cards) {
            // Repaint the visible thumbnails, because the theme may have changed.
            self.seen.unobserve(card);
            self.seen.observe(card);
        }
    } catch (error) {
        self.filled = null;
        html('no-results').hidden = false;
        self.clear.hidden = true;
        setText(self.nothing, say`The gallery could not be loaded (${reasonOf(error)}).`);
    }
}
