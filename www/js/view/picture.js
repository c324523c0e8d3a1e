/** The picture on the canvas: the worker's last picture, moved to its place in the current view. */

import { placement, viewFrom } from './view.js';

/** @typedef {import('../state/state.js').View} View */
/** @typedef {import('../state/state.js').Camera} Camera */
/** In CSS pixels. @typedef {{width: number, height: number}} Size */

/**
 * @param {HTMLCanvasElement} canvas
 * @param {(viewpoint: import('./marks.js').Viewpoint) => void} mark moves the marks
 */
export function createPicture(canvas, mark) {
    const context = /** @type {ImageBitmapRenderingContext} */ (canvas.getContext('bitmaprenderer', { alpha: false }));
    /** The picture's view, its size, and its scale in CSS pixels per fitted extent at zoom 1. @type {{view: View, scale: number, size: Size} | null} */
    let shown = null;

    return {
        /** Whether there is a picture. */
        get painted() {
            return shown !== null;
        },
        get scale() {
            return shown?.scale ?? 1;
        },

        /** Tells the picture's view from another origin. @param {number[]} place of the new origin @param {string} at its segment @param {string | undefined} before the old origin's segment */
        from(place, at, before) {
            if (shown && shown.view.at === before) shown.view = viewFrom(shown.view, place, at);
        },

        /** Moves the picture to its place in a view. @param {View} view @param {Camera | null} camera null for a drawing in the plane @param {Size} size of the stage */
        place(view, camera, size) {
            if (!shown) return;
            mark({ view, camera, scale: shown.scale, size: { width: size.width, height: size.height } });
            const at = placement(shown.view, view, shown.scale);
            const x = size.width / 2 + at.x - (shown.size.width / 2) * at.factor;
            const y = size.height / 2 + at.y - (shown.size.height / 2) * at.factor;
            const still = Math.abs(x) < 0.01 && Math.abs(y) < 0.01 && Math.abs(at.factor - 1) < 1e-6;
            // A moved picture cannot stand in for a view from another side.
            canvas.style.transform = camera || still ? 'none' : `translate(${x}px, ${y}px) scale(${at.factor})`;
        },

        /** @param {import('../engine/engine.js').Drawn} drawn */
        paint({ bitmap, scale, view, canvas: made }) {
            if (canvas.width !== bitmap.width) canvas.width = bitmap.width;
            if (canvas.height !== bitmap.height) canvas.height = bitmap.height;
            // A picture that is shown only for a moment may have fewer pixels than the canvas.
            shown = {
                view,
                scale: scale / made.ratio,
                size: { width: made.width / made.ratio, height: made.height / made.ratio },
            };
            context.transferFromImageBitmap(bitmap);
            canvas.style.width = `${shown.size.width}px`;
            canvas.style.height = `${shown.size.height}px`;
        },
    };
}
