/** The dialog of keys and gestures. */

import styles from '../css/shortcuts.css';
import { byId, closes } from './dom.js';
import { addElements } from './late.js';
import markup from './shortcuts.html';

export function createShortcuts() {
    addElements(markup, [styles]);
    const dialog = byId('shortcuts', HTMLDialogElement);
    closes(dialog, 'close-shortcuts');
    return { open: () => dialog.showModal() };
}
