/** Keeps the field with the focus in sight when the keyboard of a phone takes a part of the screen. */

import { html } from '../base/dom.js';

export function followKeyboard() {
    const show = () => {
        const field = document.activeElement;
        if (!field?.matches('textarea, .number') || !html('panel').contains(field)) return;
        // A field's frame is larger than the field.
        (field.closest('.editor') ?? field).scrollIntoView({ block: 'nearest' });
    };
    // The layout follows the focus, too: the header makes room.
    for (const event of ['resize', 'focusin']) addEventListener(event, () => requestAnimationFrame(show));
}
