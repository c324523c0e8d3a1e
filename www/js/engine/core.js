/**
 * The compiled core, for all workers. Nothing that failed is kept: what is no wasm, such as the error page of a server that
 * answers 200, is fetched again.
 */

import { WASM, WORKER, responseOf, scriptAddress } from '../files.js';

/** @type {Promise<WebAssembly.Module> | null} */
let compiled = null;
/** Whether it has failed before, so that the browser's own copy of it is not asked for again. */
let failed = false;

/** @returns {Promise<WebAssembly.Module>} */
export function core() {
    if (!compiled) {
        compiled = compile();
        compiled.catch(forgetCore);
    }
    return compiled;
}

/** It could not be used: the next time it is fetched anew. */
export function forgetCore() {
    compiled = null;
    failed = true;
}

/** Compiles while it comes, where the server says what it is. */
async function compile() {
    const response = await responseOf(WASM, failed);
    const streams = response.headers.get('content-type') === 'application/wasm';
    try {
        return await (streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer()));
    } catch (error) {
        throw new Error(`${WASM} is not what the server sent (${error instanceof Error ? error.message : error})`);
    }
}

/** @typedef {import('../protocol.js').Channel<import('../protocol.js').ToWorker, import('../protocol.js').FromWorker> & Pick<Worker, 'terminate' | 'onerror'>} Hired */

/** A worker that waits for the core. @returns {Hired} */
export const hire = () => new Worker(scriptAddress(WORKER));
