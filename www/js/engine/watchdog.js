/**
 * Detects a worker that owes an answer and is silent. The page pings the worker while it owes something; a healthy
 * worker returns to its event loop every few milliseconds and answers.
 */

/** A worker counts as stopped after this silence, in milliseconds. */
export const SILENCE = 4000;
/** The limit before the worker's first message, in milliseconds: its script may come from a slow server. */
export const STARTUP = 15_000;
/** Time between two pings, in milliseconds. */
const BEAT = 250;
/** Beats farther apart than this, in milliseconds, mean that the machine slept. */
const SLEEP = 5000;

/**
 * How long a worker has been silent, one beat later, in milliseconds. Time does not count while the machine slept or
 * the page was hidden. A beat that came late, because the page was busy, counts as at most two beats.
 * @param {number} silent so far
 * @param {number} apart since the beat before
 * @param {boolean} visible
 */
export function silenceAfter(silent, apart, visible) {
    return !visible || apart > SLEEP ? 0 : silent + Math.min(apart, 2 * BEAT);
}

/**
 * @param {object} worker
 * @param {() => number} worker.patience how long the worker may be silent now, in milliseconds; 0 while nothing is expected from it
 * @param {() => void} worker.ping
 * @param {(silent: number) => void} [worker.doubted] the worker has been silent for this many milliseconds, within its limit
 * @param {() => void} worker.stopped
 */
export function createWatchdog({ patience, ping, doubted, stopped }) {
    let timer = 0;
    let silent = 0;
    let last = 0;

    function beat() {
        timer = 0;
        const most = patience();
        if (most === 0) return;
        const now = performance.now();
        silent = silenceAfter(silent, now - last, document.visibilityState === 'visible');
        last = now;
        if (silent < most) {
            doubted?.(silent);
            ping();
            timer = window.setTimeout(beat, BEAT);
            return;
        }
        silent = 0;
        stopped();
    }

    return {
        /** Starts watching, if the worker owes something. */
        watch() {
            if (timer !== 0 || patience() === 0) return;
            silent = 0;
            last = performance.now();
            timer = window.setTimeout(beat, BEAT);
        },

        /** The worker has sent a message. */
        heard() {
            silent = 0;
        },

        /** The worker is gone: stops watching. */
        leave() {
            clearTimeout(timer);
            timer = 0;
            silent = 0;
        },
    };
}
