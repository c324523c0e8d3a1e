/**
 * Notices a worker that has stopped: one that owes something and says nothing. The page pings it while it owes something,
 * and a healthy worker answers from its event loop, to which it returns every few milliseconds.
 */

/** A worker that is silent for this long has stopped, in milliseconds. */
export const SILENCE = 4000;
/** The same before its first word: its script may come from a slow server. */
export const STARTUP = 15_000;
/** Between two pings. */
const BEAT = 250;
/** Beats that are farther apart than this: the machine has slept in between. */
const SLEEP = 5000;

/**
 * How long a worker has been silent, one beat later. Time in which the machine slept or nobody could see the page does
 * not count, and of a beat that came late, because the page was busy, only the length of two.
 * @param {number} silent so far
 * @param {number} apart since the beat before
 * @param {boolean} visible
 */
export function silenceAfter(silent, apart, visible) {
    return !visible || apart > SLEEP ? 0 : silent + Math.min(apart, 2 * BEAT);
}

/**
 * @param {object} worker
 * @param {() => number} worker.patience how long it may be silent now, in milliseconds; 0 while it owes nothing
 * @param {() => void} worker.ping
 * @param {(silent: number) => void} [worker.doubted] it has been silent for so long, but not yet for too long
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
        /** The worker has been asked for something. */
        watch() {
            if (timer !== 0 || patience() === 0) return;
            silent = 0;
            last = performance.now();
            timer = window.setTimeout(beat, BEAT);
        },

        /** The worker has said something. */
        heard() {
            silent = 0;
        },

        /** There is another worker, or none. */
        leave() {
            clearTimeout(timer);
            timer = 0;
            silent = 0;
        },
    };
}
