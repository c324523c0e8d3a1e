/** Thumbnails: small pictures of systems on cards. */

import { make } from '../base/dom.js';

/** @typedef {import('../state/state.js').Definition} Definition */

/** A thumbnail that is not drawn yet. */
export const emptyThumb = () => make('canvas', { class: 'thumb', width: '1', height: '1', 'aria-hidden': 'true' });

/**
 * Draws a system; throws if the worker stops or is missing. Returns why there is no picture, or null.
 * @param {HTMLCanvasElement} picture
 * @param {import('../engine/engine.js').Engine} engine
 * @param {Definition} definition
 * @param {number} side in CSS pixels
 * @param {() => boolean} [wanted] whether to show the finished picture
 * @param {Definition | null} [frame] the system whose still picture has the same frame
 */
export async function paintThumb(picture, engine, definition, side, wanted = () => true, frame = null) {
    const pixels = Math.round(side * Math.min(2, devicePixelRatio || 1));
    // Minimum line widths for a full page would cover a small plant.
    const { bitmap, missing } = await engine.thumb(
        { ...definition, minWidth: Math.min(definition.minWidth, 1) },
        pixels,
        pixels,
        null,
        frame,
    );
    if (!bitmap) return missing;
    if (!wanted()) {
        bitmap.close();
        return null;
    }
    picture.width = bitmap.width;
    picture.height = bitmap.height;
    picture.getContext('bitmaprenderer')?.transferFromImageBitmap(bitmap);
    picture.classList.add('inked');
    return null;
}
