/** What the reader tells of the chosen symbol: where it comes from, back to the axiom, and what it has become in the drawing. */

import { html, make } from '../dom.js';
import { countText, placeText } from './places.js';
import { birth, birthOf, descent, origin, visible } from './words.js';

/** @typedef {import('../protocol.js').Link} Link */
/** @typedef {import('../protocol.js').SymbolFacts} SymbolFacts */
/** The symbol itself, if it is at hand, and where it stands; and the generation that is drawn. @typedef {{symbol: string | undefined, index: bigint, generation: number, iterations: number}} Chosen */

const UNTRACED = 'This derivation is too long to be remembered, so where the symbol comes from is not known.';

/** @param {(generation: number, index: bigint) => void} turn to a symbol of the chain */
export function createOriginCard(turn) {
    const card = html('reader-path');

    /** @param {Link} link @param {Link} own the chosen symbol's */
    function item(link, own) {
        const here = make('button', { type: 'button', class: 'link' }, make('kbd', {}, visible(link.symbol)), make('span', {}, birth(link)));
        here.addEventListener('click', () => turn(link.generation, BigInt(link.index)));
        return make('li', link.generation === own.generation && link.index === own.index ? { class: 'own' } : {}, here);
    }

    return {
        clear() {
            card.replaceChildren(make('p', { class: 'note' }, 'Choose a symbol to see where it comes from.'));
        },

        /** @param {Chosen} chosen @param {SymbolFacts} facts */
        show(chosen, { ancestry, part, stroke }) {
            const own = ancestry.at(-1);
            if (!own) {
                card.replaceChildren(make('p', { class: 'path-head' }, make('kbd', {}, visible(chosen.symbol ?? '?')), `symbol ${placeText(chosen.index + 1n)}`), make('p', { class: 'note' }, UNTRACED));
                return;
            }
            card.replaceChildren(
                make('p', { class: 'path-head' }, make('kbd', {}, visible(own.symbol)), make('span', {}, own.symbol.length === 1 ? origin(ancestry) : birthOf(ancestry))),
                make('p', { class: 'note' }, part ? drawnText(chosen, part, stroke !== null) : ''),
                make('ol', { class: 'links', 'aria-label': 'Where it comes from, back to the axiom' }, ...descent(ancestry).map((link) => item(link, own))),
            );
        },
    };
}

/** What a symbol has become in the drawing, in words. @param {Chosen} chosen @param {import('../protocol.js').Part} part @param {boolean} placed whether it has a place there */
function drawnText({ generation, iterations }, { symbols, segments }, placed) {
    const from = BigInt(segments[0]);
    const count = BigInt(segments[1]) - from;
    const grown = generation === iterations ? '' : `${countText(BigInt(symbols[1]) - BigInt(symbols[0]))} symbols at n = ${iterations}: `;
    const drawn = count === 0n ? `draws no segment itself${placed ? ', marked where the turtle is' : ''}` : `${count === 1n ? `segment ${placeText(from + 1n)}` : `${countText(count)} segments`}, marked in the drawing`;
    return `${grown}${drawn}.`.replace(/^./, (letter) => letter.toUpperCase());
}
