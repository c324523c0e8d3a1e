/**
 * Mates: workers that draw panes of slow pictures in space. Mates are hired when a picture was slow, and dismissed when
 * no picture has been slow for a while. The drawing worker talks to its mates directly and can draw everything without
 * them.
 */

import { hire } from './core.js';
import { SILENCE, STARTUP, createWatchdog } from './watchdog.js';

/** @typedef {import('./core.js').Hired} Hired */

const MAX_MATES = 3;
/** Mates are hired only on machines with this much memory, in gigabytes, as far as the browser tells. */
const MIN_MEMORY = 4;
/** Mates are dismissed after this time without a slow picture, in milliseconds. */
const IDLE_TIME = 30_000;

/**
 * The number of mates: the drawing worker needs a core for itself, and each mate needs memory.
 * @param {{hardwareConcurrency?: number, deviceMemory?: number}} machine
 */
export const matesOn = ({ hardwareConcurrency = 1, deviceMemory = MIN_MEMORY }) =>
    deviceMemory < MIN_MEMORY ? 0 : Math.max(0, Math.min(hardwareConcurrency - 1, MAX_MATES));

/** @param {number} count */
export function createMates(count) {
    /** The hired mates and their watchdogs. @type {{mate: Hired, watchdog: ReturnType<typeof createWatchdog>}[]} */
    let hired = [];
    /** The worker that the mates help. @type {Hired | null} */
    let master = null;
    let timer = 0;

    function leave() {
        clearTimeout(timer);
        for (const { mate, watchdog } of hired) {
            watchdog.leave();
            mate.terminate();
        }
        hired = [];
        master?.postMessage({ type: 'mates', ports: [] });
        master = null;
    }

    /** Hires a mate. @param {WebAssembly.Module} wasm @param {WebAssembly.Module} rest @returns the port to the mate */
    function hireMate(wasm, rest) {
        const mate = hire();
        const { port1, port2 } = new MessageChannel();
        let hasSpoken = false;
        const watchdog = createWatchdog({
            patience: () => (hasSpoken ? SILENCE : STARTUP),
            ping: () => mate.postMessage({ type: 'ping' }),
            stopped: dismiss,
        });
        /** Ends the mate; the drawing worker draws unanswered panes itself. */
        function dismiss() {
            watchdog.leave();
            mate.terminate();
            hired = hired.filter((each) => each.mate !== mate);
        }
        mate.onerror = (event) => {
            event.preventDefault();
            dismiss();
        };
        mate.onmessage = ({ data }) => {
            hasSpoken = true;
            watchdog.heard();
            if (data.type === 'fatal') dismiss();
        };
        mate.postMessage({ type: 'init', wasm, master: port2 }, [port2]);
        mate.postMessage({ type: 'rest', wasm: rest });
        hired.push({ mate, watchdog });
        watchdog.watch();
        return port1;
    }

    return {
        /** A worker's picture was slow. @param {Hired} worker @param {WebAssembly.Module} wasm @param {WebAssembly.Module} rest of the core */
        help(worker, wasm, rest) {
            if (worker !== master) {
                leave();
                master = worker;
                try {
                    const ports = Array.from({ length: count }, () => hireMate(wasm, rest));
                    worker.postMessage({ type: 'mates', ports }, ports);
                } catch {
                    // Some pages may not start more workers.
                    leave();
                    master = worker;
                }
            }
            clearTimeout(timer);
            timer = window.setTimeout(leave, IDLE_TIME);
        },

        leave,
    };
}
