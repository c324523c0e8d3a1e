/**
 * The site's other files: fetched from the same folder, or read from the page itself if the page is a single file
 * (crates/xtask/src/one_file.rs).
 */

import { fromBase64 } from './base64.js';

/** The compiled core: what most first pictures need, and the rest. And the worker's script. */
export const WASM = 'lsystem.wasm';
export const REST = 'lsystem-rest.wasm';
export const WORKER = 'worker.js';

/** @param {string} name */
const embedded = (name) => document.querySelector(`script[data-file="${name}"]`);

/**
 * The address of this page with a hash, to be given to others: without the language of the one who gives it.
 * @param {string} hash
 */
export function addressOf(hash) {
    const address = new URL(hash, location.href);
    address.search = '';
    return address.href;
}

/** Whether the page is a single file. */
export const isWhole = () => embedded(WASM) !== null;

/** The language whose words a page in a single file has inside; none in English. */
export const carriedLanguage = () =>
    /^lang\/(.+)\/words\.json$/.exec(
        document.querySelector('script[data-file^="lang/"]')?.getAttribute('data-file') ?? '',
    )?.[1] ?? null;

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
    if (here) return new Response(contentOf(here));
    const response = anew ? await fetch(name, { cache: 'reload' }) : await fetch(name);
    if (!response.ok) throw new Error(`${name}: ${response.status}`);
    return response;
}

/** @param {string} name @returns {Promise<any>} */
export async function jsonOf(name) {
    return (await responseOf(name)).json();
}

/** A file in the page: a text, or compressed as in long links. @param {Element} element */
function contentOf(element) {
    const text = element.textContent ?? '';
    if (element.getAttribute('type') !== 'text/zlib') return text;
    return new Blob([fromBase64(text)]).stream().pipeThrough(new DecompressionStream('deflate'));
}
