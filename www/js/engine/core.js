/**
 * The compiled core, for all workers. A failed download is never kept: an invalid wasm, such as the error page of a
 * server that answers 200, is fetched again.
 */

import { WASM, WORKER, scriptAddress } from '../files.js';
import { compile } from '../wasm.js';

/** @type {Promise<WebAssembly.Module> | null} */
let compiled = null;
/** Whether a load has failed before; then the browser's cached copy is bypassed. */
let failed = false;

/** @returns {Promise<WebAssembly.Module>} */
export function core() {
    if (!compiled) {
        compiled = compile(WASM, failed);
        compiled.catch(forgetCore);
    }
    return compiled;
}

/** Drops an unusable core; the next call fetches a new copy. */
export function forgetCore() {
    compiled = null;
    failed = true;
}

/** @typedef {import('../protocol.js').Channel<import('../protocol.js').ToWorker, import('../protocol.js').FromWorker> & Pick<Worker, 'terminate' | 'onerror'>} Hired */

/** Starts a worker, which waits for the core. @returns {Hired} */
export const hire = () => new Worker(scriptAddress(WORKER));
