/**
 * A worker and its wasm. Nothing that failed is kept: bytes that are no wasm, such as the error page of a server that
 * answers 200, or that do not compile, are fetched again.
 */

import { bytesOf, scriptAddress } from './files.js';
import { SILENCE, STARTUP, createWatchdog } from './watchdog.js';

/**
 * A worker and its wasm, by name.
 * @typedef {{worker: string, wasm: string}} Kit
 */

/** What does not load is tried again after these times, in milliseconds. */
export const DELAYS = [500, 1500, 4000];

/** "\0asm", with which every wasm begins. */
const MAGIC = [0, 0x61, 0x73, 0x6d];

/** Wasm that is there, by name. @type {Map<string, Promise<ArrayBuffer>>} */
const held = new Map();
/** What has failed before, so that the browser's own copy of it is not asked for again. @type {Set<string>} */
const failed = new Set();

/** @param {Kit} kit @returns {Promise<ArrayBuffer>} */
export function wasmOf({ wasm }) {
    const known = held.get(wasm);
    if (known) return known;
    const fresh = fetched(wasm);
    held.set(wasm, fresh);
    fresh.catch(() => forgetWasm({ wasm }));
    return fresh;
}

/** The wasm could not be used: the next time it is fetched anew. @param {{wasm: string}} kit */
export function forgetWasm({ wasm }) {
    held.delete(wasm);
    failed.add(wasm);
}

/** @param {string} name */
async function fetched(name) {
    const bytes = await bytesOf(name, failed.has(name));
    const first = new Uint8Array(bytes, 0, Math.min(MAGIC.length, bytes.byteLength));
    if (MAGIC.some((byte, at) => first[at] !== byte)) throw new Error(`${name} is not what the server sent`);
    return bytes;
}

/** @param {Kit} kit */
export const hire = ({ worker }) => new Worker(scriptAddress(worker));

/**
 * A worker that has its wasm and is ready. What fails on the way is tried again a few times.
 * @param {Kit} kit
 * @param {(message: string) => void} waits is told why it takes longer
 */
export async function readyWorker(kit, waits) {
    for (const delay of DELAYS) {
        try {
            return await started(kit);
        } catch (error) {
            waits(error instanceof Error ? error.message : String(error));
            await new Promise((resolve) => setTimeout(resolve, delay));
        }
    }
    return started(kit);
}

/** @param {Kit} kit @returns {Promise<Worker>} */
async function started(kit) {
    const bytes = await wasmOf(kit);
    const fresh = hire(kit);
    let met = false;
    try {
        await new Promise((resolve, reject) => {
            const watchdog = createWatchdog({
                patience: () => (met ? SILENCE : STARTUP),
                ping: () => fresh.postMessage({ type: 'ping' }),
                stopped: () => reject(new Error('the worker does not answer')),
            });
            const end = (/** @type {() => void} */ how) => {
                watchdog.leave();
                how();
            };
            fresh.onmessage = ({ data }) => {
                met = true;
                watchdog.heard();
                if (data.type === 'ready') end(() => resolve(null));
                if (data.type === 'fatal') end(() => reject(new Error(data.message)));
            };
            fresh.onerror = (event) => {
                event.preventDefault();
                end(() => reject(new Error(event.message || 'the worker did not start')));
            };
            fresh.postMessage({ type: 'init', wasm: bytes });
            watchdog.watch();
        });
        return fresh;
    } catch (error) {
        fresh.terminate();
        forgetWasm(kit);
        throw error;
    }
}
