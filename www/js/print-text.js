/** The system as text, for printing. */

import { html, make } from './dom.js';

/** @typedef {Readonly<import('./state.js').State>} State */

/** @param {State} state @param {State | null} before the state that is shown already */
export function showPrintText(state, before) {
    if (before && state.axiom === before.axiom && state.rules === before.rules && state.source === before.source)
        return;
    const rows = Object.entries({ 'Start (axiom)': state.axiom, Rules: state.rules, Source: state.source }).filter(
        ([, text]) => text !== '',
    );
    html('sheet').replaceChildren(...rows.flatMap(([name, text]) => [make('dt', {}, name), make('dd', {}, text)]));
}
