/** The dialog for films: a live preview, a timeline, and files. The page loads this module with the first film. */

import { toast } from '../announce.js';
import { copyText } from '../copy.js';
import { html, icon, make, setChoice, setText, setValue } from '../dom.js';
import { download, fileName } from '../download.js';
import { isWhole } from '../files.js';
import { bestLink } from '../packed.js';
import { SIZES as FRAMES } from '../share-code.js';
import { definitionOf } from '../state.js';
import { Cancelled } from '../tool.js';
import { filmCode } from './embed-code.js';
import { createFilmTool } from './frames.js';
import { createPlayer } from './player.js';
import { fileOf, videosOf } from './save.js';
import { EASINGS, ENDINGS, SIZES, dive, growth, stretched, turntable, turtle, withTrack, written } from './script.js';
import { createTimeline } from './timeline.js';

/** @typedef {import('../protocol.js').Film} Film */
/** @typedef {import('../protocol.js').FilmScript} FilmScript */
/** @typedef {import('../protocol.js').FilmTrack} FilmTrack */

/** The first film: growth, in a size that every place shows. */
const FIRST = '1;8s;25fps;1280x720;repeat';
/** The largest preview, in CSS pixels. */
const PREVIEW = [640, 420];
/** The camera's first azimuth, in degrees. */
const AZIMUTH = 25;

/** @type {ReturnType<typeof createFilms> | null} */
let made = null;

/**
 * Opens the dialog.
 * @param {import('../store.js').Store} store
 * @param {{readonly space: boolean}} stage whether the drawing is in space
 * @param {string} [text] the film to open; the last one if left out
 */
export async function openFilm(store, stage, text) {
    made ??= createFilms(store, stage);
    await made.open(text);
}

/** @param {string} id @param {readonly (readonly [string, string])[]} choices @param {string} label */
function choice(id, choices, label) {
    const select = make('select', { id }, ...choices.map(([value, words]) => make('option', { value }, words)));
    return { select, row: make('label', { class: 'film-option' }, label, select) };
}

/** @param {string} id @param {string} label @param {Record<string, string>} attributes */
function numberOption(id, label, attributes) {
    const field = make('input', { id, class: 'number', type: 'number', ...attributes });
    return { field, row: make('label', { class: 'film-option' }, label, field) };
}

/**
 * @param {import('../store.js').Store} store
 * @param {{readonly space: boolean}} stage whether the drawing is in space
 */
function createFilms(store, stage) {
    const tool = createFilmTool();
    const canvas = make('canvas', { id: 'film-picture', role: 'img', 'aria-label': 'Preview of the film' });
    const play = make('button', { id: 'film-play', class: 'tool', type: 'button', 'aria-label': 'Play' }, icon('i-play'));
    const slider = make('input', { id: 'film-at', type: 'range', min: '0', value: '0', 'aria-label': 'Frame' });
    const clock = make('output', { class: 'film-clock', 'aria-live': 'off' });
    const problem = make('p', { id: 'film-problem', class: 'note alert', role: 'status' });
    const text = make('input', { id: 'film-text', class: 'number', type: 'text', spellcheck: 'false', autocomplete: 'off', 'aria-label': 'The film as text' });
    const adder = make('select', { id: 'film-add', 'aria-label': 'Add a track' });
    const seconds = numberOption('film-seconds', 'Seconds', { min: '0.1', max: '3600', step: '0.5' });
    const rate = numberOption('film-rate', 'Frames a second', { min: '1', max: '60', step: '1' });
    const size = choice('film-size', [...SIZES, ['own', 'Other size']], 'Size');
    const sides = ['width', 'height'].map((name) => make('input', { id: `film-${name}`, class: 'number', type: 'number', min: '16', max: '4096', 'aria-label': `${name === 'width' ? 'Width' : 'Height'} in pixels` }));
    const own = make('span', { class: 'film-option film-own' }, /** @type {HTMLElement} */ (sides[0]), '×', /** @type {HTMLElement} */ (sides[1]));
    const ending = choice('film-loop', ENDINGS, 'Loop');
    const pace = choice('film-pace', EASINGS, 'Pace');
    const presets = Object.fromEntries([['growth', 'Growth'], ['turtle', 'Turtle’s way'], ['turntable', 'Turntable'], ['dive', 'Dive']].map(([name, words]) => [name, make('button', { class: 'button', type: 'button', 'data-preset': String(name) }, String(words))]));
    const kinds = /** @type {import('./save.js').FilmFile[]} */ (['gif', 'webm', 'mp4']).map((kind) => ({ kind, button: make('button', { class: kind === 'gif' ? 'button primary' : 'button', type: 'button', 'data-film': kind, hidden: kind !== 'gif' }, icon('i-save'), kind === 'webm' ? 'WebM' : kind.toUpperCase()) }));
    const embed = make('button', { id: 'film-embed', class: 'button', type: 'button' }, icon('i-link'), 'Copy as embed');
    const bar = make('progress', { id: 'film-progress', max: '1', value: '0', 'aria-label': 'Progress' });
    const cancel = make('button', { id: 'film-cancel', class: 'button quiet', type: 'button' }, 'Cancel');
    const told = make('span', { class: 'note', role: 'status' });
    const progress = make('div', { class: 'film-progress', hidden: true }, bar, told, cancel);
    const timeline = createTimeline({ change: (tracks) => change({ tracks }), label: (subject) => subjects.find(({ name }) => name === subject)?.label ?? subject });
    const close = make('button', { id: 'close-film', class: 'tool', type: 'button', 'aria-label': 'Close' }, icon('i-close'));
    const credit = make('p', { class: 'note film-credit' }, 'WebM and MP4 files are written by ', make('a', { href: 'https://mediabunny.dev', target: '_blank', rel: 'noopener' }, 'Mediabunny'), ' (Mozilla Public License 2.0).');
    const dialog = make(
        'dialog',
        { id: 'film-dialog', class: 'dialog fitted film', 'aria-labelledby': 'h-film' },
        make('header', { class: 'dialog-head' }, make('h2', { id: 'h-film' }, 'Film'), close),
        make(
            'div',
            { class: 'film-body' },
            make('div', { class: 'film-stage' }, canvas, make('div', { class: 'film-bar' }, play, slider, clock), problem),
            make(
                'div',
                { class: 'film-options' },
                make('div', { class: 'row', role: 'group', 'aria-label': 'Presets' }, ...Object.values(presets)),
                make('div', { class: 'film-fields' }, seconds.row, rate.row, size.row, own, ending.row, pace.row),
                make('div', { class: 'row' }, ...kinds.map(({ button }) => button), embed),
                progress,
                credit,
            ),
            make('section', { class: 'film-score', 'aria-label': 'Timeline' }, timeline.element, make('div', { class: 'film-bottom' }, adder, text)),
        ),
    );
    document.body.append(dialog);

    /** @type {FilmScript | null} */
    let script = null;
    /** @type {Film} */
    let film = { definition: definitionOf(store.state), view: null, camera: null, text: '' };
    /** @type {import('../protocol.js').FilmSubject[]} */
    let subjects = [];
    let turn = 0;
    /** The file in the making. @type {AbortController | null} */
    let saving = null;

    const player = createPlayer(tool, canvas, {
        most: () => {
            const ratio = Math.min(2, devicePixelRatio);
            const [across = 1, down = 1] = PREVIEW;
            const width = Math.min(across, canvas.parentElement?.clientWidth || across);
            return [width * ratio, down * ratio];
        },
        shown: (frame) => {
            if (!script) return;
            setText(problem, '');
            slider.value = String(frame);
            slider.style.setProperty('--at', String(script.frames > 1 ? frame / (script.frames - 1) : 0));
            timeline.at(script.frames > 1 ? timeOf(frame) / script.seconds : 0);
            setText(clock, `${(frame / script.rate).toFixed(1)} of ${(script.frames / script.rate).toFixed(1)} s`);
            showPlay();
        },
        failed: (words) => {
            setText(problem, words);
            showPlay();
        },
    });

    /** The time of a frame on the timeline, in seconds. @param {number} frame */
    function timeOf(frame) {
        const { frames, rate, ending } = /** @type {FilmScript} */ (script);
        const at = ending === 'bounce' && frame > (frames + 1) / 2 ? frames - frame : frame;
        return at / rate;
    }

    function showPlay() {
        const words = player.playing ? 'Pause' : 'Play';
        if (play.getAttribute('aria-label') === words) return;
        play.setAttribute('aria-label', words);
        play.replaceChildren(icon(player.playing ? 'i-pause' : 'i-play'));
    }

    /** Reads and shows a film's text. @param {string} next */
    async function take(next) {
        const own = ++turn;
        try {
            const read = await tool.call('read', { text: next });
            if (own !== turn) return;
            script = read;
            film = { ...film, text: next };
            setText(problem, '');
            showScript();
            player.show(film, read);
        } catch (error) {
            if (own === turn && !(error instanceof Cancelled)) setText(problem, error instanceof Error ? error.message : String(error));
        }
    }

    /** Changes the script. @param {Partial<FilmScript>} values */
    function change(values) {
        if (!script) return;
        // The timeline follows the pointer before the text is read.
        script = { ...script, ...values };
        timeline.show(script);
        take(written(script));
    }

    function showScript() {
        if (!script) return;
        const { width, height } = script;
        if (document.activeElement !== seconds.field) setValue(seconds.field, String(script.seconds));
        if (document.activeElement !== rate.field) setValue(rate.field, String(script.rate));
        const known = SIZES.some(([name]) => name === `${width}x${height}`);
        setChoice(size.select, known && size.select.value !== 'own' ? `${width}x${height}` : 'own');
        own.hidden = size.select.value !== 'own';
        sides.forEach((field, at) => document.activeElement !== field && setValue(field, String(at === 0 ? width : height)));
        setChoice(ending.select, script.ending);
        setChoice(pace.select, script.easing);
        slider.max = String(script.frames - 1);
        if (document.activeElement !== text) setValue(text, film.text);
        timeline.show(script);
        showAdder();
        showVideos();
    }

    function showAdder() {
        const used = new Set(script?.tracks.map(({ subject }) => subject));
        const options = subjects.filter(({ name, value }) => !used.has(name) && value !== null).map(({ name, label }) => make('option', { value: name }, `${label} (${name})`));
        const others = (stage.space ? [['camera', 'Camera']] : [['view', 'View']]).concat([['drawn', 'Part drawn']]).filter(([name]) => !used.has(String(name)));
        adder.replaceChildren(make('option', { value: '' }, 'Add a track…'), ...others.map(([name, words]) => make('option', { value: String(name) }, String(words))), ...options);
    }

    /** Shows the kinds of video that the browser can write. */
    async function showVideos() {
        if (!script) return;
        const found = await videosOf(script).catch(() => []);
        for (const { kind, button } of kinds) button.hidden = kind !== 'gif' && !found.some((each) => each === kind);
        credit.hidden = found.length === 0;
    }

    adder.addEventListener('change', () => {
        if (!script || adder.value === '') return;
        const subject = adder.value;
        const { view, camera } = store.state;
        const values = { view: view ? [view.x, view.y, view.zoom] : [0, 0, 1], camera: camera ? [camera.azimuth, camera.elevation, camera.zoom, camera.x, camera.y, camera.z] : [AZIMUTH, 12, 1], drawn: [1] };
        const value = Object.hasOwn(values, subject) ? values[/** @type {keyof typeof values} */ (subject)] : (subjects.find(({ name }) => name === subject)?.value ?? [0]);
        const keys = [0, script.seconds].map((time) => ({ time, value, easing: script?.easing ?? 'linear' }));
        change(withTrack(script, { subject, keys }));
    });

    for (const [name, button] of Object.entries(presets)) {
        button.addEventListener('click', async () => {
            if (!script) return;
            // A preset takes the place of the others, so that each shows what it is.
            const tracks = script.tracks.filter(({ subject }) => !['n', 'drawn', 'view', 'camera'].includes(subject));
            const bare = { ...script, tracks };
            if (name === 'growth') return change(withTrack(bare, growth(bare, store.state.iterations)));
            if (name === 'turtle') return change(withTrack(bare, turtle(bare)));
            if (name === 'turntable') return change(withTrack(bare, turntable(bare, store.state.camera?.azimuth ?? AZIMUTH)));
            const place = await placeToDive();
            if (place) change(withTrack(bare, dive(bare, place, stage.space)));
        });
    }

    /** The place of a dive: what the page shows if it is zoomed in, or else the segment in the middle. @returns {Promise<number[] | null>} */
    async function placeToDive() {
        const { view, camera } = store.state;
        if (stage.space && camera && camera.zoom > 2) return [camera.azimuth, camera.elevation, camera.zoom, camera.x, camera.y, camera.z];
        if (!stage.space && view && view.zoom > 2) return [view.x, view.y, view.zoom, view.fx ?? 0, view.fy ?? 0];
        try {
            return await tool.call('place', { film });
        } catch (error) {
            setText(problem, error instanceof Error ? error.message : String(error));
            return null;
        }
    }

    seconds.field.addEventListener('change', () => {
        if (script && seconds.field.valueAsNumber > 0) change(stretched(script, seconds.field.valueAsNumber));
    });
    rate.field.addEventListener('change', () => change({ rate: Math.round(rate.field.valueAsNumber) || 25 }));
    size.select.addEventListener('change', () => {
        own.hidden = size.select.value !== 'own';
        const [width, height] = size.select.value.split('x').map(Number);
        if (width && height) change({ width, height });
    });
    for (const field of sides) {
        field.addEventListener('change', () => {
            const [width = NaN, height = NaN] = sides.map((side) => Math.round(side.valueAsNumber));
            if (width && height) change({ width, height });
        });
    }
    ending.select.addEventListener('change', () => change({ ending: ending.select.value }));
    pace.select.addEventListener('change', () => {
        const easing = pace.select.value;
        const before = script?.easing;
        const paced = (/** @type {FilmTrack} */ track) => ({ ...track, keys: track.keys.map((key) => (key.easing === before ? { ...key, easing } : key)) });
        change({ easing, tracks: script?.tracks.map(paced) ?? [] });
    });
    text.addEventListener('change', () => take(text.value.trim()));
    play.addEventListener('click', () => {
        if (player.playing) player.pause();
        else player.play();
        showPlay();
    });
    slider.addEventListener('input', () => {
        player.pause();
        player.seek(Number(slider.value));
        showPlay();
    });
    close.addEventListener('click', () => dialog.close());
    dialog.addEventListener('click', (event) => event.target === dialog && !saving && dialog.close());
    dialog.addEventListener('close', () => {
        player.close();
        saving?.abort();
        tool.close();
    });

    for (const { kind, button } of kinds) button.addEventListener('click', () => save(kind));
    cancel.addEventListener('click', () => saving?.abort());

    /** @param {import('./save.js').FilmFile} kind */
    async function save(kind) {
        if (!script || saving) return;
        const { frames } = script;
        const mine = new AbortController();
        saving = mine;
        player.pause();
        showPlay();
        const start = performance.now();
        const show = (/** @type {number} */ done) => {
            bar.value = done / frames;
            const left = done > 0 ? ((performance.now() - start) / done) * (frames - done) : NaN;
            setText(told, `Frame ${done} of ${frames}${Number.isFinite(left) ? `, ${Math.ceil(left / 1000)} s left` : ''}`);
        };
        show(0);
        progress.hidden = false;
        for (const { button } of kinds) button.disabled = true;
        try {
            const blob = await fileOf(kind, film, script, { signal: mine.signal, progress: show });
            download(blob, `${fileName(store.state)}.${kind}`);
            toast(`Saved: ${(blob.size / 1e6).toFixed(1)} MB, made in ${((performance.now() - start) / 1000).toFixed(1)} s`);
        } catch (error) {
            if (!mine.signal.aborted) toast(`Not saved: ${error instanceof Error ? error.message : error}.`);
        } finally {
            saving = null;
            progress.hidden = true;
            for (const { button } of kinds) button.disabled = false;
        }
    }

    embed.addEventListener('click', async () => {
        if (!script) return;
        if (location.protocol === 'file:' || isWhole()) return toast('This page was opened from a disk. Put it on a web server to get code that works in other pages.');
        const { width, height } = script;
        const [most = width] = FRAMES.large ?? [];
        const scale = Math.min(1, most / width);
        const page = new URL('film.html', location.href).href;
        const code = filmCode(store.state, await bestLink(store.state), film.text, page, Math.round(width * scale), Math.round(height * scale));
        toast((await copyText(code)) ? 'Embed code copied' : 'The browser refused to copy.');
    });

    return {
        /** @param {string} [next] the film to open */
        async open(next) {
            const { view, camera } = store.state;
            film = { ...film, definition: definitionOf(store.state), view: stage.space ? null : view, camera };
            for (const [name, button] of Object.entries(presets)) button.disabled = name === 'turntable' && !stage.space;
            if (!dialog.open) dialog.showModal();
            subjects = await tool.call('subjects', { definition: film.definition });
            if (next || film.text) await take(next || film.text);
            else {
                const first = await tool.call('read', { text: FIRST });
                await take(written(withTrack(first, growth(first, store.state.iterations))));
            }
            // A film that fails tells why in place of playing.
            if (!html('film-problem').textContent) player.play();
            showPlay();
        },
    };
}
