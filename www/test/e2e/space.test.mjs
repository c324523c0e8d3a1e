import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import {
    DESKTOP,
    PHONE,
    close,
    inkedRows,
    morePictures,
    nextPicture,
    sameAgain,
    stillPicture,
    until,
    withPage,
} from './browser.mjs';

after(close);

const TREE =
    '#v=1&axiom=T&rules=T%20-%3E%20TF%0AF%20-%3E%20F%5B+F%5D%5B-FF%5D%5B%3CF%5D%5B%3EFF%5D%5B%26F%5D&n=4&angle=40&turtle=practical';
const STICK = '#v=1&axiom=F/&rules=F%20-%3E%20FF&n=3&angle=90';
const LEAF = '#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5DF&n=4&angle=25';

/** @param {import('playwright-core').Page} page */
const hash = (page) => page.evaluate(() => location.hash);

/** @param {import('playwright-core').Page} page @param {[number, number]} from @param {[number, number]} to */
async function drag(page, from, to) {
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(...to, { steps: 4 });
    await page.mouse.up();
}

test('the tools for drawings in space are shown only for them', () =>
    withPage({ hash: TREE }, async (page) => {
        const tree = await stillPicture(page);
        assert.ok(tree.ink > 0.003);
        assert.ok(await page.isVisible('#space-tools'));
        await page.evaluate((next) => (location.hash = next), LEAF);
        await nextPicture(page, tree);
        await until(async () => !(await page.isVisible('#space-tools')), 'the tools are gone');
    }));

test("a drawing in space is played segment by segment, with the turtle's pose", () =>
    withPage({ hash: TREE }, async (page) => {
        const whole = await stillPicture(page);
        await page.click('#open-playback');
        await page.click('#play');
        await page.fill('#play-place', '1');
        await page.press('#play-place', 'Enter');
        await until(
            async () => /^At 0, 1, 0, heading 0, 1, 0, level 0/.test((await page.textContent('#play-pose')) ?? ''),
            'the pose behind the first segment',
        );
        await page.fill('#play-place', '50 %');
        await page.press('#play-place', 'Enter');
        await until(async () => {
            const { ink } = await stillPicture(page);
            return ink > 0 && ink < whole.ink;
        }, 'half of it is drawn');
        await page.click('#close-playback');
        await sameAgain(page, whole);
    }));

test('a drag turns the drawing, Shift and a drag move the drawing, Fit shows it whole, and the link keeps the camera', () =>
    withPage({ hash: TREE }, async (page) => {
        const first = await stillPicture(page);
        await drag(page, [500, 400], [620, 430]);
        const round = await nextPicture(page, first);
        await until(async () => /camera=/.test(await hash(page)), 'the link has the camera');
        await page.keyboard.down('Shift');
        await drag(page, [500, 400], [600, 350]);
        await page.keyboard.up('Shift');
        const moved = await nextPicture(page, round);
        await page.focus('#drawing');
        await page.keyboard.press('+');
        await nextPicture(page, moved);
        await page.click('#fit');
        await sameAgain(page, round);
        await page.focus('#drawing');
        await page.keyboard.press('Shift+ArrowLeft');
        await nextPicture(page, round);
    }));

test('the segment under the pointer is described, marked and highlighted, but not while the drawing turns', () =>
    withPage({ hash: STICK }, async (page) => {
        await page.click('#open-reader');
        await until(
            async () => (await page.locator('.row-line .cells').allTextContents()).join('') === 'FFFFFFFF/',
            'the string',
        );
        await stillPicture(page);
        const box = /** @type {{x: number, y: number, width: number, height: number}} */ (
            await page.locator('#stage').boundingBox()
        );
        const ends = await inkedRows(page);
        const y = ends.bottom - ((ends.bottom - ends.top) * 2.5) / 8;
        const hover = () => page.mouse.move(box.x + box.width / 2 + 2, box.y + y);
        const card = async () => (await page.textContent('#card')) ?? '';
        await hover();
        await page.waitForSelector('#card:visible');
        assert.match(await card(), /^Fstep 3, by rule 1, first symbol.*Segment 3, heading 0, 1, 0Symbol 3$/s);
        const [x1 = 0, y1 = 0, x2 = 0, y2 = 0] = await page.evaluate(() =>
            (
                document
                    .querySelector('#mark-found .line')
                    ?.getAttribute('d')
                    ?.match(/-?[\d.]+/g) ?? []
            ).map(Number),
        );
        const step = (ends.bottom - ends.top) / 8;
        assert.ok(
            Math.abs(x1 - box.width / 2) < 1 && Math.abs(x2 - x1) < 1 && y1 > y && y > y2,
            `${x1} ${y1} ${x2} ${y2}`,
        );
        assert.ok(
            Math.abs(y1 - y2 - step) < 0.15 * step && Math.abs((y1 + y2) / 2 - y) < 0.3 * step,
            `${y1} ${y2} ${step}`,
        );
        await until(async () => (await page.locator('.cells .lit').count()) === 1, 'it is lit');
        // The drawing is upright, so turning about the vertical does not move it.
        await page.mouse.down();
        await page.mouse.move(box.x + box.width / 2 + 60, box.y + y, { steps: 4 });
        assert.ok(!(await page.isVisible('#card')));
        await page.mouse.up();
        await hover();
        await until(
            async () => (await page.isVisible('#card')) && (await card()).includes('Segment 3'),
            'it is told again',
        );
        // Zooming hides the card until the drawing rests.
        await page.mouse.wheel(0, -100);
        await until(async () => !(await page.isVisible('#card')), 'the card is gone');
        await until(
            async () => (await page.isVisible('#card')) && (await card()).includes('Segment 3'),
            'it is told when the drawing rests',
        );
        // Segments that playback has not drawn yet are not found.
        await page.click('#open-playback');
        await page.click('#play');
        await page.fill('#play-place', '2');
        await page.press('#play-place', 'Enter');
        await until(async () => /^At 0, 2, 0/.test((await page.textContent('#play-pose')) ?? ''), 'two segments');
        await stillPicture(page);
        const turtle = /translate\(([-\d.]+) ([-\d.]+)\) rotate\(-90/.exec(
            (await page.getAttribute('#mark-turtle', 'transform')) ?? '',
        );
        assert.ok(turtle && (await page.isVisible('#mark-turtle')));
        const at = [box.x + Number(turtle[1]), box.y + Number(turtle[2])];
        await page.mouse.move(Number(at[0]), Number(at[1]) + 25);
        await until(
            async () => (await page.isVisible('#card')) && (await card()).includes('Segment 2'),
            'where it has been',
        );
        await page.mouse.move(Number(at[0]), Number(at[1]) - 25);
        await until(async () => !(await page.isVisible('#card')), 'nothing is there yet');
    }));

test('perspective, fading and the turntable change the picture', () =>
    withPage({ hash: TREE }, async (page) => {
        const first = await stillPicture(page);
        await page.click('#perspective');
        assert.equal(await page.getAttribute('#perspective', 'aria-pressed'), 'false');
        const flat = await nextPicture(page, first);
        await page.fill('#fade', '80');
        const faded = await nextPicture(page, flat);
        // With reduced motion the turntable moves by steps.
        await page.click('#turntable');
        await nextPicture(page, faded);
        assert.equal(await page.getAttribute('#turntable', 'aria-pressed'), 'false');
    }));

test('the turntable turns until it is stopped', () =>
    withPage({ hash: TREE, options: { ...DESKTOP, reducedMotion: 'no-preference' } }, async (page) => {
        await stillPicture(page);
        await page.click('#turntable');
        assert.equal(await page.getAttribute('#turntable', 'aria-pressed'), 'true');
        await morePictures(page, 3);
        await page.click('#turntable');
        const there = await stillPicture(page);
        assert.equal((await stillPicture(page)).digest, there.digest);
        await until(async () => /camera=/.test(await hash(page)), 'the link has the camera');
    }));

test('a turning drawing fills the stage with fewer pixels, and has all pixels at rest', () =>
    withPage(
        { hash: TREE.replace('n=4', 'n=8&width=0.1'), options: { ...DESKTOP, reducedMotion: 'no-preference' } },
        async (page) => {
            const sizes = () =>
                page.evaluate(() => {
                    const canvas = /** @type {HTMLCanvasElement} */ (document.querySelector('#drawing'));
                    const [box, stage] = [
                        canvas.getBoundingClientRect(),
                        /** @type {Element} */ (document.querySelector('#stage')),
                    ];
                    return {
                        shown: [box.width, box.height],
                        stage: [stage.clientWidth, stage.clientHeight],
                        pixels: [canvas.width, canvas.height],
                    };
                });
            await page.click('#turntable');
            for (let look = 0; look < 10; look++) {
                await morePictures(page);
                const { shown, stage, pixels } = await sizes();
                assert.deepEqual(shown, stage);
                assert.ok(
                    stage.every((side, axis) => [side, Math.ceil(side / 2)].includes(pixels[axis] ?? 0)),
                    `${pixels}`,
                );
            }
            await page.click('#turntable');
            await until(async () => (await page.getAttribute('#stage', 'aria-busy')) !== 'true', 'it is at rest');
            const { shown, pixels } = await sizes();
            assert.deepEqual(pixels, shown);
        },
    ));

test('drawings in space work on a phone', () =>
    withPage({ hash: TREE, options: PHONE }, async (page) => {
        const first = await stillPicture(page);
        await page.locator('#turntable').tap();
        await nextPicture(page, first);
    }));
