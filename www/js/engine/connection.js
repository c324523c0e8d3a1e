/**
 * The connection to the drawing worker: starts the worker, hands over the core, watches that it answers, and requests
 * files that did not load again. The engine handles the worker's messages and decides whether a stopped worker is
 * replaced.
 *
 * A worker starts with the first part of the core, and gets the rest after its first picture or before a question. A
 * worker that stops without the rest has probably called it: the next worker starts with the whole core and the same
 * state.
 */

import { ours } from '../base/words.js';
import { core, forgetCore, hire, restOfCore } from './core.js';
import { SILENCE, STARTUP, createWatchdog } from './watchdog.js';
import { say } from '../base/words.js';

/** @typedef {import('./core.js').Hired} Hired */
/** @typedef {import('../protocol.js').FromWorker} FromWorker */
/** @typedef {import('../protocol.js').ToWorker} ToWorker */
/** The mates, which help with slow pictures. @typedef {{help: (worker: Hired, wasm: WebAssembly.Module, rest: WebAssembly.Module) => void, leave: () => void}} Mates */

/**
 * @typedef {object} ConnectionEvents
 * @property {() => void} begun the worker has the wasm and accepts messages
 * @property {(message: FromWorker) => void} received a message has come from the worker
 * @property {() => void} left the worker is gone; a fresh one knows no state
 * @property {(how: 'silent' | 'crashed', message: string) => void} stopped
 * @property {(how: 'loading' | 'unloadable', message: string) => void} loadFailed the worker's files did not load; `loading`: the files are requested again
 * @property {(silent: number) => void} doubted the worker has been silent for this many milliseconds, within its limit
 * @property {(id: number, error: Error) => void} unanswerable a question needs files that did not load
 * @property {() => boolean} owes whether the worker owes a picture or an answer
 */

/** Delays before files that did not load are requested again, in milliseconds. */
const DELAYS = [500, 1500, 4000];

/** After more workers in a row that stopped before any picture or answer, wait for new input before starting another. */
const MOST_FAILURES = 4;

/** @param {ConnectionEvents} events */
export function createConnection({ begun, received, left, stopped, loadFailed, doubted, unanswerable, owes }) {
    /** @type {Hired | null} */
    let worker = null;
    /** Whether the worker has sent any message, has been sent the wasm, and has started the wasm. */
    let [hasSpoken, ready, started] = [false, false, false];
    /** Whether the worker has the rest of the core, and whether the next one starts with it. */
    let [isWhole, startsWhole] = [false, false];
    /** The timer of the next load attempt. */
    let retry = 0;
    const attempts = createAttempts();
    const help = createHelp(() => worker);
    const watchdog = createWatchdog({
        patience,
        ping: () => worker?.postMessage({ type: 'ping' }),
        doubted,
        stopped: () => stopped('silent', say`the worker did not answer`),
    });

    function start() {
        clearTimeout(retry);
        leave();
        const fresh = hire();
        worker = fresh;
        fresh.onmessage = ({ data }) => worker === fresh && receive(data);
        fresh.onerror = (event) => {
            event.preventDefault();
            if (worker === fresh) fail(event.message || say`the worker did not start`);
        };
        Promise.all([core(), startsWhole ? restOfCore() : null]).then(
            ([wasm, rest]) => {
                if (worker !== fresh) return;
                fresh.postMessage({ type: 'init', wasm, words: ours });
                if (rest) join(fresh, rest);
                ready = true;
                begun();
            },
            (error) => worker === fresh && failLoading(error.message),
        );
        watchdog.watch();
    }

    /** Hands over the rest of the core. @param {Hired} fresh @param {WebAssembly.Module} wasm */
    function join(fresh, wasm) {
        fresh.postMessage({ type: 'rest', wasm });
        isWhole = true;
    }

    /** Completes the core of the worker. */
    async function complete() {
        const fresh = worker;
        const wasm = await restOfCore();
        startsWhole = true;
        if (fresh && worker === fresh && !isWhole) join(fresh, wasm);
    }

    /**
     * Asks a question. Most of them need the whole core.
     * @param {import('../protocol.js').Question} question
     */
    async function ask(question) {
        const asked = worker;
        try {
            if (question.type !== 'notation' && !isWhole) await complete();
            if (worker === asked) asked?.postMessage(question);
        } catch (error) {
            unanswerable(question.id, error instanceof Error ? error : new Error(String(error)));
        }
    }

    function leave() {
        help.leave();
        watchdog.leave();
        worker?.terminate();
        worker = null;
        [hasSpoken, ready, started, isWhole] = [false, false, false, false];
        left();
    }

    /** @param {FromWorker} message */
    function receive(message) {
        hasSpoken = true;
        watchdog.heard();
        if (message.type === 'ready') {
            started = true;
            attempts.loaded();
        }
        received(message);
        // If the rest does not load, it is requested again with the next picture.
        if (message.type === 'done' && !isWhole) complete().catch(() => {});
        if (message.type === 'fatal') fail(message.message, message.isEarly);
    }

    /** @param {string} message @param {boolean} [isEarly] whether the worker did not have the rest yet, which may be on its way */
    function fail(message, isEarly = !isWhole) {
        if (!started) return failLoading(message);
        if (!isEarly) return stopped('crashed', message);
        startsWhole = true;
        start();
    }

    /** The worker or its wasm did not load. @param {string} message */
    function failLoading(message) {
        leave();
        forgetCore();
        const delay = attempts.loadFailed();
        if (delay !== undefined) retry = window.setTimeout(start, delay);
        loadFailed(delay === undefined ? 'unloadable' : 'loading', message);
    }

    /** How long the worker may be silent now, in milliseconds; 0 while nothing is expected from it. */
    function patience() {
        if (!worker) return 0;
        if (!hasSpoken) return STARTUP;
        return started && !owes() ? 0 : SILENCE;
    }

    return {
        /** Whether the worker accepts messages. */
        get ready() {
            return ready;
        },

        start,
        leave,

        /** @param {ToWorker} message */
        post: (message) => worker?.postMessage(message),
        ask,

        /** Starts watching that the worker answers. */
        watch: watchdog.watch,

        /** Replaces a stopped worker. @returns {boolean} false if too many workers have stopped in a row */
        replace() {
            const may = attempts.failed();
            if (may) start();
            return may;
        },

        /** The worker has drawn or answered: resets the count of stopped workers. */
        proven: attempts.proven,

        /** New input or a question: starts a worker again after the last failure. */
        revive() {
            if (worker) return;
            // The new state may need the first part only.
            startsWhole = false;
            attempts.renew();
            start();
        },

        noteSlow: help.noteSlow,
        share: help.share,
    };
}

/** Counts stopped workers and failed loads in a row. */
function createAttempts() {
    let failures = 0;
    let failedLoads = 0;
    return {
        /** A worker has stopped. @returns {boolean} whether to start another */
        failed() {
            failures += 1;
            return failures <= MOST_FAILURES;
        },

        /** A worker has drawn or answered. */
        proven() {
            failures = 0;
        },

        /** A load has failed. @returns {number | undefined} the delay before the next attempt in milliseconds; undefined for no further attempt */
        loadFailed() {
            failedLoads += 1;
            return DELAYS[failedLoads - 1];
        },

        loaded() {
            failedLoads = 0;
        },

        /** Allows new attempts after the last one failed. */
        renew() {
            if (failures > MOST_FAILURES) failures = 0;
            if (failedLoads > DELAYS.length) failedLoads = 0;
        },
    };
}

/** Calls the mates while pictures are slow. @param {() => Hired | null} worker */
function createHelp(worker) {
    /** @type {Mates | null} */
    let mates = null;
    /** Whether the last picture was slow. */
    let slow = false;

    /** Lets mates help with the next picture. */
    async function help() {
        const helped = worker();
        const [wasm, rest] = await Promise.all([core(), restOfCore()]);
        if (helped && worker() === helped) mates?.help(helped, wasm, rest);
    }

    return {
        leave: () => mates?.leave(),

        /** A picture has come. @param {boolean} long whether the picture was slow */
        noteSlow(long) {
            slow = long;
            if (slow) help();
        },

        /** @param {Mates} newMates */
        share(newMates) {
            mates = newMates;
            if (slow) help();
        },
    };
}
