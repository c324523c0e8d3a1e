/** Loads the dialog for films when it is first needed. */

import { toast } from '../announce.js';
import { button } from '../dom.js';
import { filmIn } from './embed-code.js';

/**
 * @param {import('../store.js').Store} store
 * @param {{readonly space: boolean}} stage whether the drawing is in space
 */
export function createFilms(store, stage) {
    /** Opens the dialog, with a film's text or the last film. @param {string} [text] */
    async function openFilm(text) {
        try {
            const films = await import('./films.js');
            await films.openFilm(store, stage, text);
        } catch (error) {
            toast(`Films could not be loaded (${error instanceof Error ? error.message : error}).`);
        }
    }

    button('open-film').addEventListener('click', () => openFilm());
    const text = filmIn(location.hash);
    if (text) openFilm(text);
    return openFilm;
}
