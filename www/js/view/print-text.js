/** The system as text, for printing. */

import { html, make } from '../base/dom.js';
import { say } from '../base/words.js';

/** @typedef {Readonly<import('../state/state.js').State>} State */

/** @param {State} state @param {State | null} before the state that is shown already */
export function showPrintText(state, before) {
    if (before && state.axiom === before.axiom && state.rules === before.rules && state.source === before.source)
        return;
    const rows = /** @type {const} */ ([
        [say`Start (axiom)`, state.axiom],
        [say`Rules`, state.rules],
        [say`Source`, state.source],
    ]).filter(([, text]) => text !== '');
    html('sheet').replaceChildren(...rows.flatMap(([name, text]) => [make('dt', {}, name), make('dd', {}, text)]));
}
