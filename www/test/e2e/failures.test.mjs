/** Tools that do not load or stop: dialogs tell it, and try again. */

import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { close, until, withPage } from './browser.mjs';

after(close);

/** @typedef {import('playwright-core').Page} Page */

const WEED = '#v=1&axiom=F&rules=F%20-%3E%20F%5B%2BF%5DF&n=3&angle=30';

/** Each dialog with a tool: how it opens, where it tells a failure, and what shows that it works. @type {[string, (page: Page) => Promise<unknown>, string, (page: Page) => Promise<unknown>][]} */
const DIALOGS = [
    [
        'films',
        async (page) => {
            await page.click('#tab-save');
            await page.click('#open-film');
        },
        '#film-problem',
        (page) => page.waitForSelector('#film-picture[data-frame]'),
    ],
    [
        'step by step',
        (page) => page.click('#open-steps'),
        '#steps-problem',
        (page) => until(async () => /Generation/.test((await page.textContent('#steps-words')) ?? ''), 'the steps'),
    ],
    [
        'the check of a program',
        async (page) => {
            await page.click('#tab-save');
            await page.click('#check-program');
            await page.fill('#check-output', 'F[+F]F');
        },
        '#check-result',
        (page) => page.waitForSelector('#check-result:is(.agrees, .differs)'),
    ],
    [
        'the mathematics',
        (page) => page.click('#mathematics summary'),
        '#math-words',
        (page) => page.waitForSelector('#math-known:visible'),
    ],
    [
        'an exercise',
        async (page) => {
            await page.click('#tab-save');
            await page.click('#make-exercise');
        },
        '#maker-problem',
        (page) => page.waitForSelector('#maker-made:visible'),
    ],
];

for (const [name, open, place, works] of some(DIALOGS, 2))
    test(`a tool that does not load is told in a sentence, and tried again: ${name}`, () =>
        withPage({ hash: WEED, expected: /tools-first\.wasm|Failed to load/ }, async (page) => {
            await page.route(/tools-first\.wasm$/, (route) => route.abort());
            await open(page);
            await page.waitForSelector(`${place} .try-again`);
            assert.match((await page.textContent(place)) ?? '', /^[A-Z].*[.!?] Try again$/);
            await page.unroute(/tools-first\.wasm$/);
            await page.click(`${place} .try-again`);
            await works(page);
            assert.equal(await page.locator(`${place} .try-again`).count(), 0);
        }));
