/**
 * Workers that make panes of pictures in space which take long for one. They are hired when a picture has, and let go when none has
 * for a while. The drawing worker hears from them directly; without them it makes all by itself.
 */

import { hire } from './core.js';
import { SILENCE, STARTUP, createWatchdog } from './watchdog.js';

/** @typedef {import('./core.js').Hired} Hired */

const MOST = 3;
/** Gigabytes, as far as the browser tells. */
const LEAST_MEMORY = 4;
/** In milliseconds. */
const PAUSE = 30_000;

/**
 * How many there may be: the drawing worker has a core to itself, and each of them needs some memory.
 * @param {{hardwareConcurrency?: number, deviceMemory?: number}} machine
 */
export const matesOn = ({ hardwareConcurrency = 1, deviceMemory = LEAST_MEMORY }) =>
    deviceMemory < LEAST_MEMORY ? 0 : Math.max(0, Math.min(hardwareConcurrency - 1, MOST));

/** @param {number} count */
export function createMates(count) {
    /** Those at work, and what watches them. @type {{mate: Hired, watchdog: ReturnType<typeof createWatchdog>}[]} */
    let hired = [];
    /** The one that they help. @type {Hired | null} */
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

    /** The other end of a new mate's port. @param {WebAssembly.Module} wasm */
    function recruit(wasm) {
        const mate = hire();
        const { port1, port2 } = new MessageChannel();
        let met = false;
        const watchdog = createWatchdog({ patience: () => (met ? SILENCE : STARTUP), ping: () => mate.postMessage({ type: 'ping' }), stopped: dismiss });
        /** What it does not answer is made without it. */
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
            met = true;
            watchdog.heard();
            if (data.type === 'fatal') dismiss();
        };
        mate.postMessage({ type: 'init', wasm, master: port2 }, [port2]);
        hired.push({ mate, watchdog });
        watchdog.watch();
        return port1;
    }

    return {
        /** A worker's picture has taken long. @param {Hired} worker @param {WebAssembly.Module} wasm */
        help(worker, wasm) {
            if (worker !== master) {
                leave();
                master = worker;
                try {
                    const ports = Array.from({ length: count }, () => recruit(wasm));
                    worker.postMessage({ type: 'mates', ports }, ports);
                } catch {
                    // A page that may not have more workers does without.
                    leave();
                    master = worker;
                }
            }
            clearTimeout(timer);
            timer = window.setTimeout(leave, PAUSE);
        },

        leave,
    };
}
