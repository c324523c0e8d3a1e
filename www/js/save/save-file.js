/** Makes a file of a state by the tool `export`, and small pictures for its preview. */

import { byId, make } from '../base/dom.js';
import { definitionOf } from '../state/state.js';
import { FORMATS } from '../late-tables.js';
import { say } from '../base/words.js';
import { pixelSize, sizeOf } from './choices.js';

/** @typedef {import('../protocol.js').Format} Format */
/** What is wanted: a format, and those of its options that differ from their defaults. @typedef {{format: Format, values: Record<string, import('./choices.js').Value>}} FileWanted */

/**
 * @param {object} page
 * @param {import('../state/store.js').Store} page.store
 * @param {import('../engine/engine.js').Engine} page.engine
 * @param {ReturnType<typeof import('./exports.js').createExports>} page.exports
 * @param {() => import('../protocol.js').Canvas} page.canvas
 */
export function createSaveFile({ store, engine, exports, canvas }) {
    /** The width and the height of a picture that is asked for. @param {import('./choices.js').Value | undefined} size @returns {[number, number]} */
    function sidesOf(size) {
        const sides = sizeOf(pixelSize(size, canvas()), { most: Infinity });
        if (!sides) throw new Error(say`the size is not a width and a height`);
        return sides;
    }

    return {
        /** A small copy of the picture on the page, with a longer side of `side` pixels. @param {number} side */
        small(side) {
            const [width, height] = sidesOf(String(side));
            const copy = new OffscreenCanvas(width, height);
            const context = copy.getContext('2d');
            if (context) context.imageSmoothingQuality = 'high';
            context?.drawImage(byId('drawing', HTMLCanvasElement), 0, 0, width, height);
            return copy.convertToBlob();
        },

        /** The whole drawing in a picture of this size, as a sheet shows it; throws if there is none. @param {number} width @param {number} height @returns {Promise<HTMLElement>} */
        async fitted(width, height) {
            const { camera } = store.state;
            const { bitmap } = await engine.thumb(
                definitionOf(store.state),
                width,
                height,
                camera && { ...camera, zoom: 1, x: 0, y: 0, z: 0, perspective: false },
            );
            if (!bitmap) throw new Error('there is no picture');
            const picture = make('canvas', {
                role: 'img',
                'aria-label': say`The drawing`,
                width: String(bitmap.width),
                height: String(bitmap.height),
            });
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
            const options = isPicture ? { ...values, size: sides.join('x') } : values;
            // Lines are as wide in a larger picture as on the page, in proportion.
            const shown = canvas();
            const ratio = (shown.ratio * sides[0]) / Math.max(shown.width, 1);
            const { blob, diagnostics } = await exports.make(
                { definition, format, options, view, camera, ratio, upto: engine.upto },
                how,
            );
            return { blob: blob && new Blob([blob], { type: mime }), diagnostics };
        },
    };
}
