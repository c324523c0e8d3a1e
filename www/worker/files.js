/** Reads files. */

import { page } from './page.js';

/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Answer<T>} Answer */

/**
 * @param {object} worker
 * @param {(action: () => void) => void} worker.guard
 * @param {(question: number) => void} worker.tellAt
 */
export function createReadFile({ guard, tellAt }) {
    /** @param {Question<'read'>} question @returns {Promise<Answer<'read'>>} */
    async function read({ type, id, file }) {
        const bytes = new Uint8Array(await file.arrayBuffer());
        tellAt(id);
        const found = wasm_bindgen.read_file(bytes);
        return { type, id, ...found, text: found.diagnostics.length > 0 ? textOf(bytes) : null };
    }

    /** Reads a file and sends the answer later. @param {Question<'read'>} question */
    return async function answer(question) {
        try {
            page.postMessage(await read(question));
        } catch (error) {
            if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError)
                guard(() => {
                    throw error;
                });
            else page.postMessage({ type: 'read', id: question.id, definition: null, diagnostics: [], text: null });
        }
    };
}

/** The text of a readable file, in UTF-8, or in UTF-16, which some Windows programs write; null for other files. @param {Uint8Array} bytes */
function textOf(bytes) {
    /** Longer files are not shown as text, in bytes. */
    const LONGEST_TEXT = 1 << 20;
    if (bytes.length > LONGEST_TEXT) return null;
    const [first, second] = bytes;
    const mark =
        first === 0xff && second === 0xfe ? 'utf-16le' : first === 0xfe && second === 0xff ? 'utf-16be' : 'utf-8';
    const text = new TextDecoder(mark).decode(bytes);
    // SVG and PNG files are pictures, not text to read.
    return text.trim() !== '' && !/^\s*<|^.PNG/.test(text) ? text : null;
}
