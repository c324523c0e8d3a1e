/** Marks the segment or polygon under the pointer, shows its symbol on a card, and highlights the symbol in the string view. */

import { html } from '../base/dom.js';
import { createHoverCard } from './hover-card.js';
import { latest } from '../base/latest.js';

/** How near the pointer a segment or polygon must be, in CSS pixels. */
const NEAR = { mouse: 6, touch: 16 };
/** A press that moved farther (CSS pixels) or lasted longer (milliseconds) is no tap. */
const TAP_DISTANCE = 6;
const TAP_MS = 500;
/** The pause after the last turn of a drawing in space, in milliseconds. */
const REST_MS = 200;
/** @typedef {import('../protocol.js').Picked} Picked */
/** @typedef {import('./hover-card.js').StagePoint} Place */

/**
 * @param {import('../engine/engine.js').Engine} engine
 * @param {object} page
 * @param {{resolution: () => {ratio: number}}} page.stage
 * @param {{found: (points: number[][]) => void}} page.marks
 * @param {ReturnType<typeof import('../reading/reader.js').createReader>} page.reader
 * @param {{readonly upto: bigint | null}} page.playback
 * @param {() => boolean} [page.offered] whether symbols are shown
 */
export function createHover(engine, { stage: drawing, marks, reader, playback, offered = () => true }) {
    const canvas = html('drawing');
    const stage = html('stage');
    const card = createHoverCard(stage, { hidden: () => leave(), read: reader.read });
    const signs = createSigns(canvas, card, marks, reader);
    const { hide } = signs;
    /** Where the pointer is, or a finger tapped; null while the pointer is elsewhere or drags. @type {Place | null} */
    let place = null;
    /** Whether to select the symbol in the string view as well. */
    let choosing = false;
    /** The timer that runs while a drawing in space turns. */
    let turning = 0;

    const ask = latest(
        (/** @type {Place} */ { x, y, touch }, /** @type {boolean} */ _chosen) => {
            const { ratio } = drawing.resolution();
            return engine.pick(x * ratio, y * ratio, (touch ? NEAR.touch : NEAR.mouse) * ratio);
        },
        (picked, _asked, chosen) => {
            if (place === null) return;
            if (turning || (picked.stroke ?? picked.filled) === null) return hide();
            signs.show(picked, place);
            if (!chosen) return;
            if (place.touch) reader.choose(picked.ancestry);
            else reader.read(picked.ancestry);
            // The string view shows the same facts, and a phone has no room for both.
            if (place.touch && reader.open && picked.ancestry.length > 0) card.hide();
        },
    );

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

    followPointer(canvas, stage, {
        leave,
        at(next, isTap) {
            place = next;
            look(isTap);
        },
    });

    return {
        /** A new picture has come: asks again what is under the pointer. */
        drawn() {
            if (playback.upto === null) look(false);
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

/**
 * The signs of what is under the pointer: its mark, its card and its symbol in the string view.
 * @param {HTMLElement} canvas
 * @param {ReturnType<typeof createHoverCard>} card
 * @param {{found: (points: number[][]) => void}} marks
 * @param {ReturnType<typeof import('../reading/reader.js').createReader>} reader
 */
function createSigns(canvas, card, marks, reader) {
    return {
        hide() {
            card.hide();
            marks.found([]);
            reader.light([]);
            canvas.classList.remove('found');
        },
        /** @param {Picked} picked with a segment or a polygon @param {Place} place */
        show(picked, place) {
            const { ancestry, stroke, filled } = picked;
            marks.found(filled ? filled.outline : stroke ? [stroke.fittedFrom, stroke.fittedTo] : []);
            reader.light(ancestry);
            canvas.classList.add('found');
            card.show(picked, place);
        },
    };
}

/**
 * Tells where the mouse is, or a finger tapped.
 * @param {HTMLElement} canvas
 * @param {HTMLElement} stage
 * @param {{at: (place: Place, isTap: boolean) => void, leave: () => void}} told `leave` when the pointer is elsewhere or drags
 */
function followPointer(canvas, stage, { at, leave }) {
    /** @type {{x: number, y: number, time: number} | null} */
    let press = null;

    /** @param {PointerEvent} event @returns {Place} */
    function placeOf(event) {
        const box = stage.getBoundingClientRect();
        return { x: event.clientX - box.left, y: event.clientY - box.top, touch: event.pointerType !== 'mouse' };
    }

    canvas.addEventListener('pointermove', (event) => {
        if (press && Math.hypot(event.clientX - press.x, event.clientY - press.y) <= TAP_DISTANCE) return;
        if (event.buttons !== 0) return leave();
        if (event.pointerType !== 'mouse') return;
        at(placeOf(event), false);
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
        at(placeOf(event), true);
    });
    canvas.addEventListener('pointerleave', (event) => {
        // A finger always leaves; its mark stays until the next tap. WebKit also sends pointerleave when a mouse button
        // is released.
        if (event.pointerType === 'mouse' && document.elementFromPoint(event.clientX, event.clientY) !== canvas)
            leave();
    });
}
