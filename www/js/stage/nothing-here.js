/** The note on a view that shows no part of the drawing, with ways back. */

import { button, html } from '../dom.js';

/** The first search reaches this far, in CSS pixels, and each further one this many times as far. */
const FIRST = 500;
const FARTHER = 16;
const MOST_SEARCHES = 20;

/**
 * @param {object} stage
 * @param {(at: [number, number], reach: number) => Promise<import('../protocol.js').Picked>} stage.pick
 * @param {(picked: import('../protocol.js').Picked) => void} stage.goTo shows what was found
 * @param {() => void} stage.fit
 */
export function createNothingHere({ pick, goTo, fit }) {
    const note = html('nothing-here');

    button('nothing-here-back').addEventListener('click', async () => {
        try {
            let reach = FIRST;
            for (let search = 0; search < MOST_SEARCHES; search++, reach *= FARTHER) {
                const picked = await pick([0, 0], reach);
                if (picked.stroke || picked.filled) return goTo(picked);
            }
        } catch {
            // The worker was replaced. The whole drawing is a way back as well.
        }
        fit();
    });
    button('nothing-here-fit').addEventListener('click', fit);

    return {
        /** @param {boolean} empty whether nothing of the drawing is in view */
        show(empty) {
            if (note.hidden === !empty) return;
            // The focus must not be lost with the button.
            if (!empty && note.contains(document.activeElement)) html('drawing').focus({ preventScroll: true });
            note.hidden = !empty;
        },
    };
}
