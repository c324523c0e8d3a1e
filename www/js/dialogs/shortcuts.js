/** The dialog of keys and gestures. */

import styles from '../../css/shortcuts.css';
import { PLAIN_KEYS } from './dialogs.js';
import { byId, closes, input } from '../base/dom.js';
import { nameKeys } from '../base/keys.js';
import { addElements } from '../base/late.js';
import markup from './shortcuts.html';

/** @param {import('./dialogs.js').Page} page */
export function createShortcuts({ storage }) {
    addElements(markup, [styles]);
    const dialog = byId('shortcuts', HTMLDialogElement);
    nameKeys(dialog);
    closes(dialog, 'close-shortcuts');
    const plain = input('plain-keys');
    const show = () => void (plain.checked = storage.read(PLAIN_KEYS) !== false);
    show();
    storage.follow(PLAIN_KEYS, show);
    plain.addEventListener('change', () => storage.write(PLAIN_KEYS, plain.checked));
    return { open: () => dialog.showModal() };
}
