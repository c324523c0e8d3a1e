/** The growth animation: generations as a continuous value, the youngest modules growing in. */

import { createAnimation } from './animation.js';
import { button, reducedMotion } from '../base/dom.js';
import { definitionOf } from '../state/state.js';
import { say } from '../base/words.js';
import { marked } from '../base/numerals.js';

/** @typedef {import('./playback.js').Show} Show */

/** Seconds per generation, and limits for the whole animation. */
const EACH = 0.9;
const WHOLE = { least: 3, most: 14 };
/** Seconds of the growth that greets a new visitor. */
const GREETING = 2;
/** With reduced motion, the time for each whole generation, in milliseconds. */
const REDUCED_MOTION_MS = 1000;

/** The state at a point of growth: 2.25 is a quarter of the way from generation 2 to 3. @param {import('../state/state.js').Definition} definition @param {number} grown @returns {import('../state/state.js').Definition} */
export function at(definition, grown) {
    const iterations = Math.ceil(grown);
    return { ...definition, iterations, growth: iterations === 0 ? 1 : 1 - (iterations - grown) };
}

/** How long growing takes, in seconds. @param {number} iterations */
export function duration(iterations) {
    return Math.min(WHOLE.most, Math.max(WHOLE.least, EACH * iterations));
}

/**
 * @param {import('../state/store.js').Store} store
 * @param {import('../engine/engine.js').Engine} engine
 * @param {import('./animation.js').Page} page
 */
export function createGrowing(store, engine, page) {
    /** The generation, with the part of the next one that has grown. */
    let grown = 0;
    /** The generation that was requested last, or -1. */
    let requested = -1;
    /** Seconds of the whole animation. */
    let seconds = 0;
    /** Ends the greeting of a new visitor, in which nothing but the plant moves. @type {AbortController | null} */
    let greeting = null;
    const iterations = () => store.state.iterations;

    /** @param {number} time */
    function tick(time) {
        if (requested < 0) {
            request(0);
            return true;
        }
        if (reducedMotion() && time < REDUCED_MOTION_MS) return false;
        const next = reducedMotion() ? Math.floor(grown) + 1 : grown + (time / 1000 / seconds) * iterations();
        if (next >= iterations()) animation.stop();
        else request(next);
        return true;
    }

    /** Shows a point of growth. @param {number} next */
    function request(next) {
        grown = next;
        if (grown === requested) return;
        requested = grown;
        animation.draw(at(definitionOf(store.state), grown));
    }

    const own = { begins: page.begins, present: (/** @type {Show | null} */ shown) => greeting || page.present(shown) };
    const animation = createAnimation(button('grow'), store, engine, own, {
        start() {
            seconds = greeting ? GREETING : duration(iterations());
            requested = -1;
            grown = 0;
        },
        tick,
        part: () => (iterations() === 0 ? 1 : grown / iterations()),
        words: () => say`generation ${marked(grown.toFixed(1))} of ${String(iterations())}`,
        seek: (part) => request(part * iterations()),
        ended() {
            greeting?.abort();
            greeting = null;
        },
    });
    const { stop, forget } = animation;

    return {
        get moves() {
            return animation.moves;
        },
        /** Grows once, quickly. Any input ends it. */
        greet() {
            greeting = new AbortController();
            animation.begin();
            for (const input of ['pointerdown', 'keydown', 'wheel'])
                addEventListener(input, stop, { capture: true, passive: true, signal: greeting.signal });
        },
        /** A picture has come. The time until the first one is no part of growth. */
        drawn: () => animation.drawn(requested === 0),
        stop,
        forget,
    };
}
