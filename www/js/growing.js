/** Growth as it is watched: generations as a continuous value, the youngest modules growing in. */

import { button, calm } from './dom.js';
import { definitionOf } from './state.js';

/** Seconds for a generation, and for all of them: at least and at most. */
const EACH = 0.9;
const WHOLE = { least: 3, most: 14 };
/** With less motion whole generations follow each other, in milliseconds. */
const CALM_MS = 1000;
/** A picture that takes longer is not waited for, in milliseconds. */
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
 * @param {{begins: () => void, tell: (words: string) => void}} page what is done before it grows, and what it says as it does
 */
export function createGrowing(store, engine, { begins, tell }) {
    const toggle = button('grow');
    let running = false;
    let frame = 0;
    let began = 0;
    /** When the last picture was asked for; 0 when it is shown. */
    let asked = 0;
    let shown = -1;

    /** @param {number} now */
    function tick(now) {
        frame = requestAnimationFrame(tick);
        if (asked && now - asked < PATIENCE) return;
        const definition = definitionOf(store.state);
        const part = (now - began) / 1000 / duration(definition.iterations);
        const whole = Math.floor((now - began) / CALM_MS);
        const grown = Math.min(definition.iterations, calm() ? whole : part * definition.iterations);
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

    /** Somebody changed the state, which the engine has already been told of. */
    function forget() {
        if (!running) return;
        running = false;
        cancelAnimationFrame(frame);
        toggle.setAttribute('aria-pressed', 'false');
    }

    /** Back to the state as it is. */
    function stop() {
        if (!running) return;
        forget();
        engine.define(definitionOf(store.state));
    }

    toggle.addEventListener('click', () => (running ? stop() : start()));

    return {
        /** Whether what the engine shows is not the state. */
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
