/** The growth animation: generations as a continuous value, the youngest modules growing in. */

import { createAnimation } from './animation.js';
import { button, reducedMotion } from './dom.js';
import { definitionOf } from './state.js';
import { say } from './words.js';
import { marked } from './numerals.js';

/** Seconds per generation, and limits for the whole animation. */
const EACH = 0.9;
const WHOLE = { least: 3, most: 14 };
/** Seconds of the growth that greets a new visitor. */
const GREETING = 2;
/** With reduced motion, the time for each whole generation, in milliseconds. */
const REDUCED_MOTION_MS = 1000;
/** Pictures are waited for up to this time, in milliseconds. */
const PATIENCE = 4000;

/** The state at a point of growth: 2.25 is a quarter of the way from generation 2 to 3. @param {import('./state.js').Definition} definition @param {number} grown @returns {import('./state.js').Definition} */
export function at(definition, grown) {
    const iterations = Math.ceil(grown);
    return { ...definition, iterations, growth: iterations === 0 ? 1 : 1 - (iterations - grown) };
}

/** How long growing takes, in seconds. @param {number} iterations */
export function duration(iterations) {
    return Math.min(WHOLE.most, Math.max(WHOLE.least, EACH * iterations));
}

/**
 * @param {import('./store.js').Store} store
 * @param {import('./engine.js').Engine} engine
 * @param {{begins: () => void, present: (show: import('./playback.js').Show | null) => void}} page `begins` is called
 *   before growth begins; `present` shows growth on the playback bar, or the segments again
 */
export function createGrowing(store, engine, page) {
    /** The time of the last frame. */
    let before = 0;
    /** The generation, with the part of the next one that has grown. */
    let grown = 0;
    /** When the last picture was requested; 0 when it is shown. */
    let asked = 0;
    /** The generation that was requested last. */
    let requested = -1;
    /** Seconds of the whole animation. */
    let seconds = 0;
    /** Called when growth ends. */
    let ended = () => {};
    /** Whether a new visitor is greeted: nothing but the plant moves. */
    let isGreeting = false;
    const present = (/** @type {import('./playback.js').Show | null} */ shown) => {
        if (!isGreeting) page.present(shown);
    };
    const iterations = () => store.state.iterations;

    /** @param {number} now */
    function tick(now) {
        if (asked && now - asked < PATIENCE) return;
        const time = now - before;
        if (reducedMotion() && time < REDUCED_MOTION_MS) return;
        before = now;
        const next = reducedMotion() ? Math.floor(grown) + 1 : grown + (time / 1000 / seconds) * iterations();
        if (next >= iterations()) return animation.stop();
        request(next, now);
    }

    /** Shows a point of growth. @param {number} next @param {number} now */
    function request(next, now) {
        grown = next;
        if (grown !== requested) {
            requested = grown;
            asked = now;
            engine.define({ ...at(definitionOf(store.state), grown), still: true });
        }
        present(show);
    }

    function start(lasts = duration(iterations())) {
        page.begins();
        seconds = lasts;
        animation.begin();
        asked = 0;
        requested = -1;
        request(0, performance.now());
        animation.resume();
    }

    const animation = createAnimation({
        toggle: button('grow'),
        start,
        tick,
        resumed: () => {
            before = performance.now();
        },
        forgotten: () => {
            ended();
            ended = () => {};
            present(null);
            isGreeting = false;
        },
        draw: () => engine.define(definitionOf(store.state)),
    });
    const { pause, stop, forget } = animation;

    /** @type {import('./playback.js').Show} */
    const show = {
        get playing() {
            return animation.playing;
        },
        get part() {
            return iterations() === 0 ? 1 : grown / iterations();
        },
        get words() {
            return say`generation ${marked(grown.toFixed(1))} of ${String(iterations())}`;
        },
        toggle() {
            if (animation.playing) pause();
            else animation.resume();
            present(show);
        },
        seek(part) {
            pause();
            request(part * iterations(), performance.now());
        },
        stop,
    };

    return {
        /** Whether the engine shows a state of growth instead of the store's state. */
        get running() {
            return animation.running;
        },
        /** Grows once, quickly. Any input ends it. */
        greet() {
            isGreeting = true;
            start(GREETING);
            const over = new AbortController();
            for (const input of ['pointerdown', 'keydown', 'wheel'])
                addEventListener(input, end, { capture: true, passive: true, signal: over.signal });
            function end() {
                over.abort();
                stop();
            }
            ended = () => over.abort();
        },
        /** A picture has come. */
        drawn() {
            asked = 0;
            // The time until the first picture is no part of growth.
            if (requested === 0) before = performance.now();
        },
        stop,
        forget,
    };
}
