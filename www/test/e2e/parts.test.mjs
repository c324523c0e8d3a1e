/** The core in two parts: the first draws first pictures, and the rest joins it. */

import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { answered, close, nextPicture, quiet, sameAgain, stillPicture, until, withPage } from './browser.mjs';

after(close);

/** @typedef {import('playwright-core').Page} Page */

const REST = '**/lsystem-rest.wasm';
const SOLID = '#v=1&axiom=F&rules=F%20-%3E%20F%5B%26F%5D%5B%5EF%5D&n=4&angle=25';

/** Counts the page's workers, and those that have the rest of the core. @param {Page} page */
const counting = (page) =>
    page.addInitScript(() => {
        const site = /** @type {any} */ (globalThis);
        [site.workers, site.whole] = [0, 0];
        site.Worker = class extends Worker {
            /** @param {[string]} how */
            constructor(...how) {
                super(...how);
                site.workers += 1;
            }
            postMessage(/** @type {any[]} */ ...message) {
                if (message[0]?.type === 'rest') site.whole += 1;
                return super.postMessage(.../** @type {[any]} */ (message));
            }
        };
    });

/** @param {Page} page @returns {Promise<[number, number, number]>} workers, whole ones, and pictures */
const counted = (page) =>
    page.evaluate(() => {
        const { workers, whole, pictures } = /** @type {any} */ (globalThis);
        return [workers, whole, pictures];
    });

/** Holds requests of the rest back. @param {Page} page */
async function hold(page) {
    /** @type {() => void} */
    let release = () => {};
    const held = new Promise((resolve) => {
        release = () => resolve(undefined);
    });
    await page.route(REST, async (route) => {
        await held;
        await route.continue();
    });
    return release;
}

for (const [what, hash] of some(
    /** @type {const} */ ([
        ['the opening plant', ''],
        ['a curve', '#v=1&axiom=F--F--F&rules=F%20-%3E%20F+F--F+F&n=4&angle=60'],
    ]),
)) {
    test(`the first part draws ${what}, and the rest joins without a change`, async () => {
        let release = () => {};
        await withPage(
            {
                hash,
                before: async (page) => {
                    await counting(page);
                    release = await hold(page);
                },
            },
            async (page) => {
                const before = await stillPicture(page);
                assert.ok(before.ink > 0.001);
                const [workers, whole, pictures] = await counted(page);
                assert.deepEqual([workers, whole], [1, 0], 'one worker, with the first part');
                release();
                await until(async () => (await counted(page))[1] === 1, 'the worker has the rest');
                assert.ok(
                    await page.evaluate(() =>
                        performance.getEntriesByType('resource').some(({ name }) => name.endsWith('lsystem-rest.wasm')),
                    ),
                );
                const box = await page.locator('#drawing').boundingBox();
                assert.ok(box);
                await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
                await answered(page);
                assert.deepEqual(
                    await counted(page),
                    [1, 1, pictures],
                    'the same worker answers, and no picture is new',
                );
                assert.equal((await stillPicture(page)).digest, before.digest);
                await page.click('#open-reader');
                await until(async () => (await page.innerText('#reader')).includes('F'), 'the string is read');
                assert.equal((await counted(page))[0], 1);
            },
        );
    });
}

test('a question waits for the rest', async () => {
    let release = () => {};
    await withPage(
        {
            before: async (page) => {
                await counting(page);
                release = await hold(page);
            },
        },
        async (page) => {
            const before = await stillPicture(page);
            await page.click('#open-reader');
            await quiet(200, 'a worker without the rest would stop');
            release();
            await until(async () => (await page.innerText('#reader-text')).includes('F'), 'the string is read');
            assert.deepEqual((await counted(page)).slice(0, 2), [1, 1]);
            assert.ok(await page.isHidden('#trouble'), 'nothing was wrong');
            await page.click('#open-reader');
            await sameAgain(page, before);
        },
    );
});

test('a drawing in space is drawn by the whole core', () =>
    withPage({ hash: SOLID, before: counting }, async (page) => {
        assert.ok((await stillPicture(page)).ink > 0.001);
        assert.ok((await counted(page))[1] > 0);
        assert.ok(await page.isHidden('#trouble'));
    }));

test('without the rest pictures in the plane are drawn, and the others say what is missing', () =>
    withPage(
        { before: (page) => page.route(REST, (route) => route.abort()), expected: /Failed to load resource/ },
        async (page) => {
            const before = await stillPicture(page);
            await page.fill('#rules', 'F -> F[+F]F');
            const plane = await nextPicture(page, before);
            await page.fill('#rules', 'F -> F[&F]F');
            await page.waitForSelector('#trouble:visible');
            assert.match(await page.innerText('#trouble'), /could not be loaded/);
            await page.fill('#rules', 'F -> F[+F]F');
            await sameAgain(page, plane);
            await page.unroute(REST);
            await page.fill('#rules', 'F -> F[&F]F');
            await nextPicture(page, plane);
            await page.waitForSelector('#trouble', { state: 'hidden' });
        },
    ));
