/** What growth and wind share: a toggle, frames that can pause, a place on the playback bar, and the drawing at the end. */

import { definitionOf } from '../state/state.js';

/** Pictures are waited for up to this time, in milliseconds. */
const PATIENCE_MS = 4000;

/** `begins` is called before the motion begins; `present` shows it on the playback bar, or the segments again. @typedef {{begins: () => void, present: (show: import('./playback.js').Show | null) => void}} Page */

/**
 * @param {HTMLButtonElement} toggle starts and stops
 * @param {import('../state/store.js').Store} store
 * @param {import('../engine/engine.js').Engine} engine
 * @param {Page} page
 * @param {object} motion
 * @param {() => void} motion.start is called before the still drawing is shown
 * @param {(time: number) => boolean} motion.tick is called for each frame with the milliseconds since the last one that it took
 * @param {() => number} motion.part how much is done, from 0 to 1
 * @param {() => string} motion.words
 * @param {(part: number) => void} motion.seek
 * @param {() => void} [motion.ended]
 */
export function createAnimation(toggle, store, engine, { begins, present }, { start, tick, part, words, seek, ended }) {
    let running = false;
    /** The still drawing, whose picture comes first: its frame is that of the motion. Null once it is shown. @type {import('../state/state.js').Definition | null} */
    let still = null;
    const frames = createFrames((time) => !isSettled() || tick(time));
    const { pause, resume } = frames;

    function isSettled() {
        if (still && engine.good.definition === still) still = null;
        return still === null;
    }

    /** Draws the still drawing first. */
    function settle() {
        still = definitionOf(store.state);
        frames.drawn();
        engine.define(still);
    }

    function begin() {
        begins();
        running = true;
        toggle.setAttribute('aria-pressed', 'true');
        start();
        settle();
        resume();
        present(show);
    }

    /** The state has changed, and the engine already draws it. */
    function forget() {
        if (!running) return;
        running = false;
        still = null;
        pause();
        toggle.setAttribute('aria-pressed', 'false');
        present(null);
        ended?.();
    }

    /** Stops, and draws the state again. */
    function stop() {
        if (!running) return;
        forget();
        engine.define(definitionOf(store.state));
    }

    /** @type {import('./playback.js').Show} */
    const show = {
        get playing() {
            return frames.running;
        },
        get part() {
            return part();
        },
        get words() {
            return words();
        },
        toggle() {
            if (frames.running) pause();
            else resume();
            present(show);
        },
        seek(to) {
            pause();
            still = null;
            seek(to);
            present(show);
        },
        stop,
    };

    toggle.addEventListener('click', () => (running ? stop() : begin()));

    return {
        /** Whether the engine shows a moment of the motion instead of the store's state. */
        get moves() {
            return running && still === null;
        },
        begin,
        /** The state has changed, and the engine already draws it: the motion goes on with the new drawing. */
        edited() {
            if (running) settle();
        },
        /** Shows a moment of the motion. @param {import('../state/state.js').Definition} moment */
        draw(moment) {
            frames.asked();
            engine.define({ ...moment, still: true });
            present(show);
        },
        /** A picture has come. @param {boolean} [isFirst] whether the time until then is no part of the motion */
        drawn: (isFirst = false) => frames.drawn(isFirst),
        forget,
        stop,
    };
}

/** Frames, none of which comes before the picture of the last one. @param {(time: number) => boolean} tick */
function createFrames(tick) {
    /** The request for the next frame; 0 during a pause. */
    let frame = 0;
    /** The time of the last frame that was taken. */
    let before = 0;
    /** When the last picture was requested; 0 when it is shown. */
    let asked = 0;

    /** @param {number} now */
    function next(now) {
        frame = requestAnimationFrame(next);
        if (asked && now - asked < PATIENCE_MS) return;
        if (tick(now - before)) before = now;
    }

    return {
        get running() {
            return frame !== 0;
        },
        resume() {
            before = performance.now();
            frame = requestAnimationFrame(next);
        },
        pause() {
            cancelAnimationFrame(frame);
            frame = 0;
        },
        /** A picture is requested. */
        asked() {
            asked = performance.now();
        },
        /** The picture has come. @param {boolean} [isFirst] */
        drawn(isFirst) {
            asked = 0;
            if (isFirst) before = performance.now();
        },
    };
}
