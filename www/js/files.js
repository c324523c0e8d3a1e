/**
 * The site's other files: fetched from the same folder, or read from the page itself if the page is a single file
 * (crates/xtask/src/one_file.rs).
 */

/** The compiled core, and the worker's script. */
export const WASM = 'lsystem.wasm';
export const WORKER = 'worker.js';

/** @param {string} name */
const embedded = (name) => document.querySelector(`script[data-file="${name}"]`);

/** Whether the page is a single file. */
export const isWhole = () => embedded(WASM) !== null;

/** Whether the page has a file inside. @param {string} name */
export const isCarried = (name) => embedded(name) !== null;

/**
 * The address of a classic script.
 * @param {string} name
 */
export function scriptAddress(name) {
    const text = embedded(name)?.textContent;
    return text ? URL.createObjectURL(new Blob([text], { type: 'text/javascript' })) : name;
}

/**
 * @param {string} name
 * @param {boolean} [anew] whether to bypass the browser's cache
 * @returns {Promise<Response>}
 */
export async function responseOf(name, anew = false) {
    const here = embedded(name);
    if (here) return gunzip(here.textContent ?? '');
    const response = anew ? await fetch(name, { cache: 'reload' }) : await fetch(name);
    if (!response.ok) throw new Error(`${name}: ${response.status}`);
    return response;
}

/** @param {string} name @returns {Promise<any>} */
export async function jsonOf(name) {
    return (await responseOf(name)).json();
}

/** Decodes base64. @param {string} text @returns {Uint8Array<ArrayBuffer>} */
function decode(text) {
    // The native function is faster, which matters on a page with many frames.
    const own = /** @type {any} */ (Uint8Array);
    if (own.fromBase64) return own.fromBase64(text);
    const letters = atob(text);
    const bytes = new Uint8Array(letters.length);
    for (let at = 0; at < letters.length; at++) bytes[at] = letters.charCodeAt(at);
    return bytes;
}

/** Decodes base64 and gzip. @param {string} text */
function gunzip(text) {
    return new Response(new Blob([decode(text)]).stream().pipeThrough(new DecompressionStream('gzip')));
}
