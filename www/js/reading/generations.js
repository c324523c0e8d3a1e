/** The buttons and the slider that choose the generation of the string view. */

import { button, html, input, setText } from '../base/dom.js';
import { say } from '../base/words.js';

/** @param {(to: number) => void} goTo */
export function createGenerations(goTo) {
    const slider = input('reader-step');
    let iterations = 0;
    /** The shown generation; null for the last. @type {number | null} */
    let step = null;
    const now = () => Math.min(step ?? iterations, iterations);

    button('reader-back').addEventListener('click', () => goTo(now() - 1));
    button('reader-on').addEventListener('click', () => goTo(now() + 1));
    slider.addEventListener('input', () => goTo(Number(slider.value)));

    return {
        now,
        get iterations() {
            return iterations;
        },

        /** The nearest existing generation. @param {number} generation */
        bounded: (generation) => Math.min(iterations, Math.max(0, generation)),

        /** @param {number} generation */
        set(generation) {
            step = generation === iterations ? null : generation;
        },

        /** @param {number} next */
        setIterations(next) {
            iterations = next;
            if (step !== null && step >= iterations) step = null;
        },

        show() {
            const shown = now();
            setText(html('reader-generation'), `n = ${shown}`);
            slider.max = String(iterations);
            slider.value = String(shown);
            slider.style.setProperty('--at', String(iterations === 0 ? 0 : shown / iterations));
            slider.setAttribute('aria-valuetext', say`generation ${String(shown)} of ${String(iterations)}`);
            button('reader-back').disabled = shown === 0;
            button('reader-on').disabled = shown === iterations;
        },
    };
}
