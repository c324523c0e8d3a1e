/** The names of keys, as the keyboards of the reader's language have them. */

import { say } from './words.js';

/** By the names in the markup. */
const NAMES = new Map([
    ['Ctrl', say`Ctrl`],
    ['Shift', say`Shift`],
    ['Esc', say`Esc`],
    ['Space', say`Space bar`],
    ['Home', say`Home key`],
    ['End', say`End key`],
    ['Page', say`Page up, Page down`],
]);

/** Names the keys of the page's own markup. @param {Element} root */
export function nameKeys(root) {
    for (const key of root.querySelectorAll('kbd'))
        key.textContent = NAMES.get(key.textContent ?? '') ?? key.textContent;
}
