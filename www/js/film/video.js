/**
 * Video files by WebCodecs. The page loads this module with the first video, because it holds the library that writes
 * the files: Mediabunny (https://mediabunny.dev), under the Mozilla Public License 2.0.
 */

import { say } from '../base/words.js';
import {
    BufferTarget,
    Mp4OutputFormat,
    Output,
    Quality,
    VideoSample,
    VideoSampleSource,
    WebMOutputFormat,
    getFirstEncodableVideoCodec,
} from 'mediabunny';

/** The codecs of each kind of file, the best first. @type {{webm: import('mediabunny').VideoCodec[], mp4: import('mediabunny').VideoCodec[]}} */
const CODECS = { webm: ['vp9', 'av1', 'vp8'], mp4: ['avc', 'hevc', 'av1', 'vp9'] };

/** Lines stay sharp. */
const QUALITY = new Quality('very-high');

/** @typedef {keyof typeof CODECS} VideoKind */

/** The codec for a video of this size, or null if the browser has none. @param {VideoKind} kind @param {number} width @param {number} height */
export function codecOf(kind, width, height) {
    return getFirstEncodableVideoCodec(CODECS[kind], { width, height, quality: QUALITY });
}

/**
 * Makes a video of frames.
 * @param {VideoKind} kind
 * @param {{width: number, height: number, rate: number}} script
 * @param {AsyncIterable<Uint8Array<ArrayBuffer>>} frames RGBA
 * @param {{signal: AbortSignal, progress: (done: number) => void}} options
 */
export async function videoOf(kind, { width, height, rate }, frames, { signal, progress }) {
    const codec = await codecOf(kind, width, height);
    if (!codec)
        throw new Error(
            say`this browser cannot write ${kind === 'webm' ? 'WebM' : 'MP4'} of ${String(width)} × ${String(height)} pixels`,
        );
    const target = new BufferTarget();
    const output = new Output({
        format: kind === 'webm' ? new WebMOutputFormat() : new Mp4OutputFormat({ fastStart: 'in-memory' }),
        target,
    });
    const source = new VideoSampleSource({ codec, quality: QUALITY, keyFrameInterval: 2 });
    output.addVideoTrack(source, { frameRate: rate });
    await output.start();
    try {
        let number = 0;
        for await (const pixels of frames) {
            signal.throwIfAborted();
            const sample = new VideoSample(pixels, {
                format: 'RGBX',
                codedWidth: width,
                codedHeight: height,
                timestamp: number / rate,
                duration: 1 / rate,
            });
            try {
                // Waits while the encoder has enough to do, so that frames do not pile up.
                await source.add(sample);
            } finally {
                sample.close();
            }
            progress(++number);
        }
        await output.finalize();
    } catch (error) {
        await output.cancel().catch(() => {});
        throw error;
    }
    return new Blob([/** @type {ArrayBuffer} */ (target.buffer)], {
        type: kind === 'webm' ? 'video/webm' : 'video/mp4',
    });
}
