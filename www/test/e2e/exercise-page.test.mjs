/** The page of an exercise: on phones, in frames, on paper, and the way to the next one. */

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import test, { after } from 'node:test';
import { sampled } from '../effort.mjs';
import { ADDRESS, PHONE, close, until, withPage } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('playwright-core').Frame} Frame */

after(close);

/** @type {{id: string, shelf: string, title: string, x: string}[]} */
const EXERCISES = JSON.parse(await readFile(new URL('../../../dist/exercises.json', import.meta.url), 'utf8'));
const GALLERY = EXERCISES.filter(({ shelf }) => !['lesson', 'program'].includes(shelf));
/** @param {string} id */
const linkOf = (id) => `exercise.html#v=1&x=${EXERCISES.find((exercise) => exercise.id === id)?.x ?? assert.fail(id)}`;

/** The boxes of elements in their window, and the window's height. @param {Page | Frame} page @param {string[]} ids */
const boxes = (page, ...ids) =>
    page.evaluate(
        (names) => ({
            window: innerHeight,
            boxes: names.map((name) => {
                const box = /** @type {Element} */ (document.getElementById(name)).getBoundingClientRect();
                return { left: box.left, right: box.right, top: box.top, bottom: box.bottom };
            }),
        }),
        ids,
    );

/** @param {Page | Frame} page @param {number} [low] the height of the lowest part of the window that is covered */
async function areInSightTogether(page, low = 0) {
    const {
        window,
        boxes: [target, own, rules],
    } = await boxes(page, 'target', 'stage', 'rules');
    assert.ok(target && own && rules);
    assert.ok(target.top >= 0 && rules.bottom <= window - low, JSON.stringify({ target, rules, window }));
    assert.ok(target.top === own.top && target.right <= own.left + 0.5, 'both pictures stand side by side');
    assert.ok(target.bottom - target.top >= 119, 'the pictures are not too small');
}

for (const id of sampled(
    GALLERY.map((exercise) => exercise.id).filter((id) => !['algae', 'signal'].includes(id)),
    5,
))
    test(`on a phone target and rules are in sight together: ${id}`, () =>
        withPage({ address: ADDRESS, hash: linkOf(id), options: PHONE, drawing: '#mark:visible' }, areInSightTogether));

test('on a phone there are keys for symbols while rules are typed', () =>
    withPage({ address: ADDRESS, hash: linkOf('koch'), options: PHONE }, async (page) => {
        assert.equal(await page.isVisible('#symbol-keys'), false);
        await page.tap('#rules');
        await page.waitForSelector('#symbol-keys:visible');
        for (const key of ['F', 'Arrow', 'F', '[', '+', 'F', ']']) await page.tap(`#symbol-keys [aria-label="${key}"]`);
        assert.equal(await page.inputValue('#rules'), 'F -> F[+F]');
        await areInSightTogether(page, (await page.locator('#symbol-keys').boundingBox())?.height);
    }));

test('the choice of what is shown stands free below both pictures on a phone', () =>
    withPage(
        { address: ADDRESS, hash: linkOf('koch'), options: { ...PHONE, viewport: { width: 320, height: 640 } } },
        async (page) => {
            for (const name of ['differences', 'blink', 'target']) {
                await page.tap(`label:has(#show-${name})`);
                assert.ok(await page.isChecked(`#show-${name}`));
            }
            assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
        },
    ));

test('the code of an exercise shows its field in a frame on a phone, and grows by itself', () =>
    withPage({ hash: '#v=1&title=Weed&axiom=X&rules=X%20-%3E%20F%5B%2BX%5D-X&n=4&angle=25' }, async (page) => {
        await page.click('#tab-save');
        await page.click('#make-exercise');
        await page.waitForSelector('#maker-made:visible');
        const code = await page.inputValue('#maker-code');
        assert.match(code, /^<script src="[^"]+l-system\.js" defer><\/script>\n<l-system link="#v=1&amp;x=/);
        await page.check('#maker-frame');
        await until(
            async () => /^<iframe src="[^"]*exercise\.html#v=1&amp;x=/.test(await page.inputValue('#maker-code')),
            'the other code',
        );
        const frame = await page.inputValue('#maker-code');
        for (const [name, body] of [
            ['element', code],
            ['frame', frame],
        ]) {
            await page.setViewportSize({ width: 390, height: 640 });
            await page.route(`${ADDRESS}host-${name}`, (route) =>
                route.fulfill({
                    contentType: 'text/html',
                    body: `<!doctype html><html lang="en"><title>Host</title><body style="margin:0">${body}</body></html>`,
                }),
            );
            await page.goto(`${ADDRESS}host-${name}`);
            const inner = await until(() => page.frames().find((one) => /exercise\.html/.test(one.url())), 'the frame');
            await inner.waitForSelector('#mark:visible');
            const sight = async () => {
                const offset = (await (await inner.frameElement()).boundingBox()) ?? assert.fail();
                const { boxes: found } = await boxes(inner, 'target', 'rules');
                return offset.y + (found[0]?.top ?? -1) >= 0 && offset.y + (found[1]?.bottom ?? 999) <= 640;
            };
            await until(sight, `${name}: target and rules are in sight`);
            if (name === 'frame') continue;
            await until(
                () => inner.evaluate(() => document.documentElement.scrollHeight <= innerHeight),
                'nothing of it is hidden',
            );
        }
    }));

test('embedded controls leave most of a phone to the picture', () =>
    withPage(
        {
            address: ADDRESS,
            hash: 'embed.html#v=1&axiom=F&rules=F%20-%3E%20F%5B%2BF%5DF&n=4&angle=25&controls=n,angle,rules,string,play',
            options: { viewport: { width: 390, height: 480 } },
        },
        async (page) => {
            const part = async () => ((await page.locator('#stage').boundingBox())?.height ?? 0) / 480;
            assert.ok((await part()) >= 0.55, `${await part()}`);
            await page.click('#open-playback');
            await page.waitForSelector('#playback:visible');
            assert.ok((await part()) >= 0.55, `${await part()}`);
            // All controls are reached.
            await page.locator('#rules').scrollIntoViewIfNeeded();
            const box = (await page.locator('#rules').boundingBox()) ?? assert.fail();
            assert.ok(box.y >= 0.55 * 480 - 1 && box.y < 480);
        },
    ));

test('a solved exercise of the gallery leads to the next, the easiest first', () =>
    withPage({ address: ADDRESS, hash: linkOf('algae'), drawing: '#mark:visible' }, async (page) => {
        assert.equal(await page.isVisible('#next-exercise'), false);
        await page.fill('#rules', 'B -> A\nA -> AB');
        await page.waitForSelector('#next-exercise:visible');
        assert.equal(await page.getAttribute('#next-exercise', 'title'), 'Koch snowflake');
        await page.click('#next-exercise');
        await until(async () => (await page.textContent('#exercise-title')) === 'Koch snowflake', 'the next one');
        assert.equal(await page.isVisible('#next-exercise'), false);
    }));

test('the gallery shows exercises in the order in which they are done', () =>
    withPage({}, async (page) => {
        await page.click('#open-gallery');
        const cards = page.locator('.shelf:has(a[href^="exercise.html"]) .card-kind');
        await cards.first().waitFor();
        const kinds = await cards.allTextContents();
        assert.deepEqual([...new Set(kinds)], ['Rising difficulty', 'From the assignment', 'Program']);
    }));

/**
 * Runs a function in the page on the pixels of a part of the page as printed.
 * @template T
 * @param {Page} page
 * @param {string} selector
 * @param {(pixels: ImageData) => T} read uses nothing from outside
 * @returns {Promise<T>}
 */
async function onPrint(page, selector, read) {
    const clip = (await page.locator(selector).boundingBox()) ?? assert.fail(selector);
    const png = (await page.screenshot({ clip })).toString('base64');
    return page.evaluate(`(async () => (${read})(await (${decoded})('${png}')))()`);
}

/** Runs in the page. @param {string} png in base64 */
async function decoded(png) {
    const image = new Image();
    image.src = `data:image/png;base64,${png}`;
    await image.decode();
    const copy = new OffscreenCanvas(image.width, image.height);
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (copy.getContext('2d'));
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, image.width, image.height);
}

test('a printed target keeps its shape', () =>
    withPage(
        { address: ADDRESS, hash: linkOf('weed'), options: { viewport: { width: 1280, height: 657 } } },
        async (page) => {
            await page.emulateMedia({ media: 'print' });
            const blue = await until(async () => {
                // On paper the picture has other sides than on the screen, where it was made.
                await page.evaluate(() => {
                    const canvas = /** @type {HTMLCanvasElement} */ (document.querySelector('#target-picture'));
                    [canvas.width, canvas.height] = [400, 150];
                    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
                    context.fillStyle = '#00f';
                    context.fillRect(150, 25, 100, 100);
                });
                const found = await onPrint(page, '#target', ({ data, width, height }) => {
                    const is = (/** @type {number} */ x, /** @type {number} */ y) =>
                        Number((data[4 * (y * width + x)] ?? 0) < 99 && (data[4 * (y * width + x) + 2] ?? 0) > 200);
                    const count = (/** @type {number} */ to, /** @type {(at: number) => number} */ each) =>
                        Array.from({ length: to }, (_, at) => each(at)).reduce((sum, one) => sum + one, 0);
                    return {
                        across: count(width, (x) => is(x, Math.floor(height / 2))),
                        down: count(height, (y) => is(Math.floor(width / 2), y)),
                    };
                });
                return found.across > 0 ? found : null;
            }, 'the square is printed');
            assert.ok(Math.abs(blue.across - blue.down) <= 3, JSON.stringify(blue));
        },
    ));

test('dark exercises are printed on light paper', () =>
    withPage({ address: ADDRESS, hash: linkOf('koch') }, async (page) => {
        await page.fill('#rules', 'F -> FF');
        await page.waitForSelector('#stage.on-dark');
        await page.emulateMedia({ media: 'print' });
        for (const name of ['#target', '#stage']) {
            const darkest = await onPrint(page, name, ({ data, width }) =>
                Math.min(...data.slice(4 * (8 * width + 8), 4 * (8 * width + 12))),
            );
            assert.ok(darkest > 200, `${name}: ${darkest}`);
        }
    }));

test('a printed sheet has a place for name, date and answer', () =>
    withPage({ address: ADDRESS, hash: linkOf('weed') }, async (page) => {
        for (const name of ['.print-lines', '.print-date']) assert.equal(await page.isVisible(name), false);
        await page.emulateMedia({ media: 'print' });
        const shown = async () =>
            Promise.all(
                ['.print-lines', '.print-date', '#student-name', '#stage', '#mark', '#next-exercise', '#hand-in'].map(
                    (name) => page.isVisible(name),
                ),
            );
        assert.deepEqual(await shown(), [true, true, true, false, false, false, false]);
        await page.emulateMedia({ media: 'screen' });
        await page.fill('#rules', 'F -> FF');
        await page.emulateMedia({ media: 'print' });
        assert.deepEqual(await shown(), [true, true, true, true, true, false, false]);
        await page.emulateMedia({ media: 'screen' });
        await page.fill('#rules', 'F -> F[+F]F[-F]F');
        await page.waitForSelector('#mark.solved');
        await page.emulateMedia({ media: 'print' });
        assert.deepEqual(await shown(), [false, true, true, true, true, false, false]);
        const name = (await page.locator('#student-name').boundingBox())?.y ?? 999;
        assert.ok(name < ((await page.locator('#exercise-title').boundingBox())?.y ?? 0), 'the name stands above');
    }));

test('every task of the lesson is in sight as a whole on a small laptop', () =>
    withPage(
        { address: ADDRESS, hash: 'course.html', drawing: null, options: { viewport: { width: 1280, height: 657 } } },
        async (page) => {
            for (const step of sampled([1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11], 4)) {
                await page.goto(`${ADDRESS}course.html#step-${step}`);
                const task = page.locator('.step.now l-system.task');
                if ((await task.count()) === 0) continue;
                const frame = page.frameLocator('.step.now l-system.task >> iframe');
                await frame.locator('#mark-percent:not(:empty)').waitFor();
                const hidden = await frame.locator('html').evaluate((root) => root.scrollHeight - root.clientHeight);
                const box = await task.boundingBox();
                assert.ok(box && box.y + box.height <= 657 && hidden <= 0, `${step}: ${JSON.stringify(box)} ${hidden}`);
                const scrolled = await page.evaluate(() => document.documentElement.scrollTop);
                assert.equal(scrolled, 0, `${step}`);
            }
        },
    ));

test('every step of the lesson has its field in sight on a phone', () =>
    withPage({ address: ADDRESS, hash: 'course.html', drawing: null, options: PHONE }, async (page) => {
        for (const step of sampled([0, 1, 2, 3, 4, 7, 8, 9, 10, 11, 12], 4, 2)) {
            await page.goto(`${ADDRESS}course.html#step-${step}`);
            const field = page.frameLocator('.step.now l-system >> iframe').locator('#rules');
            await field.waitFor();
            const box = await field.boundingBox();
            const height = page.viewportSize()?.height ?? 0;
            assert.ok(box && box.y + 30 < height, `${step}: ${JSON.stringify(box)} of ${height}`);
        }
    }));

test('the lesson begins with a plant and ends with an own one, which goes to the playground', () =>
    withPage({ address: ADDRESS, hash: 'course.html', drawing: null, also: ADDRESS }, async (page) => {
        const frame = page.frameLocator('.step.now l-system >> iframe');
        await frame.locator('#stage.inked').waitFor();
        assert.match(await frame.locator('#rules').inputValue(), /^X -> F/);
        await page.click('#onward');
        assert.equal(await page.textContent('.step.now h2'), '1. One rule');
        await page.click('.places li:last-child a');
        await frame.locator('#rules').fill('X -> F[+X]F[-X]X\nF -> FF');
        await page.waitForFunction(() => /** @type {any} */ (document.querySelector('.own'))?.state?.includes('X%5DX'));
        const [opened] = await Promise.all([page.waitForEvent('popup'), page.click('#take')]);
        await opened.locator('#stage.inked').waitFor();
        assert.equal(await opened.inputValue('#rules'), 'X -> F[+X]F[-X]X\nF -> FF');
    }));

test('a lesson that was begun when it had no step 0 goes on where it was', () =>
    withPage({ address: ADDRESS, hash: 'course.html', drawing: null }, async (page) => {
        await page.evaluate(() => localStorage.setItem('l-system-lesson', '{"at":3,"done":[0,2]}'));
        await page.goto(`${ADDRESS}course.html`);
        assert.equal(await page.textContent('.step.now h2'), '4. Two letters');
        assert.deepEqual(await page.locator('.places .done').allTextContents(), ['1', '3']);
    }));

test('an exercise that draws nothing yet says which rule to write', () => {
    const x = EXERCISES.find(({ id }) => id === 'twigs')?.x;
    return withPage({ address: `${ADDRESS}exercise.html`, hash: `#v=1&x=${x}`, drawing: null }, async (page) => {
        await page.locator('#empty:visible').waitFor();
        assert.match((await page.textContent('#empty')) ?? '', /^Write a rule for X: /);
    });
});
