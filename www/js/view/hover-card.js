/** The card beside the pointer: the segment or polygon there, its symbol, and the symbol's ancestry. */

import { html, make } from '../base/dom.js';
import { setLayer } from '../base/layers.js';
import { placeText } from '../reading/places.js';
import { birth, birthOf, descent, filledText, strokeText, visible } from '../reading/words.js';
import { counted, say } from '../base/words.js';

/** How many ancestors the card shows. A finger leaves less room. */
const MAX_ANCESTORS = { mouse: 4, touch: 1 };
/** The distance from the pointer to the card, in CSS pixels. */
const APART = { mouse: 18, touch: 34 };
/** The distance from the card to the stage's edge, in CSS pixels. */
const EDGE = 8;

/** @typedef {import('../protocol.js').Picked} Picked */
/** @typedef {{x: number, y: number, touch: boolean}} StagePoint CSS pixels from the stage's upper left corner */
/** The card's left and top, in CSS pixels from the stage's upper left corner. @typedef {[number, number]} Corner */

/**
 * @param {HTMLElement} stage
 * @param {{hidden: () => void, read: (ancestry: Picked['ancestry']) => void}} page `read` opens the string at a symbol
 */
export function createHoverCard(stage, { hidden, read }) {
    const card = html('card');
    let shownFacts = '';

    function close() {
        hide();
        hidden();
    }

    function hide() {
        shownFacts = '';
        card.hidden = true;
        setLayer(close, false);
    }

    return {
        /** @param {Picked} picked with a segment or a polygon @param {StagePoint} place */
        show(picked, place) {
            const facts = factsOf(picked);
            if (shownFacts !== facts || card.hidden) fill(read, card, facts, picked, place.touch);
            shownFacts = facts;
            if (card.hidden) setLayer(close, true);
            card.hidden = false;
            position(stage, card, place);
        },

        hide,
    };
}

/**
 * @param {(ancestry: Picked['ancestry']) => void} read
 * @param {HTMLElement} card
 * @param {string} facts
 * @param {Picked} picked
 * @param {boolean} touch
 */
function fill(read, card, facts, { symbol, ancestry }, touch) {
    const most = touch ? MAX_ANCESTORS.touch : MAX_ANCESTORS.mouse;
    const own = ancestry.at(-1);
    const [, ...older] = descent(ancestry);
    const more = older.length - most;
    // A mouse opens the string with a click on the segment.
    const show = make('button', { class: 'button card-read' }, say`Show in the string`);
    show.addEventListener('click', () => read(ancestry));
    card.replaceChildren(
        ...(own
            ? [
                  make(
                      'p',
                      { class: 'card-head' },
                      make('kbd', {}, visible(own.symbol)),
                      make('span', {}, birthOf(ancestry)),
                  ),
              ]
            : []),
        ...(older.length > 0
            ? [
                  make(
                      'ol',
                      { class: 'card-path' },
                      ...older
                          .slice(0, most)
                          .map((link) =>
                              make('li', {}, make('kbd', {}, visible(link.symbol)), make('span', {}, birth(link))),
                          ),
                      ...(more > 0
                          ? [
                                make(
                                    'li',
                                    { class: 'more' },
                                    counted(more, 'and {} more, back to the axiom', 'and {} more, back to the axiom'),
                                ),
                            ]
                          : []),
                  ),
              ]
            : []),
        make(
            'p',
            { class: 'card-facts' },
            facts,
            ...(symbol === null ? [] : [make('br'), say`Symbol ${number(symbol)}`]),
        ),
        ...(touch && ancestry.length > 0 ? [show] : []),
    );
}

/**
 * Moves the card beside the pointer, to a place without buttons.
 * @param {HTMLElement} stage
 * @param {HTMLElement} card
 * @param {StagePoint} place
 */
function position(stage, card, { x, y, touch }) {
    const apart = touch ? APART.touch : APART.mouse;
    const frame = stage.getBoundingClientRect();
    const { width, height } = card.getBoundingClientRect();
    const [right, bottom] = [frame.width - EDGE - width, frame.height - EDGE - height];
    const isInside = (/** @type {Corner} */ [left, top]) =>
        left >= EDGE && left <= right && top >= EDGE && top <= bottom;
    const tools = [...stage.querySelectorAll('.tools, .trouble:not([hidden])')].map((bar) =>
        bar.getBoundingClientRect(),
    );
    const isFree = (/** @type {Corner} */ [left, top]) => {
        const [clientLeft, clientTop] = [frame.left + left, frame.top + top];
        return !tools.some(
            (bar) =>
                bar.left < clientLeft + width &&
                bar.right > clientLeft &&
                bar.top < clientTop + height &&
                bar.bottom > clientTop,
        );
    };
    /** @type {Corner[]} */
    const corners = [y + apart, y - apart - height, y - height / 2].flatMap((top) =>
        [x + apart, x - apart - width, x - width / 2].map((left) => /** @type {Corner} */ ([left, top])),
    );
    // The last corner would put the card under the pointer.
    const inside = corners.slice(0, -1).filter(isInside);
    const [left, top] = inside.find(isFree) ??
        inside[0] ?? [Math.max(EDGE, Math.min(right, x + apart)), Math.max(EDGE, Math.min(bottom, y + apart))];
    card.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
}

/** @param {Picked} picked */
function factsOf({ segment, polygon, stroke, filled }) {
    if (stroke) return say`Segment ${number(segment)}, ${strokeText(stroke)}`;
    return filled ? say`Polygon ${number(polygon)}, ${filledText(filled)}` : '';
}

/** @param {string | null} digits counted from 0 */
function number(digits) {
    return placeText(BigInt(digits ?? 0) + 1n, 15);
}
