/** Announcements for assistive technology, and short messages on the drawing. */

import { html, make, setText } from './dom.js';

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
    timer = window.setTimeout(() => setText(html('announcer'), words), PAUSE);
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
    const close = () => note.classList.remove('shown');
    if (action) {
        const act = make('button', { type: 'button', class: 'toast-act' }, action.label);
        const dismiss = make('button', { type: 'button', class: 'toast-close', 'aria-label': 'Close this message' }, '×');
        act.addEventListener('click', () => {
            close();
            action.act();
        });
        dismiss.addEventListener('click', close);
        note.replaceChildren(make('span', {}, words), act, dismiss);
    } else {
        note.replaceChildren(words);
    }
    note.classList.add('shown');
    if (!stay && !action) toastTimer = window.setTimeout(close, Math.max(TOAST, words.length * 60));
}
