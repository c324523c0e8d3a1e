/** A film that plays on a canvas: frames are asked for one at a time, and those that come too late are left out. */

import { Cancelled } from '../tool.js';
import { frameAt } from './script.js';

/** @typedef {import('../protocol.js').Film} Film */
/** @typedef {import('../protocol.js').FilmScript} FilmScript */

/**
 * @param {import('./frames.js').FilmTool} tool
 * @param {HTMLCanvasElement} canvas
 * @param {{most: () => [number, number], shown: (frame: number) => void, failed: (error: unknown) => void}} options
 *   `most` is the largest picture, in device pixels; `shown` is called with each frame
 */
export function createPlayer(tool, canvas, { most, shown, failed }) {
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d', { alpha: false }));
    /** @type {{film: Film, script: FilmScript} | null} */
    let open = null;
    let playing = false;
    /** When the film began, in milliseconds, while it plays. */
    let start = 0;
    /** The frame that is asked for next. */
    let frame = 0;
    /** Whether a frame is being made, and whether another one is wanted afterwards. */
    let busy = false;
    let stale = false;
    let timer = 0;

    /** The size of the frames, with the film's proportions. @param {FilmScript} script @returns {[number, number]} */
    function size({ width, height }) {
        const [across, down] = most();
        const scale = Math.min(1, across / width, down / height);
        return [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
    }

    async function make() {
        if (!open) return;
        if (busy) {
            stale = true;
            return;
        }
        busy = true;
        stale = false;
        const { film, script } = open;
        const [width, height] = size(script);
        const number = Math.min(frame, script.frames - 1);
        try {
            const pixels = await tool.call('frame', { film, number, width, height });
            if (canvas.width !== width) canvas.width = width;
            if (canvas.height !== height) canvas.height = height;
            context.putImageData(
                new ImageData(new Uint8ClampedArray(pixels.buffer, pixels.byteOffset, pixels.length), width, height),
                0,
                0,
            );
            canvas.dataset.frame = String(number);
            shown(number);
        } catch (error) {
            if (error instanceof Cancelled) return;
            playing = false;
            failed(error);
        } finally {
            busy = false;
        }
        if (stale) make();
        else if (playing) wait();
    }

    /** Waits until the next frame is due. */
    function wait() {
        clearTimeout(timer);
        const { script } = /** @type {{script: FilmScript}} */ (open);
        const time = (performance.now() - start) / 1000;
        const due = (Math.floor(time * script.rate) + 1) / script.rate;
        timer = window.setTimeout(tick, (due - time) * 1000);
    }

    function tick() {
        if (!open || !playing) return;
        const { script } = open;
        const time = (performance.now() - start) / 1000;
        frame = frameAt(script, time);
        if (script.ending === 'once' && time * script.rate >= script.frames) playing = false;
        make();
    }

    return {
        get playing() {
            return playing;
        },
        get frame() {
            return frame;
        },
        /** Shows a film, or a changed film, at the present frame. @param {Film} film @param {FilmScript} script */
        show(film, script) {
            open = { film, script };
            frame = Math.min(frame, script.frames - 1);
            if (playing) start = performance.now() - (frame / script.rate) * 1000;
            make();
        },
        play() {
            if (!open) return;
            const { script } = open;
            if (script.ending === 'once' && frame >= script.frames - 1) frame = 0;
            playing = true;
            start = performance.now() - (frame / script.rate) * 1000;
            tick();
        },
        pause() {
            playing = false;
            clearTimeout(timer);
        },
        /** @param {number} number of a frame */
        seek(number) {
            frame = number;
            if (open && playing) start = performance.now() - (frame / open.script.rate) * 1000;
            make();
        },
        /** Stops, and forgets the film. */
        close() {
            playing = false;
            clearTimeout(timer);
            open = null;
            frame = 0;
        },
    };
}
