/** The card beside the pointer: the segment or polygon there, its symbol, and the symbol's ancestry. */

import { html, make } from './dom.js';
import { placeText } from './reading/places.js';
import { birth, birthOf, descent, filledText, strokeText, visible } from './reading/words.js';

/** How many ancestors the card shows. A finger leaves less room. */
const MAX_ANCESTORS = { mouse: 4, touch: 1 };
/** The lower edge of the stage that the card avoids on touch screens, because phones show buttons there, in CSS pixels. */
const FOOT = 72;
/** The distance from the pointer to the card, in CSS pixels. */
const APART = { mouse: 18, touch: 34 };
/** The distance from the card to the stage's edge, in CSS pixels. */
const EDGE = 8;

/** @typedef {import('./protocol.js').Picked} Picked */
/** @typedef {{x: number, y: number, touch: boolean}} StagePoint CSS pixels from the stage's upper left corner */

/** @param {HTMLElement} stage */
export function createHoverCard(stage) {
    const card = html('card');
    let shownFacts = '';

    /** @param {string} facts @param {Picked} picked @param {number} most ancestors */
    function fill(facts, { symbol, ancestry }, most) {
        const own = ancestry.at(-1);
        const [, ...older] = descent(ancestry);
        const more = older.length - most;
        card.replaceChildren(
            ...(own ? [make('p', { class: 'card-head' }, make('kbd', {}, visible(own.symbol)), make('span', {}, birthOf(ancestry)))] : []),
            ...(older.length > 0 ? [make('ol', { class: 'card-path' }, ...older.slice(0, most).map((link) => make('li', {}, make('kbd', {}, visible(link.symbol)), make('span', {}, birth(link)))), ...(more > 0 ? [make('li', { class: 'more' }, `and ${more} more, back to the axiom`)] : []))] : []),
            make('p', { class: 'card-facts' }, facts, ...(symbol === null ? [] : [make('br'), `Symbol ${number(symbol)}`])),
        );
    }

    /** Moves the card to a place with room for it. @param {StagePoint} place */
    function position({ x, y, touch }) {
        const { width, height } = card.getBoundingClientRect();
        const apart = touch ? APART.touch : APART.mouse;
        const room = { width: stage.clientWidth, height: stage.clientHeight - (touch ? FOOT : 0) };
        const left = x + apart + width < room.width ? x + apart : Math.max(EDGE, x - apart - width);
        const top = y + apart + height < room.height ? y + apart : Math.max(EDGE, y - apart - height);
        card.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
    }

    return {
        /** @param {Picked} picked with a segment or a polygon @param {StagePoint} place */
        show(picked, place) {
            const facts = factsOf(picked);
            if (shownFacts !== facts || card.hidden) fill(facts, picked, place.touch ? MAX_ANCESTORS.touch : MAX_ANCESTORS.mouse);
            shownFacts = facts;
            card.hidden = false;
            position(place);
        },

        hide() {
            shownFacts = '';
            card.hidden = true;
        },
    };
}

/** @param {Picked} picked */
function factsOf({ segment, polygon, stroke, filled }) {
    if (stroke) return `Segment ${number(segment)}, ${strokeText(stroke)}`;
    return filled ? `Polygon ${number(polygon)}, ${filledText(filled)}` : '';
}

/** @param {string | null} digits counted from 0 */
function number(digits) {
    return placeText(BigInt(digits ?? 0) + 1n, 15);
}
