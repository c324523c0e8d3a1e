/** The page on a projector: what fills the screen, and whether it is read from the last row. */

import assert from 'node:assert/strict';
import test, { after } from 'node:test';
import { some } from '../effort.mjs';
import { DESKTOP, PHONE, close, until, withPage } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */

after(close);

const HALL = { viewport: { width: 1920, height: 1080 } };
const ALGAE = '#v=1&title=Algae&axiom=A&rules=A%20-%3E%20AB%0AB%20-%3E%20A&n=6&angle=60';
/** A picture of this width, seen from this distance, in metres; and the height of capital letters in parts of their size. */
const [WIDE, AWAY, CAPITAL] = [2.5, 10, 0.65];
/** The least height of letters, in degrees of sight. */
const LEAST = 0.3;

/** The height of the capital letters of shown elements, in degrees of sight. @param {Page} page @param {string} selector */
async function degrees(page, selector) {
    // An element that was just replaced has no style.
    const size = await until(
        () =>
            page
                .locator(selector)
                .first()
                .evaluate((element) => parseFloat(getComputedStyle(element).fontSize)),
        `${selector} has a size`,
    );
    const metres = (size * CAPITAL * WIDE) / (page.viewportSize()?.width ?? 0);
    return (Math.atan(metres / AWAY) * 180) / Math.PI;
}

/** @param {Page} page @param {string[]} selectors */
async function areRead(page, ...selectors) {
    for (const selector of selectors) {
        await page.locator(selector).first().waitFor();
        const found = await degrees(page, selector);
        assert.ok(found >= LEAST, `${selector}: ${found.toFixed(2)} degrees`);
    }
}

/** Whether an element covers the window. @param {Page} page @param {string} selector */
const fills = (page, selector) =>
    page.locator(selector).evaluate((element) => {
        const { left, top, right, bottom } = element.getBoundingClientRect();
        return left <= 0 && top <= 0 && right >= innerWidth && bottom >= innerHeight;
    });

/** @param {Page} page @param {string} words */
const captioned = (page, words) =>
    until(async () => (await page.textContent('#caption-text'))?.startsWith(words), `the caption says ${words}`);

for (const [name, before] of some(
    /** @type {const} */ ([
        ['in full screen', undefined],
        ['in a browser without full screen', () => delete (/** @type {any} */ (Element.prototype).requestFullscreen)],
    ]),
))
    test(`F fills the screen with the drawing, n and the angle, ${name}`, () =>
        withPage(
            { hash: ALGAE, options: HALL, before: async (page) => before && page.addInitScript(before) },
            async (page) => {
                assert.ok((await degrees(page, '#caption-text')) < LEAST, 'the page is for one reader');
                await page.locator('#drawing').focus();
                await page.keyboard.press('f');
                await until(() => fills(page, '#stage'), 'the stage fills the screen');
                const isFull = () => page.evaluate(() => document.fullscreenElement !== null);
                if (before) assert.equal(await isFull(), false);
                else await until(isFull, 'full screen');
                await areRead(page, '#caption-title', '#caption-text');
                assert.ok(await page.isVisible('.projector-keys'));
                await page.keyboard.press('ArrowUp');
                await captioned(page, 'n = 7, 60°');
                // A button has no use for arrows, so they still mean the drawing.
                await page.locator('#projector-end').focus();
                await page.keyboard.press('ArrowRight');
                await captioned(page, 'n = 7, 61°');
                await page.keyboard.press('Escape');
                await until(async () => !(await fills(page, '#stage')), 'it ends');
                assert.ok(await page.isVisible('#panel'));
                assert.equal(await page.isVisible('#projector-bar'), false);
                assert.equal(await isFull(), false);
            },
        ));

test('the end of full screen by the browser ends it, and the button begins and ends it', () =>
    withPage({ hash: ALGAE, options: HALL }, async (page) => {
        await page.click('#project');
        await page.waitForFunction(() => document.fullscreenElement);
        await page.evaluate(() => document.exitFullscreen());
        await page.waitForSelector('#panel:visible');
        await page.click('#project');
        assert.equal(await page.getAttribute('#project', 'aria-pressed'), 'true');
        await page.click('#project');
        assert.equal(await page.getAttribute('#project', 'aria-pressed'), 'false');
        assert.ok(await page.isVisible('#panel'));
    }));

test('keys and tools go away, and come back with the pointer', () =>
    withPage({ hash: ALGAE, options: HALL }, async (page) => {
        await page.keyboard.press('f');
        await page.waitForSelector('.projector-keys', { state: 'hidden' });
        assert.equal(await page.isVisible('.tools-read'), false);
        assert.ok(await page.isVisible('#caption-text'));
        await page.mouse.move(400, 400);
        await page.waitForSelector('.projector-keys:visible');
    }));

test('what plays goes on', () =>
    withPage(
        { hash: '#v=1&axiom=F&rules=F%20-%3E%20F%5B%2BF%5DF%5B-F%5DF&n=5&angle=25', options: HALL },
        async (page) => {
            await page.click('#open-playback');
            await page.click('#play');
            const at = async () => Number(await page.inputValue('#play-slider'));
            await until(async () => (await at()) < 10_000, 'it plays');
            await page.locator('#drawing').focus();
            await page.keyboard.press('f');
            await page.waitForSelector(':root.projecting');
            assert.ok(await page.isVisible('#playback'));
            const then = await at();
            await until(async () => (await at()) !== then, 'it goes on');
            await page.click('#grow');
            await until(async () => (await page.getAttribute('#grow', 'aria-pressed')) === 'true', 'it grows');
            await page.keyboard.press('f');
            await page.waitForSelector('#panel:visible');
            assert.equal(await page.getAttribute('#grow', 'aria-pressed'), 'true');
            await page.click('#wind');
            await page.waitForSelector('#wind[aria-pressed=true]');
            await page.locator('#drawing').focus();
            await page.keyboard.press('f');
            await page.waitForSelector(':root.projecting');
            assert.equal(await page.getAttribute('#wind', 'aria-pressed'), 'true');
        },
    ));

for (const viewport of some([HALL.viewport, { width: 1280, height: 720 }]))
    test(`step by step fills the screen, in type that grows with it: ${viewport.width} x ${viewport.height}`, () =>
        withPage({ hash: ALGAE, options: { viewport } }, async (page) => {
            await page.click('#open-steps');
            await page.waitForSelector('#steps[open]');
            assert.equal(await fills(page, '#steps'), false);
            await page.click('#steps-project');
            await until(() => fills(page, '#steps'), 'the dialog fills the screen');
            await page.click('#steps-on');
            await areRead(page, '.family .parent', '.family .children code', '#steps-words');
            await page.click('#steps-single');
            await areRead(page, '#steps-table td code');
            await page.click('#steps-turtle');
            await areRead(page, '#steps-string .symbol', '#steps-state');
            // The focus is on a radio button, which nobody types into.
            await page.keyboard.press('f');
            await until(async () => !(await fills(page, '#steps')), 'it ends');
            assert.ok(await page.isVisible('#steps'));
        }));

test('the mathematics fills the screen, follows n, and returns to its place', () =>
    withPage({ hash: ALGAE, options: HALL }, async (page) => {
        await page.click('#mathematics summary');
        await page.waitForSelector('#math-project');
        await page.click('#math-project');
        await until(() => fills(page, '#projector-page'), 'the page fills the screen');
        await areRead(page, '#math-words p', '#math-table .now td', '#math-matrix td');
        const label = await page
            .locator('#math-plot text')
            .first()
            .evaluate((text) => text.getBoundingClientRect().height);
        assert.ok(label > 60, `letters of the plot: ${label} px`);
        await page.keyboard.press('ArrowUp');
        await until(async () => /^7/.test((await page.textContent('#math-table tr.now')) ?? ''), 'it follows');
        await page.keyboard.press('Escape');
        await page.waitForSelector('#projector-page', { state: 'hidden' });
        await page.keyboard.press('Escape');
        await page.waitForSelector('#panel:visible');
        assert.ok(await page.isVisible('#section-rules > #mathematics #math-words'));
        assert.equal(await page.locator('#mathematics + #status').count(), 1);
    }));

test('F is a letter in text, and listed among the keys', () =>
    withPage({ hash: ALGAE, options: DESKTOP }, async (page) => {
        await page.focus('#axiom');
        await page.keyboard.press('End');
        await page.keyboard.press('f');
        assert.equal(await page.inputValue('#axiom'), 'Af');
        assert.equal(await page.locator(':root.projecting').count(), 0);
        await page.click('#open-shortcuts');
        assert.match((await page.textContent('#shortcuts')) ?? '', /Ffill the screen/);
    }));

test('a phone has no button for it', () =>
    withPage({ options: PHONE }, async (page) => {
        assert.ok(await page.isVisible('#surprise'));
        assert.equal(await page.isVisible('#project'), false);
    }));
