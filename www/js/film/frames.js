/** Frames of a film from several workers, in order. */

import { createTool } from '../engine/tool.js';

/** @typedef {import('../protocol.js').Film} Film */
/** @typedef {import('../protocol.js').FilmScript} FilmScript */
/** @typedef {ReturnType<typeof createTool<import('../protocol.js').FilmCalls>>} FilmTool */

/** The most workers of a film. Each has a drawing of its own in memory. */
const MOST_WORKERS = 4;
/** Below this memory of the device, in GiB, one worker makes all frames. */
const ENOUGH_MEMORY = 4;

/** @returns {FilmTool} */
export const createFilmTool = () => createTool('film');

/** The number of workers: a core stays free for the page and for the video encoder. @param {{hardwareConcurrency?: number, deviceMemory?: number}} device */
export function workersOn({ hardwareConcurrency = 2, deviceMemory = ENOUGH_MEMORY }) {
    return deviceMemory < ENOUGH_MEMORY ? 1 : Math.max(1, Math.min(MOST_WORKERS, hardwareConcurrency - 1));
}

/**
 * All frames in order. Each worker makes one frame at a time, and few frames are in memory.
 * @param {FilmTool[]} tools
 * @param {Film} film
 * @param {FilmScript} script
 * @param {AbortSignal} signal
 */
export async function* framesOf(tools, film, { frames, width, height }, signal) {
    /** @type {Promise<Uint8Array<ArrayBuffer>>[]} */
    const waiting = [];
    let next = 0;
    const ask = () => {
        const tool = tools[next % tools.length];
        if (next >= frames || !tool) return;
        const frame = tool.call('frame', { film, number: next, width, height }, { signal });
        // A failure is told when the frame's turn comes.
        frame.catch(() => {});
        waiting.push(frame);
        next++;
    };
    for (let at = 0; at < tools.length; at++) ask();
    for (;;) {
        const frame = waiting.shift();
        if (!frame) return;
        const pixels = await frame;
        ask();
        yield pixels;
    }
}
