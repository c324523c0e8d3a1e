/** The dialog for films: a live preview, a timeline, and files. */

import styles from '../../css/film.css';
import { toast } from '../base/announce.js';
import { copyText } from '../base/copy.js';
import { decimal } from '../base/numerals.js';
import { button, byId, html, icon, input, setText, setValue } from '../base/dom.js';
import { showFailure } from '../base/failure.js';
import { isWhole } from '../base/files.js';
import { addElements } from '../base/late.js';
import { bestLink } from '../state/packed.js';
import { SIZES as FRAMES, stable } from '../dialogs/share-code.js';
import { definitionOf } from '../state/state.js';
import { Cancelled } from '../engine/tool.js';
import { said, say } from '../base/words.js';
import { createAdder } from './adder.js';
import { filmCode, filmIn } from './embed-code.js';
import { createFilmTool } from './frames.js';
import markup from './films.html';
import { createOptions } from './options.js';
import { createPlayer } from './player.js';
import { createPresets } from './presets.js';
import { createSaving } from './saving.js';
import { withTrack, written } from './script.js';
import { createTimeline } from './timeline.js';

/** @typedef {import('../protocol.js').Film} Film */
/** @typedef {import('../protocol.js').FilmScript} FilmScript */

/** The first film: growth, in a size that every place shows. */
const FIRST = '1;8s;25fps;1280x720;repeat';
/** The largest preview, in CSS pixels. */
const PREVIEW = [640, 420];

/**
 * The dialog and its film.
 * @typedef {object} Showing
 * @property {import('../dialogs/dialogs.js').Page['store']} store
 * @property {import('../dialogs/dialogs.js').Page['stage']} stage
 * @property {ReturnType<typeof createFilmTool>} tool
 * @property {HTMLDialogElement} dialog
 * @property {HTMLCanvasElement} canvas
 * @property {HTMLButtonElement} play
 * @property {HTMLInputElement} slider
 * @property {HTMLElement} problem
 * @property {HTMLInputElement} text
 * @property {ReturnType<typeof createSaving>} saving
 * @property {ReturnType<typeof createOptions>} options
 * @property {ReturnType<typeof createPresets>} presets
 * @property {ReturnType<typeof createAdder>} adder
 * @property {ReturnType<typeof createTimeline>} timeline
 * @property {FilmScript | null} script
 * @property {Film} film
 * @property {import('../protocol.js').FilmSubject[]} subjects
 * @property {string} wanted The text of the film to open
 * @property {number} turn
 * @property {ReturnType<typeof createPlayer>} player
 */

/** @param {import('../dialogs/dialogs.js').Page} page */
export function createFilms({ store, stage }) {
    addElements(markup, [styles]);
    const tool = createFilmTool();

    const canvas = byId('film-picture', HTMLCanvasElement);

    const saving = createSaving(store, {
        film: () => ({ film: self.film, script: self.script }),
        start: () => pause(self),
    });
    const options = createOptions({ change: (values) => change(self, values) });
    const presets = createPresets(store, stage, {
        dive: (view) => dive(self, view),
        use: (preset) => usePreset(self, preset, self.script ? written(self.script) : FIRST),
    });
    const adder = createAdder(store, stage, {
        add: (subject, value) => addTrack(self, subject, value),
    });

    const timeline = createTimeline({
        change: (tracks) => change(self, { tracks }),
        label: (subject) => said(self.subjects.find(({ name }) => name === subject)?.label ?? subject),
    });
    html('film-options').prepend(presets.element, options.element);
    html('film-acts').prepend(...saving.buttons);
    html('film-bar').after(saving.progress);
    html('film-score').prepend(timeline.element);
    html('film-score').append(saving.credit);
    html('film-bottom').prepend(adder.element);

    const player = createPlayer(tool, canvas, {
        most: () => previewSize(self),
        shown: (frame) => showFrame(self, frame),
        failed: (error) => failed(self, error),
    });
    /** @type {Showing} */
    const self = {
        store,
        stage,
        tool,
        dialog: byId('film-dialog', HTMLDialogElement),
        canvas,
        play: button('film-play'),
        slider: input('film-at'),
        problem: html('film-problem'),
        text: input('film-text'),
        saving,
        options,
        presets,
        adder,
        timeline,
        script: null,
        film: { definition: definitionOf(store.state), view: null, camera: null, text: '' },
        subjects: [],
        wanted: '',
        turn: 0,
        player,
    };

    self.text.addEventListener('change', () => take(self, self.text.value.trim()));
    self.play.addEventListener('click', () => toggle(self));

    self.slider.addEventListener('input', () => seek(self));

    button('close-film').addEventListener('click', () => self.dialog.close());
    self.dialog.addEventListener(
        'click',
        (event) => event.target === self.dialog && !saving.busy && self.dialog.close(),
    );
    self.dialog.addEventListener('close', () => end(self));

    button('film-embed').addEventListener('click', () => copyEmbed(self));

    return {
        /** @param {string} [hash] of a link that may hold a film */
        open: (hash) => openFilm(self, hash),
    };
}

/** @param {Showing} self @param {import('../protocol.js').FilmSubject["name"]} subject @param {number[]} value */
function addTrack(self, subject, value) {
    if (!self.script) return;
    const { seconds, easing } = self.script;
    const track = { subject, keys: [0, seconds].map((time) => ({ time, value, easing })) };
    // The numbers of a view are those of the page's view, and about its segment.
    const about = subject === 'view' ? { segment: self.film.view?.at ?? '' } : {};
    change(self, { ...withTrack(self.script, track), ...about });
}

/** @param {Showing} self */
function pause(self) {
    self.player.pause();
    showPlay(self);
}

/** @param {Showing} self @param {number} frame */
function showFrame(self, frame) {
    if (!self.script) return;
    setText(self.problem, '');
    self.slider.value = String(frame);
    self.slider.style.setProperty('--at', String(self.script.frames > 1 ? frame / (self.script.frames - 1) : 0));
    self.timeline.at(self.script.frames > 1 ? timeOf(self, frame) / self.script.seconds : 0);
    setText(
        html('film-clock'),
        say`${decimal(frame / self.script.rate, 1)} of ${decimal(self.script.frames / self.script.rate, 1)} s`,
    );
    showPlay(self);
}

/** @param {Showing} self @param {unknown} error */
function failed(self, error) {
    fail(self, error);
    showPlay(self);
}

/** @param {Showing} self @returns {[number, number]} */
function previewSize(self) {
    const ratio = Math.min(2, devicePixelRatio);
    const [across = 1, down = 1] = PREVIEW;
    const width = Math.min(across, self.canvas.parentElement?.clientWidth || across);
    return [width * ratio, down * ratio];
}

/** The time of a frame on the timeline, in seconds. @param {Showing} self @param {number} frame */
function timeOf(self, frame) {
    const { frames, rate, ending } = /** @type {FilmScript} */ (self.script);
    const at = ending === 'bounce' && frame > (frames + 1) / 2 ? frames - frame : frame;
    return at / rate;
}

/** @param {Showing} self */
function showPlay(self) {
    const words = self.player.playing ? say`Pause` : say`Play`;
    if (self.play.getAttribute('aria-label') === words) return;
    self.play.setAttribute('aria-label', words);
    self.play.replaceChildren(icon(self.player.playing ? 'i-pause' : 'i-play'));
}

/** Reads and shows a film's text. @param {Showing} self @param {string} next */
async function take(self, next) {
    const own = ++self.turn;
    self.wanted = next;
    try {
        const read = await self.tool.call('read', { text: next });
        if (own !== self.turn) return;
        self.script = read;
        self.film = { ...self.film, text: next };
        self.wanted = '';
        setText(self.problem, '');
        showScript(self);
        self.player.show(self.film, read);
    } catch (error) {
        if (own === self.turn) fail(self, error);
    }
}

/** Changes the script. @param {Showing} self @param {Partial<FilmScript>} values */
function change(self, values) {
    if (!self.script) return;
    // The timeline follows the pointer before the text is read.
    self.script = { ...self.script, ...values };
    // Without views of its own, the film shows the page's view, which names its segment itself.
    if (!self.script.tracks.some(({ subject }) => subject === 'view')) self.script.segment = '';
    self.timeline.show(self.script);
    take(self, written(self.script));
}

/** @param {Showing} self */
function showScript(self) {
    if (!self.script) return;
    self.options.show(self.script);
    self.slider.max = String(self.script.frames - 1);
    if (document.activeElement !== self.text) setValue(self.text, self.film.text);
    self.timeline.show(self.script);
    self.adder.show(self.script, self.subjects);
    self.saving.show(self.script);
}

/**
 * Shows a preset in place of the presets in a film's text.
 * @param {Showing} self
 * @param {import('../protocol.js').FilmPreset} preset
 * @param {string} before
 */
async function usePreset(self, preset, before) {
    try {
        await take(self, await self.tool.call('preset', { text: before, preset }));
    } catch (error) {
        fail(self, error);
    }
}

/**
 * Shows a dive to a view about a segment, or to the segment in the middle.
 * @param {Showing} self
 * @param {import('../state/state.js').View | null} view
 */
async function dive(self, view) {
    try {
        const next = await self.tool.call('dive', {
            film: self.film,
            text: self.script ? written(self.script) : FIRST,
            view,
        });
        if (next) await take(self, next);
    } catch (error) {
        fail(self, error);
    }
}

/** @param {Showing} self @param {unknown} error */
function fail(self, error) {
    if (!(error instanceof Cancelled)) showFailure(self.problem, error, () => begin(self));
}

/** @param {Showing} self */
function toggle(self) {
    if (self.player.playing) self.player.pause();
    else self.player.play();
    showPlay(self);
}

/** @param {Showing} self */
function seek(self) {
    self.player.pause();
    self.player.seek(Number(self.slider.value));
    showPlay(self);
}

/** @param {Showing} self */
function end(self) {
    self.player.close();
    self.saving.abort();
    self.tool.close();
}

/** @param {Showing} self */
async function copyEmbed(self) {
    if (!self.script) return;
    if (location.protocol === 'file:' || isWhole())
        return toast(
            say`This page was opened from a disk. Put it on a web server to get code that works in other pages.`,
        );
    const { width, height } = self.script;
    const [most = width] = FRAMES.large ?? [];
    const scale = Math.min(1, most / width);
    const page = stable('film.html');
    const code = filmCode(
        self.store.state,
        await bestLink(self.store.state),
        self.film.text,
        page,
        Math.round(width * scale),
        Math.round(height * scale),
    );
    toast((await copyText(code)) ? say`Embed code copied` : say`The browser refused to copy.`);
}

/** Shows the wanted film, or the last one, and plays it. @param {Showing} self */
async function begin(self) {
    try {
        self.subjects = await self.tool.call('subjects', { definition: self.film.definition });
    } catch (error) {
        return fail(self, error);
    }
    if (self.wanted || self.film.text) await take(self, self.wanted || self.film.text);
    else await usePreset(self, { kind: 'growth', n: self.store.state.iterations }, FIRST);
    // A film that fails tells why in place of playing.
    if (!self.problem.textContent) self.player.play();
    showPlay(self);
}

/** @param {Showing} self @param {string} [hash] of a link that may hold a film */
async function openFilm(self, hash = '') {
    const { view } = self.store.state;
    const camera = self.stage.space ? self.stage.camera() : null;
    self.film = {
        ...self.film,
        definition: definitionOf(self.store.state),
        view: self.stage.space ? null : view,
        camera,
    };
    self.wanted = filmIn(hash);
    setText(self.problem, '');
    self.presets.show();
    if (!self.dialog.open) self.dialog.showModal();
    await begin(self);
}
