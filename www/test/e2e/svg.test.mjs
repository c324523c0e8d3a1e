import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { sampled } from '../effort.mjs';
import { close, withModules, withPage } from './browser.mjs';

after(close);

/**
 * The browser draws both SVG forms of a system and compares them in the page: the mean difference of a channel, and the
 * largest mean of an 8x8 tile, of 255. Null if the forms have the same text.
 * @param {{definition: object, size: number}} what
 */
async function compare({ definition, size }) {
    const global = /** @type {any} */ (window);
    if (!global.exports) {
        const { createExports } = await import(new URL('js/save/exports.js', document.baseURI).href);
        const { make } = createExports();
        /** @param {object} system */
        global.exports = async (system) => {
            const texts = [];
            for (const format of ['svg', 'svg-compact']) {
                const { blob, diagnostics } = await make({ definition: system, format, options: {}, camera: null });
                if (blob === null) throw new Error(JSON.stringify(diagnostics));
                texts.push(await blob.text());
            }
            return texts;
        };
    }
    /** @param {string} text */
    const pixels = async (text) => {
        const image = new Image();
        image.src = URL.createObjectURL(new Blob([text], { type: 'image/svg+xml' }));
        await image.decode();
        URL.revokeObjectURL(image.src);
        const scale = size / Math.max(image.naturalWidth, image.naturalHeight);
        const canvas = new OffscreenCanvas(
            Math.ceil(image.naturalWidth * scale),
            Math.ceil(image.naturalHeight * scale),
        );
        const context = /** @type {OffscreenCanvasRenderingContext2D} */ (
            canvas.getContext('2d', { willReadFrequently: true })
        );
        context.drawImage(image, 0, 0, image.naturalWidth * scale, image.naturalHeight * scale);
        return context.getImageData(0, 0, canvas.width, canvas.height);
    };
    const [flat, compact] = await global.exports(definition);
    if (flat === compact) return null;
    const [a, b] = [await pixels(flat), await pixels(compact)];
    if (a.width !== b.width || a.height !== b.height)
        throw new Error(`${a.width}x${a.height} and ${b.width}x${b.height}`);
    let mean = 0;
    let ink = 0;
    const columns = Math.ceil(a.width / 8);
    const tiles = new Float64Array(columns * Math.ceil(a.height / 8));
    const [words, others] = [a, b].map(({ data }) => new Uint32Array(data.buffer));
    for (let pixel = 0; pixel < a.width * a.height; pixel++) {
        if (words?.[pixel] !== words?.[0]) ink++;
        if (words?.[pixel] === others?.[pixel]) continue;
        let difference = 0;
        for (let at = 4 * pixel; at < 4 * pixel + 3; at++)
            difference += Math.abs(Number(a.data[at]) - Number(b.data[at])) / 3;
        mean += difference;
        const tile = Math.floor(pixel / a.width / 8) * columns + Math.floor((pixel % a.width) / 8);
        tiles[tile] = /** @type {number} */ (tiles[tile]) + difference / 64;
    }
    return { mean: mean / (a.data.length / 4), tile: Math.max(...tiles), ink, shorter: compact.length < flat.length };
}

/*
 * Both forms draw the same strokes. They differ in partly covered pixels where strokes meet or overlap: strokes of one
 * path cover such a pixel once, strokes of two paths one over the other. If both cover the fraction a of the pixel, its
 * colour differs by a - a * a of the contrast, at most a quarter: 64 of 255. Only pictures of many strokes thinner than
 * a pixel come near that in a whole tile. The mean is over the whole picture.
 */
const MEAN = 2;
const TILE = 64;

test('compact SVG pictures look like flat ones', () =>
    withPage({ before: withModules }, async (page) => {
        const entries = await page.evaluate(async () => (await fetch('gallery.json')).json());
        /** @type {any[]} */
        const found = [];
        const chosen = sampled(/** @type {any[]} */ (entries), 4);
        for (const { path, solid, definition } of chosen) {
            // A file of a drawing in space has at most 200,000 segments.
            const n = Math.min(definition.iterations, solid ? 5 : 6);
            const difference = await page.evaluate(compare, {
                definition: { ...definition, iterations: n },
                size: 1024,
            });
            if (difference) found.push({ path, n, ...difference });
        }
        if (process.env.LSYSTEM_FIGURES) console.table(found.sort((a, b) => b.tile - a.tile));
        assert.ok(found.length > chosen.length / 3, `${found.length}`);
        for (const { path, n, mean, tile, ink } of found) {
            assert.ok(mean <= MEAN && tile <= TILE, `${path} at n = ${n}: mean ${mean}, worst tile ${tile}`);
            assert.ok(ink > 0 || mean === 0, path);
        }
    }));
