/** Marks the segment or polygon under the pointer, shows its symbol on a card, and highlights the symbol in the string view. */

import { html } from './dom.js';
import { createHoverCard } from './hover-card.js';
import { latest } from './latest.js';

/** How near the pointer a segment or polygon must be, in CSS pixels. */
const NEAR = { mouse: 6, touch: 16 };
/** A press that moved farther (CSS pixels) or lasted longer (milliseconds) is no tap. */
const TAP_DISTANCE = 6;
const TAP_MS = 500;
/** The pause after the last turn of a drawing in space, in milliseconds. */
const REST_MS = 200;
/** @typedef {import('./protocol.js').Picked} Picked */
/** @typedef {import('./hover-card.js').StagePoint} Place */

/**
 * @param {import('./engine.js').Engine} engine
 * `choose` selects a symbol in the open string, `read` opens the string there.
 * @param {{ratio: () => number, mark: (points: number[][]) => void, light: (chain: import('./protocol.js').AncestryLink[]) => void, choose: (chain: import('./protocol.js').AncestryLink[]) => void, read: (chain: import('./protocol.js').AncestryLink[]) => void, reading: () => boolean, upto: () => bigint | null, offered?: () => boolean}} page
 */
export function createHover(engine, { ratio, mark, light, choose, read, reading, upto, offered = () => true }) {
    const canvas = html('drawing');
    const stage = html('stage');
    const card = createHoverCard(stage, { hidden: () => leave(), read });
    /** Where the pointer is, or a finger tapped; null while the pointer is elsewhere or drags. @type {Place | null} */
    let place = null;
    /** Whether to select the symbol in the string view as well. */
    let choosing = false;
    /** @type {{x: number, y: number, time: number} | null} */
    let press = null;
    /** The timer that runs while a drawing in space turns. */
    let turning = 0;

    const ask = latest(
        (/** @type {Place} */ { x, y, touch }, /** @type {boolean} */ _chosen) =>
            engine.pick(x * ratio(), y * ratio(), (touch ? NEAR.touch : NEAR.mouse) * ratio()),
        (picked, _asked, chosen) => {
            if (place === null) return;
            if (turning || (picked.stroke ?? picked.filled) === null) return hide();
            show(picked);
            if (!chosen) return;
            if (place.touch) choose(picked.ancestry);
            else read(picked.ancestry);
            // The string view shows the same facts, and a phone has no room for both.
            if (place.touch && reading() && picked.ancestry.length > 0) card.hide();
        },
    );

    function hide() {
        card.hide();
        mark([]);
        light([]);
        canvas.classList.remove('found');
    }

    // When the stage is resized, another part of the drawing is at that place.
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

    /** @param {Picked} picked with a segment or a polygon */
    function show(picked) {
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
        if (press && Math.hypot(event.clientX - press.x, event.clientY - press.y) <= TAP_DISTANCE) return;
        if (event.buttons !== 0) return leave();
        if (event.pointerType !== 'mouse') return;
        place = placeOf(event);
        look(false);
    });
    canvas.addEventListener('pointerdown', (event) => {
        press =
            event.isPrimary && event.button === 0
                ? { x: event.clientX, y: event.clientY, time: event.timeStamp }
                : null;
    });
    canvas.addEventListener('pointerup', (event) => {
        const tap =
            press &&
            event.isPrimary &&
            Math.hypot(event.clientX - press.x, event.clientY - press.y) <= TAP_DISTANCE &&
            event.timeStamp - press.time < TAP_MS;
        press = null;
        if (!tap) return;
        place = placeOf(event);
        look(true);
    });
    canvas.addEventListener('pointerleave', (event) => {
        // A finger always leaves; its mark stays until the next tap. WebKit also sends pointerleave when a mouse button
        // is released.
        if (event.pointerType === 'mouse' && document.elementFromPoint(event.clientX, event.clientY) !== canvas)
            leave();
    });

    return {
        /** A new picture has come: asks again what is under the pointer. */
        drawn() {
            if (upto() === null) look(false);
        },
        /** The camera has moved: hides the card until the camera rests. */
        turned() {
            if (place !== null) hide();
            clearTimeout(turning);
            turning = window.setTimeout(() => {
                turning = 0;
                look(false);
            }, REST_MS);
        },
        /** The drawing has changed. */
        forget: leave,
    };
}
