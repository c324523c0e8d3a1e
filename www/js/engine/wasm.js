/** Compiling the site's wasms. */

import { isCarried, responseOf } from '../base/files.js';
import { reasonOf, say } from '../base/words.js';

/**
 * Compiles while downloading, if the server sends the right content type.
 * @param {string} name
 * @param {boolean} anew whether to bypass the browser's cache
 */
export async function compile(name, anew) {
    if (isCarried(name) && typeof DecompressionStream !== 'function')
        throw new Error(say`This browser cannot read compressed pages. Use a newer browser.`);
    const response = await responseOf(name, anew);
    const streams = response.headers.get('content-type') === 'application/wasm';
    try {
        return await (streams
            ? WebAssembly.compileStreaming(response)
            : WebAssembly.compile(await response.arrayBuffer()));
    } catch (error) {
        throw new Error(say`${name} is not what the server sent (${reasonOf(error)})`);
    }
}
