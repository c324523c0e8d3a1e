/** Reads files, and makes pictures for files. The tool `export` writes all other files. */

import { STEP_MS, page } from './page.js';

/** @typedef {wasm_bindgen.Playground} Playground */
/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Answer<T>} Answer */

/**
 * Reads files and makes pictures. Pictures are made one after another, because each may take all the memory reserved
 * for files.
 * @param {object} worker
 * @param {Playground} worker.playground
 * @param {(action: () => void) => void} worker.guard
 * @param {() => void} worker.wake
 * @param {(question: number) => void} worker.tellAt
 */
export function createFiles({ playground, guard, wake, tellAt }) {
    /** The queue of files to write, and its length. */
    let queue = Promise.resolve();
    let queued = 0;

    /** Writes a file after those before it. @param {number} id @param {() => Promise<void>} write */
    function enqueue(id, write) {
        queued += 1;
        queue = queue.then(async () => {
            tellAt(id);
            await write();
            queued -= 1;
            wake();
        });
    }

    /**
     * Sends an answer that is made asynchronously.
     * @template {Answer} A
     * @param {Promise<A>} work @param {(reason: string | null) => A} failed makes the answer if the work fails
     */
    async function sendLater(work, failed) {
        try {
            page.postMessage(await work);
        } catch (error) {
            if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) guard(() => { throw error; });
            else page.postMessage(failed(typeof error === 'string' ? error : null));
        }
    }

    /** @param {Question<'read'>} question @returns {Promise<Answer<'read'>>} */
    async function read({ type, id, file }) {
        const bytes = new Uint8Array(await file.arrayBuffer());
        tellAt(id);
        /** @type {Omit<import('../js/protocol.js').FileRead, 'text'>} */
        const found = wasm_bindgen.read_file(bytes);
        return { type, id, ...found, text: found.diagnostics.length > 0 ? textOf(bytes) : null };
    }

    /** Runs all steps of a file, with pauses for messages. @param {number} id @param {() => boolean} step returns whether it was the last */
    async function runSteps(id, step) {
        while (!step()) {
            await new Promise((resolve) => setTimeout(resolve));
            tellAt(id);
        }
    }

    /** Writes a PNG file that stores its system, if there is one, so that the file can be opened again. @param {Question<'png'>} question @returns {Promise<Answer<'png'>>} */
    async function writePng({ type, id, width, height, definition }) {
        const canvas = new OffscreenCanvas(1, 1);
        const picture = playground.snapshot(canvas, width, height);
        try {
            await runSteps(id, () => picture.step(STEP_MS));
        } finally {
            // The canvas has the pixels, and drawings wait until the picture is freed.
            picture.free();
        }
        const plain = await canvas.convertToBlob({ type: 'image/png' });
        const bytes = new Uint8Array(await plain.arrayBuffer());
        tellAt(id);
        const file = definition === null ? bytes : /** @type {Uint8Array<ArrayBuffer>} */ (wasm_bindgen.tag_png(bytes, definition));
        return { type, id, blob: new Blob([file], { type: 'image/png' }), reason: null };
    }

    return {
        /** Whether no file is being written. */
        get idle() {
            return queued === 0;
        },

        /** @param {Question<'read' | 'png'>} question */
        answer(question) {
            const { id } = question;
            if (question.type === 'read') sendLater(read(question), () => ({ type: 'read', id, definition: null, diagnostics: [], text: null }));
            else enqueue(id, () => sendLater(writePng(question), (reason) => ({ type: 'png', id, blob: null, reason })));
        },
    };
}

/** The text of a readable file, in UTF-8, or in UTF-16, which some Windows programs write; null for other files. @param {Uint8Array} bytes */
function textOf(bytes) {
    /** Longer files are not shown as text, in bytes. */
    const LONGEST_TEXT = 1 << 20;
    if (bytes.length > LONGEST_TEXT) return null;
    const [first, second] = bytes;
    const mark = first === 0xff && second === 0xfe ? 'utf-16le' : first === 0xfe && second === 0xff ? 'utf-16be' : 'utf-8';
    const text = new TextDecoder(mark).decode(bytes);
    // SVG and PNG files are pictures, not text to read.
    return text.trim() !== '' && !/^\s*<|^.PNG/.test(text) ? text : null;
}
