/** Damaged downloads and hostile files: invalid wasm, files that are far too large. */

import assert from 'node:assert/strict';
import { mkdtemp, open, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { sampled, some } from '../effort.mjs';
import { close, nextPicture, ready, stillPicture, until, withPage } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */

let folder = '';
before(async () => {
    folder = await mkdtemp(join(tmpdir(), 'damage'));
});
after(async () => {
    await close();
    await rm(folder, { recursive: true });
});

const WEED = '#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5DF%5B-F%5DF&n=4&angle=25';

/** Responses with status 200 that are no valid wasm. @type {Record<string, (wasm: Buffer) => Buffer>} */
const DAMAGE = {
    'the first half': (wasm) => wasm.subarray(0, wasm.length >> 1),
    'an error page': () => Buffer.from('<!doctype html><title>Not found</title>'),
    nothing: () => Buffer.alloc(0),
};

/** The page's delays before it fetches the wasm again, in milliseconds. */
const DELAYS = [500, 1500, 4000];

for (const [what, damage] of some(Object.entries(DAMAGE))) {
    test(`${what} in place of the wasm: the wasm is fetched again`, () => {
        let sent = 0;
        return withPage(
            {
                hash: WEED,
                drawing: '#trouble:not([hidden])',
                expected: /preload/,
                before: async (page) => {
                    await page.clock.install();
                    await page.route(/lsystem\.wasm$/, async (route) => {
                        const response = await route.fetch();
                        const body = await response.body();
                        await route.fulfill({ response, body: sent++ < 2 ? damage(body) : body });
                    });
                },
            },
            async (page) => {
                for (const delay of DELAYS.slice(0, 2)) {
                    const before = sent;
                    assert.ok(await page.isVisible('#trouble'));
                    await page.clock.runFor(delay);
                    await until(() => sent > before, 'the wasm is fetched again');
                }
                await ready(page);
                await page.waitForSelector('#trouble', { state: 'hidden' });
            },
        );
    });
}

test('wasm that never loads is reported, and requested again with the next input', () => {
    let broken = true;
    return withPage(
        {
            hash: WEED,
            drawing: '#trouble:not([hidden])',
            expected: /preload/,
            before: async (page) => {
                await page.clock.install();
                await page.route(/lsystem\.wasm$/, async (route) =>
                    broken
                        ? route.fulfill({ status: 200, contentType: 'text/html', body: '<!doctype html>' })
                        : route.fallback(),
                );
            },
        },
        async (page) => {
            assert.match(await page.innerText('#trouble'), /could not be loaded/);
            await until(async () => {
                // Each failure is told before the next delay begins.
                await page.clock.runFor(Math.max(...DELAYS));
                return page.isVisible('#trouble-again');
            }, 'no more tries');
            broken = false;
            await page.fill('#axiom', 'F+F');
            await ready(page);
            await page.waitForSelector('#trouble', { state: 'hidden' });
        },
    );
});

/** Measures how long the main thread is busy. @param {Page} page */
const watched = (page) =>
    page.addInitScript(() => {
        const site = /** @type {any} */ (globalThis);
        site.longest = 0;
        const note = (/** @type {PerformanceEntryList} */ entries) => {
            for (const { duration } of entries) site.longest = Math.max(site.longest, duration);
        };
        const observer = new PerformanceObserver((list) => note(list.getEntries()));
        observer.observe({ type: 'longtask', buffered: true });
        site.noteLast = () => note(observer.takeRecords());
    });

/**
 * A page that is busy for longer than so many times a fixed piece of work does not respond. On an idle machine the longest
 * task takes about 150 ms and the work 20 ms; a busy one stretches both.
 */
const RESPONSIVE = 100;

/** Fails if a task of this many milliseconds keeps the page from responding. @param {Page} page @param {number} longest */
async function assertResponsive(page, longest) {
    const yardstick = await page.evaluate(() => {
        const begun = performance.now();
        const text = JSON.stringify(Array.from({ length: 200_000 }, (_, at) => `${at}`));
        return JSON.parse(text).length && performance.now() - begun;
    });
    assert.ok(longest < RESPONSIVE * yardstick, `a task took ${longest} ms, a fixed piece of work ${yardstick} ms`);
}

/** The longest task since the last call, in milliseconds. @param {Page} page @returns {Promise<number>} */
const longestTask = (page) =>
    page.evaluate(async () => {
        const site = /** @type {any} */ (globalThis);
        // The task before this frame has ended, and its record waits.
        await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
        site.noteLast();
        const { longest } = site;
        site.longest = 0;
        return longest;
    });

/** Writes a file piece by piece. @param {string} name @param {string[]} ends @param {string} piece @param {number} count */
async function written(name, [start = '', end = ''], piece, count) {
    const path = join(folder, name);
    const file = await open(path, 'w');
    await file.write(start);
    const most = 50_000;
    for (let at = 0; at < count; at += most) await file.write(piece.repeat(Math.min(most, count - at)));
    await file.write(end);
    await file.close();
    return path;
}

const HEAD = '{"format":"l-systems favourites","version":1,"favourites":[';
const packed = deflateSync(`rules=${'F'.repeat(500_000)}`).toString('base64url');

/** Files that are far too large, and their messages. @type {Record<string, [string, () => Promise<string>, RegExp]>} */
const BOMBS = {
    '1.6 million damaged links': [
        'favourites',
        () => written('links.json', [HEAD, 'null]}'], '{"name":"a","link":"#v=1&rules=%"},', 1_600_000),
        /too large/,
    ],
    '2 MB of damaged links': [
        'favourites',
        () => written('few.json', [HEAD, 'null]}'], '{"link":"#v=1&n=x"},', 100_000),
        /could not be read/,
    ],
    '9,000 damaged links': [
        'favourites',
        () => written('damaged.json', [HEAD, 'null]}'], '{"name":"a","link":"#v=1&rules=%"},', 9000),
        /could not be read/,
    ],
    '49 MB of compressed bombs': [
        'favourites',
        () => written('bombs.json', [HEAD, 'null]}'], `{"name":"a","link":"#v=1&z=${packed}"},`, 70_000),
        /too large/,
    ],
    '2 MB of compressed bombs': [
        'favourites',
        () => written('bomb.json', [HEAD, 'null]}'], `{"name":"a","link":"#v=1&z=${packed}"},`, 2500),
        /could not be read|Added|too large/,
    ],
    '50 MB of newlines': ['file', () => written('lines.json', [], '\n', 50 << 20), /too large/],
    '3 MB of newlines': ['file', () => written('few lines.json', [], '\n', 3 << 20), /could not be read/],
    '8 MB of brackets': ['file', () => written('deep.json', [], '[', 8 << 20), /too large/],
    '2 MB of brackets': ['file', () => written('less deep.json', [], '[', 2 << 20), /could not be read/],
    '2 MB of favourites in brackets': [
        'favourites',
        () => written('deep favourites.json', [HEAD, 'null]}'], '[', 1_900_000),
        /no favourites/,
    ],
    '60 MB that are no picture': [
        'file',
        () => written('noise.png', [], 'abcdefgh', (60 << 20) / 8),
        /has no system inside/,
    ],
    '80 MB that are no picture': ['file', () => written('more.svg', ['<svg>'], '<g>\n', 20 << 20), /too large/],
};

for (const [what, [field, make, words]] of sampled(Object.entries(BOMBS), 3)) {
    test(`${what}: refused with a message, and the page stays responsive`, async () => {
        const path = await make();
        try {
            await withPage({ hash: WEED, before: watched }, async (page) => {
                const before = await stillPicture(page);
                if (field === 'favourites')
                    await page.evaluate(
                        () =>
                            document.querySelector('#open-favourites') instanceof HTMLElement &&
                            /** @type {HTMLElement} */ (document.querySelector('#open-favourites')).click(),
                    );
                await longestTask(page);
                const begun = Date.now();
                await page.setInputFiles(field === 'file' ? '#file' : '#favourites-file', path);
                const told = field === 'file' ? '#toast' : '#favourites-status';
                await until(async () => words.test(String(await page.textContent(told))), `it is told: ${words}`);
                const longest = await longestTask(page);
                console.log(
                    `${what}: told after ${((Date.now() - begun) / 1000).toFixed(1)} s, longest task ${longest.toFixed(0)} ms`,
                );
                await assertResponsive(page, longest);
                if (field === 'favourites') await page.keyboard.press('Escape');
                await page.fill('#axiom', 'F+F');
                await nextPicture(page, before);
            });
        } finally {
            await rm(path);
        }
    });
}

test('a text that is far too long is cut, and the page stays responsive', () =>
    withPage({ hash: WEED, before: watched }, async (page) => {
        await stillPicture(page);
        await longestTask(page);
        // In a task of the page: the driver's tasks are not measured.
        await page.evaluate(async () => {
            await new Promise((resolve) => setTimeout(resolve));
            const area = /** @type {HTMLTextAreaElement} */ (document.querySelector('#rules'));
            area.focus();
            area.select();
            document.execCommand('insertText', false, 'F'.repeat(400_000));
        });
        assert.equal((await page.inputValue('#rules')).length, 50_000);
        assert.match(await page.innerText('#toast'), /the rest was cut/);
        const longest = await longestTask(page);
        console.log(`400,000 characters pasted: longest task ${longest.toFixed(0)} ms`);
        await assertResponsive(page, longest);
    }));

test('thousands of productions are marked and coloured without blocking the page', () =>
    withPage({ hash: WEED, before: watched }, async (page) => {
        await stillPicture(page);
        for (const line of ['A -> F', 'A -> %']) {
            await longestTask(page);
            await page.evaluate(async (piece) => {
                await new Promise((resolve) => setTimeout(resolve));
                const area = /** @type {HTMLTextAreaElement} */ (document.querySelector('#rules'));
                area.value = Array(6000).fill(piece).join('\n');
                area.dispatchEvent(new Event('input', { bubbles: true }));
            }, line);
            await until(
                async () => (await page.locator('#rules-problems li').count()) > 0,
                'it is told that productions repeat',
            );
            await stillPicture(page);
            const longest = await longestTask(page);
            console.log(`6,000 times ${line}: longest task ${longest.toFixed(0)} ms`);
            await assertResponsive(page, longest);
        }
    }));
