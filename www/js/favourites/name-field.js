/** The field in which a favourite gets another name, in the place of what can be done to it. */

import { make } from '../dom.js';
import { LONGEST_NAME } from '../favourites.js';

/**
 * @param {Element} place whose children it replaces
 * @param {string} name as it is
 * @param {(name: string | null, focused: boolean) => void} finish null where the name stays; `focused` until then
 */
export function showNameField(place, name, finish) {
    const field = make('input', { type: 'text', class: 'number', maxlength: String(LONGEST_NAME), value: name, 'aria-label': `New name of ${name}`, autocomplete: 'off' });
    let done = false;

    /** @param {boolean} keep */
    function end(keep) {
        if (done) return;
        done = true;
        finish(keep ? field.value : null, document.activeElement === field);
    }

    field.addEventListener('keydown', (event) => {
        if (event.key !== 'Enter' && event.key !== 'Escape') return;
        // Escape would close the dialog as well.
        event.preventDefault();
        event.stopPropagation();
        end(event.key === 'Enter');
    });
    field.addEventListener('blur', () => end(true));
    place.replaceChildren(field);
    field.focus();
    field.select();
}
