/** Pictures from files and the clipboard as levels of grey: decoded by the browser, but for SVG. */

import { say } from '../base/words.js';
import { promisedSize } from './header.js';
import { greyOf, isPlain } from './ink.js';

/** @typedef {import('./ink.js').Grey} Grey */
/** @typedef {import('../protocol.js').DrawnPicture} DrawnPicture */

/** Larger files are not read, in bytes. */
const LARGEST = 64 << 20;
const LARGEST_SVG = 16 << 20;
/** Pictures with more pixels are not decoded: that takes 256 MB of memory. */
const MOST_PIXELS = 64e6;
/** A JPEG tells its size after its notes, a preview among them. In bytes. */
const HEADER = 4 << 20;
/** Larger pictures are made smaller, to this side in pixels: three times that of the compared pictures, for crops. */
const SIDE = 1536;
/** A picture that is not decoded after this time is given up, in milliseconds. */
const PATIENCE = 10_000;

const DAMAGED = say`This picture is damaged, or the browser does not know its format.`;

/** How files of pictures begin. @type {Readonly<Record<string, RegExp>>} */
const KINDS = {
    'image/png': /^\x89PNG\r\n/,
    'image/jpeg': /^\xff\xd8\xff/,
    'image/webp': /^RIFF.{4}WEBP/s,
    'image/gif': /^GIF8/,
    'image/svg+xml': /^(?:\xef\xbb\xbf|\xff\xfe|\xfe\xff)?[\s\0]*</,
};

/**
 * Decodes a picture; throws a sentence if it cannot be read.
 * @param {Blob} blob
 * @param {(bytes: Uint8Array<ArrayBuffer>) => Promise<DrawnPicture>} drawSvg in a worker: drawing an SVG may take any time
 * @returns {Promise<DrawnPicture>}
 */
export async function readPicture(blob, drawSvg) {
    const start = String.fromCharCode(...new Uint8Array(await blob.slice(0, 1024).arrayBuffer()));
    const kind = Object.keys(KINDS).find((kind) => KINDS[kind]?.test(start));
    if (!kind) throw new Error(say`This file is no PNG, JPEG, WebP, GIF or SVG picture.`);
    const isSvg = kind === 'image/svg+xml';
    if (blob.size > (isSvg ? LARGEST_SVG : LARGEST))
        throw new Error(say`This picture has more than ${isSvg ? 16 : 64} MB.`);
    if (isSvg) return drawSvg(new Uint8Array(await blob.arrayBuffer()));
    const size = promisedSize(kind, await blob.slice(0, HEADER).arrayBuffer());
    if (!size) throw new Error(DAMAGED);
    check(...size);
    const bitmap = await inTime(createImageBitmap(new Blob([blob], { type: kind })));
    try {
        const { width, height } = bitmap;
        check(width, height);
        const scale = Math.min(1, SIDE / Math.max(width, height));
        const [wide = 1, high = 1] = [width, height].map((side) => Math.max(1, Math.round(side * scale)));
        return { ...pixelsOf(bitmap, wide, high), leftOut: '' };
    } finally {
        bitmap.close();
    }
}

/** @param {number} width @param {number} height */
function check(width, height) {
    if (width * height > MOST_PIXELS)
        throw new Error(say`This picture has ${width} × ${height} pixels. At most 64 million are read.`);
    if (width === 0 || height === 0) throw new Error(say`This picture is empty.`);
}

/** @param {Promise<ImageBitmap>} decoded @returns {Promise<ImageBitmap>} */
function inTime(decoded) {
    return new Promise((resolve, reject) => {
        let isLate = false;
        const timer = setTimeout(() => {
            isLate = true;
            reject(new Error(say`This picture takes too long to read.`));
        }, PATIENCE);
        decoded.then(
            (bitmap) => {
                clearTimeout(timer);
                if (isLate) bitmap.close();
                else resolve(bitmap);
            },
            () => {
                clearTimeout(timer);
                reject(new Error(DAMAGED));
            },
        );
    });
}

/**
 * A picture as levels of grey; what is transparent is white, or black where that shows nothing.
 * @param {ImageBitmap} source @param {number} width @param {number} height
 * @returns {Grey}
 */
export function pixelsOf(source, width, height) {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [width, height];
    const context = canvas.getContext('2d', { willReadFrequently: true });
    if (!context) throw new Error(say`The browser has no memory for this picture.`);
    context.imageSmoothingQuality = 'high';
    for (const paper of ['#fff', '#000']) {
        context.fillStyle = paper;
        context.fillRect(0, 0, width, height);
        context.drawImage(source, 0, 0, width, height);
        const grey = greyOf(context.getImageData(0, 0, width, height).data, width, height);
        if (!isPlain(grey)) return grey;
    }
    throw new Error(say`This picture has one shade of grey only.`);
}
