/** Files that are read and written. */

import { STEP_MS, page } from './page.js';

/** @typedef {wasm_bindgen.Playground} Playground */
/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Answer<T>} Answer */

/**
 * Files, which are read and written. They are made one after another: each may take all the memory that there is for one.
 * @param {object} worker
 * @param {Playground} worker.playground
 * @param {(action: () => void) => void} worker.guard
 * @param {() => void} worker.wake
 * @param {(question: number) => void} worker.tellAt
 */
export function createFiles({ playground, guard, wake, tellAt }) {
    /** The file being made, and those asked for after it; and how many those are. */
    let saving = Promise.resolve();
    let unsaved = 0;

    /** Makes a file after those before it. @param {number} id @param {() => Promise<void>} answered */
    function save(id, answered) {
        unsaved += 1;
        saving = saving.then(async () => {
            tellAt(id);
            await answered();
            unsaved -= 1;
            wake();
        });
    }

    /**
     * Answers a question whose answer takes others' time as well.
     * @template {Answer} A
     * @param {Promise<A>} work @param {(reason: string | null) => A} failed the answer where it fails
     */
    async function later(work, failed) {
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

    /** Goes through the steps of a file. @param {number} id @param {() => boolean} step whether it was the last */
    async function inSteps(id, step) {
        while (!step()) {
            await new Promise((resolve) => setTimeout(resolve));
            tellAt(id);
        }
    }

    /** A file, whose pieces leave the memory of the wasm as they are written. @param {Question<'export'>} question @returns {Promise<Answer<'export'>>} */
    async function written({ type, id, format }) {
        const file = playground.export(format);
        /** @type {Blob[]} */
        const pieces = [];
        try {
            await inSteps(id, () => {
                const done = file.step(STEP_MS);
                pieces.push(new Blob([/** @type {Uint8Array<ArrayBuffer>} */ (file.take())]));
                return done;
            });
            /** @type {{complete: boolean, diagnostics: import('../js/protocol.js').Diagnostic[]}} */
            const { complete, diagnostics } = file.report();
            return { type, id, blob: complete ? new Blob(pieces) : null, diagnostics };
        } finally {
            // No drawing is made as long as it is there.
            file.free();
        }
    }

    /** A PNG file that carries its system, so that it can be opened again. @param {Question<'png'>} question @returns {Promise<Answer<'png'>>} */
    async function tagged({ type, id, width, height, definition }) {
        const sheet = new OffscreenCanvas(1, 1);
        const picture = playground.snapshot(sheet, width, height);
        try {
            await inSteps(id, () => picture.step(STEP_MS));
        } finally {
            // Its pixels are on the sheet, and no drawing is made as long as it is there.
            picture.free();
        }
        const plain = await sheet.convertToBlob({ type: 'image/png' });
        const bytes = new Uint8Array(await plain.arrayBuffer());
        tellAt(id);
        const file = /** @type {Uint8Array<ArrayBuffer>} */ (wasm_bindgen.tag_png(bytes, definition));
        return { type, id, blob: new Blob([file], { type: 'image/png' }), reason: null };
    }

    return {
        /** Whether none is being made. */
        get rest() {
            return unsaved === 0;
        },

        /** @param {Question<'read' | 'export' | 'png'>} question */
        answer(question) {
            const { id } = question;
            if (question.type === 'read') later(read(question), () => ({ type: 'read', id, definition: null, diagnostics: [], text: null }));
            else if (question.type === 'export') save(id, () => later(written(question), () => ({ type: 'export', id, blob: null, diagnostics: [] })));
            else save(id, () => later(tagged(question), (reason) => ({ type: 'png', id, blob: null, reason })));
        },
    };
}

/** A file as text, where people can read it: in UTF-8, or in UTF-16, as programs of Windows write it. @param {Uint8Array} bytes */
function textOf(bytes) {
    /** Longer files are not shown to their reader, in bytes. */
    const LONGEST_TEXT = 1 << 20;
    if (bytes.length > LONGEST_TEXT) return null;
    const [first, second] = bytes;
    const mark = first === 0xff && second === 0xfe ? 'utf-16le' : first === 0xfe && second === 0xff ? 'utf-16be' : 'utf-8';
    const text = new TextDecoder(mark).decode(bytes);
    // What a picture carries is not to be read by people.
    return text.trim() !== '' && !/^\s*<|^.PNG/.test(text) ? text : null;
}
