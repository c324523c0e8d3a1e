/** Makes a file of a state: pixels are drawn by the page's worker, and all other files are made by the tool `export`. */

import { make } from '../dom.js';
import { definitionOf } from '../state.js';
import { FORMATS } from '../tables.js';
import { Cancelled } from '../tool.js';
import { pixelSize, sizeOf } from './choices.js';

/** @typedef {import('../protocol.js').Format} Format */
/** What is wanted: a format, and those of its options that differ from their defaults. @typedef {{format: Format, values: Record<string, import('./choices.js').Value>}} FileWanted */

/** The most pixels along a side of a picture that the browser draws on a canvas. */
export const CANVAS_SIDE = 4096;

/** Whether the page's worker makes the files of a format. @param {Format} format */
export const isOfPixels = (format) => FORMATS[format].content === 'pixels';

/**
 * @param {object} page
 * @param {import('../store.js').Store} page.store
 * @param {import('../engine.js').Engine} page.engine
 * @param {ReturnType<typeof import('./exports.js').createExports>} page.exports
 * @param {() => import('../protocol.js').Canvas} page.canvas
 */
export function createSaveFile({ store, engine, exports, canvas }) {
    /** A picture of the view on the page. @param {import('./choices.js').Value | undefined} size @param {boolean} isBare */
    async function picture(size, isBare) {
        const sides = sizeOf(pixelSize(size, canvas()), { most: CANVAS_SIDE, mostPixels: CANVAS_SIDE ** 2 });
        if (!sides) throw new Error(`pictures have at most ${CANVAS_SIDE.toLocaleString('en')} pixels each way`);
        return engine.png(...sides, isBare ? null : definitionOf(store.state));
    }

    return {
        /** A small picture of the view, with a longer side of `side` pixels. @param {number} side */
        small: (side) => picture(String(side), true),

        /** The whole drawing in a picture of this size; throws if there is none. @param {number} width @param {number} height @returns {Promise<HTMLElement>} */
        async fitted(width, height) {
            // Small pictures have the first camera.
            if (store.state.camera) return make('img', { src: URL.createObjectURL(await engine.png(width, height, null)), alt: 'The drawing' });
            const { bitmap } = await engine.thumb(definitionOf(store.state), width, height);
            if (!bitmap) throw new Error('there is no picture');
            const picture = make('canvas', { role: 'img', 'aria-label': 'The drawing', width: String(bitmap.width), height: String(bitmap.height) });
            picture.getContext('bitmaprenderer')?.transferFromImageBitmap(bitmap);
            return picture;
        },

        /**
         * @param {FileWanted} wanted
         * @param {{signal?: AbortSignal, progress?: (size: number, piece: Blob) => void}} [how]
         * @returns {Promise<import('./exports.js').Exported>}
         */
        async make({ format, values }, how = {}) {
            const { mime } = FORMATS[format];
            if (isOfPixels(format)) {
                const blob = await picture(values['size'], values['bare'] === true);
                if (how.signal?.aborted) throw new Cancelled();
                return { blob, diagnostics: [] };
            }
            const { state } = store;
            const options = FORMATS[format].options.some((name) => name === 'size') ? { ...values, size: pixelSize(values['size'], canvas()) } : values;
            const { blob, diagnostics } = await exports.make({ definition: definitionOf(state), format, options, camera: state.camera }, how);
            return { blob: blob && new Blob([blob], { type: mime }), diagnostics };
        },
    };
}
