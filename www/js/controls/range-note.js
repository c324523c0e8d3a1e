/** The note below a number field about its range, shown for an invalid number and after a correction. */

import { make } from '../base/dom.js';
import { said, say } from '../base/words.js';

/**
 * @param {HTMLInputElement} field
 * @param {string} expected
 * @returns {(wrong: boolean, corrected?: boolean) => void} updates the note; `wrong`: the text is no number within the
 *   range; `corrected`: the nearest valid number was taken
 */
export function rangeNote(field, expected) {
    const id = `${field.id}-range-note`;
    const note = make('p', { id, class: 'range-note', role: 'status' });
    return (wrong, corrected = false) => {
        field.toggleAttribute('data-wrong', wrong);
        field.setAttribute('aria-invalid', String(wrong));
        // An empty field is about to be typed into.
        if ((wrong && field.value.trim() !== '') || corrected) {
            note.textContent = corrected
                ? say`Must be ${said(expected)}; the nearest value was taken.`
                : say`Must be ${said(expected)}.`;
            if (!note.isConnected) (field.closest('.dial, .quad, .seed') ?? field).after(note);
            if (wrong) field.setAttribute('aria-errormessage', id);
        } else {
            note.remove();
            field.removeAttribute('aria-errormessage');
        }
    };
}
