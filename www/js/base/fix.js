/** Remedies that the reader can apply with a button. */

import { counted, say } from './words.js';

/** @typedef {import('../protocol.js').Diagnostic} Diagnostic */

/** The label of a remedy's button. @param {string} fix */
export const fixLabel = (fix) => (fix === '' ? say`Remove it` : say`Write ${fix}`);

/** Applies a remedy, as one undo step. @param {import('../state/store.js').Store} store @param {Diagnostic} diagnostic */
export function applyFix(store, { field, start, end, fix }) {
    if (fix === null || (field !== 'axiom' && field !== 'rules' && field !== 'overrides')) return;
    const text = store.state[field];
    store.change({ [field]: text.slice(0, start) + fix + text.slice(end) }, '');
}

/** The label of the button that takes the largest number of iterations that can be drawn. @param {number} largest */
export const largestLabel = (largest) => counted(largest, 'Use {1} iteration', 'Use {1} iterations', String(largest));
