/**
 * The connection to the worker that draws: starts it, hands it the wasm, watches that it answers, and tries again where its
 * files do not load. The engine says what to do with what the worker sends, and whether another takes its place.
 */

import { core, forgetCore, hire } from './core.js';
import { SILENCE, STARTUP, createWatchdog } from './watchdog.js';

/** @typedef {import('./core.js').Hired} Hired */
/** @typedef {import('../protocol.js').FromWorker} FromWorker */
/** @typedef {import('../protocol.js').ToWorker} ToWorker */
/** The mates, which help with pictures that take long. @typedef {{help: (worker: Hired, wasm: WebAssembly.Module) => void, leave: () => void}} Helpers */

/**
 * @typedef {object} Events
 * @property {() => void} begun the worker has its wasm and takes messages
 * @property {(message: FromWorker) => void} received every message of the worker's
 * @property {() => void} left the worker is gone: a fresh one knows nothing
 * @property {(how: 'silent' | 'crashed', message: string) => void} stopped
 * @property {(how: 'loading' | 'unloadable', message: string) => void} missed the worker's files did not load; `loading`: they are tried again
 * @property {(silent: number) => void} doubted the worker has been silent for this long, in milliseconds, but not yet for too long
 * @property {() => boolean} owes whether the worker owes a picture or an answer
 */

/** What does not load is tried again after these times, in milliseconds. */
const DELAYS = [500, 1500, 4000];

/** After so many workers in a row that have stopped before they drew anything none is started by itself. */
const MOST_FAILURES = 4;

/** @param {Events} events */
export function createConnection({ begun, received, left, stopped, missed, doubted, owes }) {
    /** @type {Hired | null} */
    let worker = null;
    /** Whether the worker has said anything, has been handed the wasm, and has begun to work. */
    let [met, ready, started] = [false, false, false];
    /** The timer of the next try to load. */
    let retry = 0;
    const attempts = createAttempts();
    const help = createHelp(() => worker);
    const watchdog = createWatchdog({ patience, ping: () => worker?.postMessage({ type: 'ping' }), doubted, stopped: () => stopped('silent', 'the worker did not answer') });

    function start() {
        clearTimeout(retry);
        leave();
        const fresh = hire();
        worker = fresh;
        fresh.onmessage = ({ data }) => worker === fresh && receive(data);
        fresh.onerror = (event) => {
            event.preventDefault();
            if (worker === fresh) fail(event.message || 'the worker did not start');
        };
        core().then(
            (wasm) => {
                if (worker !== fresh) return;
                fresh.postMessage({ type: 'init', wasm });
                ready = true;
                begun();
            },
            (error) => worker === fresh && miss(error.message),
        );
        watchdog.watch();
    }

    function leave() {
        help.leave();
        watchdog.leave();
        worker?.terminate();
        worker = null;
        [met, ready, started] = [false, false, false];
        left();
    }

    /** @param {FromWorker} message */
    function receive(message) {
        met = true;
        watchdog.heard();
        if (message.type === 'ready') {
            started = true;
            attempts.loaded();
        }
        received(message);
        if (message.type === 'fatal') fail(message.message);
    }

    /** @param {string} message */
    function fail(message) {
        if (started) stopped('crashed', message);
        else miss(message);
    }

    /** The worker or its wasm does not load. @param {string} message */
    function miss(message) {
        leave();
        forgetCore();
        const delay = attempts.missed();
        if (delay !== undefined) retry = window.setTimeout(start, delay);
        missed(delay === undefined ? 'unloadable' : 'loading', message);
    }

    /** How long the worker may be silent now; 0 while it owes nothing. */
    function patience() {
        if (!worker) return 0;
        if (!met) return STARTUP;
        return started && !owes() ? 0 : SILENCE;
    }

    return {
        /** Whether the worker takes messages. */
        get ready() {
            return ready;
        },

        start,
        leave,

        /** @param {ToWorker} message */
        post: (message) => worker?.postMessage(message),

        /** The worker has been asked for something. */
        watch: watchdog.watch,

        /** A fresh worker takes the place of one that has stopped. @returns {boolean} whether it may: too many in a row are no use */
        replace() {
            const may = attempts.failed();
            if (may) start();
            return may;
        },

        /** The worker has drawn or answered: workers before it that stopped count no more. */
        proven: attempts.proven,

        /** After a failure for good, new input or a question is worth a fresh start. */
        revive() {
            if (worker) return;
            attempts.renew();
            start();
        },

        took: help.took,
        share: help.share,
    };
}

/** Counts the workers that have stopped, and the loads that have failed, in a row. */
function createAttempts() {
    let failures = 0;
    let misses = 0;
    return {
        /** A worker has stopped. @returns {boolean} whether another may be started */
        failed() {
            failures += 1;
            return failures <= MOST_FAILURES;
        },

        /** A worker has done something. */
        proven() {
            failures = 0;
        },

        /** A load has failed. @returns {number | undefined} after how long it is tried again, in milliseconds, if it is */
        missed() {
            misses += 1;
            return DELAYS[misses - 1];
        },

        loaded() {
            misses = 0;
        },

        /** What has failed for good may be tried again. */
        renew() {
            if (failures > MOST_FAILURES) failures = 0;
            if (misses > DELAYS.length) misses = 0;
        },
    };
}

/** Calls the mates while the worker's pictures take long. @param {() => Hired | null} worker */
function createHelp(worker) {
    /** @type {Helpers | null} */
    let mates = null;
    /** Whether the last picture took long. */
    let slow = false;

    /** The next picture is made by several workers. */
    async function help() {
        const helped = worker();
        const wasm = await core();
        if (helped && worker() === helped) mates?.help(helped, wasm);
    }

    return {
        leave: () => mates?.leave(),

        /** A picture has come. @param {boolean} long whether it took long */
        took(long) {
            slow = long;
            if (slow) help();
        },

        /** @param {Helpers} helpers */
        share(helpers) {
            mates = helpers;
            if (slow) help();
        },
    };
}
