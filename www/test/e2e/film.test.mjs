/** Films: the dialog, files, and films in other pages. */

import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { ADDRESS, DESKTOP, PHONE, close, until, withPage } from './browser.mjs';

after(close);

const WEED = '#v=1&axiom=X&rules=X%20-%3E%20F-%5B%5BX%5D+X%5D+F%5B+FX%5D-X%0AF%20-%3E%20FF&n=4&angle=22.5';
const SPIRE = '#v=1&axiom=X&rules=X%20-%3E%20F%26%5BX%5D/%5BX%5D%0AF%20-%3E%20FF&n=4&angle=30';
const SHORT = '1;1s;5fps;64x48;repeat;n=0:0,0.8:4';

/** @typedef {import('playwright-core').Page} Page */

/** @param {Page} page */
async function open(page) {
    await page.click('#tab-save');
    await page.click('#open-film');
    await page.waitForSelector('#film-picture[data-frame]');
}

/** @param {Page} page */
const text = (page) => page.inputValue('#film-text');
/** Writes the film's text. @param {Page} page @param {string} film */
async function write(page, film) {
    if (!(await page.isVisible('#film-text'))) await page.click('.film-raw summary');
    await page.fill('#film-text', film);
    await page.press('#film-text', 'Enter');
}

/** Saves the film. @param {Page} page @param {string} kind */
async function saved(page, kind) {
    const [file] = await Promise.all([page.waitForEvent('download'), page.click(`[data-film="${kind}"]`)]);
    if (process.env.FILM_KEEP) await file.saveAs(`${process.env.FILM_KEEP}/${file.suggestedFilename()}`);
    return readFile(await file.path());
}

for (const [name, options] of some(
    /** @type {const} */ ([
        ['a phone', PHONE],
        ['a desktop', DESKTOP],
    ]),
)) {
    test(`a film grows, and its tracks are edited, on ${name}`, () =>
        withPage({ hash: WEED, options: { ...options, reducedMotion: 'no-preference' } }, async (page) => {
            await open(page);
            assert.equal(await text(page), '1;8s;25fps;1280x720;repeat;fixed;n=0:0,7.2:4');
            await until(
                async () => Number(await page.getAttribute('#film-picture', 'data-frame')) > 5,
                'the film plays',
            );
            // The place of a dive does not depend on the frame that plays meanwhile.
            const dived = async () => {
                await page.click('[data-preset="dive"]');
                await until(async () => (await text(page)).includes('view=0.4:0/0/1~smooth,7.2:'), 'the dive');
                return text(page);
            };
            const first = await dived();
            await page.click('[data-preset="growth"]');
            await until(async () => (await text(page)).endsWith('fixed;n=0:0,7.2:4'), 'growth');
            await page.check('#film-follow');
            await until(async () => (await text(page)).endsWith('repeat;n=0:0,7.2:4'), 'the camera follows');
            assert.equal(await dived(), first);
            await page.click('#film-play');
            await page.selectOption('#film-add', 'angle');
            await until(async () => (await text(page)).endsWith(';angle=0:22.5,8:22.5'), 'the track');
            await page.locator('[data-subject="angle"] .film-dot').nth(1).click();
            await page.fill('.film-value', '30');
            await page.press('.film-value', 'Enter');
            await until(async () => (await text(page)).endsWith(';angle=0:22.5,8:30'), 'the value');
            await page.locator('[data-subject="angle"] .film-dot').nth(1).press('ArrowLeft');
            await until(async () => (await text(page)).endsWith(';angle=0:22.5,7.9:30'), 'the time');
            await page.fill('#film-seconds', '4');
            await page.press('#film-seconds', 'Enter');
            await until(async () => (await text(page)).endsWith(';angle=0:22.5,3.95:30'), 'the length');
            assert.ok(await page.isDisabled('[data-preset="turntable"]'));
            await write(page, '1;angle=0:x');
            await until(
                async () => (await page.textContent('#film-problem')) === 'film, `x`: expected a number',
                'the problem',
            );
            await page.keyboard.press('Escape');
            assert.ok(!(await page.isVisible('#film-dialog')));
        }));
}

test('a film is saved as GIF, and as video where the browser can', () =>
    withPage({ hash: WEED }, async (page) => {
        await open(page);
        await write(page, SHORT);
        await until(async () => (await page.getAttribute('#film-at', 'max')) === '4', 'the film');
        const gif = await saved(page, 'gif');
        assert.equal(gif.subarray(0, 6).toString('latin1'), 'GIF89a');
        assert.deepEqual([gif.readUInt16LE(6), gif.readUInt16LE(8), gif.at(-1)], [64, 48, 0x3b]);
        // The browser's own decoder finds all frames and times.
        const found = await page.evaluate(
            async (bytes) => {
                const Decoder = /** @type {any} */ (globalThis).ImageDecoder;
                const decoder = new Decoder({ data: new Uint8Array(bytes), type: 'image/gif' });
                await Promise.all([decoder.completed, decoder.tracks.ready]);
                const frames = [];
                for (let frameIndex = 0; frameIndex < decoder.tracks.selectedTrack.frameCount; frameIndex++)
                    frames.push((await decoder.decode({ frameIndex })).image.duration);
                return { frames, repeats: decoder.tracks.selectedTrack.repetitionCount };
            },
            [...gif],
        );
        assert.deepEqual(found, { frames: Array(5).fill(200_000), repeats: Infinity });
        if (process.env.FILM_KEEP) await writeFile(`${process.env.FILM_KEEP}/small.gif`, gif);
        for (const kind of ['webm', 'mp4']) {
            if (!(await page.isVisible(`[data-film="${kind}"]`))) continue;
            const video = await saved(page, kind);
            assert.ok(
                kind === 'webm'
                    ? video.readUInt32BE(0) === 0x1a45dfa3
                    : video.subarray(4, 8).toString('latin1') === 'ftyp',
                kind,
            );
        }
    }));

test('saving is cancelled, and the page goes on', () =>
    withPage({ hash: WEED }, async (page) => {
        await open(page);
        await write(page, '1;60s;60fps;1280x720;n=0:0,60:8');
        await until(async () => (await page.getAttribute('#film-at', 'max')) === '3599', 'the film');
        await page.click('[data-film="gif"]');
        await page.waitForSelector('.film-progress:not(.idle)');
        await page.click('#film-cancel');
        await page.waitForSelector('.film-progress', { state: 'hidden' });
        await write(page, SHORT);
        await until(async () => (await page.getAttribute('#film-at', 'max')) === '4', 'another film');
        assert.equal((await saved(page, 'gif')).subarray(0, 6).toString('latin1'), 'GIF89a');
    }));

test('drawings in space turn', () =>
    withPage({ hash: SPIRE }, async (page) => {
        await open(page);
        await page.click('[data-preset="turntable"]');
        // The turn begins at the azimuth that was chosen for the drawing.
        const turn = async () =>
            /camera=0:(-?[\d.]+),8:([\d.]+)$/
                .exec(await text(page))
                ?.slice(1)
                .map(Number);
        const [from = NaN, to = NaN] = await until(turn, 'the turn');
        assert.equal(to - from, 360);
        assert.equal(await page.textContent('#film-problem'), '');
    }));

test('a film plays in a page of its own, and opens in the playground', () =>
    withPage(
        { address: ADDRESS, hash: `film.html${WEED}&film=${SHORT}`, drawing: '#film-picture[data-frame]' },
        async (page) => {
            assert.deepEqual(
                await page
                    .locator('#film-picture')
                    .evaluate((canvas) => [canvas.getAttribute('width'), canvas.getAttribute('height')]),
                ['64', '48'],
            );
            await page.focus('#film-play');
            await page.keyboard.press('Enter');
            await until(
                async () => Number(await page.getAttribute('#film-picture', 'data-frame')) > 1,
                'the film plays',
            );
            await page.goto(
                String(
                    await page.locator('#film-open').evaluate((link) => /** @type {HTMLAnchorElement} */ (link).href),
                ),
            );
            await page.waitForSelector('#film-dialog #film-picture[data-frame]');
            assert.equal(await text(page), SHORT);
        },
    ));

test('the dialog has one size, and says why a drawing in the plane has no turntable', () =>
    withPage({ hash: WEED }, async (page) => {
        await open(page);
        assert.ok(await page.isDisabled('[data-preset=turntable]'));
        assert.match(await page.innerText('#film-options'), /A turntable needs a drawing in space/);
        assert.ok(!(await page.isVisible('#film-text')), 'the raw text is folded');
        const first = await page.locator('#film-dialog').boundingBox();
        await write(page, SHORT);
        const [saved] = await Promise.all([page.waitForEvent('download'), page.click('[data-film=gif]')]);
        assert.match(saved.suggestedFilename(), /gif$/);
        await page.waitForSelector('#film-dialog .toast.shown');
        assert.match(await page.innerText('#toast'), /^Saved/);
        assert.deepEqual(await page.locator('#film-dialog').boundingBox(), first);
        await page.keyboard.press('Escape');
        await page.waitForSelector('#stage .toast', { state: 'attached' });
    }));

test('the best kind of film that the browser writes is the first', () =>
    withPage({ hash: WEED }, async (page) => {
        await open(page);
        await page.waitForSelector('[data-film].primary');
        const kinds = await page
            .locator('[data-film]:visible')
            .evaluateAll((all) => all.map((each) => [each.getAttribute('data-film'), each.className]));
        assert.match(String(kinds[0]?.[1]), /primary/);
        assert.equal(kinds.at(-1)?.[0], 'gif');
        assert.equal(kinds.filter(([, name]) => /primary/.test(String(name))).length, 1);
    }));
