/** The tags by which gallery systems are filtered. Pure functions. */

/** @typedef {{kinds: string[], solid: boolean, memoised: boolean, blocks: number}} Facts */

/** All tags, with their meanings. */
export const TAGS = Object.freeze({
    deterministic: 'No randomness',
    stochastic: 'Productions are chosen at random',
    'context-sensitive': 'Productions depend on neighbouring symbols',
    parametric: 'Symbols have parameters',
    '2D': 'Drawn in the plane',
    '3D': 'Drawn in space',
    'reusable parts': 'Equal parts are drawn once, so many iterations are possible',
    'expanded in full': 'Every symbol is drawn separately, so memory limits the iterations',
});

/**
 * The tags of a system, in the order of TAGS.
 * @param {Facts} facts
 */
export function tagsOf({ kinds, solid, memoised }) {
    const own = [...kinds, solid ? '3D' : '2D', memoised ? 'reusable parts' : 'expanded in full'];
    return Object.keys(TAGS).filter((tag) => own.includes(tag));
}

/**
 * How the drawing of a system is made, in a few words.
 * @param {Facts} facts
 */
export function makingOf({ memoised, blocks }) {
    if (!memoised) return 'expanded in full';
    return blocks === 1 ? 'one part' : `${blocks} reusable parts`;
}

/** Pairs of tags that exclude each other. */
const EXCLUSIVE = [
    ['2D', '3D'],
    ['reusable parts', 'expanded in full'],
];

/**
 * Adds a tag to the chosen tags, or removes it.
 * @param {ReadonlySet<string>} chosen
 * @param {string} tag
 * @returns {Set<string>}
 */
export function choose(chosen, tag) {
    if (chosen.has(tag)) return new Set([...chosen].filter((each) => each !== tag));
    const rivals = EXCLUSIVE.find((pair) => pair.includes(tag)) ?? [];
    return new Set([...[...chosen].filter((each) => !rivals.includes(each)), tag]);
}

/**
 * How many systems have all the chosen tags.
 * @param {readonly string[][]} tagged the tags of each system
 * @param {ReadonlySet<string>} chosen
 */
export function count(tagged, chosen) {
    return tagged.filter((own) => [...chosen].every((tag) => own.includes(tag))).length;
}
