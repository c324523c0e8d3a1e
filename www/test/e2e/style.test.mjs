import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { close, nextPicture, onPixels, picture, stillPicture, until, withPage } from './browser.mjs';

after(close);

const PLANT = `#v=1&title=Plant&axiom=X&rules=${encodeURIComponent('X -> F[+X][-X]FX\nF -> FF')}&n=5&angle=25`;

/** @param {import('playwright-core').Page} page @param {string} name */
const tab = (page, name) => page.click(`#tab-${name}`);

test('colours follow the choice of Colour by', () =>
    withPage({ hash: PLANT }, async (page) => {
        const digests = new Set([(await stillPicture(page)).digest]);
        await tab(page, 'look');
        let before = await stillPicture(page);
        for (const mode of ['level', 'path', 'turn']) {
            await page.selectOption('#colour-by', mode);
            before = await nextPicture(page, before);
            digests.add(before.digest);
            await until(
                () => page.evaluate((name) => location.hash.includes(`colour=${name}`), mode),
                'the address follows',
            );
        }
        assert.equal(digests.size, 4);
        assert.ok(await page.isVisible('#turns-row'));
        assert.ok(!(await page.isVisible('#holds-row')));
        await page.selectOption('#colour-by', 'generation');
        assert.ok(await page.isVisible('#holds-row'));
    }));

test('additive ink adds up and follows the exposure', () =>
    withPage({ hash: `${PLANT.replace('n=5', 'n=30')}&ink=solid` }, async (page) => {
        const solid = await stillPicture(page);
        await tab(page, 'look');
        assert.ok(!(await page.isVisible('#exposure-row')));
        await page.selectOption('#ink', 'density');
        const density = await nextPicture(page, solid);
        await until(() => page.evaluate(() => location.hash.includes('ink=density')), 'the address follows');
        assert.ok(await page.isVisible('#exposure-row'));
        await page.fill('#exposure', '-2');
        await page.press('#exposure', 'Enter');
        const faint = await nextPicture(page, density);
        assert.ok(faint.digest !== solid.digest);
        await page.selectOption('#colour-by', 'density');
        await nextPicture(page, faint);
        for (let step = 0; step < 3; step += 1) await page.click('#undo');
        await until(async () => (await stillPicture(page)).digest === solid.digest, 'it can be undone');
        assert.equal(await page.inputValue('#ink'), 'solid');
    }));

test('ink adds up in space, too', () =>
    withPage({ hash: PLANT.replace('%2BX', '%26X') }, async (page) => {
        const solid = await stillPicture(page);
        await tab(page, 'look');
        assert.ok(await page.isEnabled('#ink'));
        await page.selectOption('#ink', 'density');
        const density = await nextPicture(page, solid);
        assert.ok(await page.isVisible('#exposure-row'));
        await page.fill('#exposure', '-2');
        await page.press('#exposure', 'Enter');
        await nextPicture(page, density);
    }));

test('nine seeds can be compared', () =>
    withPage({ hash: `${PLANT}&vary=20&seed=7` }, async (page) => {
        const before = await stillPicture(page);
        await page.waitForSelector('#seed-sheet:visible');
        await page.click('#seed-sheet');
        const cards = page.locator('#breed-cards .card');
        assert.equal(await cards.count(), 9);
        await page.setViewportSize({ width: 1280, height: 657 });
        assert.ok(
            await page.evaluate(() => {
                const shelf = document.querySelector('#breed-cards');
                return shelf && shelf.scrollHeight <= shelf.clientHeight;
            }),
            'all nine are in sight',
        );
        await until(async () => (await page.locator('#breed-cards .thumb.inked').count()) === 9, 'all nine are drawn');
        assert.equal(
            new Set(await cards.evaluateAll((all) => all.map((card) => /** @type {HTMLButtonElement} */ (card).value)))
                .size,
            9,
        );
        // The current seed has the focus; arrow keys move from there.
        assert.match(
            (await page.evaluate(() => document.activeElement?.getAttribute('aria-label'))) ?? '',
            /Seed 7, current/,
        );
        await page.keyboard.press('ArrowRight');
        const chosen = await page.evaluate(() => /** @type {HTMLButtonElement} */ (document.activeElement).value);
        await page.keyboard.press('Enter');
        await until(async () => (await page.inputValue('#seed')) === chosen, 'the seed is taken');
        assert.notEqual((await nextPicture(page, before)).digest, before.digest);
        await page.click('#undo');
        await until(async () => (await page.inputValue('#seed')) === '7', 'it can be undone');
    }));

/** The first and the last row with ink. @param {import('playwright-core').Page} page */
const inkedRange = (page) =>
    onPixels(page, ({ words, width, height }) => {
        const rows = Array.from({ length: height }, (_, y) => y).filter((y) =>
            words.subarray(y * width, (y + 1) * width).some((word) => word !== words[0]),
        );
        return { top: rows[0] ?? 0, bottom: rows.at(-1) ?? 0 };
    });

test('a plant grows from the ground, in the frame of the whole plant', () =>
    withPage({ hash: '#v=1&axiom=X&rules=X%20-%3E%20F[%2BX][-X]X%0AF%20-%3E%20FF&n=5&angle=30' }, async (page) => {
        await stillPicture(page);
        await page.click('#open-playback');
        await page.click('#grow');
        await page.fill('#play-slider', '9999');
        await until(async () => (await page.textContent('#play-total')) === 'generation 5.0 of 5', 'it is grown');
        const before = await stillPicture(page);
        const whole = await inkedRange(page);
        await page.fill('#play-slider', '8000');
        await nextPicture(page, before);
        const part = await inkedRange(page);
        assert.ok(Math.abs(part.bottom - whole.bottom) <= 2, `the root stays: ${part.bottom} of ${whole.bottom}`);
        const share = (part.bottom - part.top) / (whole.bottom - whole.top);
        assert.ok(share > 0.4 && share < 0.6, `half as high: ${share}`);
    }));

test('growth ends with the former drawing', () =>
    withPage({ hash: PLANT }, async (page) => {
        const before = await stillPicture(page);
        await page.click('#open-playback');
        await page.click('#grow');
        await until(async () => (await picture(page)).digest !== before.digest, 'it begins to grow');
        assert.equal(await page.getAttribute('#grow', 'aria-pressed'), 'true');
        assert.match((await page.textContent('#play-total')) ?? '', /^generation \d\.\d of 5$/);
        await page.click('#grow');
        await page.click('#close-playback');
        await until(async () => (await stillPicture(page)).digest === before.digest, 'the whole plant is back');
        // Growth did not change the state.
        assert.ok(!(await page.evaluate(() => location.hash)).includes('growth'));
    }));
