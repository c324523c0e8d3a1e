/** Words for assistive technology and short notes on the drawing. */

import { html, make, setText } from './dom.js';

const PAUSE = 900;
const TOAST = 3200;

let timer = 0;
let toastTimer = 0;

/**
 * Says something once typing or dragging has paused.
 * @param {string} words
 */
export function announce(words) {
    clearTimeout(timer);
    timer = window.setTimeout(() => setText(html('announcer'), words), PAUSE);
}

/**
 * Shows a short note on the drawing; it is read out as well. With an `action` it has a button for it, and stays until it
 * is used or closed.
 * @param {string} words
 * @param {{stay?: boolean, action?: {label: string, act: () => void}}} [options]
 */
export function toast(words, { stay = false, action } = {}) {
    const note = html('toast');
    clearTimeout(toastTimer);
    const close = () => note.classList.remove('shown');
    if (action) {
        const act = make('button', { type: 'button', class: 'toast-act' }, action.label);
        const dismiss = make('button', { type: 'button', class: 'toast-close', 'aria-label': 'Close this note' }, '×');
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
