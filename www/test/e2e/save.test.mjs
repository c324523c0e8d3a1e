/** The save dialog: choices, preview, size, problems, cancelling, memory of choices, keyboard, phone. */

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { groupsOf } from '../../js/save/choices.js';
import { PHONE, close, nextPicture, saveFile, stillPicture, until, withPage } from './browser.mjs';

after(close);

const WEED = '#v=1&title=Weed&axiom=F&rules=F%20-%3E%20F%5B+F%5DF%5B-F%5DF&n=4&angle=25';

/** @param {import('playwright-core').Page} page */
async function open(page) {
    if ((await page.getAttribute('#tab-save', 'aria-selected')) !== 'true') await page.click('#tab-save');
    await page.click('#open-save');
    await page.waitForSelector('#save-preview > *');
}

/** @param {import('playwright-core').Page} page @param {string} value */
const choose = (page, value) => page.click(`.save-tile:has([value=${value}])`);

/** @param {import('playwright-core').Page} page */
const size = (page) => page.innerText('#save-size');

test('the dialog shows the file, its name and its size', () =>
    withPage({ hash: WEED }, async (page) => {
        await open(page);
        assert.deepEqual(
            await page.locator('#save-purposes .save-tile').allInnerTexts(),
            groupsOf().map(({ label }) => label),
        );
        await until(async () => /^\d+ kB$/.test(await size(page)), 'the size of the SVG is known');
        assert.equal(await page.innerText('#save-name'), 'Weed_n4.svg');
        assert.ok((await page.getAttribute('#save-preview img', 'src'))?.startsWith('blob:'));
        await choose(page, 'png');
        await page.waitForSelector('#option-size');
        await until(async () => /× \d+ pixels$/.test(await size(page)), 'the size of the picture');
        await choose(page, 'data');
        await choose(page, 'csv');
        await until(
            async () =>
                (await page.locator('#save-preview pre').allInnerTexts())[0]?.startsWith(
                    'x0,y0,x1,y1,level,colour\n0,0,',
                ) ?? false,
            'the first lines are shown',
        );
        const told = await size(page);
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-now')]);
        const bytes = await readFile(String(await download.path()));
        assert.equal(bytes.toString().trim().split('\n').length, 5 ** 4 + 1);
        assert.equal(told, `${Math.round(bytes.length / 1000)} kB`);
        await page.waitForSelector('#save-dialog', { state: 'hidden' });
        assert.match(await page.innerText('#toast'), /^Saved/);
    }));

test('options change the file, and all choices are remembered', () =>
    withPage({ hash: WEED }, async (page) => {
        await open(page);
        await page.check('#option-transparent');
        await page.check('#option-bare');
        await page.waitForSelector('#save-preview.clear img');
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-now')]);
        const text = await readFile(String(await download.path()), 'utf8');
        assert.ok(text.startsWith('<svg') && !text.includes('<rect') && !text.includes('F[+F]'));
        await page.click('#open-save');
        await choose(page, 'svg-compact');
        await page.click('#save-cancel');
        await page.reload();
        await open(page);
        assert.ok(await page.isChecked('[name=save-format][value=svg-compact]'));
        assert.ok((await page.isChecked('#option-transparent')) && (await page.isChecked('#option-bare')));
    }));

test('a picture has the size that is asked for, and sizes out of range are told', () =>
    withPage({ hash: WEED }, async (page) => {
        await open(page);
        await choose(page, 'png');
        await page.selectOption('#option-size', 'own');
        await page.fill('.save-sides input >> nth=0', '40000');
        await page.waitForSelector('.range-note:visible');
        await page.fill('.save-sides input >> nth=0', '300');
        await page.fill('.save-sides input >> nth=1', '200');
        await until(async () => (await size(page)) === '300 × 200 pixels', 'the size is told');
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-now')]);
        const bytes = await readFile(String(await download.path()));
        assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [300, 200]);
    }));

test('a picture larger than a canvas, without a background, is made piece by piece', () =>
    withPage({ hash: WEED }, async (page) => {
        await open(page);
        await choose(page, 'png');
        await page.selectOption('#option-size', 'own');
        await page.fill('.save-sides input >> nth=0', '5000');
        await page.fill('.save-sides input >> nth=1', '300');
        await page.check('#option-transparent');
        await page.fill('#option-dpi', '300');
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-now')]);
        const bytes = await readFile(String(await download.path()));
        // Width, height, and the colour type for RGB with alpha.
        assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20), bytes[25]], [5000, 300, 6]);
        assert.ok(bytes.includes('pHYs') && bytes.includes('F[+F]F[-F]F'));
    }));

test('limits and mistakes are told in the dialog, with hints', () =>
    withPage({ hash: WEED.replace('n=4', 'n=30') }, async (page) => {
        await open(page);
        // What works is taken, with the reason; what cannot work says so when it is chosen.
        await until(() => page.isChecked('[name=save-format][value=png]'), 'a picture of pixels is taken');
        assert.match(await page.innerText('#save-advice'), /SVG would be too large/);
        await choose(page, 'svg');
        await page.waitForSelector('#save-problems .error');
        assert.match(await page.innerText('#save-problems'), /segments/);
        assert.match(await page.innerText('#save-advice'), /PNG holds every drawing/);
        // The compact form has no such limit here.
        await choose(page, 'svg-compact');
        await until(async () => /kB$/.test(await size(page)), 'it is made');
        assert.equal(await page.locator('#save-problems .error').count(), 0);
        await page.click('#close-save');
        await page.click('#tab-rules');
        await page.fill('#rules', 'F = FF');
        await open(page);
        await choose(page, 'data');
        await page.waitForSelector('#save-problems .problem-hint');
        assert.match(await page.innerText('#save-problems'), /->/);
    }));

test('a large file shows its progress, and can be stopped', () =>
    withPage({ hash: WEED.replace('n=4', 'n=9') }, async (page) => {
        await open(page);
        await choose(page, 'data');
        await choose(page, 'csv');
        await until(async () => /^More than/.test(await size(page)), 'the file is too large for the background');
        await page.click('#save-now');
        await page.waitForSelector('#save-bar:visible');
        await until(async () => /so far$/.test(await size(page)), 'progress is told');
        await page.click('#save-stop');
        await page.waitForSelector('#save-now:enabled');
        assert.equal(await size(page), 'Cancelled');
        // The page draws meanwhile, and the dialog closes.
        await page.keyboard.press('Escape');
        await page.waitForSelector('#save-dialog', { state: 'hidden' });
        const before = await stillPicture(page);
        await page.click('#tab-rules');
        await page.fill('#axiom', 'F+F');
        await nextPicture(page, before);
    }));

test('the dialog is used with the keyboard alone', () =>
    withPage({ hash: WEED }, async (page) => {
        await page.keyboard.press('Control+s');
        await page.waitForSelector('#save-dialog[open]');
        assert.equal(await page.evaluate(() => document.activeElement?.getAttribute('value')), 'screen');
        for (let steps = 0; steps < 10 && !(await page.isChecked('[name=save-purpose][value=data]')); steps++)
            await page.keyboard.press('ArrowRight');
        await page.keyboard.press('Tab');
        await page.keyboard.press('ArrowDown');
        assert.ok(await page.isChecked('[name=save-format][value=txt]'));
        await until(async () => (await page.locator('#save-preview pre').count()) === 1, 'the text is shown');
        await page.focus('#save-now');
        const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Enter')]);
        assert.equal(download.suggestedFilename(), 'Weed_n4.txt');
        await page.keyboard.press('Control+s');
        await page.waitForSelector('#save-dialog[open]');
        await page.keyboard.press('Escape');
        await page.waitForSelector('#save-dialog', { state: 'hidden' });
        assert.equal(
            await page.evaluate(
                () => document.querySelectorAll('#save-dialog input:not([id]):not([name]):not([aria-label])').length,
            ),
            0,
        );
    }));

test('on a phone the dialog fills the screen and nothing is cut', () =>
    withPage({ hash: WEED, options: PHONE }, async (page) => {
        await page.tap('#tab-save');
        await page.tap('#open-save');
        await page.waitForSelector('#save-preview img');
        for (const value of ['png', 'data', 'mesh', 'sound']) await page.tap(`.save-tile:has([value=${value}])`);
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
        const wide = await page.evaluate(
            () =>
                [...document.querySelectorAll('#save-dialog *')].filter(
                    (element) => element.getBoundingClientRect().right > 391,
                ).length,
        );
        assert.equal(wide, 0);
        const button = await page.locator('#save-now').boundingBox();
        assert.ok(button && button.y + button.height <= 844 && button.height >= 30);
    }));

test('works where the browser stores nothing', () =>
    withPage(
        {
            hash: WEED,
            before: (page) =>
                page.addInitScript(() =>
                    Object.defineProperty(window, 'localStorage', {
                        get: () => {
                            throw new Error('refused');
                        },
                    }),
                ),
        },
        async (page) => {
            await page.click('#tab-save');
            assert.equal((await saveFile(page, 'json')).suggestedFilename(), 'Weed_n4.json');
            // The choices hold for this visit.
            await page.click('#open-save');
            assert.ok(await page.isChecked('[name=save-format][value=json]'));
        },
    ));

/** The part of the pixels in which a saved PNG differs from the picture on the page. @param {import('playwright-core').Page} page */
async function difference(page) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('[data-save=png]')]);
    const bytes = [...(await readFile(String(await download.path())))];
    return page.evaluate(async (file) => {
        const shown = /** @type {HTMLCanvasElement} */ (document.querySelector('#drawing'));
        const saved = await createImageBitmap(new Blob([new Uint8Array(file)], { type: 'image/png' }));
        const [a, b] = [shown, saved].map((source) => {
            const context = /** @type {OffscreenCanvasRenderingContext2D} */ (
                new OffscreenCanvas(source.width, source.height).getContext('2d')
            );
            context.drawImage(source, 0, 0);
            return new Uint32Array(context.getImageData(0, 0, source.width, source.height).data.buffer);
        });
        return a && b && a.length === b.length ? a.filter((pixel, at) => pixel !== b[at]).length / a.length : 1;
    }, bytes);
}

test('a PNG shows what the page shows: the place, the segments played so far, and the camera', () =>
    withPage({ hash: WEED }, async (page) => {
        await page.click('#tab-save');
        let before = await stillPicture(page);
        assert.equal(await difference(page), 0);
        await page.mouse.move(700, 300);
        await page.mouse.wheel(0, -400);
        before = await nextPicture(page, before);
        assert.equal(await difference(page), 0);
        await page.click('#open-playback');
        await page.fill('#play-place', '100');
        await page.press('#play-place', 'Enter');
        before = await nextPicture(page, before);
        assert.equal(await difference(page), 0);
        await page.click('#tab-rules');
        await page.fill('#rules', 'F -> F[&F]F[-F]F');
        await nextPicture(page, before);
        await page.focus('#drawing');
        await page.keyboard.press('ArrowLeft');
        await stillPicture(page);
        await page.click('#tab-save');
        // In space a file is made with more work than the picture on the screen.
        const differ = await difference(page);
        assert.ok(differ < 0.02, `${differ}`);
    }));

test('additive ink is saved as pixels unless strokes are asked for', () =>
    withPage({ hash: `${WEED}&ink=density` }, async (page) => {
        await open(page);
        assert.ok(await page.isChecked('[name=save-format][value=png]'));
        assert.match(await page.innerText('#save-advice'), /glow/);
        await choose(page, 'svg');
        assert.equal(await page.innerText('#save-advice'), '');
        await page.click('#save-cancel');
        await page.click('#open-save');
        assert.ok(await page.isChecked('[name=save-format][value=png]'));
    }));

test('the dialog keeps its place and its size while its choices change', () =>
    withPage({ hash: WEED, options: { viewport: { width: 1280, height: 800 } } }, async (page) => {
        await open(page);
        await stillDialog(page);
        const first = await page.locator('#save-dialog').boundingBox();
        for (const purpose of ['plotter', 'paper', 'print', 'mesh', 'sound', 'data', 'screen']) {
            await choose(page, purpose);
            assert.deepEqual(await page.locator('#save-dialog').boundingBox(), first, purpose);
        }
    }));

/** Waits for the end of the dialog's movement. @param {import('playwright-core').Page} page */
const stillDialog = (page) =>
    page.evaluate(() =>
        Promise.all((document.querySelector('#save-dialog')?.getAnimations() ?? []).map(({ finished }) => finished)),
    );

test('a poster has the pixels of its sheet, and a picture for the screen keeps its own', () =>
    withPage({ hash: WEED }, async (page) => {
        await open(page);
        await choose(page, 'print');
        await page.selectOption('#poster-sheet', 'a4');
        await page.selectOption('#poster-orientation', 'landscape');
        await page.selectOption('#poster-dpi', '150');
        await until(async () => (await size(page)) === '1754 × 1240 pixels', 'the pixels are told');
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-now')]);
        const bytes = await readFile(String(await download.path()));
        assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [1754, 1240]);
        // 150 pixels per inch are 5906 per metre.
        assert.equal(bytes.readUInt32BE(bytes.indexOf('pHYs') + 4), 5906);
        await open(page);
        assert.equal(await page.inputValue('#poster-orientation'), 'landscape');
        await choose(page, 'screen');
        await choose(page, 'png');
        assert.equal(await page.inputValue('#option-size'), '');
    }));

test('a sheet is upright or on its side, and a plot is shown with the lines of its pen', () =>
    withPage({ hash: WEED }, async (page) => {
        await open(page);
        await choose(page, 'plotter');
        await page.waitForSelector('#save-preview.sheet > img');
        const shape = () =>
            page.evaluate(() => {
                const image = /** @type {HTMLImageElement | null} */ (document.querySelector('#save-preview > img'));
                return image ? image.naturalWidth / image.naturalHeight : 0;
            });
        await page.selectOption('#option-orientation', 'landscape');
        await until(async () => (await shape()) > 1.3, 'the sheet lies on its side');
        await page.selectOption('#option-orientation', 'portrait');
        await until(async () => (await shape()) < 0.8 && (await shape()) > 0, 'the sheet is upright');
        await choose(page, 'paper');
        assert.deepEqual(await page.locator('#option-orientation option').allInnerTexts(), ['Portrait', 'Landscape']);
    }));
