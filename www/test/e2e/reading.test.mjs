import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import {
    close,
    DESKTOP,
    inkedRows,
    nextPicture,
    onPixels,
    PHONE,
    picture,
    quiet,
    stillPicture,
    until,
    withPage,
} from './browser.mjs';

after(close);

/** @typedef {import('playwright-core').Page} Page */

const PLANT = '#v=1&title=Plant&axiom=X&rules=X%20-%3E%20F%5B+X%5DF%5B-X%5D+X%0AF%20-%3E%20FF&angle=20&n=40';
const SMALL = PLANT.replace('n=40', 'n=3');
const STRAIGHT = '#v=1&axiom=F&rules=F%20-%3E%20FF&n=3&angle=90';
/** A drawing 3^40 steps high, zoomed in on its first step. */
const DEEP = '#v=1&axiom=F&rules=F%20-%3E%20F+F-F-F+F&n=40&angle=90&view=0.25,-0.5,1e18,0,4.1126e-20';
const CHANCE = '#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5DF%20:%200.5%0AF%20-%3E%20F%5B-F%5DF%20:%200.5&n=4&angle=25';

const SHRINKING = `#v=1&axiom=A(1)&rules=${encodeURIComponent('A(l) : l > 0.3 -> F(l)[+A(l*0.7)]A(l*0.5)')}&n=4&angle=25`;
/** ABOP, figure 1.31a. */
const SIGNALS = `#v=1&axiom=F1F1F1&rules=${encodeURIComponent(
    [
        'ignore: +-F',
        '0 < 0 > 0 -> 0',
        '0 < 0 > 1 -> 1[+F1F1]',
        '0 < 1 > 0 -> 1',
        '0 < 1 > 1 -> 1',
        '1 < 0 > 0 -> 0',
        '1 < 0 > 1 -> 1F1',
        '1 < 1 > 0 -> 0',
        '1 < 1 > 1 -> 0',
        '+ -> -',
        '- -> +',
    ].join('\n'),
)}&n=30&angle=22.5`;

/** @param {Page} page @param {string} selector */
const text = async (page, selector) => (await page.textContent(selector)) ?? '';
/** The visible symbols. @param {Page} page */
const symbols = async (page) => (await page.locator('.row-line .cells').allTextContents()).join('');
/** @param {Page} page */
const firstPlace = (page) => page.locator('.row-line .margin').first().textContent();

/** @param {Page} page @param {string} place */
async function goTo(page, place) {
    await page.fill('#reader-goto', place);
    await page.press('#reader-goto', 'Enter');
}

/** A point inside a filled polygon: the middle of an area in one colour that is not the background's, in CSS pixels. @param {Page} page @returns {Promise<[number, number]>} */
const flatPlace = (page) =>
    onPixels(page, ({ words, width, height }) => {
        const size = 4;
        // Not under the tools at the edges.
        for (let top = Math.floor(height / 4); top < height * 0.75; top++) {
            for (let left = Math.floor(width / 4); left < width * 0.75; left++) {
                const first = words[top * width + left];
                const same = (/** @type {number} */ at) =>
                    words[(top + Math.floor(at / size)) * width + left + (at % size)] === first;
                if (first !== words[0] && Array.from({ length: size * size }, (_, at) => at).every(same))
                    return /** @type {[number, number]} */ ([left + size / 2, top + size / 2]);
            }
        }
        throw new Error('nothing is filled');
    });

/** The derived string, by plain rewriting. @param {number} n */
function derive(n) {
    const rules = /** @type {Record<string, string>} */ ({ X: 'F[+X]F[-X]+X', F: 'FF' });
    let word = 'X';
    for (let step = 0; step < n; step++) word = [...word].map((symbol) => rules[symbol] ?? symbol).join('');
    return word;
}

test('the whole string is shown, generation by generation', () =>
    withPage({ hash: SMALL }, async (page) => {
        await page.click('#open-reader');
        for (const n of [3, 2, 1, 0]) {
            await until(async () => (await symbols(page)) === derive(n), `generation ${n}`);
            assert.equal(await text(page, '#reader-generation'), `n = ${n}`);
            if (n > 0) await page.click('#reader-back');
        }
        assert.ok(await page.isDisabled('#reader-back'));
        await page.click('#reader-on');
        await until(async () => (await symbols(page)) === derive(1), 'generation 1 again');
        assert.equal((await page.locator('.cells .t-bracket').count()) > 0, true);
        // The open string view follows the rules.
        await page.fill('#rules', 'X -> FX');
        await until(async () => (await symbols(page)) === 'FX', 'the new string');
        await page.press('#reader-text', 'Escape');
        assert.ok(!(await page.isVisible('#reader')));
    }));

test('a string of 10^19 symbols scrolls by rows, by pages and to its ends', () =>
    withPage({ hash: PLANT }, async (page) => {
        await page.click('#open-reader');
        await until(async () => /^F+$/.test(await symbols(page)), 'the first page');
        assert.equal(await firstPlace(page), '1');
        const columns = (await page.locator('.row-line .cells').first().textContent())?.length ?? 0;
        assert.ok(columns >= 40 && columns % 10 === 0);
        await page.focus('#reader-text');
        await page.keyboard.press('ArrowDown');
        assert.equal(await firstPlace(page), String(columns + 1));
        await page.keyboard.press('PageDown');
        await page.keyboard.press('PageUp');
        assert.equal(await firstPlace(page), String(columns + 1));
        await page.keyboard.press('End');
        await until(async () => (await symbols(page)).endsWith('F[+X]F[-X]+X'), 'the last symbols');
        assert.equal(await page.getAttribute('#reader-bar', 'aria-valuenow'), '100.0');
        await page.keyboard.press('Home');
        await until(async () => (await firstPlace(page)) === '1', 'the first row');
        await page.hover('#reader-text');
        await page.mouse.wheel(0, 4000);
        await until(async () => (await firstPlace(page)) !== '1', 'the wheel scrolls');
        await until(async () => /^F{400}/.test(await symbols(page)), 'rows are filled');
        // The scroll bar goes to any part of the string.
        const bar = /** @type {{x: number, y: number, width: number, height: number}} */ (
            await page.locator('#reader-bar').boundingBox()
        );
        await page.mouse.click(bar.x + bar.width / 2, bar.y + bar.height / 2);
        await until(
            async () => Math.abs(Number(await page.getAttribute('#reader-bar', 'aria-valuenow')) - 50) < 2,
            'half way',
        );
        await until(async () => (await symbols(page)).length > columns * 3, 'rows are filled again');
    }));

test('Go to jumps to a position, and a symbol shows its origin and its part of the drawing', () =>
    withPage({ hash: PLANT }, async (page) => {
        await page.click('#open-reader');
        await goTo(page, '10^12');
        await until(async () => (await page.locator('.cells .chosen').count()) === 1, 'the symbol is chosen');
        await until(
            async () => /F at step 40, by rule 2, (first|second) symbol/.test(await text(page, '#reader-path')),
            'its origin',
        );
        assert.match(await text(page, '#reader-where'), /999,999,999,\d{3} to 1\.00.×.10¹² of 7\.90.×.10¹⁹/u);
        assert.ok(await page.isVisible('#mark-part'));
        await goTo(page, '100 %');
        await until(
            async () => (await text(page, '#reader-path')).startsWith('XX at step 40, by rule 1, twelfth symbol'),
            'the last symbol',
        );
        assert.match(await text(page, '#reader-path'), /Draws no segment/);
        await goTo(page, 'nowhere');
        assert.ok(await page.locator('#reader-goto[data-wrong]').count());
        // The selection follows its descendants and ancestors in other generations.
        await page.click('#reader-back');
        await until(async () => (await text(page, '#reader-path')).startsWith('XX at step 39'), 'its parent');
        await page.click('#reader-on');
        await until(
            async () => (await text(page, '#reader-path')).startsWith('FF at step 40, by rule 1, first symbol'),
            'the first it became',
        );
        await page.click('.links li:last-child button');
        await until(async () => (await text(page, '#reader-generation')) === 'n = 0', 'the axiom');
        await until(async () => (await symbols(page)) === 'X', 'its one symbol');
        assert.match(await text(page, '#reader-path'), /first symbol of the axiom.*7\.90.×.10¹⁹ symbols at n = 40/s);
    }));

test('a click in the string selects exactly that symbol', () =>
    withPage({ hash: SMALL }, async (page) => {
        await page.click('#open-reader');
        await until(async () => (await symbols(page)) === derive(3), 'the string');
        const cells = /** @type {{x: number, y: number}} */ (
            await page.locator('.row-line .cells').first().boundingBox()
        );
        const width = await page.evaluate(
            () => /** @type {HTMLElement} */ (document.querySelector('.ruler')).getBoundingClientRect().width / 50,
        );
        await page.mouse.click(cells.x + width * 9.5, cells.y + 8);
        await until(async () => (await page.locator('.cells .chosen').count()) === 1, 'a symbol is chosen');
        assert.equal(await page.locator('.cells .chosen').textContent(), derive(3)[9]);
        await until(async () => (await text(page, '#reader-path')).includes('at step'), 'its origin');
        await page.keyboard.press('ArrowRight');
        await until(async () => (await page.locator('.cells .chosen').textContent()) === derive(3)[10], 'the next one');
    }));

test('the pointer on the drawing shows the segment and its symbol, and highlights the symbol in the string', () =>
    withPage({ hash: STRAIGHT }, async (page) => {
        // Eight segments, one above the other: the third is a little above a quarter of the height.
        await page.click('#open-reader');
        await until(async () => (await symbols(page)) === 'FFFFFFFF', 'the string');
        await stillPicture(page);
        const box = /** @type {{x: number, y: number, width: number, height: number}} */ (
            await page.locator('#stage').boundingBox()
        );
        const shown = await inkedRows(page);
        const at = (/** @type {number} */ part) => box.y + shown.bottom - (shown.bottom - shown.top) * part;
        await page.mouse.move(box.x + box.width / 2 + 2, at(2.5 / 8));
        await page.waitForSelector('#card:visible');
        assert.match(
            await text(page, '#card'),
            /^Fstep 3, by rule 1, first symbol.*Segment 3, heading 90°.*Symbol 3$/s,
        );
        // WebKit sends pointerleave when a button is released.
        const left = { pointerType: 'mouse', clientX: box.x + box.width / 2 + 2, clientY: at(2.5 / 8) };
        await page.evaluate(
            (told) => document.querySelector('#drawing')?.dispatchEvent(new PointerEvent('pointerleave', told)),
            left,
        );
        assert.ok(await page.isVisible('#card'));
        assert.equal(await page.getAttribute('#mark-found', 'hidden'), null);
        await until(async () => (await page.locator('.cells .lit').count()) === 1, 'it is lit');
        const before = await page.evaluate(() => document.querySelector('.cells .lit')?.previousSibling?.textContent);
        assert.equal(before, 'FF');
        // In an earlier generation the symbol's ancestor is highlighted.
        await page.click('#reader-back');
        await page.mouse.move(box.x + box.width / 2 + 2, at(6.5 / 8));
        await until(async () => (await text(page, '#card')).includes('Segment 7'), 'the seventh');
        await until(
            async () =>
                (await page.evaluate(() => document.querySelector('.cells .lit')?.previousSibling?.textContent)) ===
                'FFF',
            'its parent, the fourth',
        );
        await page.mouse.move(box.x + 40, box.y + box.height / 2);
        await until(async () => !(await page.isVisible('#card')), 'the card is gone');
        assert.notEqual(await page.getAttribute('#mark-found', 'hidden'), null);
        assert.equal(await page.locator('.cells .lit').count(), 0);
    }));

for (const [title, own] of some(
    /** @type {const} */ ([
        ['Lime twig', 'L'],
        ['Bush with leaves', '{'],
    ]),
)) {
    test(`a leaf is described, marked and selected: ${title}`, () =>
        withPage({}, async (page) => {
            const before = await stillPicture(page);
            await page.click('#open-gallery');
            await page.fill('#search', title);
            // The cards come later than the dialog.
            await page.locator('.card:visible', { hasText: title }).first().click();
            const shaded = await nextPicture(page, before);
            if (own === '{') {
                // Leaves in one colour.
                await page.click('#tab-look');
                await page.uncheck('#shadows');
                await nextPicture(page, shaded);
            }
            await page.click('#open-reader');
            await until(async () => (await symbols(page)).length > 100, 'the string');
            await stillPicture(page);
            const [x, y] = await flatPlace(page);
            const box = /** @type {{x: number, y: number}} */ (await page.locator('#stage').boundingBox());
            await page.mouse.move(box.x + x, box.y + y);
            await page.waitForSelector('#card:visible');
            const words = await text(page, '#card');
            assert.ok(words.startsWith(own), words);
            assert.match(words, /step \d, by rule \d, .* symbol.*Polygon [\d,]+, filled, .*colour \d+Symbol [\d,]+$/s);
            // The pointer is within the outline.
            const corners =
                ((await page.getAttribute('#mark-found .line', 'd')) ?? '').match(/-?[\d.]+/g)?.map(Number) ?? [];
            assert.ok(corners.length >= 12, String(corners));
            const [xs, ys] = [0, 1].map((axis) => corners.filter((_, at) => at % 2 === axis));
            for (const [values, at] of /** @type {const} */ ([
                [xs, x],
                [ys, y],
            ]))
                assert.ok(Math.min(...(values ?? [])) < at && at < Math.max(...(values ?? [])), `${at} in ${values}`);
            await page.mouse.click(box.x + x, box.y + y);
            await until(async () => (await page.locator('.cells .chosen').count()) === 1, 'it is chosen in the string');
            assert.equal(await page.locator('.cells .chosen').textContent(), own);
        }));
}

test('a single step of a drawing 10^19 steps high is found, marked and highlighted', () =>
    withPage({ hash: DEEP }, async (page) => {
        await page.click('#open-reader');
        await until(async () => (await symbols(page)).startsWith('F+F-F-F+F+F+F-F'), 'the string');
        await stillPicture(page);
        const box = /** @type {{x: number, y: number, width: number, height: number}} */ (
            await page.locator('#stage').boundingBox()
        );
        const middle = [box.x + box.width / 2, box.y + box.height / 2];
        // The first step goes up through the middle of the picture; the second goes left from its end.
        const line = () =>
            page.evaluate(() =>
                (
                    document
                        .querySelector('#mark-found .line')
                        ?.getAttribute('d')
                        ?.match(/-?[\d.]+/g) ?? []
                ).map(Number),
            );
        await page.mouse.move(Number(middle[0]) + 2, Number(middle[1]));
        await page.waitForSelector('#card:visible');
        assert.match(await text(page, '#card'), /^Fstep 40, by rule 1, first symbol.*Segment 1, heading 90°Symbol 1$/s);
        const [x1 = 0, y1 = 0, x2 = 0, y2 = 0] = await line();
        assert.ok(Math.abs(x1 - box.width / 2) < 1 && Math.abs(x2 - x1) < 0.1, `${x1} ${x2}`);
        assert.ok(Math.abs((y1 + y2) / 2 - box.height / 2) < 1 && y1 - y2 > 25 && y1 - y2 < 80, `${y1} ${y2}`);
        assert.equal(await page.getAttribute('#mark-found', 'hidden'), null);
        await until(async () => (await page.locator('.cells .lit').count()) === 1, 'it is lit');
        await page.mouse.move(Number(middle[0]) - (y1 - y2) / 2, Number(middle[1]) - (y1 - y2) / 2 + 2);
        await until(async () => /Segment 2, heading 180°Symbol 3$/.test(await text(page, '#card')), 'the second step');
        // The selected symbol is marked in the drawing.
        await page.mouse.move(box.x + 20, box.y + 20);
        await goTo(page, '3');
        await until(async () => (await text(page, '#reader-path')).includes('Segment 2, marked'), 'the symbol');
        const outline = await page.evaluate(() => document.querySelector('#mark-part .line')?.getAttribute('d') ?? '');
        const [ax = 0, ay = 0, bx = 0, by = 0] = (outline.match(/-?[\d.]+/g) ?? []).map(Number);
        assert.ok(
            Math.abs(Math.abs(ax - bx) - (y1 - y2)) < 0.5 && Math.abs(ay - by) < 0.5 && Math.abs(ay - y2) < 0.5,
            outline,
        );
    }));

test('hovering asks one question at a time, and without hovering none is asked', () =>
    withPage(
        {
            hash: PLANT,
            before: (page) =>
                page.addInitScript(() => {
                    const seen = /** @type {any} */ (globalThis);
                    Object.assign(seen, { sent: 0, answered: 0, most: 0 });
                    // Chromium may move its own pointer after a layout, which is no question of this test.
                    addEventListener(
                        'pointermove',
                        (event) => event.isTrusted && event.stopImmediatePropagation(),
                        true,
                    );
                    const Real = Worker;
                    globalThis.Worker = class extends Real {
                        constructor(/** @type {string | URL} */ url) {
                            super(url);
                            this.addEventListener(
                                'message',
                                ({ data }) => data.type === 'pick' && (seen.answered += 1),
                            );
                        }
                        /** @param {any} message @param {any} [options] */
                        postMessage(message, options) {
                            if (message.type === 'pick') {
                                seen.sent += 1;
                                seen.most = Math.max(seen.most, seen.sent - seen.answered);
                            }
                            super.postMessage(message, options);
                        }
                    };
                }),
        },
        async (page) => {
            await stillPicture(page);
            const counts = () =>
                page.evaluate(() => ({
                    sent: Number(/** @type {any} */ (globalThis).sent),
                    most: Number(/** @type {any} */ (globalThis).most),
                }));
            assert.equal((await counts()).sent, 0);
            await page.evaluate(() => {
                const canvas = /** @type {HTMLElement} */ (document.querySelector('#drawing'));
                for (let at = 0; at < 300; at++)
                    canvas.dispatchEvent(
                        new PointerEvent('pointermove', {
                            clientX: 300 + at,
                            clientY: 400,
                            pointerType: 'mouse',
                            bubbles: true,
                        }),
                    );
            });
            await until(async () => (await counts()).sent >= 2, 'the first and the last are asked');
            await quiet(100, 'further questions would be asked');
            const { sent, most } = await counts();
            assert.ok(sent <= 3 && most === 1, `${sent} sent, ${most} at once`);
        },
    ));

test('symbols and segments of random systems are traced', () =>
    withPage({ hash: CHANCE }, async (page) => {
        await stillPicture(page);
        const box = /** @type {{x: number, y: number, width: number, height: number}} */ (
            await page.locator('#stage').boundingBox()
        );
        await page.click('#open-reader');
        await until(async () => /^F[F+\-[\]]+$/.test(await symbols(page)), 'the string');
        await goTo(page, '1');
        await until(
            async () =>
                /^FF at step 4, by rule [12], first symbolDraws one step.*Segment 1, marked/.test(
                    await text(page, '#reader-path'),
                ),
            'where it comes from',
        );
        assert.equal(await page.locator('.links li').count(), 5);
        await page.click('.links li:last-child button');
        await until(async () => (await symbols(page)) === 'F', 'the axiom');
        await until(async () => /81 segments, marked/.test(await text(page, '#reader-path')), 'what it has become');
        await page.click('#close-reader');
        await stillPicture(page);
        // Move down the middle until the pointer meets the stem.
        let x = 0.3;
        await until(async () => {
            if (await page.isVisible('#card')) return true;
            x = x < 0.7 ? x + 0.01 : 0.3;
            await page.mouse.move(box.x + box.width * x, box.y + box.height * 0.8);
            return false;
        }, 'something is under the pointer');
        assert.match(await text(page, '#card'), /^Fstep \d, by rule [12], .*Segment \d+, heading.*Symbol \d+$/s);
    }));

test('modules with parameters are shown with their numbers, and traced', () =>
    withPage({ hash: SHRINKING }, async (page) => {
        await page.click('#open-reader');
        await until(
            async () => (await symbols(page)).startsWith('F(1)[+F(0.7)[+F(0.49)[+F(0.343)[+A(0.2401)]'),
            'the string',
        );
        await until(async () => (await text(page, '#reader-where')).endsWith('of 36'), 'modules are counted');
        // No row is cut off.
        const widths = await page
            .locator('.row-line')
            .evaluateAll((rows) => rows.map((row) => [row.scrollWidth, row.clientWidth]));
        assert.ok(
            widths.every(([content = 0, room = 0]) => content <= room),
            String(widths),
        );
        const place = /** @type {{x: number, y: number}} */ (
            await page.locator('.row-line .cells').first().boundingBox()
        );
        const width = await page.evaluate(
            () => /** @type {HTMLElement} */ (document.querySelector('.ruler')).getBoundingClientRect().width / 50,
        );
        // In the middle of `F(0.7)`, the fourth module.
        await page.mouse.click(place.x + width * 9, place.y + 8);
        await until(
            async () =>
                /^F\(0\.7\)step 2, by rule 1, first symbolDraws l.*Segment 2, marked/.test(
                    await text(page, '#reader-path'),
                ),
            'its origin',
        );
        assert.match(
            await text(page, '#reader-path'),
            /A\(0\.7\)step 1, by rule 1, fourth symbolA\(1\)first symbol of the axiom/,
        );
        await page.keyboard.press('ArrowLeft');
        await until(async () => /^\+\+ at step 1/.test(await text(page, '#reader-path')), 'its neighbour');
        await page.click('#reader-back');
        await page.click('#reader-back');
        await until(async () => (await symbols(page)).startsWith('F(1)[+F(0.7)[+A(0.49)]'), 'two generations before');
    }));

test('the string of a context-sensitive system is read at any generation', () =>
    withPage({ hash: SIGNALS }, async (page) => {
        await page.click('#open-reader');
        await until(async () => (await text(page, '#reader-where')).endsWith('of 6,910'), 'the string');
        await goTo(page, '5000');
        await until(
            async () =>
                /at step \d+, by rule \d+, .*first symbol of the axiom|symbol of the axiom/s.test(
                    await text(page, '#reader-path'),
                ),
            'where it comes from',
        );
        assert.equal(await page.locator('.cells .chosen').count(), 1);
        await page.fill('#reader-step', '0');
        await until(async () => (await symbols(page)) === 'F1F1F1', 'the axiom');
        assert.equal(await page.locator('.cells .chosen').count(), 1);
    }));

test('playback goes from nothing to the whole picture, and shows the turtle’s pose', () =>
    withPage({ hash: STRAIGHT.replace('n=3', 'n=10') }, async (page) => {
        await stillPicture(page);
        await page.click('#open-playback');
        await page.click('#play');
        await page.click('#close-playback');
        const whole = await stillPicture(page);
        await page.click('#open-playback');
        await page.click('#play');
        await until(async () => (await page.getAttribute('#play', 'aria-label')) === 'Pause', 'it plays');
        await page.click('#play');
        assert.equal(await page.getAttribute('#play', 'aria-label'), 'Play');
        await page.fill('#play-place', '0');
        await page.press('#play-place', 'Enter');
        await until(async () => /^At 0, 0, heading 90°/.test(await text(page, '#play-pose')), 'the start');
        assert.ok((await stillPicture(page)).ink < 0.0001);
        assert.ok(await page.isVisible('#mark-turtle'));
        await page.fill('#play-place', '50 %');
        await page.press('#play-place', 'Enter');
        await until(
            async () => /^At 0, 513, heading 90°|^At 0, 512, heading 90°/.test(await text(page, '#play-pose')),
            'half way',
        );
        const half = await stillPicture(page);
        assert.ok(half.ink > 0);
        await page.press('#play-place', 'ArrowUp');
        await until(async () => /^At 0, 51[34], /.test(await text(page, '#play-pose')), 'one more');
        await page.fill('#play-slider', '10000');
        await until(async () => (await text(page, '#play-pose')) === 'The whole drawing.', 'the end');
        assert.ok(!(await page.isVisible('#mark-turtle')));
        assert.notEqual((await stillPicture(page)).digest, half.digest);
        await page.click('#close-playback');
        assert.equal((await stillPicture(page)).digest, whole.digest);
        assert.ok(!(await page.evaluate(() => location.hash)).includes('play'));
    }));

test('the space bar plays to the end for any number of segments', () =>
    withPage({ hash: PLANT, options: { ...DESKTOP, reducedMotion: 'no-preference' } }, async (page) => {
        await stillPicture(page);
        await page.focus('#drawing');
        await page.keyboard.press(' ');
        await until(async () => (await page.getAttribute('#play', 'aria-label')) === 'Pause', 'it plays');
        assert.match(await text(page, '#play-pace'), /2\.4.×.10¹⁸ a second/);
        const first = await picture(page);
        await until(async () => (await picture(page)).digest !== first.digest, 'it draws on');
        await page.focus('#drawing');
        await page.keyboard.press(' ');
        assert.equal(await page.getAttribute('#play', 'aria-label'), 'Play');
        await stillPicture(page);
        // The highest speed: everything in a second.
        await page.fill('#play-speed', '1000');
        assert.equal(await page.getAttribute('#play-ten', 'aria-pressed'), 'false');
        await page.click('#play');
        await until(async () => (await text(page, '#play-pose')) === 'The whole drawing.', 'the end');
        assert.equal(await page.getAttribute('#play', 'aria-label'), 'Play');
        await page.click('#play-ten');
        assert.equal(await page.getAttribute('#play-ten', 'aria-pressed'), 'true');
    }));

test('another system ends playback and shows its whole picture; other colours do not', () =>
    withPage({ hash: SMALL }, async (page) => {
        await page.click('#open-playback');
        await page.fill('#play-place', '20');
        await page.press('#play-place', 'Enter');
        await until(async () => (await text(page, '#play-pose')).startsWith('At '), 'on the way');
        const part = await stillPicture(page);
        await page.click('#tab-look');
        await page.click('#inks .ink:nth-child(2)');
        await nextPicture(page, part);
        assert.match(await text(page, '#play-pose'), /^At /);
        await page.click('#tab-rules');
        await page.fill('#angle', '35');
        await until(async () => (await text(page, '#play-pose')) === 'The whole drawing.', 'the whole drawing');
        assert.ok(!(await page.isVisible('#mark-turtle')));
    }));

test('on a phone the string, a tapped segment and playback are within reach', () =>
    withPage({ hash: PLANT, options: PHONE }, async (page) => {
        await stillPicture(page);
        // The trunk stands beside the tools.
        const at = () =>
            onPixels(page, ({ words, width, height }) => {
                const row = Math.floor(height * 0.75) * width;
                for (let x = 0; x < width; x++) if (words[row + x] !== words[0]) return x / width;
                return 0;
            });
        const tapped = async () => {
            const stage = await page.locator('#stage').boundingBox();
            assert.ok(stage);
            await page.touchscreen.tap(stage.x + stage.width * (await at()), stage.y + stage.height * 0.75);
        };
        await tapped();
        await page.waitForSelector('#card:visible');
        assert.match(await text(page, '#card'), /step 40, by rule 2/);
        await page.tap('#open-reader');
        await until(async () => /^F+$/.test(await symbols(page)), 'the string');
        assert.ok(!(await page.isVisible('#panel')));
        const columns = (await page.locator('.row-line .cells').first().textContent())?.length ?? 0;
        assert.ok(columns >= 20, `${columns} columns`);
        await stillPicture(page);
        await tapped();
        await until(async () => (await page.locator('.cells .chosen').count()) === 1, 'the tapped symbol is chosen');
        await page.tap('#close-reader');
        assert.ok(await page.isVisible('#panel'));
        await page.tap('#open-playback');
        await page.tap('#play');
        await until(async () => (await page.getAttribute('#play', 'aria-label')) === 'Pause', 'it plays');
        for (const id of ['play', 'play-slider', 'play-place', 'play-speed', 'play-ten', 'wind', 'close-playback']) {
            const box = await page.locator(`#${id}`).boundingBox();
            assert.ok(box && box.x >= 0 && box.x + box.width <= 390, id);
        }
        await page.tap('#close-playback');
        assert.ok(!(await page.isVisible('#playback')));
    }));

test('the string of a generation is copied as a whole, and the keys select nothing else', () =>
    withPage(
        { hash: SMALL, options: { ...DESKTOP, permissions: ['clipboard-read', 'clipboard-write'] } },
        async (page) => {
            await page.click('#open-reader');
            await page.waitForSelector('#reader-text .cells');
            const clipboard = () => page.evaluate(() => navigator.clipboard.readText());
            await page.click('#copy-string');
            await until(async () => /^Copied/.test(await text(page, '#toast')), 'it is copied');
            const copied = await clipboard();
            const [, told = ''] = /Copied ([\d,]+) symbols/.exec(await text(page, '#toast')) ?? [];
            assert.equal(String(copied.length), told.replaceAll(',', ''));
            assert.match(copied, /^[FX+[\]-]+$/);
            await page.focus('#reader-text');
            await page.keyboard.press('Control+a');
            assert.ok(
                await page.evaluate(() => {
                    const range = getSelection()?.getRangeAt(0);
                    return range?.commonAncestorContainer === document.querySelector('#reader-text');
                }),
            );
            await page.evaluate(() => navigator.clipboard.writeText(''));
            await page.keyboard.press('Control+c');
            await until(async () => (await clipboard()) === copied, 'the keys copy the same');
        },
    ));
