/** Why a part of the page could not do its work, with a way to try again. */

import { make } from './dom.js';
import { say } from './words.js';

/**
 * Tells why something failed. What a tool refuses is a text and would be refused again; a tool that stopped or did not
 * load is an `Error`, and starts afresh with the next try.
 * @param {HTMLElement} element
 * @param {unknown} error
 * @param {() => void} again
 */
export function showFailure(element, error, again) {
    if (!(error instanceof Error)) return element.replaceChildren(String(error));
    const words = `${error.message.charAt(0).toUpperCase()}${error.message.slice(1)}`;
    const retry = make('button', { class: 'button try-again' }, say`Try again`);
    retry.addEventListener('click', () => {
        element.replaceChildren();
        again();
    });
    element.replaceChildren(/[.!?]$/.test(words) ? words : `${words}.`, ' ', retry);
}
