/** The clock of playback: goes on by whole segments, as many as the pace says, while it runs. */

import { calm } from '../dom.js';

/** With less motion the picture goes on this often, in milliseconds. */
const CALM_MS = 500;
/** After a longer pause, such as a hidden page, playing goes on from where it was, in milliseconds. */
const GAP = 1000;

/** @param {{perSecond: () => number, goOn: (segments: bigint) => void}} playback */
export function createClock({ perSecond, goOn }) {
    let running = false;
    let frame = 0;
    let before = 0;
    /** What is more than a whole segment. */
    let rest = 0;

    /** @param {number} now */
    function tick(now) {
        frame = requestAnimationFrame(tick);
        const time = now - before;
        if (calm() && time < CALM_MS) return;
        before = now;
        if (time <= 0 || time > GAP + CALM_MS) return;
        const way = (perSecond() * time) / 1000 + rest;
        const whole = Math.floor(way);
        rest = way - whole;
        if (whole > 0) goOn(BigInt(whole));
    }

    return {
        get running() {
            return running;
        },

        start() {
            running = true;
            rest = 0;
            before = performance.now();
            frame = requestAnimationFrame(tick);
        },

        stop() {
            cancelAnimationFrame(frame);
            running = false;
        },
    };
}
