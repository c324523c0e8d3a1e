/** A film that plays on a canvas: frames are asked for one at a time, and those that come too late are left out. */

import { Cancelled } from '../engine/tool.js';
import { frameAt } from './script.js';

/**
 * The picture and the film that plays.
 * @typedef {object} Player
 * @property {import('./frames.js').FilmTool} tool
 * @property {HTMLCanvasElement} canvas
 * @property {() => [number, number]} most
 * @property {(frame: number) => void} shown
 * @property {(error: unknown) => void} failed
 * @property {CanvasRenderingContext2D} context
 * @property {{film: Film, script: FilmScript} | null} open
 * @property {boolean} playing
 * @property {number} start When the film began, in milliseconds, while it plays
 * @property {number} frame The frame that is asked for next
 * @property {boolean} busy Whether a frame is being made, and whether another one is wanted afterwards
 * @property {boolean} stale
 * @property {number} timer
 */

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
    /** @type {Player} */
    const self = {
        tool,
        canvas,
        most,
        shown,
        failed,
        context,
        open: null,
        playing: false,
        start: 0,
        frame: 0,
        busy: false,
        stale: false,
        timer: 0,
    };

    return {
        get playing() {
            return self.playing;
        },
        get frame() {
            return self.frame;
        },
        /** Shows a film, or a changed film, at the present frame. @param {Film} film @param {FilmScript} script */
        show(film, script) {
            self.open = { film, script };
            self.frame = Math.min(self.frame, script.frames - 1);
            if (self.playing) self.start = performance.now() - (self.frame / script.rate) * 1000;
            make(self);
        },
        play() {
            if (!self.open) return;
            const { script } = self.open;
            if (script.ending === 'once' && self.frame >= script.frames - 1) self.frame = 0;
            self.playing = true;
            self.start = performance.now() - (self.frame / script.rate) * 1000;
            tick(self);
        },
        pause() {
            self.playing = false;
            clearTimeout(self.timer);
        },
        /** @param {number} number of a frame */
        seek(number) {
            self.frame = number;
            if (self.open && self.playing) self.start = performance.now() - (self.frame / self.open.script.rate) * 1000;
            make(self);
        },
        /** Stops, and forgets the film. */
        close() {
            self.playing = false;
            clearTimeout(self.timer);
            self.open = null;
            self.frame = 0;
        },
    };
}

/**
 * The size of the frames, with the film's proportions.
 * @param {Player} self
 * @param {FilmScript} script
 * @returns {[number, number]}
 */
function size(self, { width, height }) {
    const [across, down] = self.most();
    const scale = Math.min(1, across / width, down / height);
    return [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
}

/** @param {Player} self */
async function make(self) {
    if (!self.open) return;
    if (self.busy) {
        self.stale = true;
        return;
    }
    self.busy = true;
    self.stale = false;
    const { film, script } = self.open;
    const [width, height] = size(self, script);
    const number = Math.min(self.frame, script.frames - 1);
    try {
        const pixels = await self.tool.call('frame', { film, number, width, height });
        if (self.canvas.width !== width) self.canvas.width = width;
        if (self.canvas.height !== height) self.canvas.height = height;
        self.context.putImageData(
            new ImageData(new Uint8ClampedArray(pixels.buffer, pixels.byteOffset, pixels.length), width, height),
            0,
            0,
        );
        self.canvas.dataset.frame = String(number);
        self.shown(number);
    } catch (error) {
        if (error instanceof Cancelled) return;
        self.playing = false;
        self.failed(error);
    } finally {
        self.busy = false;
    }
    if (self.stale) make(self);
    else if (self.playing) wait(self);
}

/** Waits until the next frame is due. @param {Player} self */
function wait(self) {
    clearTimeout(self.timer);
    const { script } = /** @type {{script: FilmScript}} */ (self.open);
    const time = (performance.now() - self.start) / 1000;
    const due = (Math.floor(time * script.rate) + 1) / script.rate;
    self.timer = window.setTimeout(() => tick(self), (due - time) * 1000);
}

/** @param {Player} self */
function tick(self) {
    if (!self.open || !self.playing) return;
    const { script } = self.open;
    const time = (performance.now() - self.start) / 1000;
    self.frame = frameAt(script, time);
    if (script.ending === 'once' && time * script.rate >= script.frames) self.playing = false;
    make(self);
}
