/**
 * Runs programs, each in a worker of its own that is ended after it, and after a time without an answer. The interpreter
 * for Python loads with the first program in it.
 */

import { say } from '../base/words.js';
import { createFrame } from './frame.js';
import { FILES, HARNESS, LOCK } from './python.js';
import { WORKER } from './worker.js';

/** @typedef {'python' | 'javascript'} Language */
/** @typedef {import('./worker.js').Given} Given */
/** @typedef {import('./worker.js').Fault} Fault */
/**
 * What a run gave: the faults of the whole program and what it printed, the functions that it has, and the results by the
 * number of their call.
 * @typedef {{fault: Fault | null, printed: string, own: string[], results: (Given | undefined)[]}} Ran
 */

/** A call may take this long, in milliseconds. */
export const LONGEST = 5000;
/** A run of many calls may take this long. */
const LONGEST_RUN = 20_000;
/** An interpreter that has not started after this time never will. */
const LONGEST_START = 90_000;
/** Why a program was ended. @type {Fault} */
const ENDLESS = { type: 'Endless', message: '', line: null };

/** What a worker says of a call. A program may speak in its place, so only values of the right kinds are taken. @param {any} said @param {number} at @returns {Given} */
function givenOf({ value, nothing, fault, ms, changed, printed }, at) {
    const text = (/** @type {unknown} */ one) => (typeof one === 'string' ? one : '');
    return {
        at,
        ...(typeof value === 'string' ? { value } : {}),
        ...(fault
            ? { fault: { type: text(fault.type), message: text(fault.message), line: Number(fault.line) || null } }
            : {}),
        nothing: nothing === true,
        ms: Number(ms) || 0,
        changed: changed === true,
        printed: text(printed),
    };
}

/**
 * @param {(told: string, part: number | null) => void} progress of loading the interpreter: words, and the part that is loaded
 */
export function createRunner(progress) {
    /** @type {ReturnType<typeof createFrame> | null} */
    let frame = null;
    let lastId = 0;
    /** The present worker, its language, and what is told of it. @type {{id: number, language: Language, hear: (said: any) => void} | null} */
    let present = null;
    /** @type {Promise<unknown> | null} */
    let files = null;
    /** @type {Promise<void>} The run before. */
    let last = Promise.resolve();

    const send = (/** @type {object} */ message) => {
        frame ??= createFrame((id, said) => present?.id === id && present.hear(said));
        return frame.send(message);
    };

    /** Loads the interpreter's files, and hands them to the frame. */
    async function load() {
        const all = FILES.reduce((sum, [, , bytes]) => sum + bytes, 0);
        let loaded = 0;
        const size = (/** @type {number} */ bytes) => (bytes / 1e6).toFixed(1);
        const read = async (/** @type {string} */ name) => {
            const response = await fetch(`pyodide/${name}`).catch(() => null);
            if (!response?.ok || !response.body)
                throw new Error(say`Python is not here: open the exercise on its site, or write it in JavaScript`);
            /** @type {Uint8Array<ArrayBuffer>[]} */
            const pieces = [];
            const reader = response.body.getReader();
            for (;;) {
                const { done, value } = await reader.read();
                if (done) return new Blob(pieces).arrayBuffer();
                pieces.push(value);
                loaded += value.length;
                progress(say`Loading Python: ${size(loaded)} of ${size(all)} MB`, loaded / all);
            }
        };
        const parts = await Promise.all(FILES.map(async ([as, name]) => [as, await read(name)]));
        const { wasm, ...rest } = Object.fromEntries(parts);
        progress(say`Starting Python…`, null);
        await new Promise((resolve) => {
            present = { id: ++lastId, language: 'python', hear: resolve };
            void send({ id: lastId, keep: { wasm, files: rest } });
        });
    }

    /** Starts a worker. @param {Language} language @returns {Promise<void>} */
    async function start(language) {
        const isPython = language === 'python';
        if (isPython) {
            files ??= load();
            await files.catch((error) => {
                files = null;
                throw error;
            });
        }
        const first = isPython ? { python: true, harness: HARNESS, lock: LOCK } : {};
        await new Promise((resolve, reject) => {
            const timer = setTimeout(() => reject(new Error(say`it does not start`)), LONGEST_START);
            const hear = (/** @type {any} */ said) => {
                clearTimeout(timer);
                if (said?.crash === undefined) resolve(said);
                else reject(new Error(said.crash));
            };
            present = { id: ++lastId, language, hear };
            void send({ id: lastId, script: WORKER, first });
        });
        progress('', null);
    }

    /** The next worker starts before it is needed. @type {{language: Language, started: Promise<void>} | null} */
    let next = null;
    const prepare = (/** @type {Language} */ language) => {
        next = { language, started: start(language) };
        next.started.catch(() => (next = null));
        return next.started;
    };

    /** @param {Language} language @param {import('./worker.js').Run} asked @param {AbortSignal} [signal] @returns {Promise<Ran>} */
    async function runNow(language, asked, signal) {
        /** @type {Ran} */
        const ran = { fault: null, printed: '', own: [], results: [] };
        if (signal?.aborted) return ran;
        await (next?.language === language ? next.started : prepare(language));
        next = null;
        await new Promise((resolve) => {
            let [timer, at] = [0, -1];
            const end = setTimeout(() => stop(ENDLESS), LONGEST_RUN);
            const wait = () => {
                clearTimeout(timer);
                timer = window.setTimeout(() => stop(ENDLESS), LONGEST);
            };
            /** @param {Fault | null} fault of the call that has no answer */
            function stop(fault) {
                clearTimeout(timer);
                clearTimeout(end);
                signal?.removeEventListener('abort', cancel);
                if (fault && at < 0) ran.fault = fault;
                else if (fault) ran.results[at] = { at, fault, ms: LONGEST, changed: false, printed: '' };
                resolve(null);
            }
            const cancel = () => stop(null);
            signal?.addEventListener('abort', cancel);
            if (present)
                present.hear = (said) => {
                    if (said.done) return stop(null);
                    if (said.crash !== undefined) return stop({ type: 'Crash', message: said.crash, line: null });
                    if (said.at !== at) return;
                    wait();
                    const given = givenOf(said, at);
                    if (at < 0) [ran.printed, ran.fault] = [given.printed, given.fault ?? null];
                    else ran.results[at] = given;
                    if (at < 0 && Array.isArray(said.own)) ran.own = said.own.map(String);
                    if (ran.fault) return stop(null);
                    at += 1;
                };
            wait();
            void send({ id: lastId, tell: { run: asked } });
        });
        // A worker hears one program only.
        prepare(language).catch(() => {});
        return ran;
    }

    return {
        /**
         * Runs a program after those before it. Throws only if the interpreter does not load.
         * @param {Language} language
         * @param {import('./worker.js').Run} asked
         * @param {AbortSignal} [signal] ends the run
         * @returns {Promise<Ran>}
         */
        run(language, asked, signal) {
            const own = last.then(() => runNow(language, asked, signal));
            last = own.then(
                () => {},
                () => {},
            );
            return own;
        },
    };
}
