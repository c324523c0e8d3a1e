/** A real browser for the tests: every page opened here must stay within its origin and keep its console clean. */

import assert from 'node:assert/strict';
import { fileURLToPath } from 'node:url';
import { FORMATS } from '../../js/late-tables.js';
import { DEADLINE, newTab, returnTab, takeTab } from './tabs.mjs';

export { close } from './tabs.mjs';

export const ADDRESS = process.env.LSYSTEM_URL ?? 'http://127.0.0.1:8080/';

export const DESKTOP = { viewport: { width: 1280, height: 800 } };
export const PHONE = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true };

/** @typedef {import('playwright-core').Page} Page */

/** Waits for the first picture. @param {Page | import('playwright-core').Frame} page @param {string} [drawing] */
export async function ready(page, drawing = '#stage.inked') {
    await page.waitForSelector(drawing);
}

/** Serves the page's source modules, for tests that import one in the page. @param {Page} page */
export const withModules = (page) =>
    page.route('**/js/**', (route) =>
        route.fulfill({
            path: fileURLToPath(new URL(`../../js/${route.request().url().split('/js/').pop()}`, import.meta.url)),
        }),
    );

/** Saves a file by the dialog, from the open section Save. @param {Page} page @param {import('../../js/protocol.js').Format} format */
export async function saveFile(page, format) {
    await page.click('#open-save');
    await page.click(`.save-tile:has([value=${FORMATS[format].purposes[0]}])`);
    await page.click(`.save-tile:has([name=save-format][value=${format}])`);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-now')]);
    await page.waitForSelector('#save-dialog', { state: 'hidden' });
    return download;
}

/**
 * Opens the page, or the page at `address`, lets `use` work with it, and checks that nothing failed except the
 * `expected` lines of the console. `also` names another address that may be requested. `drawing` is the element that
 * shows that the drawing is ready, or null.
 * @typedef {{address?: string, also?: string, drawing?: string | null, hash?: string, expected?: RegExp | undefined, options?: import('playwright-core').BrowserContextOptions, before?: (page: Page) => Promise<unknown>}} How
 * @param {How} how
 * @param {(page: Page) => Promise<unknown>} use
 */
export async function withPage(
    { address = ADDRESS, also = address, drawing = '#stage.inked', hash = '', expected, options = DESKTOP, before },
    use,
) {
    const how = { reducedMotion: /** @type {const} */ ('reduce'), acceptDownloads: true, ...options };
    // What `before` changes in a tab may stay, and pages of other sites are not forgotten.
    const own = before || !address.startsWith(ADDRESS);
    const page = await (own ? newTab(how, count) : takeTab(how, count));
    let passed = false;
    try {
        /** @type {string[]} */
        const wrong = [];
        page.on(
            'console',
            (message) =>
                ['error', 'warning'].includes(message.type()) &&
                !expected?.test(message.text()) &&
                wrong.push(message.text()),
        );
        page.on('pageerror', (error) => wrong.push(String(error)));
        page.on('request', (request) => {
            const url = request.url();
            if (!url.startsWith(address) && !url.startsWith(also) && !/^(blob|data):/.test(url))
                wrong.push(`a request left the site: ${url}`);
        });
        await before?.(page);
        await page.goto(address + hash);
        if (drawing) await ready(page, drawing);
        await use(page);
        assert.deepEqual(wrong, []);
        passed = true;
    } finally {
        if (own || !passed) await page.context().close();
        else await returnTab(page, how, `${ADDRESS}llms.txt`);
    }
}

/**
 * Runs in every page, and counts what tests wait for: `pictures` that the canvas of the drawing has shown, and `asked`,
 * the questions about a place of the drawing and the calls of tools that have no answer yet.
 */
function count() {
    const site = /** @type {any} */ (globalThis);
    site.deadline = 120_000;
    site.pictures = 0;
    site.asked = 0;
    const canvas = ImageBitmapRenderingContext.prototype;
    const { transferFromImageBitmap } = canvas;
    canvas.transferFromImageBitmap = function (bitmap) {
        if (/** @type {Element} */ (this.canvas).id === 'drawing') site.pictures += 1;
        return transferFromImageBitmap.call(this, bitmap);
    };
    /** By worker, the ids of its questions. @type {WeakMap<Worker, Set<number>>} */
    const questions = new WeakMap();
    const { postMessage } = Worker.prototype;
    Worker.prototype.postMessage = function (/** @type {any[]} */ ...message) {
        const { type, id } = message[0] ?? {};
        if (type === 'pick' || type === 'anchor' || type === 'call') {
            const open = questions.get(this) ?? new Set();
            if (!questions.has(this))
                this.addEventListener(
                    'message',
                    ({ data }) => data?.type !== 'progress' && open.delete(data?.id) && (site.asked -= 1),
                );
            questions.set(this, open.add(id));
            site.asked += 1;
        }
        return postMessage.apply(this, /** @type {any} */ (message));
    };
}

/**
 * Repeats `check` until it neither throws nor returns false. A test that still waits at the deadline hangs.
 * @template T
 * @param {() => Promise<T> | T} check
 * @param {string} what
 * @returns {Promise<NonNullable<T>>}
 */
export async function until(check, what) {
    const end = Date.now() + DEADLINE;
    for (;;) {
        let last;
        try {
            const value = await check();
            if (value) return value;
        } catch (error) {
            last = error;
        }
        if (Date.now() > end) throw new Error(`not so in ${DEADLINE / 1000} s: ${what}`, { cause: last });
        await new Promise((resolve) => setTimeout(resolve, 30));
    }
}

/**
 * Waits where the point is that nothing happens, which no condition can show. `why` says what would happen in that time.
 * @param {number} milliseconds
 * @param {string} why
 */
export async function quiet(milliseconds, why) {
    assert.ok(why.length > 10, 'a wait has a reason');
    await new Promise((resolve) => setTimeout(resolve, milliseconds));
}

/**
 * Runs a function in the page on the pixels of the drawing, one number per pixel, row by row.
 * @template T
 * @template [Known=undefined]
 * @param {Page | import('playwright-core').Frame} page
 * @param {(pixels: {words: Uint32Array, width: number, height: number}, known: Known) => T} read uses nothing from outside
 * @param {Known} [known] plain data
 * @returns {Promise<T>}
 */
export const onPixels = (page, read, known) => page.evaluate(`(${read})((${pixels})(), ${JSON.stringify(known)})`);

/** Runs in the page: the pixels of the drawing. */
function pixels() {
    const source = /** @type {HTMLCanvasElement} */ (document.querySelector('#drawing'));
    const copy = new OffscreenCanvas(source.width, source.height);
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (
        copy.getContext('2d', { willReadFrequently: true })
    );
    context.drawImage(source, 0, 0);
    const words = new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer);
    return { words, width: copy.width, height: copy.height };
}

/**
 * The first and the last row with ink in the middle column of the canvas.
 * @param {Page} page
 */
export function inkedRows(page) {
    return onPixels(page, ({ words, width, height }) => {
        const red = (/** @type {number} */ y) => (words[y * width + Math.floor(width / 2)] ?? 0) & 255;
        const rows = Array.from({ length: height }, (_, y) => y).filter((y) => red(y) !== red(0));
        return { top: rows[0] ?? 0, bottom: rows.at(-1) ?? 0 };
    });
}

/**
 * The picture on the canvas: a digest of its pixels, and the fraction of pixels that are not background.
 * @param {Page | import('playwright-core').Frame} page
 * @returns {Promise<{digest: string, ink: number, width: number, height: number}>}
 */
export function picture(page) {
    return onPixels(page, ({ words, width, height }) => {
        let hash = 0;
        let ink = 0;
        for (const word of words) {
            hash = (Math.imul(hash, 31) + word) | 0;
            if (word !== words[0]) ink += 1;
        }
        return { digest: `${width}x${height}:${hash}`, ink: ink / words.length, width, height };
    });
}

/**
 * Waits until the picture differs from `before` and is at rest.
 * @param {Page} page
 * @param {{digest: string}} before
 */
export function nextPicture(page, before) {
    return until(async () => {
        const now = await stillPicture(page);
        return now.digest === before.digest ? null : now;
    }, 'the picture changes');
}

/** Waits until a former picture is shown again, with equal pixels. @param {Page} page @param {{digest: string}} former */
export async function sameAgain(page, former) {
    await until(async () => (await stillPicture(page)).digest === former.digest, 'the former picture is there again');
}

/**
 * Waits until the page has handled all input and shows the finest picture of its newest state. The page is busy from the
 * change of a state until that picture. Input and layout change the state in the next frame at the latest; a movement
 * changes it in every frame, and shows pictures.
 * @param {Page} page
 */
export async function stillPicture(page) {
    await page.evaluate(
        () =>
            /** @type {Promise<void>} */ (
                new Promise((resolve) => {
                    const site = /** @type {any} */ (globalThis);
                    const stage = document.querySelector('#stage');
                    let [still, seen] = [0, site.pictures];
                    const frame = () => {
                        const rests = stage?.getAttribute('aria-busy') !== 'true' && site.pictures === seen;
                        still = rests ? still + 1 : 0;
                        seen = site.pictures;
                        if (still === 3) resolve();
                        else requestAnimationFrame(frame);
                    };
                    requestAnimationFrame(frame);
                })
            ),
    );
    return picture(page);
}

/** Waits for a number of further pictures, finished or not. @param {Page} page @param {number} [number] */
export async function morePictures(page, number = 1) {
    const seen = await page.evaluate(() => Number(/** @type {any} */ (globalThis).pictures));
    await page.waitForFunction((wanted) => /** @type {any} */ (globalThis).pictures >= wanted, seen + number);
}

/** Waits until the page has asked its workers what its input needs, and shows the answers. @param {Page} page */
export const answered = (page) =>
    page.evaluate(async () => {
        const frame = () => new Promise(requestAnimationFrame);
        await frame();
        do await frame();
        while (/** @type {any} */ (globalThis).asked > 0);
    });

/**
 * The place of the highest line in one column of the drawing, in CSS pixels of the page.
 * @param {Page} page
 * @param {{across: number, from: number}} where parts of the width and of the height, from the left and from the top
 */
export async function lineIn(page, where) {
    const box = await page.locator('#drawing').boundingBox();
    assert.ok(box);
    const place = await onPixels(
        page,
        ({ words, width, height }, { across, from }) => {
            const x = Math.floor(width * across);
            for (let y = Math.floor(height * from); y < height * 0.9; y++)
                if (words[y * width + x] !== words[0]) return [x / width, y / height];
            throw new Error('there is no line');
        },
        where,
    );
    return { x: box.x + box.width * Number(place[0]), y: box.y + box.height * Number(place[1]) };
}

/**
 * Sets a slider the way a drag does: input events, without waiting for anything.
 * @param {Page} page
 * @param {string} selector
 * @param {number[]} positions
 */
export function drag(page, selector, positions) {
    return page.evaluate(
        ([name, values]) => {
            const slider = /** @type {HTMLInputElement} */ (document.querySelector(name));
            for (const value of values) {
                slider.value = String(value);
                slider.dispatchEvent(new Event('input', { bubbles: true }));
            }
            slider.dispatchEvent(new Event('change', { bubbles: true }));
        },
        /** @type {const} */ ([selector, positions]),
    );
}
