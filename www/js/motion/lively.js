/** The motion of a card under the pointer or with the focus: its plant grows once and then sways. */

import { reducedMotion } from '../base/dom.js';
import { at } from './growing.js';
import { emptyThumb, paintThumb } from '../dialogs/thumb.js';
import { strengthOf } from './wind.js';

/** @typedef {import('../state/state.js').Definition} Definition */

/** The time in which a system grows, and the time of a wave of the wind, in milliseconds. */
const GROWING_MS = 2000;
const WAVE_MS = 4000;
/** Later generations of a line hardly differ in a small picture. */
const MOST_GENERATIONS = 12;

/** Whether a system may branch. Only branches sway, and only what branches grows from a ground. @param {Definition} definition */
const branches = ({ axiom, rules }) => `${axiom}${rules}`.includes('[');

/**
 * The system some time after the beginning, or null at the end of the motion.
 * @param {Definition} definition
 * @param {number} time in milliseconds
 * @returns {Definition | null}
 */
export function moved(definition, time) {
    const part = time / GROWING_MS;
    if (part < 1) return at(definition, part * Math.min(definition.iterations, MOST_GENERATIONS));
    if (!branches(definition)) return null;
    const phase = (360 * (time - GROWING_MS)) / WAVE_MS;
    return { ...definition, sway: [Math.min(1, phase / 90) * strengthOf(definition), phase % 360] };
}

/**
 * Moves a card. The moving pictures lie over the still one, which is there again as soon as they end.
 * @param {HTMLElement} card
 * @param {HTMLElement} place the element with the still picture
 * @param {import('../engine/engine.js').Engine} engine
 * @param {() => Definition} definition
 * @param {number} side of the pictures, in CSS pixels
 */
export function enliven(card, place, engine, definition, side) {
    /** @type {HTMLCanvasElement | null} */
    let shown = null;

    async function start() {
        if (shown || reducedMotion()) return;
        const still = definition();
        const picture = emptyThumb();
        picture.classList.add('moving');
        picture.style.background = still.background;
        place.append(picture);
        shown = picture;
        const wanted = () => shown === picture && card.isConnected;
        const begun = performance.now();
        try {
            // One picture at a time: a slow worker makes fewer of them.
            for (let next = moved(still, 0); next && wanted(); next = moved(still, performance.now() - begun)) {
                await paintThumb(picture, engine, next, side, wanted, branches(still) ? still : null);
                await new Promise(requestAnimationFrame);
            }
        } catch {
            // Without a worker there is no motion, and the still picture stays.
        }
        if (shown === picture) stop();
    }

    function stop() {
        shown?.remove();
        shown = null;
    }

    card.addEventListener('pointerenter', ({ pointerType }) => {
        if (pointerType !== 'touch') void start();
    });
    card.addEventListener('focus', () => {
        if (card.matches(':focus-visible')) void start();
    });
    for (const event of ['pointerleave', 'blur', 'click']) card.addEventListener(event, stop);
}
