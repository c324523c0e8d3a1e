/**
 * The note on the stage that says why the drawing stopped and what the reader can do. The note disappears when the
 * trouble is over.
 */

import { announce } from '../base/announce.js';
import { button, html, setText } from '../base/dom.js';
import { setLayer } from '../base/layers.js';
import { say } from '../base/words.js';

/** @typedef {import('../engine/engine.js').Trouble} Trouble */
/** `held`: a drawing that stopped on an earlier visit and was not started this time. @typedef {Trouble['how'] | 'held'} Kind */

/** @type {Record<Kind, string>} */
const WORDS = {
    silent: say`Drawing stopped answering and was restarted. Your text is kept.`,
    crashed: say`Drawing failed and was restarted. Your text is kept.`,
    loading: say`The drawing engine could not be loaded. Trying again…`,
    unloadable: say`The drawing engine could not be loaded. Check the connection, then try again.`,
    lost: say`Drawing failed several times in a row. Change the system, or try again.`,
    held: say`This system could not be drawn before, so it was not started. Change it, or draw it anyway.`,
};

/** The message for a question that stopped the worker. */
export const QUESTION = say`This detail of the drawing could not be read, because the drawing engine stopped answering.`;

/**
 * @param {{back: () => void, again: () => void}} page `back` returns to the last drawing, `again` retries the drawing
 */
export function createTrouble({ back, again }) {
    const note = html('trouble');
    const backButton = button('trouble-back');
    const againButton = button('trouble-again');
    function hide() {
        note.hidden = true;
        setLayer(hide, false);
    }

    backButton.addEventListener('click', () => {
        hide();
        back();
    });
    againButton.addEventListener('click', () => {
        hide();
        again();
    });
    button('trouble-close').addEventListener('click', hide);

    return {
        /** @param {Kind} kind @param {boolean} canGoBack whether there is a last drawing @returns {string} the words */
        show(kind, canGoBack) {
            setText(html('trouble-words'), WORDS[kind]);
            backButton.hidden = !canGoBack || kind === 'loading' || kind === 'held';
            againButton.hidden = kind === 'loading';
            setText(againButton, kind === 'held' ? say`Draw it anyway` : say`Try again`);
            note.hidden = false;
            setLayer(hide, true);
            announce(WORDS[kind]);
            return WORDS[kind];
        },

        hide,
    };
}
