/**
 * The drawing: shows what the worker has painted, and moves that picture at once when the reader pans or zooms, until
 * the worker has painted anew.
 */

import { button, byId, html, setText } from './dom.js';
import { zoomText } from './numerals.js';
import { listenToGestures } from './stage/gestures.js';
import { ZOOM_STEP, listenToKeys } from './stage/keys.js';
import { createMoves } from './stage/moves.js';
import { createPicture } from './stage/picture.js';
import { watchSize } from './stage/size.js';

/** What takes longer is shown to be under way, in milliseconds. */
const SLOW_MS = 300;

/**
 * @param {import('./store.js').Store} store
 * @param {import('./engine.js').Engine} engine
 * @param {{look: (sight: import('./marks.js').Sight | null) => void}} marks what moves with the picture
 * @param {{takes?: (event: Event) => boolean, keys?: () => readonly ('angle' | 'iterations')[]}} [page]
 *   `takes` tells which gestures are the drawing's, rather than of the page it stands in; `keys` what arrows change
 */
export function createStage(store, engine, marks, { takes = () => true, keys = () => ['angle', 'iterations'] } = {}) {
    const frame = html('stage');
    const canvas = byId('drawing', HTMLCanvasElement);
    /** Whether the drawing is one in space. */
    let solid = false;
    let slow = 0;

    const picture = createPicture(canvas, marks.look);
    const moves = createMoves(store, picture, () => solid);
    const { size, measure } = watchSize(frame, look);

    /** @returns {import('./protocol.js').Canvas} */
    const resolution = () => ({ width: Math.max(1, Math.round(size.width * size.ratio)), height: Math.max(1, Math.round(size.height * size.ratio)), ratio: size.ratio });
    const place = () => picture.place(moves.view(), solid ? moves.camera() : null, size);

    function look() {
        place();
        engine.look(resolution(), moves.view(), moves.camera());
    }

    button('fit').addEventListener('click', moves.fit);
    button('zoom-in').addEventListener('click', () => moves.zoom(ZOOM_STEP));
    button('zoom-out').addEventListener('click', () => moves.zoom(1 / ZOOM_STEP));
    listenToKeys(canvas, store, moves, { solid: () => solid, side: () => Math.min(size.width, size.height), changes: keys });
    listenToGestures(canvas, {
        takes,
        drag: moves.drag,
        zoom(factor, x, y) {
            const box = frame.getBoundingClientRect();
            moves.zoomAt(factor, x - box.left - size.width / 2, y - box.top - size.height / 2);
        },
        fit: moves.fit,
    });
    measure();

    /** @param {boolean} under whether a drawing or its fine picture is being made */
    function growing(under) {
        clearTimeout(slow);
        if (under) slow = window.setTimeout(() => (html('busy').hidden = false), SLOW_MS);
        else html('busy').hidden = true;
    }

    /** @param {import('./state.js').State} state @param {import('./state.js').State | null} before */
    function show(state, before) {
        setText(html('zoom'), zoomText((solid ? moves.camera() : moves.view()).zoom));
        button('fit').setAttribute('aria-pressed', String(moves.isFitted()));
        if (!before || before.view !== state.view || before.camera !== state.camera) look();
    }

    return {
        resolution,
        show,
        growing,

        /** Goes round a drawing in space. */
        glide: moves.glideRound,

        /** Learns whether the drawing is one in space. @param {import('./protocol.js').Report} report */
        report(report) {
            if (!report.ok || solid === report.solid) return;
            solid = report.solid;
            frame.classList.toggle('solid', solid);
            show(store.state, null);
        },

        /** @param {import('./engine.js').Drawn} drawn */
        drawn(drawn) {
            picture.paint(drawn, solid);
            frame.classList.add('inked');
            growing(!drawn.complete);
            place();
        },
    };
}
