/** Sliders and fields for the iterations and the angles of an embedded drawing. */

import { dial } from '../controls/dial.js';
import { html, setText } from '../base/dom.js';
import { say } from '../base/words.js';

/**
 * @param {import('../state/store.js').Store} store
 */
export function createDials(store) {
    const steps = dial(store, 'iterations', 'iterations');
    const turns = dial(store, 'angle', 'angle');
    const rights = dial(store, 'rightAngle', 'right');

    return {
        /** @param {readonly import('./options.js').Control[]} controls */
        offer(controls) {
            html('n-row').hidden = !controls.includes('n');
            html('angle-row').hidden = !controls.includes('angle');
            html('right-row').hidden = !controls.includes('angle') || store.state.rightAngle === null;
        },

        /** @param {Readonly<import('../state/state.js').State>} state */
        show(state) {
            steps.show(state.iterations);
            turns.show(state.angle);
            setText(html('angle-label'), state.rightAngle === null ? say`Angle` : say`Left turns`);
            html('right-row').hidden = html('angle-row').hidden || state.rightAngle === null;
            if (state.rightAngle !== null) rights.show(state.rightAngle);
        },

        /** @param {import('../protocol.js').Report} report */
        report({ ok, largest }) {
            if (!ok) return;
            steps.limit(largest === null ? null : Math.max(largest, store.state.iterations));
        },
    };
}
