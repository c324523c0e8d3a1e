/** The dialog of keys and gestures, opened by a button, or by `?` outside of text fields. */

import { button, byId, closes } from './dom.js';

export function createShortcuts() {
    const dialog = byId('shortcuts', HTMLDialogElement);
    const open = () => dialog.showModal();

    button('open-shortcuts').addEventListener('click', open);
    closes(dialog, 'close-shortcuts');
    addEventListener('keydown', (event) => {
        if (event.key !== '?' || event.ctrlKey || event.metaKey || event.altKey) return;
        if (isTypedInto(event.target) || document.querySelector('dialog[open]')) return;
        event.preventDefault();
        open();
    });
}

/** Whether an element accepts typed text. @param {EventTarget | null} target */
function isTypedInto(target) {
    if (target instanceof HTMLInputElement) return !['range', 'checkbox', 'color', 'button', 'file'].includes(target.type);
    return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}
