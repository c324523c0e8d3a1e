/** Small pictures of systems, on cards. */

import { make } from './dom.js';

/** @typedef {import('./state.js').Definition} Definition */

/** A picture that is still to be made. */
export const emptyThumb = () => make('canvas', { class: 'thumb', width: '1', height: '1', 'aria-hidden': 'true' });

/**
 * Draws a system; fails where that stops the worker, or where there is none.
 * @param {HTMLCanvasElement} picture
 * @param {import('./engine.js').Engine} engine
 * @param {Definition} definition
 * @param {number} side in CSS pixels
 * @param {() => boolean} [wanted] asked when it is drawn
 */
export async function paintThumb(picture, engine, definition, side, wanted = () => true) {
    const pixels = Math.round(side * Math.min(2, devicePixelRatio || 1));
    // Lines that are right for a whole page hide a small plant.
    const bitmap = await engine.thumb({ ...definition, minWidth: Math.min(definition.minWidth, 1) }, pixels, pixels);
    if (!bitmap) return;
    if (!wanted()) return bitmap.close();
    picture.width = bitmap.width;
    picture.height = bitmap.height;
    picture.getContext('bitmaprenderer')?.transferFromImageBitmap(bitmap);
    picture.classList.add('inked');
}
