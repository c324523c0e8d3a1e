/** The note on a view that shows only the background or only one broad line, with ways back. */

import { button, html, setText } from '../base/dom.js';
import { say } from '../base/words.js';

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
        /** @param {'background' | 'ink' | null} only the one thing in view, if any */
        show(only) {
            // The focus must not be lost with the button.
            if (!only && note.contains(document.activeElement)) html('drawing').focus({ preventScroll: true });
            note.hidden = only === null;
            setText(html('nothing-here-words'), only === 'ink' ? say`You are inside one line.` : say`Nothing here.`);
            setText(button('nothing-here-back'), only === 'ink' ? say`Show this line` : say`Go to the nearest line`);
        },
    };
}
