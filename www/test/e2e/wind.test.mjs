import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { close, nextPicture, onPixels, picture, stillPicture, until, withPage } from './browser.mjs';

after(close);

const PLANT = `#v=1&axiom=X&rules=${encodeURIComponent('X -> F[+X][-X]FX\nF -> FF')}&n=5&angle=25`;

/** @param {import('playwright-core').Page} page */
const hash = (page) => page.evaluate(() => location.hash);
/** @param {import('playwright-core').Page} page */
const pressed = (page) => page.getAttribute('#wind', 'aria-pressed');

/** The lowest row with ink, and its first column: the root of the plant. @param {import('playwright-core').Page} page */
const root = (page) =>
    onPixels(page, ({ words, width }) => {
        const last = words.findLastIndex((word) => word !== words[0]);
        const row = words.subarray(last - (last % width), last + 1);
        return [Math.floor(last / width), row.findIndex((word) => word !== words[0])];
    });

/** Opens the bar and lets the wind blow. Returns the picture before. @param {import('playwright-core').Page} page */
async function blow(page) {
    await stillPicture(page);
    await page.click('#open-playback');
    const still = await stillPicture(page);
    assert.equal(await pressed(page), 'false', 'no wind by itself');
    await page.click('#wind');
    assert.equal(await pressed(page), 'true');
    return still;
}

test('wind moves the drawing, and leaves the state as it was', () =>
    withPage({ hash: PLANT }, async (page) => {
        const address = await hash(page);
        const before = await blow(page);
        const seen = new Set();
        await until(async () => seen.add((await picture(page)).digest).size > 4, 'it sways');
        assert.match((await page.textContent('#play-total')) ?? '', /^wind of 3°$/);
        assert.ok(await page.isDisabled('#undo'));
        assert.equal(await hash(page), address);
        await page.click('#wind');
        await until(async () => (await stillPicture(page)).digest === before.digest, 'the still plant is back');
        assert.ok(await page.isDisabled('#undo'));
        assert.equal(await hash(page), address);
    }));

test('the wind pauses at a phase, and keeps the frame of the still plant', () =>
    withPage({ hash: PLANT }, async (page) => {
        await page.click('#open-playback');
        await stillPicture(page);
        const place = await root(page);
        await page.click('#close-playback');
        const before = await blow(page);
        await until(async () => (await picture(page)).digest !== before.digest, 'it sways');
        // The wind has risen by then.
        await until(async () => Number(await page.inputValue('#play-slider')) > 4000, 'the wave goes on');
        await page.fill('#play-slider', '2500');
        const left = await stillPicture(page);
        await page.fill('#play-slider', '7500');
        const right = await nextPicture(page, left);
        const moved = await root(page);
        assert.ok(
            moved.every((at, axis) => Math.abs(at - (place[axis] ?? 0)) <= 3),
            `the root stays: ${moved} of ${place}`,
        );
        // The same phase has the same picture, whatever came between.
        await page.fill('#play-slider', '2500');
        assert.equal((await nextPicture(page, right)).digest, left.digest);
        await page.click('#close-playback');
        assert.equal(await pressed(page), 'false');
        await page.click('#open-playback');
        await until(async () => (await stillPicture(page)).digest === before.digest, 'the still plant is back');
    }));

test('edits change the plant in the wind, which ends with the branches', () =>
    withPage({ hash: PLANT }, async (page) => {
        await blow(page);
        await page.fill('#angle', '40');
        await page.press('#angle', 'Enter');
        await until(async () => (await hash(page)).includes('angle=40'), 'the edit counts');
        assert.equal(await pressed(page), 'true');
        const edited = (await picture(page)).digest;
        await until(async () => (await picture(page)).digest !== edited, 'it goes on');
        assert.ok(!(await hash(page)).includes('sway'));
        await page.click('#undo');
        assert.ok(await page.isDisabled('#undo'), 'one step');
        await page.fill('#rules', 'X -> F+X\nF -> FF');
        await until(() => page.isDisabled('#wind'), 'nothing sways');
        assert.equal(await pressed(page), 'false');
        assert.match((await page.getAttribute('#wind', 'title')) ?? '', /Only branches sway/);
    }));

test('a link holds the strength that is set by hand', () =>
    withPage({ hash: `${PLANT}&sway=5,90` }, async (page) => {
        const leaned = await blow(page);
        await until(async () => (await picture(page)).digest !== leaned.digest, 'it sways');
        assert.match((await page.textContent('#play-total')) ?? '', /^wind of 5°$/);
        await page.click('#wind');
        await until(async () => (await stillPicture(page)).digest === leaned.digest, 'it leans again');
        assert.ok((await hash(page)).includes('sway=5,90'));
    }));
