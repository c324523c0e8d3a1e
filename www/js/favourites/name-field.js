/** The field that renames a favourite, in place of its buttons. */

import { make } from '../base/dom.js';
import { LONGEST_NAME } from './favourites.js';
import { say } from '../base/words.js';

/**
 * @param {Element} place the element whose children are replaced
 * @param {string} name the current name
 * @param {(name: string | null, focused: boolean) => void} finish called with the new name, or null to keep the name; `focused`: the field had the focus
 */
export function showNameField(place, name, finish) {
    const field = make('input', {
        type: 'text',
        class: 'number',
        maxlength: String(LONGEST_NAME),
        value: name,
        'aria-label': say`New name of ${name}`,
        autocomplete: 'off',
    });
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
