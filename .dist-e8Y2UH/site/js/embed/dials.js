/** Sliders and fields for the iterations and the angles of an embedded drawing. */

import { html, input, setText } from '../dom.js';
import { numberField } from '../controls/number-field.js';
import { even, slider } from '../controls/slider.js';
import { plain } from '../numerals.js';
import { MAX_ITERATIONS } from '../state.js';

/** The slider reaches twice as far as the author went, or so far. */
const FEW = 10;
const MOST = 100;
const DEGREES = { low: -3600, high: 3600, step: 1 };

/**
 * @param {import('../store.js').Store} store
 */
export function createDials(store) {
    const settle = () => store.settle();
    const { iterations } = store.origin;
    const steps = { change: (/** @type {number} */ n) => store.change({ iterations: n }, 'iterations'), settle };
    const turns = { change: (/** @type {number} */ angle) => store.change({ angle }, 'angle'), settle };
    const rights = { change: (/** @type {number} */ angle) => store.change({ rightAngle: angle }, 'rightAngle'), settle };
    const stepSlider = slider(input('iterations-slider'), { stops: even(0, Math.min(MOST, Math.max(FEW, 2 * iterations)), 1), text: (n) => `${n} iterations`, ...steps });
    const stepField = numberField(input('iterations'), { low: 0, high: MAX_ITERATIONS, step: 1, whole: true, ...steps });
    const degrees = { stops: even(0, 180, 0.5), text: (/** @type {number} */ angle) => `${plain(angle)} degrees` };
    const turnSlider = slider(input('angle-slider'), { ...degrees, ...turns });
    const turnField = numberField(input('angle'), { ...DEGREES, ...turns });
    const rightSlider = slider(input('right-slider'), { ...degrees, ...rights });
    const rightField = numberField(input('right'), { ...DEGREES, ...rights });

    return {
        /** @param {readonly import('./options.js').Control[]} controls */
        offer(controls) {
            html('n-row').hidden = !controls.includes('n');
            html('angle-row').hidden = !controls.includes('angle');
            html('right-row').hidden = !controls.includes('angle') || store.state.rightAngle === null;
        },

        /** @param {Readonly<import('../state.js').State>} state */
        show(state) {
            stepSlider.show(state.iterations);
            stepField(state.iterations);
            turnSlider.show(state.angle);
            turnField(state.angle);
            setText(html('angle-label'), state.rightAngle === null ? 'Angle' : 'Left turns');
            html('right-row').hidden = html('angle-row').hidden || state.rightAngle === null;
            if (state.rightAngle === null) return;
            rightSlider.show(state.rightAngle);
            rightField(state.rightAngle);
        },

        /** @param {import('../engine.js').Report} report */
        report({ ok, largest }) {
            if (!ok) return;
            stepSlider.limit(largest === null ? null : Math.max(largest, store.state.iterations));
        },
    };
}
