/** What a number field must hold, in words below its row, while it holds something else and where it was mended. */

import { make } from '../dom.js';

/**
 * @param {HTMLInputElement} field
 * @param {string} wanted
 * @returns {(wrong: boolean, mended?: boolean) => void} to be told whether the field holds something else, and whether
 *   it held a number out of its range until the nearest one was taken
 */
export function wanting(field, wanted) {
    const id = `${field.id}-wanted`;
    const note = make('p', { id, class: 'wanted', role: 'status' });
    return (wrong, mended = false) => {
        field.toggleAttribute('data-wrong', wrong);
        field.setAttribute('aria-invalid', String(wrong));
        // Who has emptied a field is about to write.
        if ((wrong && field.value.trim() !== '') || mended) {
            note.textContent = `Must be ${wanted}${mended ? '; the nearest value was taken' : ''}.`;
            if (!note.isConnected) (field.closest('.dial, .quad, .seed') ?? field).after(note);
            if (wrong) field.setAttribute('aria-errormessage', id);
        } else {
            note.remove();
            field.removeAttribute('aria-errormessage');
        }
    };
}
