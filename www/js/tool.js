/**
 * A tool that few visits need: a worker with a wasm of its own, loaded with the first call. A tool that crashes, falls
 * silent or does not load fails its calls, and the next call starts it afresh.
 */

import { SILENCE, STARTUP, createWatchdog } from './engine/watchdog.js';
import { isCarried, isWhole, scriptAddress } from './files.js';
import { compile } from './wasm.js';
import { ours, say } from './words.js';

/** @typedef {import('./protocol.js').ToTool} ToTool */
/** @typedef {import('./protocol.js').FromTool} FromTool */
/** @typedef {{resolve: (value: any) => void, reject: (error: unknown) => void, progress?: ((value: any) => void) | undefined}} Waiting */

/** How long a worker may be silent that hears nothing while it answers, in milliseconds: it tells its progress between pieces. */
const STRAIGHT = 12_000;

/** The reason of calls whose worker was silent for too long. */
export const SILENT = say`the tool did not answer`;

/** The reason of a call that its caller cancelled. */
export class Cancelled extends Error {}

/**
 * @template {Record<string, {asked: object, answer: unknown}>} Calls
 * @param {'course' | 'export' | 'film' | 'find' | 'import' | 'invent' | 'sound'} tool
 * @param {{isStraight?: boolean}} [options] whether the worker hears nothing while it answers a call, so that a cancel ends it
 */
export function createTool(tool, { isStraight = false } = {}) {
    // The page has all tools in one wasm. Pages in single files carry or fetch no more than they need.
    const isAlone = isCarried(`${tool}.wasm`) || (isWhole() && !isCarried('tools.wasm'));
    const name = isAlone ? tool : 'tools';
    /** @type {Worker | null} */
    let worker = null;
    let hasSpoken = false;
    /** Messages until the worker has its wasm; null afterwards. @type {ToTool[] | null} */
    let early = [];
    /** Whether the last load failed; then the browser's cached copy is bypassed. */
    let failed = false;
    let lastId = 0;
    /** @type {Map<number, Waiting>} */
    const waiting = new Map();
    const watchdog = createWatchdog({
        patience: () => (!worker || waiting.size === 0 ? 0 : !hasSpoken ? STARTUP : isStraight ? STRAIGHT : SILENCE),
        ping: () => post({ type: 'ping' }),
        stopped: () => end(SILENT),
    });

    /** @param {ToTool} message */
    const post = (message) => (early && message.type !== 'ping' ? early.push(message) : worker?.postMessage(message));

    function start() {
        const fresh = new Worker(scriptAddress(`${name}.js`));
        worker = fresh;
        hasSpoken = false;
        early = [];
        fresh.onmessage = ({ data }) => worker === fresh && receive(data);
        fresh.onerror = (event) => {
            event.preventDefault();
            if (worker === fresh) end(event.message || say`the tool did not start`);
        };
        compile(`${name}.wasm`, failed).then(
            (wasm) => {
                failed = false;
                if (worker !== fresh) return;
                fresh.postMessage({ type: 'init', wasm, words: ours });
                for (const message of early ?? []) fresh.postMessage(message);
                early = null;
            },
            (error) => {
                failed = true;
                if (worker === fresh) end(error.message);
            },
        );
    }

    /** Stops the worker and fails all calls. @param {string} reason */
    function end(reason) {
        worker?.terminate();
        worker = null;
        watchdog.leave();
        const left = [...waiting.values()];
        waiting.clear();
        for (const { reject } of left) reject(new Error(reason));
    }

    /** @param {FromTool} message */
    function receive(message) {
        hasSpoken = true;
        watchdog.heard();
        if (message.type === 'pong') return;
        if (message.type === 'fatal') return end(String(message.reason));
        const call = waiting.get(message.id);
        if (message.type === 'progress') {
            // Progress without a value is a sign of life.
            if (message.value !== undefined) call?.progress?.(message.value);
            return;
        }
        waiting.delete(message.id);
        if (message.type === 'answer') call?.resolve(message.value);
        else call?.reject(message.reason);
    }

    return {
        /** Stops the worker. The next call starts another one. */
        close() {
            if (worker) end(say`it was closed`);
        },
        /**
         * @template {keyof Calls & string} T
         * @param {T} call
         * @param {Calls[T]['asked']} asked
         * @param {{signal?: AbortSignal, progress?: (value: any) => void}} [options] the signal cancels the call
         * @returns {Promise<Calls[T]['answer']>}
         */
        call: (call, asked, { signal, progress } = {}) =>
            new Promise((resolve, reject) => {
                if (signal?.aborted) return reject(new Cancelled());
                if (!worker) start();
                const id = ++lastId;
                waiting.set(id, { resolve, reject, progress });
                signal?.addEventListener('abort', () => {
                    if (!waiting.delete(id)) return;
                    if (isStraight) end(say`another call was cancelled`);
                    else post({ type: 'cancel', id });
                    reject(new Cancelled());
                });
                post({ type: 'call', id, call, asked });
                watchdog.watch();
            }),

        /** Ends the worker unless it has open calls; the next call starts it again. */
        leave() {
            if (waiting.size === 0) end('');
        },
    };
}
