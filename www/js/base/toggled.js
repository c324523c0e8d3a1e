/** A part of the page that a button opens and closes. */

import { button, html } from './dom.js';
import { setLayer } from './layers.js';

/**
 * @param {string} id of the part; its buttons are `open-` and `close-` with this id
 * @param {string} sign the class of the body while the part is open
 * @param {(open: boolean) => void} changed
 */
export function createToggled(id, sign, changed) {
    const part = html(id);
    const opener = button(`open-${id}`);
    let open = false;

    /** @param {boolean} next */
    function set(next) {
        if (open === next) return;
        open = next;
        part.hidden = !open;
        document.body.classList.toggle(sign, open);
        opener.setAttribute('aria-expanded', String(open));
        setLayer(close, open);
        changed(open);
    }

    function close() {
        set(false);
        opener.focus();
    }

    button(`close-${id}`).addEventListener('click', close);

    return {
        get open() {
            return open;
        },
        set,
        /** Calls this after the reader has opened the part by its button. @param {() => void} then */
        onOpener(then) {
            opener.addEventListener('click', () => {
                set(!open);
                if (open) then();
            });
        },
    };
}
