/** The timeline of a film: a row for each track, with its keys; the chosen key below. */

import { icon, make, setChoice, setText, setValue } from '../dom.js';
import { say } from '../words.js';
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

/** @param {{change: (tracks: FilmTrack[]) => void, label: (subject: string) => string}} page */
export function createTimeline({ change, label }) {
    const list = make('ul', { class: 'film-tracks' });
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
    const remove = make('button', { class: 'button quiet', type: 'button' }, say`Delete key`);
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
    const element = make('div', { class: 'film-timeline' }, make('div', { class: 'film-lanes' }, head, list), editor);
    /** @type {FilmScript | null} */
    let script = null;
    /** @type {Row[]} */
    let rows = [];
    /** The chosen key. @type {{subject: string, at: number} | null} */
    let chosen = null;

    const tracks = () => script?.tracks ?? [];
    const trackOf = (/** @type {string} */ subject) => tracks().find((track) => track.subject === subject);
    const chosenTrack = () => (chosen ? trackOf(chosen.subject) : undefined);

    /** Puts a track in the place of the former one. @param {FilmTrack} track */
    const replace = (track) => change(tracks().map((other) => (other.subject === track.subject ? track : other)));

    /** @param {string} subject */
    const nameOf = (subject) => NAMES[subject] ?? label(subject);

    /** @param {FilmTrack} track @returns {Row} */
    function newRow({ subject }) {
        const lane = make('div', { class: 'film-lane', title: say`Click to add a key` });
        const words = make('span', { class: 'film-name' });
        const off = make(
            'button',
            { class: 'tool', type: 'button', 'aria-label': say`Remove ${nameOf(subject)}` },
            icon('i-close'),
        );
        off.addEventListener('click', () => change(tracks().filter((track) => track.subject !== subject)));
        lane.addEventListener('click', (event) => {
            const track = trackOf(subject);
            if (event.target !== lane || !track || !script) return;
            const { left, width } = lane.getBoundingClientRect();
            const at = rounded(Math.max(0, Math.min(1, (event.clientX - left) / width)) * script.seconds);
            const next = added(track, at);
            chosen = { subject, at: next.keys.findIndex((key) => key.time >= at - 0.0005) };
            replace(next);
        });
        return { element: make('li', { class: 'film-track' }, words, lane, off), lane, label: words, keys: [] };
    }

    /** @param {Row} row @param {string} subject @param {number} at */
    function newKey(row, subject, at) {
        const key = make('button', { class: 'film-dot', type: 'button' });
        const place = (/** @type {number} */ seconds) => {
            const track = trackOf(subject);
            if (track && script) replace(moved(track, at, seconds, script.seconds));
        };
        key.addEventListener('click', () => choose(subject, at));
        key.addEventListener('keydown', (event) => {
            const by = event.key === 'ArrowLeft' ? -STEP : event.key === 'ArrowRight' ? STEP : 0;
            const now = trackOf(subject)?.keys[at]?.time;
            if (event.key === 'Delete') choose(subject, at), remove.click();
            else if (by !== 0 && now !== undefined) choose(subject, at), place(now + by);
            else return;
            event.preventDefault();
        });
        key.addEventListener('pointerdown', (event) => {
            choose(subject, at);
            key.setPointerCapture(event.pointerId);
        });
        key.addEventListener('pointermove', (event) => {
            if (!key.hasPointerCapture(event.pointerId) || !script) return;
            const { left, width } = row.lane.getBoundingClientRect();
            place(((event.clientX - left) / width) * script.seconds);
        });
        return key;
    }

    /** @param {string} subject @param {number} at */
    function choose(subject, at) {
        chosen = { subject, at };
        show(script);
    }

    /** @param {FilmScript | null} next */
    function show(next) {
        script = next;
        const same =
            rows.length === tracks().length &&
            rows.every((row, at) => row.element.dataset.subject === tracks()[at]?.subject);
        if (!same) {
            rows = tracks().map((track) => {
                const row = newRow(track);
                row.element.dataset.subject = track.subject;
                return row;
            });
            list.replaceChildren(...rows.map((row) => row.element));
        }
        tracks().forEach(({ subject, keys }, at) => {
            const row = /** @type {Row} */ (rows[at]);
            setText(row.label, nameOf(subject));
            while (row.keys.length > keys.length) row.keys.pop()?.remove();
            while (row.keys.length < keys.length) {
                const key = newKey(row, subject, row.keys.length);
                row.keys.push(key);
                row.lane.append(key);
            }
            keys.forEach(({ time, value }, number) => {
                const key = /** @type {HTMLButtonElement} */ (row.keys[number]);
                key.style.left = `${Math.min(100, (100 * time) / (script?.seconds ?? 1))}%`;
                key.setAttribute('aria-label', say`${nameOf(subject)} at ${String(time)} s: ${value.join(' ')}`);
                key.setAttribute('aria-pressed', String(chosen?.subject === subject && chosen.at === number));
                key.title = say`${String(time)} s: ${value.join(' ')}`;
            });
        });
        const track = chosenTrack();
        const key = chosen && track?.keys[chosen.at];
        editor.hidden = !key;
        if (!track || !key) return;
        setText(name, nameOf(track.subject));
        if (document.activeElement !== time) setValue(time, String(key.time));
        if (document.activeElement !== value) setValue(value, key.value.join(' '));
        setChoice(pace, key.easing);
        remove.disabled = track.keys.length === 1;
    }

    /** Changes the chosen key. @param {Partial<import('../protocol.js').FilmKey>} values */
    function edit(values) {
        const track = chosenTrack();
        const at = chosen?.at;
        if (track)
            replace({ ...track, keys: track.keys.map((key, number) => (number === at ? { ...key, ...values } : key)) });
    }

    time.addEventListener('change', () => {
        const track = chosenTrack();
        const seconds = time.valueAsNumber;
        if (track && chosen && script && Number.isFinite(seconds))
            replace(moved(track, chosen.at, seconds, script.seconds));
    });
    value.addEventListener('change', () => {
        const numbers = numbersOf(value.value);
        if (numbers) edit({ value: numbers });
    });
    pace.addEventListener('change', () => edit({ easing: pace.value }));
    remove.addEventListener('click', () => {
        const track = chosenTrack();
        const at = chosen?.at;
        if (!track || track.keys.length === 1) return;
        chosen = null;
        replace({ ...track, keys: track.keys.filter((_, number) => number !== at) });
    });

    return {
        element,
        show,
        /** Marks the present time, as a part of the film. @param {number} part */
        at: (part) => element.style.setProperty('--at', String(part)),
    };
}
