/** Thumbnails for the gallery and the seed dialog. */

import { page } from './page.js';

/** @typedef {wasm_bindgen.Playground} Playground */
/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */

/**
 * Draws small pictures of other systems while nothing else is to do, each with a playground of its own.
 * @param {object} worker
 * @param {Playground} worker.playground
 * @param {Question<'thumb'>[]} worker.waiting
 * @param {(question: number) => void} worker.tellAt
 */
export function createThumbs({ playground, waiting, tellAt }) {
    /** The picture being drawn; `missing` tells why there will be none. While `framing`, the drawing that has its frame is made. @type {{request: Question<'thumb'>, small: Playground, canvas: OffscreenCanvas, bitmap: ImageBitmap | null, missing: string | null, framing: boolean} | null} */
    let making = null;

    /** @param {Question<'thumb'>} request @returns {NonNullable<typeof making>} */
    function begin(request) {
        playground.forget();
        const canvas = new OffscreenCanvas(1, 1);
        const small = wasm_bindgen.Playground.small(canvas);
        if (request.frame) small.define(request.frame);
        const missing = request.frame ? null : take(small, request);
        return { request, small, canvas, bitmap: null, missing, framing: !!request.frame };
    }

    /** Begins the picture itself. Returns why there will be none, or null. @param {Playground} small @param {Question<'thumb'>} request */
    function take(small, { definition, width, height, camera }) {
        const { ok, empty } = small.define(definition);
        small.look({ width, height, ratio: 1, view: { x: 0, y: 0, zoom: 1 }, camera });
        return ok ? empty : 'mistakes';
    }

    return {
        get making() {
            return making !== null;
        },
        get waiting() {
            return waiting.length > 0;
        },

        /** Drops the unfinished picture, to begin it again later. */
        postpone() {
            if (!making) return;
            waiting.unshift(making.request);
            making.small.free();
            making.bitmap?.close();
            making = null;
        },

        /** Draws one step of the current or next picture. */
        step() {
            const request = making?.request ?? waiting.shift();
            if (!request) return;
            tellAt(request.id);
            const thumb = (making ??= begin(request));
            // The limits of small pictures end each of them, and no clock does.
            const { drawn, idle } = thumb.missing === null ? thumb.small.step() : { drawn: null, idle: true };
            if (thumb.framing) {
                if (!idle) return;
                thumb.framing = false;
                thumb.small.hold(true);
                thumb.missing = take(thumb.small, request);
                if (thumb.missing === null) return;
            }
            if (drawn) {
                thumb.bitmap?.close();
                thumb.bitmap = thumb.canvas.transferToImageBitmap();
            }
            if (!idle && !drawn?.complete) return;
            making = null;
            thumb.small.free();
            const { bitmap } = thumb;
            const missing = bitmap ? null : (thumb.missing ?? 'size');
            page.postMessage({ type: 'thumb', id: request.id, bitmap, missing }, bitmap ? [bitmap] : []);
        },
    };
}
