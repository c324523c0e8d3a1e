/** What reads the drawing beside its picture: playback, the string, and the segment under the pointer. */

import { createHover } from './hover.js';
import { createLegend } from '../controls/legend.js';
import { createPlayback } from '../motion/playback.js';
import { createReader } from '../reading/reader.js';
import { sameDrawing } from '../state/state.js';

/**
 * @param {import('../engine/engine.js').Engine} engine
 * @param {ReturnType<typeof import('./stage.js').createStage>} stage
 * @param {ReturnType<typeof import('./marks.js').createMarks>} marks
 * @param {(control: 'play' | 'string') => boolean} [offers] whether the page has playback, or the string
 */
export function createReadings(engine, stage, marks, offers = () => true) {
    const playback = createPlayback(engine, { turtle: marks.turtle, offered: () => offers('play') });
    const legend = createLegend();
    const reader = createReader(engine, { mark: marks.part('string'), legend, opened: () => hover.forget() });
    // Symbols under the pointer are shown only with the string, which explains them.
    const hover = createHover(engine, { stage, marks, reader, playback, offered: () => offers('string') });
    return {
        playback,
        legend,
        reader,

        /** @param {Readonly<import('../state/state.js').State>} state @param {Readonly<import('../state/state.js').State> | null} before */
        show(state, before) {
            reader.show(state, before);
            if (before && !sameDrawing(state, before)) {
                hover.forget();
                playback.forget();
            }
            if (before && before.camera !== state.camera) hover.turned();
        },

        /** @param {import('../engine/engine.js').Drawn} picture */
        drawn(picture) {
            playback.drawn(picture);
            hover.drawn();
        },
    };
}
