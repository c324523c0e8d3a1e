/** The buttons that save a film as a file, and the progress of the file in the making. */

import { toast } from '../base/announce.js';
import { decimal } from '../base/numerals.js';
import { icon, make, setText } from '../base/dom.js';
import { download, fileName } from '../base/download.js';
import { reasonOf, say } from '../base/words.js';
import { fileOf, videosOf } from './save.js';

/** @typedef {import('../protocol.js').Film} Film */
/** @typedef {import('../protocol.js').FilmScript} FilmScript */

const KINDS = /** @type {import('./save.js').FilmFile[]} */ (['mp4', 'webm', 'gif']);

/**
 * The buttons and the file in the making.
 * @typedef {object} Saving
 * @property {import('../state/store.js').Store} store
 * @property {() => {film: Film, script: FilmScript | null}} present
 * @property {() => void} begin
 * @property {{kind: import('./save.js').FilmFile, button: HTMLButtonElement}[]} kinds
 * @property {HTMLElementTagNameMap['progress']} bar
 * @property {HTMLElementTagNameMap['span']} told
 * @property {HTMLElementTagNameMap['div']} progress
 * @property {AbortController | null} saving The file in the making
 */

/**
 * @param {import('../state/store.js').Store} store
 * @param {{film: () => {film: Film, script: FilmScript | null}, start: () => void}} on `start` is called before a file is made
 */
export function createSaving(store, { film: present, start: begin }) {
    const bar = make('progress', { id: 'film-progress', max: '1', value: '0', 'aria-label': say`Progress` });
    const cancel = make('button', { id: 'film-cancel', class: 'button quiet' }, say`Cancel`);
    const told = make('span', { class: 'note', role: 'status' });
    const progress = make('div', { class: 'film-progress idle' }, bar, told, cancel);
    /** @type {Saving} */
    const self = {
        store,
        present,
        begin,
        kinds: KINDS.map((kind) => ({
            kind,
            button: make(
                'button',
                {
                    class: 'button',
                    'data-film': kind,
                    hidden: kind !== 'gif',
                },
                icon('i-save'),
                kind === 'webm' ? 'WebM' : kind.toUpperCase(),
            ),
        })),
        bar,
        told,
        progress,
        saving: null,
    };

    const [before = '', after = ''] =
        say`WebM and MP4 files are written by ${'\n'} (Mozilla Public License 2.0).`.split('\n');
    const credit = make(
        'p',
        { class: 'note film-credit' },
        before,
        make('a', { href: 'https://mediabunny.dev', target: '_blank', rel: 'noopener' }, 'Mediabunny'),
        after,
    );

    for (const { kind, button } of self.kinds) button.addEventListener('click', () => save(self, kind));
    cancel.addEventListener('click', () => self.saving?.abort());

    return {
        buttons: self.kinds.map(({ button }) => button),
        progress,
        credit,
        get busy() {
            return self.saving !== null;
        },
        abort() {
            self.saving?.abort();
        },
        /** Shows the kinds of video that the browser can write. @param {FilmScript} script */
        async show(script) {
            const found = await videosOf(script).catch(() => []);
            for (const { kind, button } of self.kinds)
                button.hidden = kind !== 'gif' && !found.some((each) => each === kind);
            // The best kind that the browser can write.
            const first = self.kinds.find(({ button }) => !button.hidden);
            for (const { button } of self.kinds) button.classList.toggle('primary', button === first?.button);
            credit.hidden = found.length === 0;
        },
    };
}

/** @param {Saving} self @param {import('./save.js').FilmFile} kind */
async function save(self, kind) {
    const { film, script } = self.present();
    if (!script || self.saving) return;
    const { frames } = script;
    const mine = new AbortController();
    self.saving = mine;
    self.begin();
    const start = performance.now();
    const show = (/** @type {number} */ done) => {
        self.bar.value = done / frames;
        const left = done > 0 ? ((performance.now() - start) / done) * (frames - done) : NaN;
        setText(
            self.told,
            Number.isFinite(left)
                ? say`Frame ${String(done)} of ${String(frames)}, ${String(Math.ceil(left / 1000))} s left`
                : say`Frame ${String(done)} of ${String(frames)}`,
        );
    };
    show(0);
    self.progress.classList.remove('idle');
    for (const { button } of self.kinds) button.disabled = true;
    try {
        const blob = await fileOf(kind, film, script, { signal: mine.signal, progress: show });
        download(blob, `${fileName(self.store.state)}.${kind}`);
        toast(
            say`Saved: ${decimal(blob.size / 1e6, 1)} MB, made in ${decimal((performance.now() - start) / 1000, 1)} s`,
        );
    } catch (error) {
        if (!mine.signal.aborted) toast(say`Not saved: ${reasonOf(error)}.`);
    } finally {
        self.saving = null;
        self.progress.classList.add('idle');
        for (const { button } of self.kinds) button.disabled = false;
    }
}
