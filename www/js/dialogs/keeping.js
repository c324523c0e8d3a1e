/** The dialog about use without a network: keeps all files of the site in the browser. */

import styles from '../../css/keeping.css';
import { button, byId, closes, html, setText } from '../base/dom.js';
import markup from './keeping.html';
import { addElements } from '../base/late.js';
import { askVersion } from '../base/offline.js';
import { say } from '../base/words.js';
import { marked } from '../base/numerals.js';

/** @param {number} bytes */
const megabytes = (bytes) => say`${marked((bytes / 1e6).toFixed(1))} MB`;

export function createKeeping() {
    addElements(markup, [styles]);
    const dialog = byId('offline', HTMLDialogElement);
    const keep = button('keep-all');

    /** @param {string} words @param {boolean} [isAlert] */
    function tell(words, isAlert = false) {
        setText(html('keep-words'), words);
        html('keep-words').classList.toggle('alert', isAlert);
    }

    /** @param {unknown} left the bytes that are not kept */
    function showLeft(left) {
        keep.hidden = left === 0;
        tell(
            left === 0
                ? say`Everything is kept in this browser and works without a network.`
                : say`Everything else takes ${megabytes(Number(left))} of this browser’s storage.`,
        );
    }

    keep.addEventListener('click', () => {
        keep.disabled = true;
        void askVersion('keep all', (left) => {
            keep.disabled = typeof left === 'number' && left > 0;
            if (typeof left !== 'number')
                tell(say`Not everything could be kept (${String(left)}). Try again with a network.`, true);
            else if (left > 0) tell(say`Downloading, ${megabytes(left)} left…`);
            else showLeft(0);
        });
    });
    closes(dialog, 'close-offline');

    return {
        open() {
            dialog.showModal();
            if (!keep.disabled) void askVersion('missing', showLeft);
        },
    };
}
