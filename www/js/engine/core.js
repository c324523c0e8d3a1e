/**
 * The compiled core, for all workers, in two files: the first has what most first pictures need, and the rest joins it
 * in a running worker. A failed download is never kept: an invalid wasm, such as the error page of a server that answers
 * 200, is fetched again.
 */

import { REST, WASM, WORKER, scriptAddress } from '../base/files.js';
import { compile } from './wasm.js';
import { say } from '../base/words.js';

/** A wasm that is compiled once. @param {(anew: boolean) => Promise<WebAssembly.Module>} load `anew` bypasses the browser's cache */
function createPart(load) {
    /** @type {Promise<WebAssembly.Module> | null} */
    let compiled = null;
    /** Whether a load has failed before. */
    let failed = false;
    /** Drops an unusable wasm; the next use fetches a new copy. */
    function forget() {
        compiled = null;
        failed = true;
    }
    return {
        get() {
            if (!compiled) {
                compiled = load(failed);
                compiled.catch(forget);
            }
            return compiled;
        },
        forget,
    };
}

const first = createPart((anew) => compile(WASM, anew));
const rest = createPart(async (anew) => {
    const [core, wasm] = await Promise.all([first.get(), compile(REST, anew)]);
    // The parts of two versions of the site do not fit each other.
    const given = new Set(WebAssembly.Module.exports(core).map(({ name }) => name));
    if (WebAssembly.Module.imports(wasm).every(({ name }) => given.has(name))) return wasm;
    throw new Error(say`${REST} belongs to another version of the page`);
});

/** @returns {Promise<WebAssembly.Module>} */
export const core = () => first.get();

/** @returns {Promise<WebAssembly.Module>} */
export const restOfCore = () => rest.get();

/** Drops an unusable core; the next call fetches a new copy. */
export function forgetCore() {
    first.forget();
    rest.forget();
}

/** @typedef {import('../protocol.js').Channel<import('../protocol.js').ToWorker, import('../protocol.js').FromWorker> & Pick<Worker, 'terminate' | 'onerror'>} Hired */

/** Starts a worker, which waits for the core. @returns {Hired} */
export const hire = () => new Worker(scriptAddress(WORKER));
