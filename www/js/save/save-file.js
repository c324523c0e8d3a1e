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
 * @param {object} page
 * @param {import('../store.js').Store} page.store
 * @param {import('../engine.js').Engine} page.engine
 * @param {ReturnType<typeof import('./exports.js').createExports>} page.exports
 * @param {() => import('../protocol.js').Canvas} page.canvas
 */
export function createSaveFile({ store, engine, exports, canvas }) {
    /** The width and the height of a picture that is asked for. @param {import('./choices.js').Value | undefined} size @returns {[number, number]} */
    function sidesOf(size) {
        const sides = sizeOf(pixelSize(size, canvas()), { most: Infinity });
        if (!sides) throw new Error('the size is not a width and a height');
        return sides;
    }

    return {
        /** A small picture of the view, with a longer side of `side` pixels. @param {number} side */
        small: (side) => engine.png(...sidesOf(String(side)), null),

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
            const { mime, content } = FORMATS[format];
            const { state } = store;
            const { view, camera } = state;
            const definition = definitionOf(state);
            const isPicture = content === 'pixels';
            const sides = sidesOf(isPicture ? values['size'] : '');
            // A canvas holds neither larger pictures nor a resolution, and the page's picture has a background.
            if (isPicture && Math.max(...sides) <= CANVAS_SIDE && !values['transparent'] && !values['dpi']) {
                const blob = await engine.png(...sides, values['bare'] === true ? null : definition);
                if (how.signal?.aborted) throw new Cancelled();
                return { blob, diagnostics: [] };
            }
            const options = isPicture ? { ...values, size: sides.join('x') } : values;
            // Lines are as wide in a larger picture as on the page, in proportion.
            const shown = canvas();
            const ratio = (shown.ratio * sides[0]) / Math.max(shown.width, 1);
            const { blob, diagnostics } = await exports.make({ definition, format, options, view, camera, ratio }, how);
            return { blob: blob && new Blob([blob], { type: mime }), diagnostics };
        },
    };
}
