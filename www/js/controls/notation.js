/** Syntax of the state's texts: asks the core after each change and passes the answer to listeners. */

import { latest } from '../base/latest.js';

/** @typedef {import('../protocol.js').Notation} Notation */
/** @typedef {import('../protocol.js').Texts} Texts */
/** @typedef {{read: (notation: Notation, texts: Texts) => void}} NotationListener `texts` may be older than the texts on the page */

/**
 * @param {import('../state/store.js').Store} store
 * @param {import('../engine/engine.js').Engine} engine
 * @param {NotationListener[]} listeners
 */
export function followNotation(store, engine, listeners) {
    const ask = latest(engine.notation, (notation, texts) => {
        for (const listener of listeners) listener.read(notation, texts);
    });
    /** @param {Readonly<Texts>} state */
    const follow = ({ axiom, rules, overrides }) => ask({ axiom, rules, overrides });
    store.subscribe((state, before) => {
        if (state.axiom !== before.axiom || state.rules !== before.rules || state.overrides !== before.overrides)
            follow(state);
    });
    follow(store.state);
}
