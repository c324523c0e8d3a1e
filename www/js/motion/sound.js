/** The drawing as sound: the notes of the turtle's walk, in step with playback or by themselves. */

import markup from './sound.html';
import styles from '../../css/sound.css';
import { toast } from '../base/announce.js';
import { button, html, input, make } from '../base/dom.js';
import { addElements } from '../base/late.js';
import { createSettings } from '../state/rows.js';
import { optionOf } from '../save/choices.js';
import { definitionOf, sameDrawing } from '../state/state.js';
import { createTool } from '../engine/tool.js';
import { createFollower } from './follower.js';
import { createInstrument } from './instrument.js';
import { createTogether } from './together.js';
import { reasonOf, said, say } from '../base/words.js';

/** The choices on the page; a file has more. */
const CHOICES = /** @type {const} */ (['pitch', 'time', 'scale']);
/** The loudness at the first time, in percent. */
const VOLUME = 60;
/** The key in the storage. */
const KEY = 'sound';

/**
 * The bar of sound and its voice.
 * @typedef {object} Sound
 * @property {import('../dialogs/dialogs.js').Page['store']} store
 * @property {import('../dialogs/dialogs.js').Page['listening']} listening
 * @property {HTMLButtonElement} listen
 * @property {ReturnType<typeof createTool<import('../protocol.js').SoundCalls>>} tool
 * @property {{context: AudioContext, instrument: ReturnType<typeof createInstrument>} | null} voice
 * @property {Promise<unknown> | null} told Whether the tool has the present system
 * @property {number} asked The number of the last tune that was asked for
 * @property {ReturnType<typeof createSettings>} settings
 * @property {HTMLElement} row
 * @property {ReturnType<typeof createRow>['choices']} choices
 * @property {() => number} volume
 * @property {ReturnType<typeof createFollower>} follower
 * @property {ReturnType<typeof createTogether>} together
 */

/** @param {import('../dialogs/dialogs.js').Page} page */
export function createSound({ store, storage, listening }) {
    const settings = createSettings(storage, KEY);
    const { row, choices, volume } = createRow(settings.read(), (name) => changed(self, name));

    const follower = createFollower({
        async ask(from, stride, count) {
            await system(self);
            return (await self.tool.call('part', { from, stride, count, options: choices() })).notes;
        },
        play: (note, seconds) => self.voice?.instrument.play(note, self.voice.instrument.now, seconds),
    });
    const together = createTogether({
        now: () => self.voice?.instrument.now ?? 0,
        play: (note, at, seconds) => self.voice?.instrument.play(note, at, seconds),
        hush: () => self.voice?.instrument.hush(),
        present: listening.present,
        mark: listening.mark,
    });
    /** @type {Sound} */
    const self = {
        store,
        listening,
        listen: button('listen'),
        tool: createTool('sound'),
        voice: null,
        told: null,
        asked: 0,
        settings,
        row,
        choices,
        volume,
        follower,
        together,
    };

    settings.show(shown(self));
    html('drawing').addEventListener('walk', (event) => {
        if (self.voice && choices()['time'] !== 'length')
            void follower.follow(/** @type {CustomEvent<Parameters<typeof follower.follow>[0]>} */ (event).detail);
    });
    store.subscribe((state, before) => {
        if (!sameDrawing(state, before)) forget(self);
    });
    // Nothing sounds beside a closed bar.
    new MutationObserver(() => html('playback').hidden && self.voice && set(self, false)).observe(html('playback'), {
        attributeFilter: ['hidden'],
    });

    return {
        /** Begins to sound, or ends. */
        open: () => set(self, self.voice === null),
    };
}

/** @param {Sound} self */
const shown = (self) => ({ ...self.choices(), volume: self.volume() });

/** Tells the tool the system, once. @param {Sound} self */
function system(self) {
    self.told ??= self.tool.call('listen', { definition: definitionOf(self.store.state) });
    return self.told;
}

/** @param {Sound} self */
function forget(self) {
    self.told = null;
    self.asked++;
    self.follower.forget();
    self.together.leave();
}

/** Plays, by length from the beginning. @param {Sound} self */
async function begin(self) {
    if (self.choices()['time'] !== 'length') return self.listening.play();
    const own = ++self.asked;
    try {
        await system(self);
        const tune = await self.tool.call('tune', { options: self.choices() });
        if (self.voice && own === self.asked) self.together.begin(tune);
    } catch (error) {
        if (own === self.asked) toast(say`No sound: ${reasonOf(error)}`);
    }
}

/** A choice has changed. @param {Sound} self @param {string} name */
function changed(self, name) {
    self.settings.write(shown(self));
    if (name === 'volume') return self.voice?.instrument.setVolume(self.volume() / 100);
    self.asked++;
    self.follower.forget();
    self.together.leave();
    if (self.voice) void begin(self);
}

/** @param {Sound} self @param {boolean} on */
function set(self, on) {
    self.listen.setAttribute('aria-pressed', String(on));
    self.row.hidden = !on;
    if (on) {
        const context = new AudioContext();
        const instrument = createInstrument(context);
        instrument.setVolume(self.volume() / 100);
        self.voice = { context, instrument };
        return void begin(self);
    }
    forget(self);
    void self.voice?.context.close();
    self.voice = null;
    self.tool.leave();
}

/** The row with the choices, below the playback bar. @param {Record<string, unknown>} stored @param {(name: string) => void} changed */
function createRow(stored, changed) {
    const lists = CHOICES.map((name) => {
        const option = optionOf(name);
        const [words, usual] = option.kind === 'word' ? [option.words, option.default] : [{}, ''];
        const list = make(
            'select',
            { id: `sound-${name}`, title: said(option.help) },
            ...Object.entries(words).map(([word, text]) => make('option', { value: word }, said(text))),
        );
        const before = String(stored[name]);
        list.value = before in words ? before : usual;
        list.addEventListener('change', () => changed(name));
        return { name, list, label: make('label', { class: 'sound-choice' }, said(option.label), list) };
    });
    const loudness = make('input', { id: 'sound-volume', type: 'range', min: '0', max: '100', step: '1' });
    const before = stored['volume'];
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
