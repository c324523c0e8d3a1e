/** What is under the pointer: marks the segment or the polygon, tells its symbol, and lights that in the string view. */

import { html } from './dom.js';
import { createHoverCard } from './hover-card.js';
import { latest } from './latest.js';

/** How near something must be, in CSS pixels. */
const NEAR = { mouse: 6, touch: 16 };
/** A press that moved or lasted more than this was no tap: CSS pixels, milliseconds. */
const SLIP = 6;
const LONG = 500;
/** A drawing in space that was turned rests after this time, in milliseconds. */
const REST_MS = 200;
/** @typedef {import('./protocol.js').Picked} Picked */
/** @typedef {import('./hover-card.js').Place} Place */

/**
 * @param {import('./engine.js').Engine} engine
 * @param {{ratio: () => number, mark: (points: number[][]) => void, light: (chain: import('./protocol.js').Link[]) => void, choose: (chain: import('./protocol.js').Link[]) => void, reading: () => boolean, upto: () => bigint | null, offered?: () => boolean}} page
 */
export function createHover(engine, { ratio, mark, light, choose, reading, upto, offered = () => true }) {
    const canvas = html('drawing');
    const stage = html('stage');
    const card = createHoverCard(stage);
    /** Where the pointer rests, or a finger tapped; null while it is elsewhere or drags. @type {Place | null} */
    let place = null;
    /** Whether what is there is to be chosen in the string view, too. */
    let choosing = false;
    /** @type {{x: number, y: number, time: number} | null} */
    let press = null;
    /** Runs while a drawing in space is being turned. */
    let turning = 0;

    const ask = latest(
        (/** @type {Place} */ { x, y, touch }, /** @type {boolean} */ _chosen) => engine.pick(x * ratio(), y * ratio(), (touch ? NEAR.touch : NEAR.mouse) * ratio()),
        (picked, _asked, chosen) => {
            if (place === null) return;
            if (turning || (picked.stroke ?? picked.filled) === null) return hide();
            tell(picked);
            if (!chosen) return;
            choose(picked.ancestry);
            // The string view says the same, and a phone has no room for both.
            if (place.touch && reading() && picked.ancestry.length > 0) card.hide();
        },
    );

    function hide() {
        card.hide();
        mark([]);
        light([]);
        canvas.classList.remove('found');
    }

    // Where the drawing becomes larger or smaller, other things are in that place.
    new ResizeObserver(leave).observe(stage);

    function leave() {
        if (place === null) return;
        place = null;
        choosing = false;
        hide();
    }

    /** @param {boolean} chosen */
    function look(chosen) {
        choosing ||= chosen;
        if (!place || turning || !offered()) return;
        ask(place, choosing);
        choosing = false;
    }

    /** @param {Picked} picked something */
    function tell(picked) {
        const { ancestry, stroke, filled } = picked;
        if (!place) return;
        mark(filled ? filled.outline : stroke ? [stroke.fittedFrom, stroke.fittedTo] : []);
        light(ancestry);
        canvas.classList.add('found');
        card.show(picked, place);
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
        // A finger always leaves; what it tapped stays until it taps elsewhere. WebKit says that a mouse left wherever
        // its button is released.
        if (event.pointerType === 'mouse' && document.elementFromPoint(event.clientX, event.clientY) !== canvas) leave();
    });

    return {
        /** The picture is another one: what is under the pointer may be, too. */
        drawn() {
            if (upto() === null) look(false);
        },
        /** The camera is at another place: what is under the pointer is told when it rests. */
        turned() {
            if (place !== null) hide();
            clearTimeout(turning);
            turning = window.setTimeout(() => {
                turning = 0;
                look(false);
            }, REST_MS);
        },
        /** What was told of is gone. */
        forget: leave,
    };
}
