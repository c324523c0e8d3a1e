/** The sheet of controls on phones: folded or not, and with the keyboard of the phone. */

import assert from 'node:assert/strict';
import test, { after } from 'node:test';
import { sampled, some } from '../effort.mjs';
import { PHONE, close, nextPicture, onPixels, stillPicture, until, withPage } from './browser.mjs';

after(close);

/** Phones, tablets, laptops. @type {[number, number][]} */
const SIZES = [
    [360, 640],
    [360, 740],
    [375, 667],
    [390, 664],
    [390, 844],
    [412, 915],
    [844, 390],
    [768, 1024],
    [1280, 657],
    [1920, 1080],
];

/** The controls of the page that are whole on the screen, outside of the scrolled sections. @param {import('playwright-core').Page} page */
const onScreen = (page) =>
    page.evaluate(() =>
        [...document.querySelectorAll('#panel :is(button, a):not(#sections *)')]
            .filter((control) => {
                const { left, right, top, bottom } = control.getBoundingClientRect();
                const whole = left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight + 0.5;
                const hit = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
                return right > left && whole && control.contains(hit);
            })
            .map(({ id }) => id),
    );

for (const [width, height] of sampled(SIZES, 3))
    test(`the selected tab folds the controls, and no control leaves the screen: ${width} x ${height}`, () =>
        withPage({ options: { ...PHONE, viewport: { width, height } } }, async (page) => {
            const before = await onScreen(page);
            for (const name of ['rules', 'turtle', 'look', 'save']) assert.ok(before.includes(`tab-${name}`), name);
            await page.tap('#tab-rules');
            assert.deepEqual(await onScreen(page), before);
            const narrow = width < 768;
            assert.equal(await page.isVisible('#axiom'), !narrow);
            if (!narrow) return;
            assert.equal(await page.getAttribute('#fold', 'aria-expanded'), 'false');
            await page.tap('#fold');
            assert.ok(await page.isVisible('#axiom'));
            assert.deepEqual(await onScreen(page), before);
        }));

test('on a phone the dials and the first rule are in sight', () =>
    withPage({ options: PHONE }, async (page) => {
        for (const id of ['iterations', 'iterations-slider', 'angle', 'angle-slider', 'axiom', 'rules']) {
            const seen = await page.evaluate((name) => {
                const { left, right, top } = /** @type {Element} */ (
                    document.getElementById(name)
                ).getBoundingClientRect();
                return document.elementFromPoint((left + right) / 2, top + 16)?.id;
            }, id);
            assert.equal(seen, id);
        }
    }));

/** A system whose iterations have no limit below that of the field. */
const ANY = '#v=1&axiom=F&rules=F-%3EFF&n=5&angle=90';

test('the slider of iterations reaches twice their number, and further when it is let go at its end', () =>
    withPage({ hash: ANY }, async (page) => {
        const slider = page.locator('#iterations-slider');
        const reach = () => slider.getAttribute('max');
        const { x, y, width, height } = (await slider.boundingBox()) ?? assert.fail('no slider');
        const to = (/** @type {number} */ part) => page.mouse.move(x + width * part, y + height / 2, { steps: 4 });
        assert.equal(await reach(), '10');
        await to(0.5);
        await page.mouse.down();
        await to(1);
        assert.deepEqual([await page.inputValue('#iterations'), await reach()], ['10', '10']);
        await page.mouse.up();
        assert.equal(await reach(), '20');
        await to(0.5);
        await page.mouse.down();
        await to(0.1);
        assert.deepEqual([await page.inputValue('#iterations'), await reach()], ['1', '20']);
        await page.mouse.up();
        assert.equal(await reach(), '20', 'the thumb stays where it was let go');
        await page.fill('#iterations', '30');
        assert.ok(Number(await reach()) > 30, 'the slider reaches beyond typed numbers');
        // The last stop of all.
        for (let times = 0; times < 8; times++) await slider.press('End');
        assert.equal(await page.inputValue('#iterations'), '1000');
    }));

test('on a phone iterations and angle are counted up and down by buttons', () =>
    withPage({ hash: ANY, options: PHONE }, async (page) => {
        for (const name of ['Iterations −', 'Iterations +', 'Iterations +', 'Angle −'])
            await page.getByRole('button', { name, exact: true }).tap();
        assert.deepEqual([await page.inputValue('#iterations'), await page.inputValue('#angle')], ['6', '89']);
        // A thumb covers three stops at most.
        const width = await page.evaluate(() => document.getElementById('iterations-slider')?.clientWidth ?? 0);
        assert.ok((width / 10) * 3 > 30, `${width} px for 10 iterations`);
    }));

test('where a mouse points, no such button is shown', () =>
    withPage({ hash: ANY }, async (page) => assert.equal(await page.locator('.step:visible').count(), 0)));

for (const [width, height] of some(
    /** @type {[number, number][]} */ ([
        [360, 360],
        [390, 480],
    ]),
))
    test(`the field that is typed into is in sight above a phone's keyboard: ${width} x ${height}`, () =>
        withPage({ options: PHONE }, async (page) => {
            for (const id of ['rules', 'axiom', 'angle']) {
                await page.tap(`#${id}`);
                await page.setViewportSize({ width, height });
                await until(
                    () =>
                        page.evaluate((name) => {
                            const field = /** @type {Element} */ (document.getElementById(name));
                            const { left, right, top, bottom } = field.getBoundingClientRect();
                            const at = (/** @type {number} */ y) =>
                                document.elementFromPoint((left + right) / 2, y) === field;
                            return top >= 0 && bottom <= innerHeight && at(top + 4) && at(bottom - 4);
                        }, id),
                    `${id} is whole on the screen`,
                );
                assert.ok(!(await page.isVisible('#open-gallery')), 'the header makes room');
                assert.ok(!(await page.isVisible('#tab-look')));
                await page.evaluate(() => /** @type {HTMLElement} */ (document.activeElement).blur());
                await page.setViewportSize(PHONE.viewport);
                assert.ok(await page.isVisible('#tab-look'));
            }
        }));

test('fingers tap, and mice point', () =>
    withPage({ options: PHONE }, async (page) => {
        assert.match((await page.textContent('#symbol-note')) ?? '', /^Tap a symbol/);
        await page.tap('#share');
        await until(async () => /Tap it to enlarge/.test((await page.textContent('#qr-note')) ?? ''), 'the words');
    }));

for (const [width, height] of sampled(SIZES, 3, 1))
    test(`a fitted drawing lies beside the tools: ${width} x ${height}`, () =>
        withPage({ options: { ...PHONE, viewport: { width, height } } }, async (page) => {
            for (const axiom of ['F', 'F+F+F+F']) {
                if (axiom !== 'F') {
                    const before = await stillPicture(page);
                    await page.fill('#axiom', axiom);
                    await page.fill('#angle', '90');
                    await page.fill('#rules', 'F -> F+F-F-FF+F+F-F');
                    await page.fill('#iterations', '3');
                    await page.evaluate(() => /** @type {HTMLElement} */ (document.activeElement).blur());
                    await nextPicture(page, before);
                    await until(async () => /2,048/.test((await page.textContent('#segments')) ?? ''), 'it is drawn');
                }
                await stillPicture(page);
                const boxes = await page.evaluate(() => {
                    const stage = /** @type {Element} */ (document.querySelector('#stage')).getBoundingClientRect();
                    return [...document.querySelectorAll('#stage .tools:not([hidden])')]
                        .filter((bar) => getComputedStyle(bar).visibility === 'visible')
                        .map((bar) => bar.getBoundingClientRect())
                        .map(({ left, top, right, bottom }) => [
                            (left - stage.left) / stage.width,
                            (top - stage.top) / stage.height,
                            (right - stage.left) / stage.width,
                            (bottom - stage.top) / stage.height,
                        ]);
                });
                assert.ok(boxes.length >= 1);
                const covered = await onPixels(
                    page,
                    ({ words, width: wide, height: high }, known) => {
                        let ink = 0;
                        for (const [left = 0, top = 0, right = 0, bottom = 0] of known)
                            for (let y = Math.ceil(top * high); y < Math.min(high, bottom * high); y++)
                                for (let x = Math.ceil(left * wide); x < Math.min(wide, right * wide); x++)
                                    if (words[y * wide + x] !== words[0]) ink += 1;
                        return ink;
                    },
                    boxes,
                );
                assert.equal(covered, 0, axiom);
            }
        }));
