/** The page of sixty lines: it draws what is typed, and loads the core and nothing else of the site. */

import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { ADDRESS, DESKTOP, PHONE, close, until, withPage } from './browser.mjs';

after(close);

/** @param {import('playwright-core').Page} page */
const picture = (page) => page.$eval('canvas', (canvas) => /** @type {HTMLCanvasElement} */ (canvas).toDataURL());

for (const [name, options] of Object.entries({ desktop: DESKTOP, phone: PHONE }))
    test(`rules, angle and iterations are drawn with expand, draw and lineTo, on a ${name}`, async () => {
        /** @type {string[]} */
        const loaded = [];
        const before = async (/** @type {import('playwright-core').Page} */ page) =>
            page.on('request', (request) => loaded.push(request.url().slice(ADDRESS.length)));
        await withPage(
            { address: `${ADDRESS}simple.html`, also: ADDRESS, drawing: null, options, before },
            async (page) => {
                const told = (/** @type {string} */ words) =>
                    until(async () => (await page.textContent('#told'))?.includes(words), words);
                await told('20°, 6 iterations, 4607 symbols: FF');
                const first = await picture(page);
                await page.fill('#angle', '60');
                await told('60°');
                const second = await picture(page);
                assert.notEqual(second, first);
                await page.fill('#n', '1');
                await told('1 iterations, 12 symbols: F[+X]F[-X]+X');
                await page.fill('#rules', 'F\nF -> F+F--F+F');
                await told('1 iterations, 8 symbols: F+F--F+F');
                const koch = await picture(page);
                await page.fill('#rules', 'F\nF = F');
                await told('is not a number');
                assert.equal(await picture(page), koch, 'the last picture stays');
                assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
            },
        );
        const expected = ['simple.html', 'core.js', 'lsystem.wasm', 'lsystem-rest.wasm'];
        assert.deepEqual(loaded.filter((file) => file !== 'icons/icon.svg').sort(), expected.sort());
    });
