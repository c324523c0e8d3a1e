/** A real browser for the tests: every page opened here must stay within its origin and keep its console clean. */

import assert from 'node:assert/strict';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { FORMATS } from '../../js/tables.js';

export const ADDRESS = process.env.LSYSTEM_URL ?? 'http://127.0.0.1:8080/';

const ARGUMENTS = [
    '--headless',
    '--no-sandbox',
    '--disable-gpu',
    '--disable-quic',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
];

export const DESKTOP = { viewport: { width: 1280, height: 800 } };
export const PHONE = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true };

/** @typedef {import('playwright-core').Page} Page */

/** @type {Promise<import('playwright-core').Browser> | undefined} */
let browser;

/** @returns {Promise<import('playwright-core').Browser>} */
const launch = () => (browser ??= chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium-headless-shell', args: ARGUMENTS }));

export async function close() {
    await (await browser)?.close();
    browser = undefined;
}

/** Waits for the first picture. @param {Page | import('playwright-core').Frame} page @param {string} [drawing] */
export async function ready(page, drawing = '#stage.inked') {
    await page.waitForSelector(drawing);
}

/** Serves the page's source modules, for tests that import one in the page. @param {Page} page */
export const withModules = (page) =>
    page.route('**/js/**', (route) => route.fulfill({ path: fileURLToPath(new URL(`../../js/${route.request().url().split('/js/').pop()}`, import.meta.url)) }));

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
 * shows that the drawing is ready, or null. A failing test runs once more in a fresh page, and its first error is
 * printed: a busy machine may be late, but a fault is repeated.
 * @typedef {{address?: string, also?: string, drawing?: string | null, hash?: string, expected?: RegExp | undefined, options?: import('playwright-core').BrowserContextOptions, before?: (page: Page) => Promise<unknown>}} How
 * @param {How} how
 * @param {(page: Page) => Promise<unknown>} use
 */
export async function withPage(how, use) {
    try {
        await once(how, use);
    } catch (error) {
        console.error('failed once, tried again:', error);
        await once(how, use);
    }
}

/** @param {How} how @param {(page: Page) => Promise<unknown>} use */
async function once({ address = ADDRESS, also = address, drawing = '#stage.inked', hash = '', expected, options = DESKTOP, before }, use) {
    const context = await (await launch()).newContext({ reducedMotion: 'reduce', acceptDownloads: true, ...options });
    try {
        const page = await context.newPage();
        /** @type {string[]} */
        const wrong = [];
        page.on('console', (message) => ['error', 'warning'].includes(message.type()) && !expected?.test(message.text()) && wrong.push(message.text()));
        page.on('pageerror', (error) => wrong.push(String(error)));
        page.on('request', (request) => {
            const url = request.url();
            if (!url.startsWith(address) && !url.startsWith(also) && !/^(blob|data):/.test(url)) wrong.push(`a request left the site: ${url}`);
        });
        await before?.(page);
        await page.goto(address + hash);
        if (drawing) await ready(page, drawing);
        await use(page);
        assert.deepEqual(wrong, []);
    } finally {
        await context.close();
    }
}

/**
 * Repeats `check` until it neither throws nor returns false.
 * @template T
 * @param {() => Promise<T> | T} check
 * @param {string} what
 * @returns {Promise<NonNullable<T>>}
 */
export async function until(check, what, patience = 8000) {
    const end = Date.now() + patience;
    for (;;) {
        let last;
        try {
            const value = await check();
            if (value) return value;
        } catch (error) {
            last = error;
        }
        if (Date.now() > end) throw new Error(`not so in ${patience} ms: ${what}`, { cause: last });
        await new Promise((resolve) => setTimeout(resolve, 30));
    }
}

/**
 * Runs a function in the page on the pixels of the drawing, one number per pixel, row by row.
 * @template T
 * @param {Page | import('playwright-core').Frame} page
 * @param {(pixels: {words: Uint32Array, width: number, height: number}) => T} read
 * @returns {Promise<T>}
 */
export async function onPixels(page, read) {
    const pixels = await page.evaluateHandle(() => {
        const source = /** @type {HTMLCanvasElement} */ (document.querySelector('#drawing'));
        const copy = document.createElement('canvas');
        copy.width = source.width;
        copy.height = source.height;
        const context = /** @type {CanvasRenderingContext2D} */ (copy.getContext('2d'));
        context.drawImage(source, 0, 0);
        const words = new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer);
        return { words, width: copy.width, height: copy.height };
    });
    try {
        return /** @type {T} */ (await pixels.evaluate(/** @type {any} */ (read)));
    } finally {
        await pixels.dispose();
    }
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
 * Waits until the picture differs from `before` and no longer changes.
 * @param {Page} page
 * @param {{digest: string}} before
 */
export async function nextPicture(page, before) {
    await until(async () => (await picture(page)).digest !== before.digest, 'the picture changes');
    return stillPicture(page);
}

/** Waits until a former picture is shown again, with equal pixels. @param {Page} page @param {{digest: string}} former */
export async function sameAgain(page, former) {
    await until(async () => (await picture(page)).digest === former.digest, 'the former picture is there again');
}

/** Waits until the page has handled all input. @param {Page} page */
const frames = (page) => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));

/** Waits until no newer state is being drawn and the picture has stopped changing. @param {Page} page */
export async function stillPicture(page) {
    let last = await picture(page);
    let since = Date.now();
    return until(async () => {
        // In this order, because the last picture may come in between.
        const busy = (await page.getAttribute('#stage', 'aria-busy')) === 'true';
        await frames(page);
        const now = await picture(page);
        if (now.digest !== last.digest) {
            last = now;
            since = Date.now();
        }
        return !busy && Date.now() - since > 150 ? now : null;
    }, 'the picture comes to rest');
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
