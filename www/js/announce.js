/** Words for assistive technology and short notes on the drawing. */

import { html, setText } from './dom.js';

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
 * Shows a short note on the drawing; it is read out as well.
 * @param {string} words
 * @param {{stay?: boolean}} [options]
 */
export function toast(words, { stay = false } = {}) {
    const note = html('toast');
    clearTimeout(toastTimer);
    setText(note, words);
    note.classList.add('shown');
    if (!stay) toastTimer = window.setTimeout(() => note.classList.remove('shown'), Math.max(TOAST, words.length * 60));
}
