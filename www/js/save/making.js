/**
 * The file that the dialog shows, made in the background. A new choice cancels the former file. A file that grows large
 * before the reader has asked for it is given up, and made anew when it is saved.
 */

import { reasonOf } from '../base/words.js';

/** @typedef {import('./save-file.js').FileWanted} FileWanted */
/** @typedef {import('../protocol.js').Diagnostic} Diagnostic */

/** Larger files are not made before the reader asks for them, in bytes. */
const LARGEST_UNASKED = 32 << 20;
/** The length of the text that the preview shows, in bytes. */
export const SHOWN = 4096;

/**
 * `made`: the file is there. `failed`: it cannot be made, for the reasons told. `large`: it is larger than `size`, and
 * is made when it is saved. `head` is the beginning of the file.
 * @typedef {object} Made
 * @property {'making' | 'made' | 'failed' | 'large' | 'cancelled'} state
 * @property {number} size in bytes, so far
 * @property {Blob | null} head
 * @property {Blob | null} blob
 * @property {Diagnostic[]} diagnostics
 * @property {string | null} reason why the file cannot be made, if no diagnostic tells
 */

/** @typedef {{control: AbortController, isAsked: boolean, made: Made, ended: Promise<Made>}} Run */

/**
 * @param {(wanted: FileWanted, how: {signal: AbortSignal, progress: (size: number, piece: Blob) => void}) => Promise<import('./exports.js').Exported>} make
 * @param {(made: Made) => void} changed
 */
export function createMaking(make, changed) {
    /** The last file begun, unless it was cancelled. @type {Run | null} */
    let current = null;

    function cancel() {
        const run = current;
        current = null;
        run?.control.abort();
    }

    /** @param {Run} run @param {Partial<Made>} news */
    function tell(run, news) {
        run.made = { ...run.made, ...news };
        if (run === current) changed(run.made);
        return run.made;
    }

    /** @param {Run} run @param {FileWanted} wanted @returns {Promise<Made>} */
    async function finish(run, wanted) {
        try {
            const { blob, diagnostics } = await make(wanted, {
                signal: run.control.signal,
                progress(size, piece) {
                    const { state, head } = run.made;
                    if (state !== 'making') return;
                    tell(run, {
                        size,
                        head:
                            head && head.size >= SHOWN
                                ? head
                                : new Blob([...(head ? [head] : []), piece]).slice(0, SHOWN),
                    });
                    if (run.isAsked || size <= LARGEST_UNASKED) return;
                    tell(run, { state: 'large' });
                    run.control.abort();
                },
            });
            return tell(run, {
                state: blob ? 'made' : 'failed',
                size: blob?.size ?? 0,
                head: blob?.slice(0, SHOWN) ?? null,
                blob,
                diagnostics,
            });
        } catch (error) {
            // The class of the error would not tell: this module may have been loaded apart from the tool's.
            if (run.control.signal.aborted)
                return run.made.state === 'large' ? run.made : tell(run, { state: 'cancelled' });
            return tell(run, { state: 'failed', reason: reasonOf(error) });
        }
    }

    /** @param {FileWanted} wanted @param {boolean} isAsked whether the file may be of any size */
    function begin(wanted, isAsked) {
        cancel();
        /** @type {Made} */
        const made = { state: 'making', size: 0, head: null, blob: null, diagnostics: [], reason: null };
        const run = { control: new AbortController(), isAsked, made, ended: Promise.resolve(made) };
        current = run;
        changed(made);
        run.ended = finish(run, wanted);
        return run;
    }

    return {
        cancel,

        /** Makes a file in the background. @param {FileWanted} wanted */
        show: (wanted) => void begin(wanted, false),

        /** The whole file: the one in the background, if there is one of this kind. @param {FileWanted} wanted @returns {Promise<Made>} */
        whole(wanted) {
            if (current?.made.state !== 'making' && current?.made.state !== 'made') return begin(wanted, true).ended;
            current.isAsked = true;
            return current.ended;
        },
    };
}
