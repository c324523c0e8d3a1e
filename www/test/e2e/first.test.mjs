/** The first five minutes: the opening plant, and refusals with their remedies. */

import assert from 'node:assert/strict';
import test, { after } from 'node:test';
import { sampled, some } from '../effort.mjs';
import { DESKTOP, PHONE, close, nextPicture, onPixels, quiet, stillPicture, until, withPage } from './browser.mjs';

after(close);

/** The text of an element. @param {import('playwright-core').Page} page @param {string} selector */
const text = async (page, selector) => (await page.textContent(selector)) ?? '';

for (const [device, options] of some(
    /** @type {const} */ ([
        ['small desktop', { viewport: { width: 1280, height: 657 } }],
        ['phone', PHONE],
        ['desktop', DESKTOP],
    ]),
    2,
)) {
    test(`the page opens with the rule, what it means and a lesson in sight: ${device}`, () =>
        withPage({ options }, async (page) => {
            const { height } = page.viewportSize() ?? { height: 0 };
            for (const part of [
                '#intro',
                '#open-lesson',
                '#axiom',
                '#rules',
                '#tab-rules',
                '#tab-turtle',
                '#tab-look',
                '#tab-save',
                '#share',
                '#quick-favourite',
                '#open-gallery',
            ]) {
                const box = await page.locator(part).boundingBox();
                assert.ok(box && box.y >= 0 && box.y < height - 20, `${part} ${JSON.stringify(box)}`);
            }
            assert.equal(await page.inputValue('#rules'), 'F -> F[+F]F[-F][F]');
            assert.match(await text(page, '#intro'), /replaced at once by its rule/);
            await page.fill('#rules', 'F -> F[+F]F');
            assert.ok(await page.isVisible('#intro'), 'an edit keeps the explanation');
            await page.click('#start-anew');
            assert.ok(!(await page.isVisible('#intro')));
        }));
}

test('every change of one symbol of the opening rule draws something or says why not', () =>
    withPage({}, async (page) => {
        const rule = 'F[+F]F[-F][F]';
        const changed = new Set(['F', '']);
        for (let at = 0; at < rule.length; at++)
            for (const symbol of ['', 'F', '+', '-', '[', ']', 'X', 'f'])
                changed.add(rule.slice(0, at) + symbol + rule.slice(at + 1));
        // All of it runs in the page: the driver's part would take longer than the page's.
        const silent = await page.evaluate(
            async (successors) => {
                const area = /** @type {HTMLTextAreaElement} */ (document.querySelector('#rules'));
                const element = (/** @type {string} */ name) =>
                    /** @type {HTMLElement} */ (document.querySelector(name));
                const says = () =>
                    document.querySelectorAll('#rules-problems li').length > 0 ||
                    !element('#empty').hidden ||
                    /, [1-9][\d,]* segment/.test(element('#caption-text').textContent ?? '');
                const silent = [];
                for (const successor of successors) {
                    area.value = `F -> ${successor}`;
                    area.dispatchEvent(new Event('input', { bubbles: true }));
                    const begun = performance.now();
                    do await new Promise(requestAnimationFrame);
                    while (
                        (element('#stage').getAttribute('aria-busy') !== 'false' || !says()) &&
                        performance.now() - begun < /** @type {any} */ (globalThis).deadline
                    );
                    if (!says()) silent.push(successor);
                }
                return silent;
            },
            sampled([...changed], 4, 1),
        );
        assert.ok(changed.size > 80, `${changed.size} changes`);
        assert.deepEqual(silent, [], 'each draws something or says why not');
    }));

test('a single segment is longer than wide', () =>
    withPage({}, async (page) => {
        const before = await stillPicture(page);
        await page.fill('#rules', 'F -> F');
        await nextPicture(page, before);
        assert.match(await text(page, '#caption-text'), /, 1 segment$/);
    }));

test('a limit is refused on the drawing, with a button that draws what fits', () =>
    withPage({}, async (page) => {
        await page.fill('#iterations', '14');
        await page.click('#variation summary');
        await page.fill('#angle-variation', '5');
        await page.click('#tab-look');
        await page.waitForSelector('#refusal:visible');
        await until(() => page.isVisible('#refusal-fix'), 'the largest number is known');
        const label = await text(page, '#refusal-fix');
        assert.match(label, /^Use \d+ iterations$/);
        await page.click('#refusal-fix');
        await until(
            async () => `Use ${await page.inputValue('#iterations')} iterations` === label,
            'the number is taken',
        );
        await until(async () => !(await page.isVisible('#refusal')), 'nothing is refused');
        await page.keyboard.press('Control+z');
        assert.equal(await page.inputValue('#iterations'), '14');
    }));

test('a mistake is shown on the drawing after a pause, and its remedy is one undo step', () =>
    withPage({}, async (page) => {
        await page.fill('#rules', 'F = F[+F]F');
        assert.ok(!(await page.isVisible('#refusal')), 'half a rule is no mistake yet');
        await page.waitForSelector('#rules-problems li:visible');
        await quiet(1200, 'the mistake would be told twice');
        assert.ok(!(await page.isVisible('#refusal')), 'a mistake is told once');
        await page.click('#tab-look');
        await page.waitForSelector('#refusal:visible');
        await page.click('#tab-rules');
        await page.waitForSelector('#refusal', { state: 'hidden' });
        await page.click('#tab-look');
        await page.waitForSelector('#refusal:visible');
        assert.doesNotMatch(await text(page, '#refusal-words'), /`/);
        assert.doesNotMatch(await text(page, '#rules-problems'), /`/);
        await page.click('#refusal-show');
        assert.equal(await page.evaluate(() => document.activeElement?.id), 'rules');
        await page.click('#rules-problems .fix');
        assert.equal(await page.inputValue('#rules'), 'F -> F[+F]F');
        await until(async () => !(await page.isVisible('#refusal')), 'nothing is refused');
        await page.click('#undo');
        assert.equal(await page.inputValue('#rules'), 'F = F[+F]F');
    }));

test('a limit has its remedy beside the numbers, where it is in sight', () =>
    withPage({}, async (page) => {
        await page.fill('#iterations', '14');
        await page.click('#variation summary');
        await page.fill('#angle-variation', '5');
        await page.locator('#numbers-problems').scrollIntoViewIfNeeded();
        const remedy = page.locator('#numbers-problems .fix');
        await remedy.waitFor();
        assert.match((await remedy.textContent()) ?? '', /^Use \d+ iterations$/);
        assert.ok(!(await page.isVisible('#refusal')), 'it is told once');
        await remedy.click();
        await until(async () => (await text(page, '#numbers-problems')) === '', 'what fits is drawn');
    }));

test('a symbol in the rules says what it does, by pointer and by caret', () =>
    withPage({}, async (page) => {
        assert.match(await text(page, '#symbol-note'), /Point at a symbol/);
        const box = /** @type {{x: number, y: number, width: number, height: number}} */ (
            await page.locator('[data-editor=rules] .t-turn').first().boundingBox()
        );
        await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
        await until(
            async () => /^\+ turns left by 22/.test(await text(page, '#symbol-note')),
            'the symbol under the pointer is told',
        );
        await page.mouse.move(5, 5);
        await page.focus('#axiom');
        await page.keyboard.press('End');
        await until(
            async () => /^F .*replaced by its rule/.test(await text(page, '#symbol-note')),
            'the symbol at the caret is told',
        );
    }));

test('on a phone a row of keys writes the symbols of the notation', () =>
    withPage({ options: PHONE }, async (page) => {
        assert.ok(!(await page.isVisible('#symbol-keys')));
        await page.tap('#rules');
        await page.waitForSelector('#symbol-keys:visible');
        await page.fill('#rules', '');
        for (const key of ['F', 'Arrow', 'F', '[', '+', 'F', ']', 'F'])
            await page.getByRole('button', { name: key, exact: true }).tap();
        assert.equal(await page.inputValue('#rules'), 'F -> F[+F]F');
        await until(async () => /, 243 segments/.test(await text(page, '#caption-text')), 'the drawing follows');
        await page.evaluate(() => /** @type {HTMLElement} */ (document.activeElement).blur());
        await until(async () => !(await page.isVisible('#symbol-keys')), 'the keys go with the focus');
    }));

test('number fields take arithmetic', () =>
    withPage({}, async (page) => {
        await page.fill('#angle', '360/7');
        await until(async () => /51\.43|51\.428/.test(await text(page, '#caption-text')), 'the angle is taken');
        assert.equal(await page.inputValue('#angle'), '360/7', 'the text stays while it is edited');
        await page.locator('#angle').blur();
        assert.match(await page.inputValue('#angle'), /^51\.42857/);
        await page.fill('#angle', '360/');
        assert.equal(await page.getAttribute('#angle', 'aria-invalid'), 'true');
    }));

test('the star adds the system to favourites', () =>
    withPage({}, async (page) => {
        await page.click('#quick-favourite');
        await until(
            async () => (await text(page, '#toast')).includes('Added “A plant by one rule”'),
            'the favourite is added',
        );
    }));

for (const { device, most, options } of some([
    { device: 'a laptop', most: 22, options: { viewport: { width: 1280, height: 657 } } },
    { device: 'a phone', most: 23, options: PHONE },
    { device: 'a large screen', most: 37, options: { viewport: { width: 1920, height: 1080 } } },
]))
    test(`the first screen of ${device} has at most ${most} controls`, () =>
        withPage({ options }, async (page) => {
            const seen = await page.evaluate(() =>
                [...document.querySelectorAll('button, a, input, textarea, select, summary')]
                    .filter((control) => {
                        const { left, right, top, bottom } = control.getBoundingClientRect();
                        const [x, y] = [(left + right) / 2, (top + bottom) / 2];
                        return right - left > 1 && control.contains(document.elementFromPoint(x, y));
                    })
                    .map(({ id, textContent }) => id || textContent),
            );
            assert.ok(seen.length > 15 && seen.length <= most, `${seen.length}: ${seen.join()}`);
        }));

test('a new system has the look of the opening plant', () =>
    withPage({}, async (page) => {
        await page.click('#start-anew');
        await until(async () => (await page.inputValue('#rules')) === '', 'it is new');
        await page.fill('#rules', 'F -> F[+F]F');
        await until(async () => /, 81 segments/.test(await text(page, '#caption-text')), 'it is drawn');
        await page.click('#tab-look');
        assert.equal(await page.inputValue('#colour-by'), 'level');
        assert.equal(await page.inputValue('#width'), '0.45');
        assert.match(await text(page, '#caption-title'), /^Untitled system/);
    }));

test('letters that draw nothing are told, with the dialect in which they draw', () =>
    withPage({ hash: '#v=1&axiom=X&rules=X%20-%3E%20F%5B%2BX%5DX&n=3&angle=30' }, async (page) => {
        await page.click('#tab-turtle');
        assert.match(await text(page, '#legend-hint'), /^X draws nothing \(course assignments: every letter draws\)/);
        await page.selectOption('#dialect', 'every-letter');
        await until(async () => !(await page.isVisible('#legend-hint')), 'every letter draws');
    }));

test('on the first visit the plant grows once, and any input ends it', () =>
    withPage({ options: { ...DESKTOP, reducedMotion: 'no-preference' } }, async (page) => {
        const grows = async () => (await page.getAttribute('#grow', 'aria-pressed')) === 'true';
        assert.ok(await grows());
        assert.ok(!(await page.isVisible('#playback')), 'without the playback bar');
        const ink = () => onPixels(page, ({ words }) => words.filter((word) => word !== words[0]).length);
        let most = 0;
        await until(async () => {
            most = Math.max(most, await ink());
            return !(await grows());
        }, 'it ends by itself');
        assert.ok(!(await page.isVisible('#playback')));
        const whole = await ink();
        assert.ok(whole > 0 && most < 1.2 * whole, `in the frame of the whole plant: ${most} of ${whole}`);
        await until(async () => (await text(page, '#segments')) === '3,125', 'the whole plant is counted');
        assert.ok(!(await page.isEnabled('#undo')), 'nothing is to be undone');
        await page.reload();
        await page.waitForSelector('#stage.inked');
        assert.ok(!(await grows()), 'not again');
        await page.evaluate(() => localStorage.clear());
        await page.reload();
        await page.waitForSelector('#stage.inked');
        assert.ok(await grows());
        await page.keyboard.press('Shift');
        assert.ok(!(await grows()), 'a key ends it');
    }));

test('one press makes an empty drawing draw', () =>
    withPage({ hash: '#v=1&axiom=A&rules=A%20-%3E%20AB%0AB%20-%3E%20A&n=4', drawing: null }, async (page) => {
        await page.waitForSelector('#empty:visible');
        await page.click('#mend');
        await page.waitForSelector('#empty', { state: 'hidden' });
        assert.equal(await page.inputValue('#dialect'), 'every-letter');
        assert.ok(!(await page.isVisible('#mend')));
    }));

test('a press gives a system leaves', () =>
    withPage({}, async (page) => {
        await page.click('#leaves > summary');
        await page.click('#leaves button >> nth=0');
        assert.match(await page.inputValue('#overrides'), /: .*leaf heart/);
        assert.match(await page.inputValue('#rules'), /L\]/);
    }));
