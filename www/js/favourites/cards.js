/** Cards of the favourites dialog: favourites with their buttons, and earlier visits. */

import { make } from '../base/dom.js';
import { language, said, say } from '../base/words.js';

/** @typedef {import('./favourites.js').Favourite} Favourite */
/** @typedef {import('../state/state.js').State} State */

/** @param {string} words @param {string} label @param {() => void} act */
function actButton(words, label, act) {
    const element = make('button', { class: 'card-act', 'aria-label': label }, words);
    element.addEventListener('click', act);
    return element;
}

/**
 * @param {Favourite} one
 * @param {HTMLCanvasElement | null} picture
 * @param {{open: () => void, rename: () => void, remove: () => void}} act
 */
export function favouriteCard(one, picture, { open, rename, remove }) {
    const opener = make(
        'button',
        { class: 'card', 'data-id': one.id },
        ...(picture ? [picture] : []),
        make('span', { class: 'card-title' }, one.name),
    );
    opener.addEventListener('click', open);
    const acts = make(
        'div',
        { class: 'card-acts' },
        actButton(say`Rename`, say`Rename ${one.name}`, rename),
        actButton(say`Delete`, say`Delete ${one.name}`, remove),
    );
    return make('li', { class: 'card-item', 'data-favourite': one.id }, opener, acts);
}

/** @param {number} time when the visit ended @param {State} state @param {HTMLCanvasElement} picture @param {() => void} open */
export function visitCard(time, state, picture, open) {
    const when = new Date(time).toLocaleString(language === 'en' ? [] : language, {
        dateStyle: 'medium',
        timeStyle: 'short',
    });
    const opener = make(
        'button',
        { class: 'card' },
        picture,
        make('span', { class: 'card-title' }, said(state.title || state.name) || say`Untitled system`),
        make('span', { class: 'card-kind' }, when),
    );
    opener.addEventListener('click', open);
    return make('li', { class: 'card-item' }, opener);
}
