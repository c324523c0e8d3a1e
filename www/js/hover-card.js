/** The card beside the pointer: tells the segment or the polygon there, its symbol, and where that comes from. */

import { html, make } from './dom.js';
import { placeText } from './reading/places.js';
import { birth, birthOf, descent, filledText, strokeText, visible } from './reading/words.js';

/** Links of the chain that the card tells: beside a mouse, and where a finger leaves less room. */
const TOLD = { mouse: 4, touch: 1 };
/** What a finger tapped near the lower edge is told above: buttons stand there on a phone, in CSS pixels. */
const FOOT = 72;
/** Between the pointer and the card, in CSS pixels. */
const APART = { mouse: 18, touch: 34 };
/** Between the card and the stage's edge, in CSS pixels. */
const EDGE = 8;

/** @typedef {import('./protocol.js').Picked} Picked */
/** @typedef {{x: number, y: number, touch: boolean}} Place CSS pixels from the stage's upper left corner */

/** @param {HTMLElement} stage */
export function createHoverCard(stage) {
    const card = html('card');
    let told = '';

    /** @param {string} facts @param {Picked} picked @param {number} most links of the chain */
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

    /** Puts the card where there is room for it. @param {Place} place */
    function stand({ x, y, touch }) {
        const { width, height } = card.getBoundingClientRect();
        const apart = touch ? APART.touch : APART.mouse;
        const room = { width: stage.clientWidth, height: stage.clientHeight - (touch ? FOOT : 0) };
        const left = x + apart + width < room.width ? x + apart : Math.max(EDGE, x - apart - width);
        const top = y + apart + height < room.height ? y + apart : Math.max(EDGE, y - apart - height);
        card.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
    }

    return {
        /** @param {Picked} picked something @param {Place} place */
        show(picked, place) {
            const facts = factsOf(picked);
            if (told !== facts || card.hidden) fill(facts, picked, place.touch ? TOLD.touch : TOLD.mouse);
            told = facts;
            card.hidden = false;
            stand(place);
        },

        hide() {
            told = '';
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
