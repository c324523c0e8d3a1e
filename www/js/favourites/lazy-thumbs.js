/** Thumbnails on the cards of favourites and visits, painted when they become visible. */

import { definitionOf } from '../state/state.js';
import { watchSight } from '../base/dom.js';
import { emptyThumb, paintThumb } from '../dialogs/thumb.js';

/** @typedef {import('../state/state.js').State} State */

/** The side of a thumbnail, in CSS pixels. */
const SIDE = 168;

/**
 * @param {import('../engine/engine.js').Engine} engine
 * @param {Element} root the scrolling element
 */
export function createLazyThumbs(engine, root) {
    /** The thumbnails that are not painted yet. @type {Map<Element, State>} */
    const unpainted = new Map();
    const seen = watchSight(root, (target) => paint(/** @type {HTMLCanvasElement} */ (target)));

    /** @param {HTMLCanvasElement} picture */
    async function paint(picture) {
        const state = unpainted.get(picture);
        if (!state) return;
        unpainted.delete(picture);
        try {
            await paintThumb(picture, engine, definitionOf(state), SIDE);
        } catch {
            // The worker was replaced; the thumbnail is painted when the dialog is next opened.
        }
    }

    return {
        /** @param {State} state */
        of(state) {
            const picture = emptyThumb();
            unpainted.set(picture, state);
            seen.observe(picture);
            return picture;
        },

        clear() {
            unpainted.clear();
            seen.disconnect();
        },
    };
}
