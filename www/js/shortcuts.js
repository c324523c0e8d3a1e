/** The sheet of keys and gestures: a button opens it, and `?` wherever nothing is being typed. */

import { button, byId, closes } from './dom.js';

export function createShortcuts() {
    const sheet = byId('shortcuts', HTMLDialogElement);
    const open = () => sheet.showModal();

    button('open-shortcuts').addEventListener('click', open);
    closes(sheet, 'close-shortcuts');
    addEventListener('keydown', (event) => {
        if (event.key !== '?' || event.ctrlKey || event.metaKey || event.altKey) return;
        if (isTypedInto(event.target) || document.querySelector('dialog[open]')) return;
        event.preventDefault();
        open();
    });
}

/** Whether keys are text to this element. @param {EventTarget | null} target */
function isTypedInto(target) {
    if (target instanceof HTMLInputElement) return !['range', 'checkbox', 'color', 'button', 'file'].includes(target.type);
    return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}
