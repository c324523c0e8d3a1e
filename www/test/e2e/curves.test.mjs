import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { PHONE, close, nextPicture, picture, stillPicture, until, withPage } from './browser.mjs';

after(close);

const RULES =
    'curve taper = (0, 1) (0.5, 0.8) (1, 0.2) /* of the stem */\nA(k) : k < 12 -> F(taper(k/12))[+(60*taper(k/12))F(1)]A(k + 1)';
const PLANT = `#v=1&title=Plant&axiom=A(0)&rules=${encodeURIComponent(RULES)}&n=12&angle=30`;

/** @param {import('playwright-core').Page} page */
const rules = (page) => page.inputValue('#rules');
/** @param {import('playwright-core').Page} page @param {number} number */
const point = (page, number) => page.getByRole('slider', { name: `Point ${number}`, exact: true });

for (const [name, options] of some(
    /** @type {const} */ ([
        ['on a desktop', undefined],
        ['on a phone', PHONE],
    ]),
)) {
    test(`a curve is edited by its points ${name}`, () =>
        withPage({ hash: PLANT, ...(options ? { options } : {}) }, async (page) => {
            await page.waitForSelector('#curves:visible');
            const before = await stillPicture(page);
            assert.equal(await page.locator('#curves .handle').count(), 3);
            assert.equal(await point(page, 2).getAttribute('aria-valuetext'), 'x 0.5, y 0.8');
            const box = await page.locator('#curves .plot').boundingBox();
            const handle = await point(page, 2).boundingBox();
            assert.ok(box && handle);
            const inside = await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
            assert.ok(
                inside && box.x >= 0 && box.x + box.width <= (page.viewportSize()?.width ?? 0),
                'the plot is on the screen',
            );
            await point(page, 2).scrollIntoViewIfNeeded();
            const from = await point(page, 2).boundingBox();
            assert.ok(from);
            await page.mouse.move(from.x + from.width / 2, from.y + from.height / 2);
            await page.mouse.down();
            for (let step = 1; step <= 4; step++)
                await page.mouse.move(from.x + from.width / 2 + 5 * step, from.y + from.height / 2 + 5 * step);
            await page.mouse.up();
            const dragged = await rules(page);
            assert.match(dragged, /^curve taper = \(0, 1\) \(0\.5\d+, 0\.6\d*\) \(1, 0\.2\) \/\* of the stem \*\/\n/);
            assert.notEqual((await nextPicture(page, before)).digest, before.digest);
            await page.click('#undo');
            assert.equal(await rules(page), RULES, 'the drag is one step');
            await until(async () => (await picture(page)).digest === before.digest, 'the drawing is back');
            // By keys.
            await point(page, 2).focus();
            await page.keyboard.press('ArrowUp');
            await page.keyboard.press('Shift+ArrowLeft');
            assert.match(await rules(page), /\(0\.4, 0\.81\)/);
            await page.keyboard.press('Delete');
            assert.match(await rules(page), /= \(0, 1\) \(1, 0\.2\) \/\*/);
            await page.keyboard.press('Delete');
            assert.match(await rules(page), /= \(0, 1\) \(1, 0\.2\) \/\*/, 'two points stay');
            for (let number = 3; number <= 8; number++) {
                await page.getByRole('button', { name: 'Add point' }).click();
                assert.equal(await page.locator('#curves .handle').count(), number);
            }
            assert.ok(await page.getByRole('button', { name: 'Add point' }).isDisabled());
            // The text leads.
            await page.fill('#rules', RULES.replace('(0.5, 0.8)', '(0.25, 0.5)').replaceAll('taper', 'slim'));
            await until(
                async () => (await point(page, 2).getAttribute('aria-valuetext')) === 'x 0.25, y 0.5',
                'the plot follows',
            );
            await page.fill('#rules', 'A(k) -> F(k)A(k + 1)');
            await until(async () => !(await page.isVisible('#curves')), 'without curves there is no plot');
        }));
}

test('a leaf is made for a surface and shaped by its three curves', () =>
    withPage({ hash: '#v=1&axiom=K&rules=&do=K%3A%20surface%20l&n=1' }, async (page) => {
        await page.getByRole('button', { name: 'Make a leaf for surface l' }).click();
        await page.waitForSelector('#curves .handle');
        assert.equal(await page.locator('#curves .curve').count(), 3);
        assert.equal(await page.getByRole('button', { name: 'Add point' }).count(), 0);
        const before = await stillPicture(page);
        const outline = page.getByRole('group', { name: 'Curve l: outline' });
        const second = outline.getByRole('slider', { name: 'Point 2', exact: true });
        assert.equal(await second.getAttribute('aria-valuetext'), 'x 0.3, y 0.4');
        await second.focus();
        await page.keyboard.press('Shift+ArrowUp');
        assert.notEqual((await nextPicture(page, before)).digest, before.digest);
        assert.equal(await second.getAttribute('aria-valuetext'), 'x 0.3, y 0.41');
        await page.keyboard.press('Delete');
        assert.equal(await outline.locator('.handle').count(), 4);
        for (let turn = 0; turn < 2; turn++) await page.click('#undo');
        await page.getByRole('button', { name: 'Make a leaf for surface l' }).waitFor();
    }));
