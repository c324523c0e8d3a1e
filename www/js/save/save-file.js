/**
 * Makes a file of a state by the tool `export`. Pictures of the view that a canvas can hold are drawn by the page's worker,
 * which has the drawing.
 */

import { make } from '../dom.js';
import { definitionOf } from '../state.js';
import { FORMATS } from '../tables.js';
import { Cancelled } from '../tool.js';
import { pixelSize, sizeOf } from './choices.js';

/** @typedef {import('../protocol.js').Format} Format */
/** What is wanted: a format, and those of its options that differ from their defaults. @typedef {{format: Format, values: Record<string, import('./choices.js').Value>}} FileWanted */

/** The most pixels along a side of a picture that the browser draws on a canvas. */
const CANVAS_SIDE = 4096;

/**
 * Whether the page's worker makes a file: an opaque picture without a resolution, small enough for a canvas.
 * @param {FileWanted} wanted @param {import('../protocol.js').Canvas} canvas
 */
export function isQuick({ format, values }, canvas) {
    const size = sizeOf(pixelSize(values['size'], canvas), { most: CANVAS_SIDE });
    return FORMATS[format].content === 'pixels' && !values['transparent'] && !values['dpi'] && size !== null;
}

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
        const sides = sizeOf(pixelSize(size, canvas()), { most: CANVAS_SIDE });
        if (!sides) throw new Error(`a canvas has at most ${CANVAS_SIDE.toLocaleString('en')} pixels each way`);
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
            const shown = canvas();
            if (isQuick({ format, values }, shown)) {
                const blob = await picture(values['size'], values['bare'] === true);
                if (how.signal?.aborted) throw new Cancelled();
                return { blob, diagnostics: [] };
            }
            const { state } = store;
            const size = FORMATS[format].options.some((name) => name === 'size') ? pixelSize(values['size'], shown) : null;
            const options = size === null ? values : { ...values, size };
            const [width] = size === null ? [shown.width] : (sizeOf(size, { most: Infinity }) ?? [shown.width]);
            // Lines are as wide in a larger picture as on the page, in proportion.
            const ratio = (shown.ratio * width) / Math.max(shown.width, 1);
            const { view, camera } = state;
            const { blob, diagnostics } = await exports.make({ definition: definitionOf(state), format, options, view, camera, ratio }, how);
            return { blob: blob && new Blob([blob], { type: mime }), diagnostics };
        },
    };
}
