/** The string view's card about the selected symbol: its ancestry back to the axiom, and the part of the drawing derived from it. */

import { html, make } from '../base/dom.js';
import { countText, placeText } from './places.js';
import { birth, birthOf, descent, origin, visible } from './words.js';
import { counted, say } from '../base/words.js';

/** @typedef {import('../protocol.js').AncestryLink} AncestryLink */
/** @typedef {import('../protocol.js').SymbolFacts} SymbolFacts */
/** The symbol, if loaded, its meaning in words, its index and generation, and the drawn generation. @typedef {{symbol: string | undefined, words: string, index: bigint, generation: number, iterations: number}} Chosen */

const UNTRACED = say`This derivation is too long to record, so the origin of the symbol is unknown.`;

/** @param {(generation: number, index: bigint) => void} goTo shows a symbol of the chain */
export function createOriginCard(goTo) {
    const card = html('reader-path');

    /** @param {AncestryLink} link @param {AncestryLink} own the chosen symbol's */
    function item(link, own) {
        const here = make(
            'button',
            { class: 'link' },
            make('kbd', {}, visible(link.symbol)),
            make('span', {}, birth(link)),
        );
        here.addEventListener('click', () => goTo(link.generation, BigInt(link.index)));
        return make('li', link.generation === own.generation && link.index === own.index ? { class: 'own' } : {}, here);
    }

    return {
        clear() {
            card.replaceChildren(make('p', { class: 'note' }, say`Select a symbol to see its origin.`));
        },

        /** @param {Chosen} chosen @param {SymbolFacts} facts */
        show(chosen, { ancestry, part, stroke }) {
            const own = ancestry.at(-1);
            if (!own) {
                card.replaceChildren(
                    make(
                        'p',
                        { class: 'path-head' },
                        make('kbd', {}, visible(chosen.symbol ?? '?')),
                        say`symbol ${placeText(chosen.index + 1n)}`,
                    ),
                    make('p', { class: 'note' }, UNTRACED),
                );
                return;
            }
            card.replaceChildren(
                make(
                    'p',
                    { class: 'path-head' },
                    make('kbd', {}, visible(own.symbol)),
                    make('span', {}, own.symbol.length === 1 ? origin(ancestry) : birthOf(ancestry)),
                ),
                ...(chosen.words
                    ? [
                          make(
                              'p',
                              { class: 'note meaning' },
                              chosen.words.replace(/^./u, (letter) => letter.toUpperCase()),
                          ),
                      ]
                    : []),
                make('p', { class: 'note' }, part ? drawnText(chosen, part, stroke !== null) : ''),
                make(
                    'ol',
                    { class: 'links', 'aria-label': say`Origin of the symbol, back to the axiom` },
                    ...descent(ancestry).map((link) => item(link, own)),
                ),
            );
        },
    };
}

/** The part of the drawing derived from a symbol, in words. @param {Chosen} chosen @param {import('../protocol.js').Descendants} part @param {boolean} placed whether the part has a place in the drawing */
function drawnText({ generation, iterations }, { symbols, segments }, placed) {
    const from = BigInt(segments[0]);
    const count = BigInt(segments[1]) - from;
    const drawn =
        count === 1n
            ? say`segment ${placeText(from + 1n)}, marked in the drawing`
            : count > 0n
              ? say`${countText(count)} segments, marked in the drawing`
              : placed
                ? say`draws no segment, marked at the turtle’s position`
                : say`draws no segment`;
    const grown = BigInt(symbols[1]) - BigInt(symbols[0]);
    const all =
        generation === iterations
            ? `${drawn}.`
            : counted(
                  grown,
                  '{1} symbols at n = {2}: {3}.',
                  '{1} symbols at n = {2}: {3}.',
                  countText(grown),
                  String(iterations),
                  drawn,
              );
    return all.replace(/^./, (letter) => letter.toUpperCase());
}
