/** The dialog for films: a live preview, a timeline, and files. */

import styles from '../../css/film.css';
import { toast } from '../announce.js';
import { copyText } from '../copy.js';
import { decimal } from '../numerals.js';
import { button, byId, html, icon, input, setText, setValue } from '../dom.js';
import { showFailure } from '../failure.js';
import { isWhole } from '../files.js';
import { addElements } from '../late.js';
import { bestLink } from '../packed.js';
import { SIZES as FRAMES, stable } from '../share-code.js';
import { definitionOf } from '../state.js';
import { Cancelled } from '../tool.js';
import { said, say } from '../words.js';
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

/** @param {import('../dialogs.js').Page} page */
export function createFilms({ store, stage }) {
    addElements(markup, [styles]);
    const tool = createFilmTool();
    const dialog = byId('film-dialog', HTMLDialogElement);
    const canvas = byId('film-picture', HTMLCanvasElement);
    const play = button('film-play');
    const slider = input('film-at');
    const problem = html('film-problem');
    const text = input('film-text');
    const saving = createSaving(store, {
        film: () => ({ film, script }),
        start: () => {
            player.pause();
            showPlay();
        },
    });
    const options = createOptions({ change: (values) => change(values) });
    const presets = createPresets(store, stage, {
        dive,
        use: (preset) => usePreset(preset, script ? written(script) : FIRST),
    });
    const adder = createAdder(store, stage, {
        add: (subject, value) => {
            if (!script) return;
            const { seconds, easing } = script;
            const track = { subject, keys: [0, seconds].map((time) => ({ time, value, easing })) };
            // The numbers of a view are those of the page's view, and about its segment.
            const about = subject === 'view' ? { segment: film.view?.at ?? '' } : {};
            change({ ...withTrack(script, track), ...about });
        },
    });
    const timeline = createTimeline({
        change: (tracks) => change({ tracks }),
        label: (subject) => said(subjects.find(({ name }) => name === subject)?.label ?? subject),
    });
    html('film-options').prepend(presets.element, options.element);
    html('film-acts').prepend(...saving.buttons);
    html('film-bar').after(saving.progress);
    html('film-score').prepend(timeline.element);
    html('film-score').append(saving.credit);
    html('film-bottom').prepend(adder.element);

    /** @type {FilmScript | null} */
    let script = null;
    /** @type {Film} */
    let film = { definition: definitionOf(store.state), view: null, camera: null, text: '' };
    /** @type {import('../protocol.js').FilmSubject[]} */
    let subjects = [];
    /** The text of the film to open. */
    let wanted = '';
    let turn = 0;

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
            setText(
                html('film-clock'),
                say`${decimal(frame / script.rate, 1)} of ${decimal(script.frames / script.rate, 1)} s`,
            );
            showPlay();
        },
        failed: (error) => {
            fail(error);
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
        const words = player.playing ? say`Pause` : say`Play`;
        if (play.getAttribute('aria-label') === words) return;
        play.setAttribute('aria-label', words);
        play.replaceChildren(icon(player.playing ? 'i-pause' : 'i-play'));
    }

    /** Reads and shows a film's text. @param {string} next */
    async function take(next) {
        const own = ++turn;
        wanted = next;
        try {
            const read = await tool.call('read', { text: next });
            if (own !== turn) return;
            script = read;
            film = { ...film, text: next };
            wanted = '';
            setText(problem, '');
            showScript();
            player.show(film, read);
        } catch (error) {
            if (own === turn) fail(error);
        }
    }

    /** Changes the script. @param {Partial<FilmScript>} values */
    function change(values) {
        if (!script) return;
        // The timeline follows the pointer before the text is read.
        script = { ...script, ...values };
        // Without views of its own, the film shows the page's view, which names its segment itself.
        if (!script.tracks.some(({ subject }) => subject === 'view')) script.segment = '';
        timeline.show(script);
        take(written(script));
    }

    function showScript() {
        if (!script) return;
        options.show(script);
        slider.max = String(script.frames - 1);
        if (document.activeElement !== text) setValue(text, film.text);
        timeline.show(script);
        adder.show(script, subjects);
        saving.show(script);
    }

    /** Shows a preset in place of the presets in a film's text. @param {import('../protocol.js').FilmPreset} preset @param {string} before */
    async function usePreset(preset, before) {
        try {
            await take(await tool.call('preset', { text: before, preset }));
        } catch (error) {
            fail(error);
        }
    }

    /** Shows a dive to a view about a segment, or to the segment in the middle. @param {import('../state.js').View | null} view */
    async function dive(view) {
        try {
            const next = await tool.call('dive', { film, text: script ? written(script) : FIRST, view });
            if (next) await take(next);
        } catch (error) {
            fail(error);
        }
    }

    /** @param {unknown} error */
    function fail(error) {
        if (!(error instanceof Cancelled)) showFailure(problem, error, begin);
    }

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
    button('close-film').addEventListener('click', () => dialog.close());
    dialog.addEventListener('click', (event) => event.target === dialog && !saving.busy && dialog.close());
    dialog.addEventListener('close', () => {
        player.close();
        saving.abort();
        tool.close();
    });

    button('film-embed').addEventListener('click', async () => {
        if (!script) return;
        if (location.protocol === 'file:' || isWhole())
            return toast(
                say`This page was opened from a disk. Put it on a web server to get code that works in other pages.`,
            );
        const { width, height } = script;
        const [most = width] = FRAMES.large ?? [];
        const scale = Math.min(1, most / width);
        const page = stable('film.html');
        const code = filmCode(
            store.state,
            await bestLink(store.state),
            film.text,
            page,
            Math.round(width * scale),
            Math.round(height * scale),
        );
        toast((await copyText(code)) ? say`Embed code copied` : say`The browser refused to copy.`);
    });

    /** Shows the wanted film, or the last one, and plays it. */
    async function begin() {
        try {
            subjects = await tool.call('subjects', { definition: film.definition });
        } catch (error) {
            return fail(error);
        }
        if (wanted || film.text) await take(wanted || film.text);
        else await usePreset({ kind: 'growth', n: store.state.iterations }, FIRST);
        // A film that fails tells why in place of playing.
        if (!problem.textContent) player.play();
        showPlay();
    }

    return {
        /** @param {string} [hash] of a link that may hold a film */
        async open(hash = '') {
            const { view } = store.state;
            const camera = stage.space ? stage.camera() : null;
            film = { ...film, definition: definitionOf(store.state), view: stage.space ? null : view, camera };
            wanted = filmIn(hash);
            setText(problem, '');
            presets.show();
            if (!dialog.open) dialog.showModal();
            await begin();
        },
    };
}
