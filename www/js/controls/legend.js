/** What the symbols of the newest valid system do, in words. */

import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').Report} Report */

export function createLegend() {
    /** @type {Report['legend']} */
    let legend = [];

    return {
        /** Takes the symbols in use. @param {Report} report */
        report(report) {
            if (report.ok) legend = report.legend;
        },

        /** A symbol with its meaning, such as `turns left by 25°`; null for a symbol that is not in use. @param {string} symbol @returns {{symbol: string, words: string, acts: boolean} | null} */
        of(symbol) {
            const entry = legend.find((each) => each.symbol.startsWith(symbol));
            if (!entry) return null;
            const actions = entry.actions || say`draws nothing`;
            return {
                symbol: entry.symbol,
                words: entry.rewritten ? say`${actions}; replaced by its rule at each iteration.` : `${actions}.`,
                acts: entry.actions !== '',
            };
        },
    };
}
