/** The timeline of a film: a row for each track, with its keys; the chosen key below. */

import { icon, make, setChoice, setText, setValue } from '../base/dom.js';
import { say } from '../base/words.js';
import { EASINGS, added, moved, numbersOf, rounded } from './script.js';

/** @typedef {import('../protocol.js').FilmScript} FilmScript */
/** @typedef {import('../protocol.js').FilmTrack} FilmTrack */
/** @typedef {{element: HTMLElement, lane: HTMLElement, label: HTMLElement, keys: HTMLButtonElement[]}} Row */

/** Seconds of an arrow key. */
const STEP = 0.1;

/** The names of subjects that are no number of the system. @type {Readonly<Record<string, string>>} */
const NAMES = {
    n: say`Iterations`,
    drawn: say`Part drawn`,
    view: say`View (x y zoom)`,
    camera: say`Camera (azimuth elevation zoom x y z)`,
};

/** The place of a field in a sentence. */
const HERE = '\n';

/** A sentence with a field in it. @param {string} words @param {HTMLElement} field */
function around(words, field) {
    const [before = '', after = ''] = words.split(HERE);
    return [before, field, after];
}

/**
 * The rows and the film that they show.
 * @typedef {object} Score
 * @property {(tracks: FilmTrack[]) => void} change
 * @property {(subject: string) => string} label
 * @property {HTMLElementTagNameMap['ul']} list
 * @property {HTMLElementTagNameMap['input']} time
 * @property {HTMLElementTagNameMap['input']} value
 * @property {HTMLElementTagNameMap['select']} pace
 * @property {HTMLElementTagNameMap['button']} remove
 * @property {HTMLElementTagNameMap['strong']} name
 * @property {HTMLElementTagNameMap['div']} editor
 * @property {FilmScript | null} script
 * @property {Row[]} rows
 * @property {{subject: string, at: number} | null} chosen The chosen key
 */

/** @param {{change: (tracks: FilmTrack[]) => void, label: (subject: string) => string}} page */
export function createTimeline({ change, label }) {
    const head = make('div', { class: 'film-head' });
    const time = make('input', {
        class: 'number',
        type: 'number',
        min: '0',
        step: '0.1',
        'aria-label': say`Time of the key, in seconds`,
    });
    const value = make('input', {
        class: 'number film-value',
        type: 'text',
        autocomplete: 'off',
        spellcheck: 'false',
        'aria-label': say`Value of the key`,
    });
    const pace = make(
        'select',
        { 'aria-label': say`Pace to the next key` },
        ...EASINGS.map(([name, words]) => make('option', { value: name }, words)),
    );
    const remove = make('button', { class: 'button quiet' }, say`Delete key`);
    const name = make('strong', {});
    const editor = make(
        'div',
        { class: 'film-key', hidden: true },
        name,
        make('label', {}, ...around(say`at ${HERE} s`, time)),
        make('label', {}, ...around(say`value ${HERE}`, value)),
        make('label', {}, ...around(say`then ${HERE}`, pace)),
        remove,
    );
    /** @type {Score} */
    const self = {
        change,
        label,
        list: make('ul', { class: 'film-tracks' }),
        time,
        value,
        pace,
        remove,
        name,
        editor,
        script: null,
        rows: [],
        chosen: null,
    };

    const element = make(
        'div',
        { class: 'film-timeline' },
        make('div', { class: 'film-lanes' }, head, self.list),
        editor,
    );

    time.addEventListener('change', () => {
        const track = chosenTrack(self);
        const seconds = time.valueAsNumber;
        if (track && self.chosen && self.script && Number.isFinite(seconds))
            replace(self, moved(track, self.chosen.at, seconds, self.script.seconds));
    });
    value.addEventListener('change', () => {
        const numbers = numbersOf(value.value);
        if (numbers) edit(self, { value: numbers });
    });
    pace.addEventListener('change', () => edit(self, { easing: pace.value }));
    remove.addEventListener('click', () => deleteKey(self));

    return {
        element,
        show: (/** @type {FilmScript | null} */ next) => show(self, next),
        /** Marks the present time, as a part of the film. @param {number} part */
        at: (part) => element.style.setProperty('--at', String(part)),
    };
}

/** @param {Score} self */
const tracks = (self) => self.script?.tracks ?? [];

/** @param {Score} self */
const trackOf = (self, /** @type {string} */ subject) => tracks(self).find((track) => track.subject === subject);

/** @param {Score} self */
const chosenTrack = (self) => (self.chosen ? trackOf(self, self.chosen.subject) : undefined);

/** Puts a track in the place of the former one. @param {Score} self @param {FilmTrack} track */
const replace = (self, track) =>
    self.change(tracks(self).map((other) => (other.subject === track.subject ? track : other)));

/** @param {Score} self @param {string} subject */
const nameOf = (self, subject) => NAMES[subject] ?? self.label(subject);

/** @param {Score} self @param {FilmTrack} track @returns {Row} */
function newRow(self, { subject }) {
    const lane = make('div', { class: 'film-lane', title: say`Click to add a key` });
    const words = make('span', { class: 'film-name' });
    const off = make('button', { class: 'tool', 'aria-label': say`Remove ${nameOf(self, subject)}` }, icon('i-close'));
    off.addEventListener('click', () => self.change(tracks(self).filter((track) => track.subject !== subject)));
    lane.addEventListener('click', (event) => {
        const track = trackOf(self, subject);
        if (event.target !== lane || !track || !self.script) return;
        const { left, width } = lane.getBoundingClientRect();
        const at = rounded(Math.max(0, Math.min(1, (event.clientX - left) / width)) * self.script.seconds);
        const next = added(track, at);
        self.chosen = { subject, at: next.keys.findIndex((key) => key.time >= at - 0.0005) };
        replace(self, next);
    });
    return { element: make('li', { class: 'film-track' }, words, lane, off), lane, label: words, keys: [] };
}

/** @param {Score} self @param {Row} row @param {string} subject @param {number} at */
function newKey(self, row, subject, at) {
    const key = make('button', { class: 'film-dot' });
    const place = (/** @type {number} */ seconds) => {
        const track = trackOf(self, subject);
        if (track && self.script) replace(self, moved(track, at, seconds, self.script.seconds));
    };
    key.addEventListener('click', () => choose(self, subject, at));
    key.addEventListener('keydown', (event) => {
        const by = event.key === 'ArrowLeft' ? -STEP : event.key === 'ArrowRight' ? STEP : 0;
        const now = trackOf(self, subject)?.keys[at]?.time;
        if (event.key === 'Delete') choose(self, subject, at), self.remove.click();
        else if (by !== 0 && now !== undefined) choose(self, subject, at), place(now + by);
        else return;
        event.preventDefault();
    });
    key.addEventListener('pointerdown', (event) => {
        choose(self, subject, at);
        key.setPointerCapture(event.pointerId);
    });
    key.addEventListener('pointermove', (event) => {
        if (!key.hasPointerCapture(event.pointerId) || !self.script) return;
        const { left, width } = row.lane.getBoundingClientRect();
        place(((event.clientX - left) / width) * self.script.seconds);
    });
    return key;
}

/** @param {Score} self @param {string} subject @param {number} at */
function choose(self, subject, at) {
    self.chosen = { subject, at };
    show(self, self.script);
}

/** @param {Score} self @param {FilmScript | null} next */
function show(self, next) {
    self.script = next;
    const same =
        self.rows.length === tracks(self).length &&
        self.rows.every((row, at) => row.element.dataset.subject === tracks(self)[at]?.subject);
    if (!same) {
        self.rows = tracks(self).map((track) => {
            const row = newRow(self, track);
            row.element.dataset.subject = track.subject;
            return row;
        });
        self.list.replaceChildren(...self.rows.map((row) => row.element));
    }
    tracks(self).forEach(({ subject, keys }, at) => {
        const row = /** @type {Row} */ (self.rows[at]);
        setText(row.label, nameOf(self, subject));
        while (row.keys.length > keys.length) row.keys.pop()?.remove();
        while (row.keys.length < keys.length) {
            const key = newKey(self, row, subject, row.keys.length);
            row.keys.push(key);
            row.lane.append(key);
        }
        keys.forEach(({ time, value }, number) => {
            const key = /** @type {HTMLButtonElement} */ (row.keys[number]);
            key.style.left = `${Math.min(100, (100 * time) / (self.script?.seconds ?? 1))}%`;
            key.setAttribute('aria-label', say`${nameOf(self, subject)} at ${String(time)} s: ${value.join(' ')}`);
            key.setAttribute('aria-pressed', String(self.chosen?.subject === subject && self.chosen.at === number));
            key.title = say`${String(time)} s: ${value.join(' ')}`;
        });
    });
    const track = chosenTrack(self);
    const key = self.chosen && track?.keys[self.chosen.at];
    self.editor.hidden = !key;
    if (!track || !key) return;
    setText(self.name, nameOf(self, track.subject));
    if (document.activeElement !== self.time) setValue(self.time, String(key.time));
    if (document.activeElement !== self.value) setValue(self.value, key.value.join(' '));
    setChoice(self.pace, key.easing);
    self.remove.disabled = track.keys.length === 1;
}

/** Changes the chosen key. @param {Score} self @param {Partial<import('../protocol.js').FilmKey>} values */
function edit(self, values) {
    const track = chosenTrack(self);
    const at = self.chosen?.at;
    if (track)
        replace(self, {
            ...track,
            keys: track.keys.map((key, number) => (number === at ? { ...key, ...values } : key)),
        });
}

/** @param {Score} self */
function deleteKey(self) {
    const track = chosenTrack(self);
    const at = self.chosen?.at;
    if (!track || track.keys.length === 1) return;
    self.chosen = null;
    replace(self, { ...track, keys: track.keys.filter((_, number) => number !== at) });
}
