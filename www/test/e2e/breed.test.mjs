import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { DESKTOP, PHONE, close, until, withPage } from './browser.mjs';
import { readFile } from 'node:fs/promises';

after(close);

/** @typedef {import('playwright-core').Page} Page */

const PLANT = '#v=1&axiom=X&rules=X%20-%3E%20F%5B%2BX%5D%5B-X%5DFX%0AF%20-%3E%20FF&n=5&angle=25';

/** Waits until all nine pictures are there. @param {Page} page */
const painted = (page) =>
    until(async () => (await page.locator('#breed-cards .thumb.inked').count()) === 9, 'nine pictures');

/** The rules of the children. @param {Page} page */
const rules = (page) =>
    page.locator('#breed-cards .card').evaluateAll((all) => all.map((card) => card.getAttribute('title')));

/** @param {Page} page */
const ancestors = (page) => page.locator('#descent .card:visible').count();

test('a child becomes the system, two are crossed, and undo goes back', () =>
    withPage({ hash: PLANT }, async (page) => {
        const first = await page.inputValue('#rules');
        await page.click('[data-opens=breed]');
        await painted(page);
        assert.ok(!(await page.isVisible('#breed-kinds')), 'nothing is left to chance');
        assert.equal(await ancestors(page), 0);
        const before = await rules(page);
        await page.locator('#breed-cards .card').nth(2).click();
        await until(async () => (await ancestors(page)) === 2, 'the line of descent');
        await painted(page);
        assert.notDeepEqual(await rules(page), before);
        const keep = page.locator('#breed-cards .keep input');
        const former = await rules(page);
        await keep.nth(0).check();
        assert.match(await page.innerText('#breed-note'), /another/);
        // Both are crossed at once, and then neither is kept any more.
        await keep.nth(4).click();
        await until(async () => JSON.stringify(await rules(page)) !== JSON.stringify(former), 'children of both');
        await painted(page);
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-descent')]);
        const film = await readFile(await download.path());
        assert.equal(film.subarray(0, 6).toString(), 'GIF89a');
        assert.match(download.suggestedFilename(), /_descent\.gif$/);
        // An ancestor is gone back to.
        await page.locator('#descent .card').first().click();
        await until(async () => (await ancestors(page)) === 0, 'the line begins anew');
        await page.click('#close-breed');
        assert.equal(await page.inputValue('#rules'), first);
        await page.click('#undo');
        await page.click('#undo');
        assert.equal(await page.inputValue('#rules'), first);
    }));

test('where chance plays a part, seeds are compared in the same dialog', () =>
    withPage({ hash: `${PLANT}&vary=20&seed=7` }, async (page) => {
        await page.click('[data-opens=breed]');
        await painted(page);
        await page.click('#show-seeds');
        await until(async () => (await page.locator('#breed-cards .present').count()) === 1, 'the current seed');
        assert.equal(await page.textContent('#h-breed'), 'Seeds');
        for (const viewport of [DESKTOP.viewport, { width: 1280, height: 657 }, PHONE.viewport]) {
            await page.setViewportSize(viewport);
            const head = await page.locator('#breed').evaluate((dialog) => {
                const { left, right } = dialog.getBoundingClientRect();
                const parts = [...dialog.querySelectorAll('.dialog-head > *')].map((part) =>
                    part.getBoundingClientRect(),
                );
                return parts.every((part) => part.left >= left && part.right <= right);
            });
            assert.ok(head, `the whole head can be seen at ${viewport.width} x ${viewport.height}`);
        }
        assert.ok(!(await page.isVisible('.keep')));
        await page.click('#show-children');
        await until(async () => (await page.locator('#breed-cards .present').count()) === 0, 'children again');
    }));

for (const [where, options] of some(
    /** @type {const} */ ([
        ['a phone', PHONE],
        ['a desk', DESKTOP],
    ]),
))
    test(`what keeps a child lies below its picture and within its card: ${where}`, () =>
        withPage({ hash: PLANT, options }, async (page) => {
            await page.locator('[data-opens=breed]').first().dispatchEvent('click');
            await painted(page);
            const slots = await page.locator('.breed-slot').evaluateAll((all) =>
                all.map((slot) => {
                    const [card, picture, keep] = ['.card', '.thumb', '.keep'].map((name) => {
                        const { bottom, top } = /** @type {Element} */ (
                            slot.querySelector(name)
                        ).getBoundingClientRect();
                        return { bottom, top };
                    });
                    return { card, picture, keep };
                }),
            );
            assert.equal(slots.length, 9);
            for (const { card, picture, keep } of slots)
                assert.ok(
                    card && picture && keep && keep.top >= picture.bottom - 1 && keep.bottom <= card.bottom + 0.5,
                    JSON.stringify({ card, picture, keep }),
                );
        }));
