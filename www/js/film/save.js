/** Saving a film: GIF, and video where the browser has an encoder. */

import { createFilmTool, framesOf, workersOn } from './frames.js';

/** @typedef {import('../protocol.js').Film} Film */
/** @typedef {import('../protocol.js').FilmScript} FilmScript */
/** @typedef {'gif' | 'webm' | 'mp4'} FilmFile */

/** The sides of videos are even: most encoders refuse others. @param {FilmScript} script @returns {FilmScript} */
const even = (script) => ({ ...script, width: script.width & ~1, height: script.height & ~1 });

/**
 * Makes the file of a film.
 * @param {FilmFile} kind
 * @param {Film} film
 * @param {FilmScript} script
 * @param {{signal: AbortSignal, progress: (done: number) => void}} options `progress` is called with the number of finished frames
 * @returns {Promise<Blob>}
 */
export async function fileOf(kind, film, script, { signal, progress }) {
    if (kind === 'gif') {
        /** @type {Uint8Array<ArrayBuffer>[]} */
        const parts = [];
        const tool = createFilmTool();
        const told = (/** @type {{done: number, bytes: Uint8Array<ArrayBuffer>}} */ { done, bytes }) => {
            parts.push(bytes);
            progress(done);
        };
        try {
            await tool.call('gif', { film, script }, { signal, progress: told });
        } finally {
            tool.close();
        }
        return new Blob(parts, { type: 'image/gif' });
    }
    const { videoOf } = await import('./video.js');
    const tools = Array.from({ length: workersOn(navigator) }, createFilmTool);
    try {
        return await videoOf(kind, even(script), framesOf(tools, film, even(script), signal), { signal, progress });
    } finally {
        // Frames that the encoder no longer needs are given up, too.
        for (const tool of tools) tool.close();
    }
}

/** The kinds of video that the browser can write. @param {FilmScript} script @returns {Promise<FilmFile[]>} */
export async function videosOf(script) {
    if (typeof VideoEncoder !== 'function') return [];
    const { codecOf } = await import('./video.js');
    const { width, height } = even(script);
    const kinds = await Promise.all(
        /** @type {const} */ (['webm', 'mp4']).map(async (kind) =>
            (await codecOf(kind, width, height)) ? kind : null,
        ),
    );
    return /** @type {FilmFile[]} */ (kinds.filter((kind) => kind !== null));
}
