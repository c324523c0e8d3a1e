/** The growth animation: generations as a continuous value, the youngest modules growing in. */

import { button, reducedMotion } from './dom.js';
import { definitionOf } from './state.js';

/** Seconds per generation, and limits for the whole animation. */
const EACH = 0.9;
const WHOLE = { least: 3, most: 14 };
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
 * @param {{begins: () => void, tell: (words: string) => void}} page `begins` is called before growth begins, `tell` with each generation
 */
export function createGrowing(store, engine, { begins, tell }) {
    const toggle = button('grow');
    let running = false;
    let frame = 0;
    let began = 0;
    /** When the last picture was requested; 0 when it is shown. */
    let asked = 0;
    let shown = -1;

    /** @param {number} now */
    function tick(now) {
        frame = requestAnimationFrame(tick);
        if (asked && now - asked < PATIENCE) return;
        const definition = definitionOf(store.state);
        const part = (now - began) / 1000 / duration(definition.iterations);
        const whole = Math.floor((now - began) / REDUCED_MOTION_MS);
        const grown = Math.min(definition.iterations, reducedMotion() ? whole : part * definition.iterations);
        if (grown === definition.iterations) return stop();
        if (grown === shown) return;
        shown = grown;
        asked = now;
        engine.define(at(definition, grown));
        tell(`Growing: generation ${Math.ceil(grown)} of ${definition.iterations}.`);
    }

    function start() {
        begins();
        running = true;
        began = performance.now();
        asked = 0;
        shown = -1;
        toggle.setAttribute('aria-pressed', 'true');
        frame = requestAnimationFrame(tick);
    }

    /** The state has changed, and the engine already draws the new state. */
    function forget() {
        if (!running) return;
        running = false;
        cancelAnimationFrame(frame);
        toggle.setAttribute('aria-pressed', 'false');
    }

    /** Stops, and draws the state again. */
    function stop() {
        if (!running) return;
        forget();
        engine.define(definitionOf(store.state));
    }

    toggle.addEventListener('click', () => (running ? stop() : start()));

    return {
        /** Whether the engine shows a state of growth instead of the store's state. */
        get running() {
            return running;
        },
        /** A picture has come. */
        drawn() {
            asked = 0;
        },
        stop,
        forget,
    };
}
