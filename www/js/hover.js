/** What is under the pointer: marks the segment, tells its symbol, and lights that in the string view. */

import { html, make } from './dom.js';
import { latest } from './latest.js';
import { DEEPEST } from './marks.js';
import { grouped, plain, shortText } from './numerals.js';
import { birth, birthOf, descent, visible } from './reading/words.js';

/** How near a segment must be, in CSS pixels. */
const NEAR = { mouse: 6, touch: 16 };
/** A press that moved or lasted more than this was no tap: CSS pixels, milliseconds. */
const SLIP = 6;
const LONG = 500;
/** Links of the chain that the card tells: beside a mouse, and where a finger leaves less room. */
const TOLD = { mouse: 4, touch: 1 };
/** What a finger tapped near the lower edge is told above: buttons stand there on a phone, in CSS pixels. */
const FOOT = 72;
/** Between the pointer and the card, in CSS pixels. */
const APART = { mouse: 18, touch: 34 };

/** @typedef {import('./engine.js').Picked} Picked */
/** @typedef {{x: number, y: number, touch: boolean}} Place CSS pixels from the stage's upper left corner */

/**
 * @param {import('./engine.js').Engine} engine
 * @param {{ratio: () => number, mark: (ends: [[number, number], [number, number]] | null) => void, light: (chain: import('./reading/words.js').Link[]) => void, choose: (chain: import('./reading/words.js').Link[]) => void, reading: () => boolean, zoom: () => number, upto: () => bigint | null}} page
 */
export function createHover(engine, { ratio, mark, light, choose, reading, zoom, upto }) {
    const canvas = html('drawing');
    const stage = html('stage');
    const card = html('card');
    /** Where the pointer rests, or a finger tapped; null while it is elsewhere or drags. @type {Place | null} */
    let place = null;
    let choosing = false;
    /** @type {{x: number, y: number, time: number} | null} */
    let press = null;
    let told = '';

    const ask = latest(
        (/** @type {Place} */ { x, y, touch }, /** @type {boolean} */ _chosen) => engine.pick(x * ratio(), y * ratio(), (touch ? NEAR.touch : NEAR.mouse) * ratio()),
        (picked, _asked, chosen) => {
            if (place === null) return;
            const shown = upto();
            const found = picked.segment !== null && (shown === null || BigInt(picked.segment) < shown) ? picked : null;
            if (!found) return hide();
            tell(found);
            if (!chosen) return;
            choose(found.ancestry);
            // The string view says the same, and a phone has no room for both.
            if (place.touch && reading() && found.ancestry.length > 0) card.hidden = true;
        },
    );

    function hide() {
        told = '';
        card.hidden = true;
        mark(null);
        light([]);
        canvas.classList.remove('found');
    }

    // Where the drawing becomes larger or smaller, other things are in that place.
    new ResizeObserver(leave).observe(stage);

    function leave() {
        if (place === null) return;
        place = null;
        hide();
    }

    /** @param {boolean} chosen */
    function look(chosen) {
        if (place && zoom() <= DEEPEST) ask(place, chosen);
    }

    /** @param {Picked} picked */
    function tell({ segment, symbol, ancestry, stroke }) {
        // Only what is in the plane is found by a place.
        if (!place || segment === null || !stroke?.fittedFrom || !stroke.fittedTo || typeof stroke.heading !== 'number') return;
        mark([stroke.fittedFrom, stroke.fittedTo]);
        light(ancestry);
        canvas.classList.add('found');
        if (told !== segment || card.hidden) {
            told = segment;
            const own = ancestry.at(-1);
            const [, ...older] = descent(ancestry);
            const most = place.touch ? TOLD.touch : TOLD.mouse;
            const more = older.length - most;
            const facts = [`Segment ${number(segment)}`, `heading ${plain(Number(stroke.heading.toFixed(2)))}°`, ...(stroke.level > 0 ? [`branch level ${stroke.level}`] : [])].join(', ');
            card.replaceChildren(
                ...(own ? [make('p', { class: 'card-head' }, make('kbd', {}, visible(own.symbol)), make('span', {}, birthOf(ancestry)))] : []),
                ...(older.length > 0 ? [make('ol', { class: 'card-path' }, ...older.slice(0, most).map((link) => make('li', {}, make('kbd', {}, visible(link.symbol)), make('span', {}, birth(link)))), ...(more > 0 ? [make('li', { class: 'more' }, `and ${more} more, back to the axiom`)] : []))] : []),
                make('p', { class: 'card-facts' }, facts, ...(symbol === null ? [] : [make('br'), `Symbol ${number(symbol)}`])),
            );
        }
        card.hidden = false;
        const { width, height } = card.getBoundingClientRect();
        const apart = place.touch ? APART.touch : APART.mouse;
        const room = { width: stage.clientWidth, height: stage.clientHeight };
        const left = place.x + apart + width < room.width ? place.x + apart : Math.max(8, place.x - apart - width);
        const top = place.y + apart + height < room.height - (place.touch ? FOOT : 0) ? place.y + apart : Math.max(8, place.y - apart - height);
        card.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
    }

    /** @param {PointerEvent} event @returns {Place} */
    function placeOf(event) {
        const box = stage.getBoundingClientRect();
        return { x: event.clientX - box.left, y: event.clientY - box.top, touch: event.pointerType !== 'mouse' };
    }

    canvas.addEventListener('pointermove', (event) => {
        if (press && Math.hypot(event.clientX - press.x, event.clientY - press.y) <= SLIP) return;
        if (event.buttons !== 0) return leave();
        if (event.pointerType !== 'mouse') return;
        place = placeOf(event);
        look(false);
    });
    canvas.addEventListener('pointerdown', (event) => {
        press = event.isPrimary && event.button === 0 ? { x: event.clientX, y: event.clientY, time: event.timeStamp } : null;
    });
    canvas.addEventListener('pointerup', (event) => {
        const tap = press && event.isPrimary && Math.hypot(event.clientX - press.x, event.clientY - press.y) <= SLIP && event.timeStamp - press.time < LONG;
        press = null;
        if (!tap) return;
        place = placeOf(event);
        look(true);
    });
    canvas.addEventListener('pointerleave', (event) => {
        // A finger always leaves; what it tapped stays until it taps elsewhere.
        if (event.pointerType === 'mouse') leave();
    });

    return {
        /** The picture is another one: what is under the pointer may be, too. */
        drawn() {
            if (upto() === null) look(false);
        },
        /** What was told of is gone. */
        forget: leave,
    };
}

/** @param {string} digits counted from 0 */
function number(digits) {
    const one = String(BigInt(digits) + 1n);
    return one.length > 15 ? shortText(one) : grouped(one);
}
