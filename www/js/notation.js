/** How the texts of the state read: asks the core when one has changed, and tells those who show it. */

import { latest } from './latest.js';

/** @typedef {import('./protocol.js').Notation} Notation */
/** @typedef {import('./protocol.js').Texts} Texts */
/** @typedef {{read: (notation: Notation, texts: Texts) => void}} Reader `texts` may be older than what is on the page */

/**
 * @param {import('./store.js').Store} store
 * @param {import('./engine.js').Engine} engine
 * @param {Reader[]} readers
 */
export function followNotation(store, engine, readers) {
    const ask = latest(engine.notation, (notation, texts) => {
        for (const reader of readers) reader.read(notation, texts);
    });
    /** @param {Readonly<Texts>} state */
    const follow = ({ axiom, rules, overrides }) => ask({ axiom, rules, overrides });
    store.subscribe((state, before) => {
        if (state.axiom !== before.axiom || state.rules !== before.rules || state.overrides !== before.overrides) follow(state);
    });
    follow(store.state);
}
