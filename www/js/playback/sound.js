/** The drawing as sound: the notes of the turtle's walk, in step with playback or by themselves. */

import markup from './sound.html';
import styles from '../../css/sound.css';
import { toast } from '../announce.js';
import { button, html, input, make } from '../dom.js';
import { addElements } from '../late.js';
import { optionOf } from '../save/choices.js';
import { definitionOf, sameDrawing } from '../state.js';
import { createTool } from '../tool.js';
import { createFollower } from './follower.js';
import { createInstrument } from './instrument.js';
import { createTogether } from './together.js';
import { said, say } from '../words.js';

/** The choices on the page; a file has more. */
const CHOICES = /** @type {const} */ (['pitch', 'time', 'scale']);
/** The loudness at the first time, in percent. */
const VOLUME = 60;
/** The key in the storage. */
const KEY = 'sound';

/** @param {import('../dialogs.js').Page} page */
export function createSound({ store, storage, listening }) {
    const listen = button('listen');
    /** @type {ReturnType<typeof createTool<import('../protocol.js').SoundCalls>>} */
    const tool = createTool('sound');
    /** @type {{context: AudioContext, instrument: ReturnType<typeof createInstrument>} | null} */
    let voice = null;
    /** Whether the tool has the present system. @type {Promise<unknown> | null} */
    let told = null;
    /** The number of the last tune that was asked for. */
    let asked = 0;
    const stored = /** @type {Record<string, unknown> | null} */ (storage.read(KEY) ?? null);
    const { row, choices, volume } = createRow(stored, changed);

    const follower = createFollower({
        async ask(from, stride, count) {
            await system();
            return (await tool.call('part', { from, stride, count, options: choices() })).notes;
        },
        play: (note, seconds) => voice?.instrument.play(note, voice.instrument.now, seconds),
    });
    const together = createTogether({
        now: () => voice?.instrument.now ?? 0,
        play: (note, at, seconds) => voice?.instrument.play(note, at, seconds),
        hush: () => voice?.instrument.hush(),
        present: listening.present,
        mark: listening.mark,
    });

    /** Tells the tool the system, once. */
    function system() {
        told ??= tool.call('listen', { definition: definitionOf(store.state) });
        return told;
    }

    function forget() {
        told = null;
        asked++;
        follower.forget();
        together.leave();
    }

    /** Plays, by length from the beginning. */
    async function begin() {
        if (choices()['time'] !== 'length') return listening.play();
        const own = ++asked;
        try {
            await system();
            const tune = await tool.call('tune', { options: choices() });
            if (voice && own === asked) together.begin(tune);
        } catch (error) {
            if (own === asked) toast(say`No sound: ${error instanceof Error ? error.message : String(error)}`);
        }
    }

    /** A choice has changed. @param {string} name */
    function changed(name) {
        storage.write(KEY, { ...choices(), volume: volume() });
        if (name === 'volume') return voice?.instrument.setVolume(volume() / 100);
        asked++;
        follower.forget();
        together.leave();
        if (voice) void begin();
    }

    html('drawing').addEventListener('walk', (event) => {
        if (voice && choices()['time'] !== 'length')
            void follower.follow(/** @type {CustomEvent<Parameters<typeof follower.follow>[0]>} */ (event).detail);
    });
    store.subscribe((state, before) => {
        if (!sameDrawing(state, before)) forget();
    });
    // Nothing sounds beside a closed bar.
    new MutationObserver(() => html('playback').hidden && voice && set(false)).observe(html('playback'), {
        attributeFilter: ['hidden'],
    });

    /** @param {boolean} on */
    function set(on) {
        listen.setAttribute('aria-pressed', String(on));
        row.hidden = !on;
        if (on) {
            const context = new AudioContext();
            const instrument = createInstrument(context);
            instrument.setVolume(volume() / 100);
            voice = { context, instrument };
            return void begin();
        }
        forget();
        void voice?.context.close();
        voice = null;
        tool.leave();
    }

    return {
        /** Begins to sound, or ends. */
        open: () => set(voice === null),
    };
}

/** The row with the choices, below the playback bar. @param {Record<string, unknown> | null} stored @param {(name: string) => void} changed */
function createRow(stored, changed) {
    const lists = CHOICES.map((name) => {
        const option = optionOf(name);
        const [words, usual] = option.kind === 'word' ? [option.words, option.default] : [{}, ''];
        const list = make(
            'select',
            { id: `sound-${name}`, title: said(option.help) },
            ...Object.entries(words).map(([word, text]) => make('option', { value: word }, said(text))),
        );
        const before = String(stored?.[name]);
        list.value = before in words ? before : usual;
        list.addEventListener('change', () => changed(name));
        return { name, list, label: make('label', { class: 'sound-choice' }, said(option.label), list) };
    });
    const loudness = make('input', { id: 'sound-volume', type: 'range', min: '0', max: '100', step: '1' });
    const before = stored?.['volume'];
    loudness.value = String(typeof before === 'number' ? before : VOLUME);
    const paint = () => loudness.style.setProperty('--at', String(Number(loudness.value) / 100));
    loudness.addEventListener('input', () => {
        paint();
        changed('volume');
    });
    paint();
    addElements(markup, [styles], html('playback'));
    const row = html('play-sound');
    row.append(...lists.map(({ label }) => label), make('label', { class: 'sound-choice' }, say`Volume`, loudness));
    return {
        row,
        choices: () => Object.fromEntries(lists.map(({ name, list }) => [name, list.value])),
        volume: () => Number(input('sound-volume').value),
    };
}
