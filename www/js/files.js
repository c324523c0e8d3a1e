/**
 * The site's other files: fetched from beside the page, or found in the page itself where that is a single file, whose
 * build has put them there (crates/xtask/src/one_file.rs).
 */

/** A wasm with its worker: the small one is enough for a first picture, the other has files and exports too. */
const KITS = [
    { worker: 'worker.js', wasm: 'lsystem.wasm' },
    { worker: 'worker-full.js', wasm: 'lsystem-full.wasm' },
];

/** @param {string} name */
const carried = (name) => document.querySelector(`script[data-file="${name}"]`);

/** Those at hand, the one to start with first; a single file carries one of them. */
export function kits() {
    const here = KITS.filter(({ wasm }) => carried(wasm));
    return here.length > 0 ? here : KITS;
}

/** Whether the page is a single file. */
export const isWhole = () => KITS.some(({ wasm }) => carried(wasm));

/**
 * The address of a classic script.
 * @param {string} name
 */
export function scriptAddress(name) {
    const text = carried(name)?.textContent;
    return text ? URL.createObjectURL(new Blob([text], { type: 'text/javascript' })) : name;
}

/**
 * @param {string} name
 * @param {boolean} [anew] from the server, even where the browser has kept what came from there
 * @returns {Promise<ArrayBuffer>}
 */
export async function bytesOf(name, anew = false) {
    const here = carried(name);
    if (here) return unpack(here.textContent ?? '');
    const response = anew ? await fetch(name, { cache: 'reload' }) : await fetch(name);
    if (!response.ok) throw new Error(`${name}: ${response.status}`);
    return response.arrayBuffer();
}

/** @param {string} name @returns {Promise<any>} */
export async function jsonOf(name) {
    return JSON.parse(new TextDecoder().decode(await bytesOf(name)));
}

/** Bytes that were written in base 64. @param {string} text @returns {Uint8Array<ArrayBuffer>} */
function decode(text) {
    // A page of many frames does this once for each.
    const own = /** @type {any} */ (Uint8Array);
    if (own.fromBase64) return own.fromBase64(text);
    const letters = atob(text);
    const bytes = new Uint8Array(letters.length);
    for (let at = 0; at < letters.length; at++) bytes[at] = letters.charCodeAt(at);
    return bytes;
}

/** Bytes that were deflated by gzip and written in base 64. @param {string} text */
function unpack(text) {
    return new Response(new Blob([decode(text)]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}
