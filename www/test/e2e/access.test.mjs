import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { sampled, some } from '../effort.mjs';
import { COLOURS, violations } from './axe.mjs';
import { ADDRESS, DESKTOP, PHONE, close, nextPicture, stillPicture, until, withPage } from './browser.mjs';
import { RULES, STATES, TREE, inStates, tab } from './states.mjs';

after(close);

/** @typedef {import('playwright-core').Page} Page */

/**
 * The violations at the levels that exclude people.
 * @param {Page} page
 * @param {string[]} [rules] only these
 */
const barriers = async (page, rules) =>
    (await violations(page, rules))
        .filter(({ impact }) => impact === 'serious' || impact === 'critical')
        .map(({ words }) => words);

const ALL = Object.keys(STATES);
/** The states that are checked in other sizes and colours. */
const SOME = ['as it opens', 'mistakes', 'gallery'];

/** @typedef {NonNullable<Parameters<Page['emulateMedia']>[0]>} Media */
/** @type {Media} */
const PLAIN = { colorScheme: 'light', contrast: 'no-preference' };

/**
 * Colours in which a state is looked at besides the plain ones. The page has the same elements and layout in all of
 * them, so only the rules about colours can find something new. @type {{name: string, media: Media, states?: string[]}[]}
 */
const DARK = [{ name: 'dark', media: { ...PLAIN, colorScheme: 'dark' }, states: sampled(ALL, 4) }];
const MORE = [
    { name: 'more contrast', media: { ...PLAIN, contrast: /** @type {const} */ ('more') }, states: SOME },
    {
        name: 'more contrast, dark',
        media: { colorScheme: /** @type {const} */ ('dark'), contrast: /** @type {const} */ ('more') },
        states: SOME,
    },
];

/** @param {Page} page */
const paper = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);

for (const [name, options, colours, states] of some(
    /** @type {[string, import('playwright-core').BrowserContextOptions, typeof DARK, string[]][]} */ ([
        // Each state usually on one of both.
        ['desktop', DESKTOP, [...DARK, ...MORE], sampled(ALL, 2)],
        ['phone', PHONE, DARK.map((dark) => ({ ...dark, states: SOME })), sampled(ALL, 2, 1)],
        ['zoomed to 200 %', { viewport: { width: 640, height: 400 } }, [], SOME],
        [
            'zoomed to 400 %',
            { viewport: { width: 320, height: 256 } },
            [],
            [...SOME, 'refused on the drawing', 'growth'],
        ],
    ]),
    2,
)) {
    test(`axe-core finds no violation: ${[name, ...colours.map((each) => each.name)].join('; ')}`, async () => {
        await withPage({ hash: TREE, options: { ...options, ...PLAIN } }, async (page) => {
            const plain = await paper(page);
            await inStates(page, TREE, states, async (state) => {
                assert.deepEqual(await barriers(page), [], state);
                for (const { name, media, states } of colours) {
                    if (states && !states.includes(state)) continue;
                    await page.emulateMedia(media);
                    assert.notEqual(await paper(page), plain, name);
                    assert.deepEqual(await barriers(page, COLOURS), [], `${state}, ${name}`);
                    await page.emulateMedia(PLAIN);
                }
            });
        });
    });
}

test('axe-core finds no violation: embedded, and in the course page', async () => {
    const address = `${ADDRESS}embed.html`;
    for (const options of some(
        /** @type {import('playwright-core').BrowserContextOptions[]} */ ([
            DESKTOP,
            { ...DESKTOP, colorScheme: 'dark' },
            PHONE,
        ]),
    )) {
        await withPage(
            { address, also: ADDRESS, hash: `${TREE}&controls=n,angle,rules,string,play`, options },
            async (page) => {
                assert.deepEqual(await barriers(page), [], 'as it opens');
                await page.fill('#rules', `${RULES}\nG = = 1`);
                await page.waitForSelector('#rules-problems .error');
                assert.deepEqual(await barriers(page), [], 'mistakes');
                await page.fill('#rules', RULES);
                await page.click('#open-playback');
                await page.click('#open-reader');
                await page.waitForSelector('#reader:visible');
                assert.deepEqual(await barriers(page), [], 'string and playback');
            },
        );
    }
    await withPage({ address: `${ADDRESS}course.html`, also: ADDRESS, drawing: null }, async (page) => {
        assert.deepEqual(await barriers(page), [], 'a course page');
    });
});

for (const viewport of some([
    { width: 320, height: 256 },
    { width: 640, height: 400 },
])) {
    test(`controls on the drawing do not overlap: ${viewport.width} pixels wide`, () =>
        withPage({ hash: TREE, options: { viewport } }, async (page) => {
            await page.fill('#rules', 'A = F');
            await tab('look')(page);
            await page.waitForSelector('#refusal:visible');
            const overlapping = await page.evaluate(() => {
                const boxes = [...document.querySelectorAll('.tools:not([hidden])')]
                    .map((bar) => bar.getBoundingClientRect())
                    .filter(({ width }) => width > 0);
                return boxes.some((a, at) =>
                    boxes
                        .slice(at + 1)
                        .some((b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom),
                );
            });
            assert.ok(!overlapping);
            const [note, stage] = [
                await page.locator('#refusal').boundingBox(),
                await page.locator('#stage').boundingBox(),
            ];
            assert.ok(note && stage && note.y + note.height <= stage.y + stage.height + 1, 'the refusal is readable');
        }));
}

test('the dialog of keys opens with ? and its button, and closes with Escape', () =>
    withPage({ hash: TREE }, async (page) => {
        await page.focus('#rules');
        await page.keyboard.type('?');
        assert.ok(!(await page.isVisible('#shortcuts')), 'a question mark in a text is a text');
        await page.focus('#drawing');
        await page.keyboard.press('?');
        await page.waitForSelector('#shortcuts:visible');
        await page.keyboard.press('Escape');
        assert.ok(!(await page.isVisible('#shortcuts')));
        assert.equal(await page.evaluate(() => document.activeElement?.id), 'drawing');
        await page.click('#open-shortcuts');
        assert.match((await page.textContent('#shortcuts')) ?? '', /Shift.*Alt/s);
        await page.uncheck('#plain-keys');
        await page.click('#close-shortcuts');
        await page.focus('#open-gallery');
        await page.keyboard.press('?');
        await page.keyboard.press('f');
        assert.ok(!(await page.isVisible('dialog[open], .projecting')), 'plain keys are switched off');
        await page.focus('#drawing');
        await page.keyboard.press('?');
        await page.waitForSelector('#shortcuts:visible');
        assert.ok(!(await page.isChecked('#plain-keys')));
        await page.check('#plain-keys');
        await page.keyboard.press('Escape');
        await page.focus('#open-gallery');
        await page.keyboard.press('?');
        await page.waitForSelector('#shortcuts:visible');
    }));

test('every control can be reached and left with the keyboard', () =>
    withPage({ hash: TREE }, async (page) => {
        const reached = new Set();
        await page.focus('#skip');
        for (let press = 0; press < 120; press++) {
            await page.keyboard.press('Tab');
            const id = await page.evaluate(() => {
                const element = document.activeElement;
                return element === document.body || element === null
                    ? ''
                    : element.id ||
                          `${element.tagName} ${element.className} ${element.getAttribute('aria-label') ?? element.textContent}`.slice(
                              0,
                              60,
                          );
            });
            if (id === 'skip' || id === '') break;
            reached.add(id);
        }
        for (const id of [
            'drawing',
            'fit',
            'open-reader',
            'open-playback',
            'open-gallery',
            'open-shortcuts',
            'theme',
            'axiom',
            'rules',
            'iterations-slider',
            'iterations',
            'angle',
            'tab-rules',
            'quick-favourite',
        ]) {
            assert.ok(reached.has(id), `${id} among ${[...reached].join(', ')}`);
        }
        // Arrow keys move between tabs.
        await page.focus('#tab-turtle');
        await page.keyboard.press('ArrowRight');
        assert.equal(await page.evaluate(() => document.activeElement?.id), 'tab-look');
        assert.ok(await page.isVisible('#section-look'));
    }));

test('keys on the drawing do what the dialog of keys says', () =>
    withPage({ hash: TREE }, async (page) => {
        await page.focus('#drawing');
        await page.keyboard.press('ArrowRight');
        assert.equal(await page.inputValue('#angle'), '26');
        await page.keyboard.press('Alt+ArrowLeft');
        assert.equal(await page.inputValue('#angle'), '25.9');
        await page.keyboard.press('ArrowDown');
        assert.equal(await page.inputValue('#iterations'), '4');
        await page.keyboard.press('Shift+ArrowLeft');
        await until(() => page.evaluate(() => location.hash.includes('view=')), 'the picture has moved');
        await page.keyboard.press('0');
        await until(() => page.evaluate(() => !location.hash.includes('view=')), 'it fits again');
        await page.keyboard.press('+');
        await until(async () => /^150/.test((await page.textContent('#zoom')) ?? ''), 'it is zoomed');
        await page.keyboard.press('Space');
        await page.waitForSelector('#playback:visible');
    }));

test('number fields step with the arrows, ten times with Shift, a tenth with Alt', () =>
    withPage({ hash: TREE }, async (page) => {
        await page.focus('#angle');
        for (const [key, value] of [
            ['ArrowUp', '26'],
            ['Shift+ArrowUp', '36'],
            ['Alt+ArrowDown', '35.9'],
            ['Shift+ArrowDown', '25.9'],
        ]) {
            await page.keyboard.press(String(key));
            assert.equal(await page.inputValue('#angle'), value, key);
        }
        await page.focus('#iterations');
        await page.keyboard.press('Shift+ArrowUp');
        assert.equal(await page.inputValue('#iterations'), '15');
    }));

test('a number field with an invalid text says what it expects', () =>
    withPage({ hash: TREE }, async (page) => {
        for (const [id, wrong, words] of [
            ['iterations', '12 times', 'Must be a whole number from 0 to 1,000.'],
            ['angle', 'wide', 'Must be a number.'],
            ['seed', 'NaN', 'Must be a whole number from 0 to 4,294,967,295.'],
        ]) {
            if (id === 'seed') {
                await page.fill('#rules', 'F -> F[+F] : 1\nF -> F : 1');
                await page.waitForSelector('#seed:visible');
            }
            const field = page.locator(`#${id}`);
            await field.fill('');
            assert.equal(await page.locator('.range-note').count(), 0, 'an empty field waits');
            await field.fill(String(wrong));
            assert.equal(await page.locator(`#${await field.getAttribute('aria-errormessage')}`).textContent(), words);
            assert.equal(await field.getAttribute('aria-invalid'), 'true');
            await field.blur();
            assert.equal(await page.locator('.range-note').count(), 0);
            assert.equal(await field.getAttribute('aria-invalid'), 'false');
        }
        await page.click('#tab-rules');
        // A value out of range becomes the nearest value; the note stays until the next change.
        await page.fill('#iterations', '5000');
        await page.locator('#iterations').blur();
        assert.equal(await page.inputValue('#iterations'), '1000');
        assert.equal(
            await page.textContent('.range-note'),
            'Must be a whole number from 0 to 1,000; the nearest value was taken.',
        );
        await page.fill('#iterations', '3');
        assert.equal(await page.locator('.range-note').count(), 0);
    }));

test('results and errors are announced once, after typing has paused', () =>
    withPage(
        {
            hash: TREE,
            before: (page) =>
                page.addInitScript(() => {
                    const said = /** @type {string[]} */ ([]);
                    Object.assign(globalThis, { said });
                    addEventListener('DOMContentLoaded', () => {
                        const region = /** @type {HTMLElement} */ (document.querySelector('#announcer'));
                        new MutationObserver(() => said.push(region.textContent ?? '')).observe(region, {
                            childList: true,
                            characterData: true,
                            subtree: true,
                        });
                    });
                }),
        },
        async (page) => {
            const said = () => page.evaluate(() => /** @type {any} */ (globalThis).said);
            assert.equal(await page.getAttribute('#announcer', 'aria-live'), 'polite');
            await until(
                async () => /lines? after 5 derivation steps/.test((await said()).at(-1) ?? ''),
                'the drawing is told',
            );
            const before = (await said()).length;
            await page.focus('#rules');
            await page.keyboard.press('Control+End');
            await page.keyboard.type('\nG = = 1', { delay: 40 });
            await until(
                async () => /Showing the last valid drawing/.test((await said()).at(-1) ?? ''),
                'the mistake is told',
            );
            assert.equal((await said()).length, before + 1);
        },
    ));

for (const [width, height] of some(
    /** @type {const} */ ([
        [320, 256],
        [320, 640],
        [640, 400],
    ]),
)) {
    test(`nothing is cut off or scrolls sideways at ${width} x ${height}`, () =>
        withPage({ hash: TREE, options: { viewport: { width, height } } }, async (page) => {
            const sideways = () =>
                page.evaluate(() =>
                    [
                        document.scrollingElement,
                        ...document.querySelectorAll('.sections, .section, .shelves, .shortcuts-body'),
                    ]
                        .filter((element) => element && element.scrollWidth > element.clientWidth + 1)
                        .map((element) => `${element?.className}: ${element?.scrollWidth} > ${element?.clientWidth}`),
                );
            assert.deepEqual(await sideways(), []);
            for (const name of ['rules', 'turtle', 'look', 'save']) {
                await tab(name)(page);
                assert.ok(await page.isVisible(`#section-${name}`), name);
                assert.deepEqual(await sideways(), [], name);
                const last = page
                    .locator(`#section-${name} :is(button, input, textarea, select, summary):visible`)
                    .last();
                // Late messages may move the content.
                await until(async () => {
                    await last.scrollIntoViewIfNeeded();
                    const box = await last.boundingBox();
                    return box && box.x >= 0 && box.x + box.width <= width + 1 && box.y >= 0 && box.y < height;
                }, `the last control of ${name} is in sight`);
            }
            for (const opener of ['gallery', 'shortcuts']) {
                await page.locator('#drawing').focus();
                if (opener === 'gallery') await page.click('#open-gallery');
                else await page.keyboard.press('?');
                await page.waitForSelector(`#${opener}:visible`);
                assert.deepEqual(await sideways(), [], opener);
                await page.click(`#close-${opener}`);
            }
        }));
}

test('with forced colours, texts, errors and sliders are visible', () =>
    withPage({ hash: TREE, options: { ...DESKTOP, forcedColors: 'active' } }, async (page) => {
        const colours = () =>
            page.evaluate(() => {
                const style = (/** @type {string} */ name) =>
                    getComputedStyle(/** @type {Element} */ (document.querySelector(name)));
                return {
                    layer: style('[data-editor=rules] > pre').color,
                    area: style('#rules').color,
                    paper: style('body').backgroundColor,
                };
            });
        const { layer, area, paper } = await colours();
        assert.notEqual(layer, paper);
        assert.match(area, /rgba\(0, 0, 0, 0\)/);
        await page.fill('#rules', 'F = = F');
        await page.waitForSelector('[data-editor=rules] .wrong');
        const line = await page
            .locator('[data-editor=rules] .wrong')
            .first()
            .evaluate((element) => getComputedStyle(element).textDecorationLine);
        assert.equal(line, 'underline');
    }));

test('with reduced motion nothing is animated', () =>
    withPage({ hash: TREE, options: { ...DESKTOP, reducedMotion: 'reduce' } }, async (page) => {
        const before = await stillPicture(page);
        await page.click('#zoom-in');
        await until(async () => /^150/.test((await page.textContent('#zoom')) ?? ''), 'it is zoomed');
        assert.notEqual((await nextPicture(page, before)).digest, before.digest);
        const moving = await page.evaluate(
            () => document.getAnimations().filter((animation) => animation.playState === 'running').length,
        );
        assert.equal(moving, 0);
    }));

test('a line that was clicked stays in place while the buttons zoom, so that nothing needs dragging', () =>
    withPage({ hash: '#v=1&axiom=F-F-F-F&rules=F%20-%3E%20F&n=0&angle=90' }, async (page) => {
        const box = await page.locator('#drawing').boundingBox();
        assert.ok(box);
        const pixels = (/** @type {number} */ x, /** @type {number} */ y) =>
            page.locator('#drawing').evaluate(
                (canvas, [x = 0, y = 0]) => {
                    const { width, height } = /** @type {HTMLCanvasElement} */ (canvas);
                    const copy = new OffscreenCanvas(width, height);
                    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (copy.getContext('2d'));
                    context.drawImage(/** @type {HTMLCanvasElement} */ (canvas), 0, 0);
                    const ratio = width / canvas.clientWidth;
                    return new Set(
                        new Uint32Array(context.getImageData(x * ratio - 8, y * ratio - 8, 17, 17).data.buffer),
                    ).size;
                },
                [x, y],
            );
        // The left side of the square, where it is seen.
        const middle = box.height / 2;
        let left = 0;
        for (let x = 60; x < box.width / 2 && left === 0; x += 4) if ((await pixels(x, middle)) > 1) left = x;
        assert.ok(left > 0);
        await page.mouse.click(box.x + left, box.y + middle);
        for (let step = 0; step < 6; step++) {
            const before = await page.textContent('#zoom');
            await page.click('#zoom-in');
            await until(async () => (await page.textContent('#zoom')) !== before, 'the view is nearer');
            await stillPicture(page);
        }
        assert.ok((await pixels(left, middle)) > 1, 'the line is where it was');
        await until(async () => /view=-/.test(page.url()), 'the link has the view');
    }));

for (const [name, options] of some(
    /** @type {[string, import('playwright-core').BrowserContextOptions][]} */ ([
        ['a phone', PHONE],
        ['a small laptop', { viewport: { width: 1280, height: 657 } }],
    ]),
))
    test(`what has the focus is never hidden behind something: ${name}`, () =>
        withPage({ hash: TREE, options }, async (page) => {
            await page.focus('#skip');
            let seen = 0;
            for (let press = 0; press < 120; press++) {
                await page.keyboard.press('Tab');
                const state = await page.evaluate(() => {
                    const element = document.activeElement;
                    if (!element || element === document.body || element.id === 'skip') return null;
                    const box = element.getBoundingClientRect();
                    const shown = [0.1, 0.5, 0.9].some((part) => {
                        const top = document.elementFromPoint(box.x + box.width * part, box.y + box.height / 2);
                        return top !== null && (element.contains(top) || top.contains(element));
                    });
                    // A field of choice may be drawn by its label.
                    const label = element.closest('label') ?? document.querySelector(`label[for="${element.id}"]`);
                    return { shown: shown || label !== null, name: element.id || element.outerHTML.slice(0, 80) };
                });
                if (!state) break;
                seen += 1;
                assert.ok(state.shown, `${state.name} is hidden`);
            }
            assert.ok(seen > 15, `${seen} controls`);
        }));
