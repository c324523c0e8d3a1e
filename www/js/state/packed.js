/**
 * Long states as short links: `#v=1&z=` and the fields, compressed (zlib, RFC 1950) and written in base64url. The zlib
 * checksum detects damaged links.
 */

import { fromBase64, toBase64 } from '../base/base64.js';
import { LONGEST, PACKED, escapeLeast, readLink, writeFields, writeLink } from './link.js';
import { say } from '../base/words.js';

/** @typedef {import('./state.js').State} State */
/** @typedef {import('./link.js').Link} Link */

/** Links up to this length stay readable, in characters; mail and chat programs do not cut them. */
export const LONG = 1500;

/** Larger states are not read, in uncompressed bytes. */
const MOST_BYTES = 4 << 20;

/** The compressed part is read in pieces of this many bytes; each expands at most about 1000 times. */
const PIECE = 256;

/**
 * The link of a state, with its `#`: readable, or compressed if the readable form is long and the compressed one shorter.
 * @param {Readonly<State>} state
 * @returns {Promise<string>}
 */
export async function bestLink(state) {
    const readable = writeLink(state);
    return readable.length > LONG ? shorter(readable, await packedLink(state)) : readable;
}

/**
 * The shortest link of a state, with its `#`.
 * @param {Readonly<State>} state
 * @returns {Promise<string>}
 */
export async function shortestLink(state) {
    return shorter(writeLink(state), await packedLink(state));
}

/**
 * Reads a hash of either form, with or without its `#`.
 * @param {string} hash
 * @returns {Promise<Link | null>} null if the hash has neither a version nor a known field
 */
export async function openLink(hash) {
    const code = hash.length > LONGEST ? undefined : new RegExp(`^#?(?:[^]*&)?${PACKED}=([^&]*)`).exec(hash)?.[1];
    if (code === undefined) return readLink(hash);
    try {
        return readLink(hash, await inflate(fromBase64(code)));
    } catch (error) {
        const { state, problems } = /** @type {Link} */ (readLink(hash, ''));
        return { state, problems: [wordsOf(error), ...problems] };
    }
}

/** @param {Readonly<State>} state @returns {Promise<string | null>} null if the browser cannot compress */
async function packedLink(state) {
    if (typeof CompressionStream !== 'function') return null;
    const fields = writeFields(state, escapeLeast);
    const stream = new Blob([fields.join('&')]).stream().pipeThrough(new CompressionStream('deflate'));
    return `#v=1&${PACKED}=${toBase64(new Uint8Array(await new Response(stream).arrayBuffer()))}`;
}

/** @param {string} readable @param {string | null} packed */
function shorter(readable, packed) {
    return packed !== null && packed.length < readable.length ? packed : readable;
}

class TooLarge extends Error {}

/** @param {Uint8Array<ArrayBuffer>} bytes @returns {Promise<string>} */
async function inflate(bytes) {
    let at = 0;
    // Read piece by piece, because browsers unpack a whole chunk before they check for cancellation.
    const pieces = new ReadableStream(
        {
            pull(controller) {
                if (at < bytes.length) controller.enqueue(bytes.subarray(at, (at += PIECE)));
                else controller.close();
            },
        },
        { highWaterMark: 0 },
    );
    const reader = pieces.pipeThrough(new DecompressionStream('deflate')).getReader();
    const decoder = new TextDecoder('utf-8', { fatal: true, ignoreBOM: true });
    let text = '';
    let size = 0;
    for (;;) {
        const { done, value } = await reader.read();
        if (done) return text + decoder.decode();
        size += value.length;
        if (size > MOST_BYTES) {
            reader.cancel().catch(() => {});
            throw new TooLarge();
        }
        text += decoder.decode(value, { stream: true });
    }
}

/** @param {unknown} error */
function wordsOf(error) {
    if (error instanceof TooLarge)
        return say`The compressed part of the link contains more than any drawing needs and was not read.`;
    if (typeof DecompressionStream !== 'function')
        return say`This browser cannot read compressed links. Use a newer browser.`;
    return say`The compressed part of the link is damaged or cut off and was not read.`;
}
