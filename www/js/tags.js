/** What systems of the gallery can be filtered by. Pure functions. */

/** @typedef {{kinds: string[], solid: boolean, memoised: boolean, blocks: number}} Sorts */

/** All tags, and what they mean. */
export const TAGS = Object.freeze({
    deterministic: 'No randomness',
    stochastic: 'Productions are chosen at random',
    'context-sensitive': 'Productions depend on neighbouring symbols',
    parametric: 'Symbols have parameters',
    '2D': 'Drawn in the plane',
    '3D': 'Drawn in space',
    'reusable parts': 'Equal parts are drawn once: any number of iterations',
    'expanded in full': 'Every symbol is drawn by itself: memory limits the iterations',
});

/**
 * The tags of a system, in the order of TAGS.
 * @param {Sorts} sorts
 */
export function tagsOf({ kinds, solid, memoised }) {
    const own = [...kinds, solid ? '3D' : '2D', memoised ? 'reusable parts' : 'expanded in full'];
    return Object.keys(TAGS).filter((tag) => own.includes(tag));
}

/**
 * How its drawing is made, in a few words.
 * @param {Sorts} sorts
 */
export function makingOf({ memoised, blocks }) {
    if (!memoised) return 'expanded in full';
    return blocks === 1 ? 'one part' : `${blocks} reusable parts`;
}

/** A system has one of each of these: who chooses one gives up the other. */
const EITHER = [
    ['2D', '3D'],
    ['reusable parts', 'expanded in full'],
];

/**
 * The chosen tags with one more, or without it if it was chosen.
 * @param {ReadonlySet<string>} chosen
 * @param {string} tag
 * @returns {Set<string>}
 */
export function choose(chosen, tag) {
    if (chosen.has(tag)) return new Set([...chosen].filter((each) => each !== tag));
    const rivals = EITHER.find((pair) => pair.includes(tag)) ?? [];
    return new Set([...[...chosen].filter((each) => !rivals.includes(each)), tag]);
}

/**
 * How many of these have all the chosen tags.
 * @param {readonly string[][]} tagged the tags of each
 * @param {ReadonlySet<string>} chosen
 */
export function count(tagged, chosen) {
    return tagged.filter((own) => [...chosen].every((tag) => own.includes(tag))).length;
}
