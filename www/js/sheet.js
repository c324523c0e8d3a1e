/** The system in words, for paper. */

import { html, make } from './dom.js';

/** @param {Readonly<import('./state.js').State>} state */
export function showSheet(state) {
    const rows = Object.entries({ Axiom: state.axiom, Productions: state.rules, Source: state.source }).filter(([, text]) => text !== '');
    html('sheet').replaceChildren(...rows.flatMap(([name, text]) => [make('dt', {}, name), make('dd', {}, text)]));
}
