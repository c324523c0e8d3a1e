/** What systems of the gallery can be filtered by. Pure functions. */

/** @typedef {{kinds: string[], solid: boolean, memoised: boolean, blocks: number}} Sorts */

/** All tags, in groups of which one system has one at most, but for the kinds. */
export const TAGS = Object.freeze({
    deterministic: 'Nothing is left to chance',
    stochastic: 'Chance decides between productions',
    'context-sensitive': 'Productions look at what stands around a symbol',
    parametric: 'Symbols carry numbers',
    '2D': 'Drawn in the plane',
    '3D': 'The turtle leaves the plane',
    'shared pieces': 'Equal pieces are drawn once: any number of iterations',
    'symbol by symbol': 'Every symbol is grown by itself',
});

/**
 * The tags of a system, in the order of TAGS.
 * @param {Sorts} sorts
 */
export function tagsOf({ kinds, solid, memoised }) {
    const own = [...kinds, solid ? '3D' : '2D', memoised ? 'shared pieces' : 'symbol by symbol'];
    return Object.keys(TAGS).filter((tag) => own.includes(tag));
}

/**
 * How its drawing is made, in a few words.
 * @param {Sorts} sorts
 */
export function makingOf({ memoised, blocks }) {
    if (!memoised) return 'grown symbol by symbol';
    return blocks === 1 ? 'one piece' : `${blocks} shared pieces`;
}

/**
 * How many of these have all the chosen tags and one more, for each tag.
 * @param {readonly string[][]} tagged the tags of each
 * @param {ReadonlySet<string>} chosen
 * @returns {Map<string, number>}
 */
export function tally(tagged, chosen) {
    const counts = new Map(Object.keys(TAGS).map((tag) => [tag, 0]));
    for (const own of tagged) {
        if (![...chosen].every((tag) => own.includes(tag))) continue;
        for (const tag of own) counts.set(tag, (counts.get(tag) ?? 0) + 1);
    }
    return counts;
}
