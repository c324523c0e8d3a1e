/**
 * The site's other files: fetched from the same folder, or read from the page itself if the page is a single file
 * (crates/xtask/src/one_file.rs).
 */

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
    if (here) return new Response(decode(here.textContent ?? ''));
    const response = anew ? await fetch(name, { cache: 'reload' }) : await fetch(name);
    if (!response.ok) throw new Error(`${name}: ${response.status}`);
    return response;
}

/** @param {string} name @returns {Promise<any>} */
export async function jsonOf(name) {
    return (await responseOf(name)).json();
}

/** The bytes of a file in the page: the lower halves of its characters. @param {string} text @returns {Uint8Array<ArrayBuffer>} */
function decode(text) {
    const bytes = new Uint8Array(text.length);
    for (let at = 0; at < text.length; at++) bytes[at] = text.charCodeAt(at);
    return bytes;
}
