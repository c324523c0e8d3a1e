/** Announcements for assistive technology, and short messages on the drawing. */

import { html, make, setText, withCode, withoutMarks } from './dom.js';
import { setLayer } from './layers.js';
import { say } from './words.js';

/** The pause before an announcement, in milliseconds. */
const PAUSE = 900;
/** A message is shown at least this long, in milliseconds. */
const TOAST = 3200;

let timer = 0;
let toastTimer = 0;

/**
 * Announces a text once typing or dragging has paused.
 * @param {string} words
 */
export function announce(words) {
    clearTimeout(timer);
    timer = window.setTimeout(() => setText(html('announcer'), withoutMarks(words)), PAUSE);
}

/** Puts the message where it can be read: a dialog dims and covers all that is not inside it. */
function place() {
    const dialog = [...document.querySelectorAll('dialog[open]')].at(-1);
    (dialog ?? html('stage')).append(html('toast'));
    dialog?.addEventListener('close', place, { once: true });
}

function close() {
    html('toast').classList.remove('shown');
    setLayer(close, false);
}

/**
 * Shows a short message on the drawing, which is also announced. A message with an `action` has a button for the action
 * and stays until the button is pressed or the message is closed.
 * @param {string} words
 * @param {{stay?: boolean, action?: {label: string, act: () => void}}} [options]
 */
export function toast(words, { stay = false, action } = {}) {
    const note = html('toast');
    clearTimeout(toastTimer);
    if (action) {
        const act = make('button', { class: 'toast-act' }, action.label);
        const dismiss = make('button', { class: 'toast-close', 'aria-label': say`Close this message` }, '×');
        act.addEventListener('click', () => {
            close();
            action.act();
        });
        dismiss.addEventListener('click', close);
        note.replaceChildren(make('span', {}, ...withCode(words)), act, dismiss);
    } else {
        note.replaceChildren(...withCode(words));
    }
    place();
    note.classList.add('shown');
    setLayer(close, action !== undefined);
    if (!stay && !action) toastTimer = window.setTimeout(close, Math.max(TOAST, words.length * 60));
}
