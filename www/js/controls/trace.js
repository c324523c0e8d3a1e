/** Finds what a symbol of the axiom or of a rule became in the drawing. */

import { latest } from '../base/latest.js';
import { modulesOf, partsOf } from '../reading/words.js';

/** Only the first generations are searched for the first use of a rule, and only their first symbols. */
const MOST_GENERATIONS = 16;
const MOST_SYMBOLS = 5000;
/** The most symbols per generation that are checked, if other rules replace the same symbol. */
const MOST_CANDIDATES = 20;

/** @typedef {'axiom' | 'rules'} TextField */
/** @typedef {import('../protocol.js').SymbolFacts} SymbolFacts */

/** What to mark for a symbol: the outline of its part, or the turtle's position where it draws nothing. @param {SymbolFacts} facts @returns {number[][]} */
export function outlineOf({ part, stroke }) {
    const outline = part?.outline ?? [];
    return outline.length > 0 || !stroke ? outline : [stroke.fittedFrom];
}

/**
 * @param {import('../state/store.js').Store} store
 * @param {import('../engine/engine.js').Engine} engine
 * @param {(outline: number[][], place: {field: TextField, offset: number}) => void} found an empty outline: there is nothing to mark
 */
export function createTrace(store, engine, found) {
    /** @param {{field: TextField, offset: number}} place @returns {Promise<SymbolFacts | null>} */
    async function search({ field, offset }) {
        const { axiom, rules, overrides, iterations } = store.state;
        const site = await engine.site({ axiom, rules, overrides }, field, offset);
        if (!site) return null;
        if (site.production === null) return engine.symbol(0, BigInt(site.position));
        for (let generation = 0; generation < Math.min(iterations, MOST_GENERATIONS); generation++) {
            const { text, apart } = await engine.string(generation, 0n, MOST_SYMBOLS);
            if (text === null) return null;
            let candidates = 0;
            for (const [index, module] of modulesOf(text, apart).entries()) {
                if (partsOf(module)[0] !== partsOf(site.predecessor ?? '')[0]) continue;
                if (++candidates > MOST_CANDIDATES) break;
                const first = await engine.descendant(generation, BigInt(index), generation + 1);
                if (first === null) continue;
                const facts = await engine.symbol(generation + 1, BigInt(first) + BigInt(site.position));
                const own = facts.ancestry.at(-1);
                if (own?.production === site.production && own.position === site.position) return facts;
            }
        }
        return null;
    }

    return latest(search, (facts, place) => found(facts ? outlineOf(facts) : [], place));
}
