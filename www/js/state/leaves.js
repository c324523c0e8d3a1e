/** Leaves for a system. */

/** @typedef {import('./state.js').State} State */

/** The colour of leaves in a drawing of one colour. */
export const GREEN = '#4f8a34';

/**
 * The changes that give a system leaves: at its buds, which are symbols that only become branches; or, without any, at
 * the end of each branch by a symbol of their own.
 * @param {Readonly<Pick<State, 'axiom' | 'rules' | 'overrides' | 'dialect' | 'palette' | 'colourBy'>>} state
 * @param {string} shape of the leaves
 * @returns {Partial<State>}
 */
export function withLeaves({ axiom, rules, overrides, dialect, palette, colourBy }, shape) {
    const lines = overrides.split('\n').filter(Boolean);
    const former = lines.find((line) => /: .*\bleaf\b/.test(line));
    const others = lines.filter((line) => line !== former);
    const isTaken = (/** @type {string} */ symbol) => others.some((line) => line.startsWith(`${symbol}:`));
    const buds = [...rules.matchAll(/^\s*([A-Za-z])[^\n]*->/gm)].map(([, symbol = '']) => symbol);
    const bud = dialect === 'abop' ? buds.find((symbol) => !'FGfg'.includes(symbol) && !isTaken(symbol)) : undefined;
    const leaf = [...'LKQZ'].find((symbol) => !(axiom + rules).includes(symbol)) ?? 'L';
    const symbol = former?.charAt(0) ?? bud ?? leaf;
    const isOwn = !former && !bud;
    const ends = rules.includes(']') ? { rules: rules.replaceAll(']', `${leaf}]`) } : { axiom: axiom + leaf };
    const isGreen = colourBy === 'single';
    return {
        ...(isOwn ? ends : {}),
        ...(isGreen && palette.length === 1 ? { palette: [...palette, GREEN] } : {}),
        overrides: [...others, `${symbol}: ${isGreen ? 'colour 1, ' : ''}leaf ${shape} 1.2`].join('\n'),
    };
}
