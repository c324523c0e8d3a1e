/** The clock of playback: advances by whole segments at the chosen speed. */

import { reducedMotion } from '../base/dom.js';

/** With reduced motion, the time between two pictures, in milliseconds. */
const REDUCED_MOTION_MS = 500;
/** A longer pause, such as a hidden page, does not count as playing time, in milliseconds. */
const GAP = 1000;

/** @param {{perSecond: () => number, advance: (segments: bigint) => void}} playback */
export function createClock({ perSecond, advance }) {
    let running = false;
    let frame = 0;
    let before = 0;
    /** The fraction of a segment that is left over. */
    let rest = 0;

    /** @param {number} now */
    function tick(now) {
        frame = requestAnimationFrame(tick);
        const time = now - before;
        if (reducedMotion() && time < REDUCED_MOTION_MS) return;
        before = now;
        if (time <= 0 || time > GAP + REDUCED_MOTION_MS) return;
        const segments = (perSecond() * time) / 1000 + rest;
        const whole = Math.floor(segments);
        rest = segments - whole;
        if (whole > 0) advance(BigInt(whole));
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
