/**
 * A tool that few visits need: a worker with the parts of a wasm that the tool needs, loaded with the first call. A tool
 * that crashes, falls silent or does not load fails its calls, and the next call starts it afresh.
 */

import { SILENCE, STARTUP, createWatchdog } from './watchdog.js';
import { isCarried, scriptAddress } from '../base/files.js';
import PARTS from '../tool-parts.json' with { type: 'json' };
import { compile } from './wasm.js';
import { ours, reasonOf, say } from '../base/words.js';

/** @typedef {import('../protocol.js').ToTool} ToTool */
/** @typedef {import('../protocol.js').FromTool} FromTool */
/** @typedef {{resolve: (value: any) => void, reject: (error: unknown) => void, progress?: ((value: any) => void) | undefined}} Waiting */

/** How long a worker may be silent that hears nothing while it answers, in milliseconds: it tells its progress between pieces. */
const STRAIGHT = 12_000;

/** The reason of calls whose worker was silent for too long. */
export const SILENT = say`the tool did not answer`;

/** The reason of a call that its caller cancelled. */
export class Cancelled extends Error {}

/** A tool: a file of worker/calls. @typedef {'class' | 'course' | 'export' | 'film' | 'find' | 'import' | 'invent' | 'package' | 'picture' | 'sound' | 'study' | 'write'} Tool */

/** The wasms of a tool, the first part first (crates/xtask/src/split/tools.rs). @param {Tool} tool */
const partsOf = (tool) =>
    Object.entries(PARTS)
        .filter(([part, tools]) => part === 'first' || tools.includes(tool))
        .map(([part]) => `tools-${part}.wasm`);

/**
 * The worker of a tool and the calls that wait for it.
 * @typedef {object} Calling
 * @property {Tool} tool
 * @property {Worker | null} worker
 * @property {boolean} hasSpoken
 * @property {ToTool[] | null} early Messages until the worker has its wasm; null afterwards
 * @property {boolean} failed Whether the last load failed; then the browser's cached copy is bypassed
 * @property {Map<number, Waiting>} waiting
 * @property {ReturnType<typeof createWatchdog>} watchdog
 */

/**
 * @template {Record<string, {asked: object, answer: unknown}>} Calls
 * @param {Tool} tool
 * @param {{isStraight?: boolean}} [options] whether the worker hears nothing while it answers a call, so that a cancel ends it
 */
export function createTool(tool, { isStraight = false } = {}) {
    let lastId = 0;

    const watchdog = createWatchdog({
        patience: () =>
            !self.worker || self.waiting.size === 0 ? 0 : !self.hasSpoken ? STARTUP : isStraight ? STRAIGHT : SILENCE,
        ping: () => post(self, { type: 'ping' }),
        stopped: () => end(self, SILENT),
    });
    /** @type {Calling} */
    const self = { tool, worker: null, hasSpoken: false, early: [], failed: false, waiting: new Map(), watchdog };

    return {
        /** Stops the worker. The next call starts another one. */
        close() {
            if (self.worker) end(self, say`it was closed`);
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
                if (!self.worker) start(self);
                const id = ++lastId;
                self.waiting.set(id, { resolve, reject, progress });
                signal?.addEventListener('abort', () => {
                    if (!self.waiting.delete(id)) return;
                    if (isStraight) end(self, say`another call was cancelled`);
                    else post(self, { type: 'cancel', id });
                    reject(new Cancelled());
                });
                post(self, { type: 'call', id, call, asked });
                watchdog.watch();
            }),

        /** Ends the worker unless it has open calls; the next call starts it again. */
        leave() {
            if (self.waiting.size === 0) end(self, '');
        },
    };
}

/** @param {Calling} self @param {ToTool} message */
const post = (self, message) =>
    self.early && message.type !== 'ping' ? self.early.push(message) : self.worker?.postMessage(message);

/** @param {Calling} self */
function start(self) {
    // Pages in single files may carry a wasm with this tool, or with all tools; exercises and steps share one.
    const carried = [self.tool === 'study' ? 'course' : self.tool, 'tools'].find((name) => isCarried(`${name}.wasm`));
    const [script, wasms] = carried ? [`${carried}.js`, [`${carried}.wasm`]] : ['tools.js', partsOf(self.tool)];
    const fresh = new Worker(scriptAddress(script));
    self.worker = fresh;
    self.hasSpoken = false;
    self.early = [];
    fresh.onmessage = ({ data }) => self.worker === fresh && receive(self, data);
    fresh.onerror = (event) => {
        event.preventDefault();
        if (self.worker === fresh) end(self, event.message || reasonOf(new TypeError(say`the tool did not start`)));
    };
    Promise.all(wasms.map((wasm) => compile(wasm, self.failed))).then(
        ([wasm, ...parts]) => {
            self.failed = false;
            if (self.worker !== fresh || !wasm) return;
            fresh.postMessage({ type: 'init', wasm, parts, words: ours });
            for (const message of self.early ?? []) fresh.postMessage(message);
            self.early = null;
        },
        (error) => {
            self.failed = true;
            if (self.worker === fresh) end(self, reasonOf(error));
        },
    );
}

/** Stops the worker and fails all calls. @param {Calling} self @param {string} reason */
function end(self, reason) {
    self.worker?.terminate();
    self.worker = null;
    self.watchdog.leave();
    const left = [...self.waiting.values()];
    self.waiting.clear();
    for (const { reject } of left) reject(new Error(reason));
}

/** @param {Calling} self @param {FromTool} message */
function receive(self, message) {
    self.hasSpoken = true;
    self.watchdog.heard();
    if (message.type === 'pong') return;
    if (message.type === 'fatal') {
        // Parts of two versions do not fit.
        if (message.id === 0) self.failed = true;
        return end(self, String(message.reason));
    }
    const call = self.waiting.get(message.id);
    if (message.type === 'progress') {
        // Progress without a value is a sign of life.
        if (message.value !== undefined) call?.progress?.(message.value);
        return;
    }
    self.waiting.delete(message.id);
    if (message.type === 'answer') call?.resolve(message.value);
    else call?.reject(message.reason);
}
