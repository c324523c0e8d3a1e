/** The drawing as a sound while it is played: the turtle's height is the pitch, its place from left to right the side. */

import { button, html } from '../dom.js';

/** The pitch of the middle, in Hertz, and the octaves from the lowest to the highest place. */
const [MIDDLE, OCTAVES] = [330, 3];
const LOUDNESS = 0.15;
/** Pitch, side and loudness glide within this time, in seconds: steps would click. */
const GLIDE = 0.02;
/** The sound fades when the turtle has stood still for this long, in milliseconds. */
const STILL = 300;

const within = (/** @type {number} */ part) => Math.min(1, Math.max(0, part));
/** @param {number} y from 0 (low) to 1; what is beyond sounds as the edge @returns {number} Hertz */
export const pitchAt = (y) => MIDDLE * 2 ** (OCTAVES * (within(y) - 0.5));
/** @param {number} x from 0 (left) to 1 @returns {number} from -1 (left) to 1 */
export const sideAt = (x) => 2 * within(x) - 1;

export function createSound() {
    const listen = button('listen');
    /** @type {{context: AudioContext, tone: OscillatorNode, side: StereoPannerNode, loudness: GainNode} | null} */
    let voice = null;
    let timer = 0;

    /** Browsers let a page sound only after the button was pressed. */
    function start() {
        const context = new AudioContext();
        const [tone, side, loudness] = [context.createOscillator(), context.createStereoPanner(), context.createGain()];
        tone.type = 'triangle';
        loudness.gain.value = 0;
        tone.connect(side).connect(loudness).connect(context.destination);
        tone.start();
        voice = { context, tone, side, loudness };
    }

    function hush() {
        clearTimeout(timer);
        voice?.loudness.gain.setTargetAtTime(0, voice.context.currentTime, GLIDE);
    }

    // The turtle is seen at x to the right and y upwards, from 0 to 1.
    html('drawing').addEventListener('turtle', (event) => {
        if (!voice) return;
        const [x, y] = /** @type {CustomEvent<[number, number]>} */ (event).detail;
        const now = voice.context.currentTime;
        voice.tone.frequency.setTargetAtTime(pitchAt(y), now, GLIDE);
        voice.side.pan.setTargetAtTime(sideAt(x), now, GLIDE);
        voice.loudness.gain.setTargetAtTime(LOUDNESS, now, GLIDE);
        clearTimeout(timer);
        timer = window.setTimeout(hush, STILL);
    });

    return {
        /** Begins to sound, or ends. */
        open() {
            const on = voice === null;
            listen.setAttribute('aria-pressed', String(on));
            if (on) return start();
            clearTimeout(timer);
            voice?.context.close();
            voice = null;
        },
    };
}
