/** Saving files. */

import { announce } from './announce.js';
import { make } from './dom.js';
import { say } from './words.js';

/** @param {Blob} blob @param {string} name */
export function download(blob, name) {
    const url = URL.createObjectURL(blob);
    const anchor = make('a', { href: url, download: name });
    anchor.click();
    // By then the download no longer needs the URL.
    setTimeout(() => URL.revokeObjectURL(url), 60_000);
    announce(say`Saved ${name}`);
}

/** A file name for a state, without the ending. @param {import('../state/state.js').State} state */
export function fileName({ name, title, iterations }) {
    const base =
        (name || title)
            .normalize('NFKD')
            .replace(/[^\w.-]+/g, '_')
            .replace(/^[_.]+|_+$/g, '')
            .slice(0, 60) || 'l-system';
    return `${base}_n${iterations}`;
}
