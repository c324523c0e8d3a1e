/** The core of the page in Firefox, driven over WebDriver BiDi: what must work in every browser. */

import assert from 'node:assert/strict';
import { mkdtemp, readFile, readdir, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test, { after, before } from 'node:test';
import { launch } from 'puppeteer-core';

const ADDRESS = process.env.LSYSTEM_URL ?? 'http://127.0.0.1:8080/';
const KOCH = '#v=1&axiom=F&rules=F%20-%3E%20F+F--F+F&n=3&angle=60&heading=0';
const DRAWN = '#stage.inked';
/** Whoever waits for longer than this waits for ever, also on a busy machine. In milliseconds. */
const DEADLINE = 120_000;
/** The frame in the element of the shown step. */
const FRAME = '.step.now l-system >>> iframe';

/** @typedef {import('puppeteer-core').Page} Page */
/** @typedef {import('puppeteer-core').Frame} Frame */

/** @type {import('puppeteer-core').Browser} */
let browser;
let downloads = '';

before(async () => {
    downloads = await mkdtemp(join(tmpdir(), 'firefox-'));
    browser = await launch({
        browser: 'firefox',
        executablePath: process.env.FIREFOX ?? '/usr/bin/firefox-esr',
        headless: true,
        extraPrefsFirefox: {
            'browser.download.folderList': 2,
            'browser.download.dir': downloads,
            'browser.download.useDownloadDir': true,
            'browser.download.always_ask_before_handling_new_types': false,
            'ui.prefersReducedMotion': 1,
        },
    });
});
after(async () => {
    await browser?.close();
    await rm(downloads, { recursive: true, force: true });
});

/** Opens a page of the site; what fails there fails the test. @param {string} path @param {(page: Page) => Promise<void>} use @param {string} [drawn] */
async function at(path, use, drawn = DRAWN) {
    const page = await browser.newPage();
    page.setDefaultTimeout(DEADLINE);
    /** @type {string[]} */
    const wrong = [];
    page.on('pageerror', (error) => wrong.push(String(error)));
    page.on('console', (message) => message.type() === 'error' && wrong.push(message.text()));
    try {
        await page.setViewport({ width: 1280, height: 800 });
        await page.goto(ADDRESS + path);
        await page.waitForSelector(drawn);
        await use(page);
        assert.deepEqual(wrong, []);
    } finally {
        await page.close();
    }
}

/** Types a text in place of what is in a field. @param {Page | Frame} page @param {string} field @param {string} text */
async function fill(page, field, text) {
    await page.$eval(field, (element) => /** @type {HTMLInputElement} */ (element).select());
    await page.type(field, text);
}

/** How many different colours the drawing has, in a coarse grid of its pixels. @param {Page | Frame} page */
const colours = (page) =>
    page.$eval('#drawing', (canvas) => {
        const copy = new OffscreenCanvas(200, 200);
        const context = /** @type {OffscreenCanvasRenderingContext2D} */ (copy.getContext('2d'));
        context.drawImage(/** @type {HTMLCanvasElement} */ (canvas), 0, 0, 200, 200);
        return new Set(new Uint32Array(context.getImageData(0, 0, 200, 200).data.buffer)).size;
    });

/** The text of the caption, when it has these words. @param {Page | Frame} page @param {string} words */
const captioned = (page, words) =>
    page.waitForFunction(
        (/** @type {string} */ words) => document.querySelector('#caption-text')?.textContent?.includes(words),
        {},
        words,
    );

test('the first picture, and an edit', () =>
    at(KOCH, async (page) => {
        await captioned(page, '64 segments');
        assert.ok((await colours(page)) > 2, 'the drawing has ink');
        await fill(page, '#rules', 'F -> F+F');
        await captioned(page, '8 segments');
        await page.waitForFunction(() => location.hash.includes('rules=F%20-%3E%20F+F&'));
        await page.keyboard.press('Tab');
        await page.click('#undo');
        await captioned(page, '64 segments');
    }));

test('a mistake is told with its place', () =>
    at(KOCH, async (page) => {
        await fill(page, '#rules', 'F');
        await page.waitForFunction(() => /arrow|->/.test(document.querySelector('#rules-problems')?.textContent ?? ''));
        await captioned(page, 'Showing the last valid drawing.');
    }));

test('a tree in space turns under the pointer', () =>
    at('#v=1&axiom=A&rules=A%20-%3E%20F%5B%26A%5D////%5B%26A%5D////%5B%26A%5D&n=5&angle=22.5', async (page) => {
        const before = await page.$eval('#drawing', (canvas) => /** @type {HTMLCanvasElement} */ (canvas).toDataURL());
        await page.mouse.move(400, 400);
        await page.mouse.down();
        await page.mouse.move(500, 420, { steps: 5 });
        await page.mouse.up();
        await page.waitForFunction(
            (/** @type {string} */ before) =>
                /** @type {HTMLCanvasElement} */ (document.querySelector('#drawing')).toDataURL() !== before,
            {},
            before,
        );
    }));

test('a link and a code to embed are made', () =>
    at(KOCH, async (page) => {
        await page.click('#share');
        await page.waitForFunction(
            () => /** @type {HTMLInputElement | null} */ (document.querySelector('#share-link'))?.value,
        );
        const value = (/** @type {string} */ field) =>
            page.$eval(field, (element) => /** @type {HTMLTextAreaElement} */ (element).value);
        assert.match(await value('#share-link'), /#v=1&.*rules=F%20-%3E%20F\+F--F\+F/);
        await page.click('#share-embed > summary');
        await page.waitForFunction(() =>
            /** @type {HTMLTextAreaElement} */ (document.querySelector('#embed-code'))?.value.includes('embed.html#'),
        );
    }));

test('a picture is saved', () =>
    at(KOCH, async (page) => {
        await page.click('#tab-save');
        await page.click('#open-save');
        await page.waitForSelector('#save-now', { visible: true });
        await page.click('.save-tile:has([name=save-format][value=svg])');
        await page.click('#save-now');
        /** @type {string | undefined} */
        let name;
        for (const end = Date.now() + DEADLINE; !name && Date.now() < end; ) {
            await new Promise((resolve) => setTimeout(resolve, 100));
            name = (await readdir(downloads)).find((file) => file.endsWith('.svg'));
        }
        assert.match(await readFile(join(downloads, name ?? ''), 'utf8'), /<svg [^]*<path [^]*<\/svg>/);
    }));

test('an embedded drawing follows its controls', () =>
    at(`embed.html${KOCH}&controls=angle,n`, async (page) => {
        await captioned(page, '64 segments');
        await fill(page, '#iterations', '2');
        await captioned(page, '16 segments');
    }));

test('an exercise in the lesson is marked', () =>
    at(
        'course.html#step-1',
        async (page) => {
            const handle = await page.waitForSelector(FRAME);
            const frame = /** @type {Frame} */ (await handle?.contentFrame());
            await frame.waitForSelector('#mark-percent:not(:empty)');
            await fill(frame, '#rules', 'F -> FF');
            await page.waitForFunction(() => /Done/.test(document.querySelector('#told')?.textContent ?? ''));
        },
        FRAME,
    ));
