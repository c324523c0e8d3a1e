/** The buttons that save a film as a file, and the progress of the file in the making. */

import { toast } from '../announce.js';
import { decimal } from '../numerals.js';
import { icon, make, setText } from '../dom.js';
import { download, fileName } from '../download.js';
import { say } from '../words.js';
import { fileOf, videosOf } from './save.js';

/** @typedef {import('../protocol.js').Film} Film */
/** @typedef {import('../protocol.js').FilmScript} FilmScript */

const KINDS = /** @type {import('./save.js').FilmFile[]} */ (['mp4', 'webm', 'gif']);

/**
 * @param {import('../store.js').Store} store
 * @param {{film: () => {film: Film, script: FilmScript | null}, start: () => void}} on `start` is called before a file is made
 */
export function createSaving(store, { film: present, start: begin }) {
    const kinds = KINDS.map((kind) => ({
        kind,
        button: make(
            'button',
            {
                class: 'button',
                type: 'button',
                'data-film': kind,
                hidden: kind !== 'gif',
            },
            icon('i-save'),
            kind === 'webm' ? 'WebM' : kind.toUpperCase(),
        ),
    }));
    const bar = make('progress', { id: 'film-progress', max: '1', value: '0', 'aria-label': say`Progress` });
    const cancel = make('button', { id: 'film-cancel', class: 'button quiet', type: 'button' }, say`Cancel`);
    const told = make('span', { class: 'note', role: 'status' });
    const progress = make('div', { class: 'film-progress idle' }, bar, told, cancel);
    const [before = '', after = ''] =
        say`WebM and MP4 files are written by ${'\n'} (Mozilla Public License 2.0).`.split('\n');
    const credit = make(
        'p',
        { class: 'note film-credit' },
        before,
        make('a', { href: 'https://mediabunny.dev', target: '_blank', rel: 'noopener' }, 'Mediabunny'),
        after,
    );
    /** The file in the making. @type {AbortController | null} */
    let saving = null;

    for (const { kind, button } of kinds) button.addEventListener('click', () => save(kind));
    cancel.addEventListener('click', () => saving?.abort());

    /** @param {import('./save.js').FilmFile} kind */
    async function save(kind) {
        const { film, script } = present();
        if (!script || saving) return;
        const { frames } = script;
        const mine = new AbortController();
        saving = mine;
        begin();
        const start = performance.now();
        const show = (/** @type {number} */ done) => {
            bar.value = done / frames;
            const left = done > 0 ? ((performance.now() - start) / done) * (frames - done) : NaN;
            setText(
                told,
                Number.isFinite(left)
                    ? say`Frame ${String(done)} of ${String(frames)}, ${String(Math.ceil(left / 1000))} s left`
                    : say`Frame ${String(done)} of ${String(frames)}`,
            );
        };
        show(0);
        progress.classList.remove('idle');
        for (const { button } of kinds) button.disabled = true;
        try {
            const blob = await fileOf(kind, film, script, { signal: mine.signal, progress: show });
            download(blob, `${fileName(store.state)}.${kind}`);
            toast(
                say`Saved: ${decimal(blob.size / 1e6, 1)} MB, made in ${decimal((performance.now() - start) / 1000, 1)} s`,
            );
        } catch (error) {
            if (!mine.signal.aborted) toast(say`Not saved: ${String(error instanceof Error ? error.message : error)}.`);
        } finally {
            saving = null;
            progress.classList.add('idle');
            for (const { button } of kinds) button.disabled = false;
        }
    }

    return {
        buttons: kinds.map(({ button }) => button),
        progress,
        credit,
        get busy() {
            return saving !== null;
        },
        abort() {
            saving?.abort();
        },
        /** Shows the kinds of video that the browser can write. @param {FilmScript} script */
        async show(script) {
            const found = await videosOf(script).catch(() => []);
            for (const { kind, button } of kinds)
                button.hidden = kind !== 'gif' && !found.some((each) => each === kind);
            // The best kind that the browser can write.
            const first = kinds.find(({ button }) => !button.hidden);
            for (const { button } of kinds) button.classList.toggle('primary', button === first?.button);
            credit.hidden = found.length === 0;
        },
    };
}
