import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { PHONE, close, until, withPage } from './browser.mjs';

after(close);

/** @typedef {import('playwright-core').Page} Page */

/** Opens the gallery and waits for its cards; those of the exercises come last. @param {Page} page */
async function open(page) {
    await page.click('#open-gallery');
    await page.waitForSelector('#gallery .card');
    await page.waitForSelector('#gallery a.card[href^="exercise.html#"]', { state: 'attached' });
}

/** @param {Page} page */
const shown = (page) => page.locator('#gallery .card:visible').count();
/** @param {Page} page */
const titles = (page) => page.locator('#gallery .card:visible .card-title').allTextContents();
/** @param {Page} page @param {string} name */
const chip = (page, name) => page.locator('.chip', { hasText: name });

test('shelves say what one sees, the simple systems first', () =>
    withPage({}, async (page) => {
        await open(page);
        const names = [
            'Start here',
            'Trees',
            'Flowers and leaves',
            'Curves',
            'Tilings',
            'Stars',
            'In space',
            'Plants that look around',
            'By chance',
            'Signals',
            'Books and courses',
            'Exercises',
        ];
        assert.deepEqual(await page.locator('#shelves h3').allTextContents(), names);
        assert.deepEqual(
            await page.locator('.chip').evaluateAll((chips) => chips.map((each) => each.firstChild?.textContent)),
            names,
        );
        const first = page.locator('.shelf').first().locator('.card');
        assert.ok((await first.count()) >= 6 && (await first.count()) <= 8);
        assert.equal(await first.first().locator('.card-title').textContent(), 'Koch snowflake');
        assert.equal(await first.first().locator('.card-kind').textContent(), 'Helge von Koch, 1904');
        await first.first().hover();
        assert.equal(await page.textContent('#about-title'), 'Koch snowflake');
        assert.match((await page.textContent('#about-source')) ?? '', /^Helge von Koch, Sur une courbe/);
        const entries = await page.evaluate(async () => (await fetch('gallery.json')).json());
        assert.equal(await page.locator('#gallery .card[data-path]').count(), entries.length);
        const all = await page.locator('#gallery .card').count();
        assert.equal(await page.locator('#gallery a.card[href^="exercise.html#"]').count(), all - entries.length);
        assert.equal(await page.textContent('#found'), `${all} systems`);
    }));

test('filters are combined, and replaced where they would find nothing', () =>
    withPage({}, async (page) => {
        await open(page);
        const all = await shown(page);
        await chip(page, 'Trees').click();
        const trees = await shown(page);
        assert.equal(await chip(page, 'Trees').locator('.chip-count').textContent(), String(trees));
        assert.equal(await page.textContent('#found'), `${trees} of ${all} systems`);
        const both = Number(await chip(page, 'In space').locator('.chip-count').textContent());
        await chip(page, 'In space').click();
        assert.ok(both > 8 && both < trees);
        assert.equal(await shown(page), both);
        await chip(page, 'Tilings').click();
        assert.deepEqual(
            await page
                .locator('.chip[aria-pressed="true"]')
                .evaluateAll((chips) => chips.map((each) => each.firstChild?.textContent)),
            ['Tilings'],
        );
        assert.ok((await titles(page)).includes('Penrose tiling'));
        await chip(page, 'Tilings').click();
        assert.equal(await shown(page), all);
    }));

test('a search reads names, notes and rules, not sources, and can be cleared', () =>
    withPage({}, async (page) => {
        await open(page);
        const all = await shown(page);
        await page.fill('#search', 'F[+F]');
        const branching = await titles(page);
        assert.ok(
            branching.includes('Feathered weed') && branching.includes('Left plant') && branching.length < all / 4,
            String(branching),
        );
        await page.fill('#search', 'penrose');
        assert.deepEqual(await titles(page), ['Penrose tiling']);
        // The author of half of the sources, and no word of the gallery.
        for (const source of ['Prusinkiewicz', 'zzz']) {
            await page.fill('#search', source);
            await page.waitForSelector('#no-results:visible');
            assert.equal(await page.textContent('#nothing-found'), 'No results.');
        }
        await page.click('#clear-search');
        assert.equal(await shown(page), all);
        assert.equal(await page.inputValue('#search'), '');
        assert.equal(await page.evaluate(() => document.activeElement?.id), 'search');
        assert.ok(await page.isHidden('#no-results'));
        // Filters are cleared as well.
        await chip(page, 'Signals').click();
        await page.fill('#search', 'snowflake');
        assert.ok((await titles(page)).includes('Koch snowflake'), 'found on another shelf');
        await chip(page, 'Curves').click();
        await page.fill('#search', 'zzz');
        await page.waitForSelector('#no-results:visible');
        await page.click('#clear-search');
        assert.equal(await shown(page), all);
    }));

test('every card has a picture or says why it has none', () =>
    withPage({}, async (page) => {
        await open(page);
        const cards = page.locator('#gallery .card');
        for (let at = 0; at < (await cards.count()); at += 5) await cards.nth(at).scrollIntoViewIfNeeded();
        await cards.last().scrollIntoViewIfNeeded();
        const states = () =>
            cards.evaluateAll((all) =>
                all.map((card) => ({
                    path: card.getAttribute('data-path'),
                    inked: card.querySelector('.thumb.inked') !== null,
                    why: card.querySelector('.card-missing:not([hidden])')?.textContent ?? '',
                })),
            );
        await until(
            async () => (await states()).every(({ inked, why }) => inked !== (why !== '')),
            'all cards are done',
        );
        const without = (await states()).filter(({ inked }) => !inked);
        const systems = without.filter(({ path }) => path !== null);
        assert.deepEqual(
            systems.map(({ path }) => path),
            ['focs-lsystems/readme-s-to-ss.json', 'turtle-blog/lri-prose-rule.json'],
        );
        for (const { why } of systems) assert.equal(why, 'No symbol of this system draws.');
        // Exercises that ask for a string show it.
        for (const { path, why } of without) if (path === null) assert.match(why, /^[AB]+$/);
    }));

test('on a phone the first shelf is in sight and a tap opens a system', () =>
    withPage({ options: PHONE }, async (page) => {
        await page.tap('#open-gallery');
        await page.waitForSelector('#gallery .card');
        for (const card of await page.locator('.shelf >> nth=0 >> .card').all()) {
            const box = await card.boundingBox();
            assert.ok(box && box.x >= 0 && box.x + box.width <= 390 && box.y + box.height <= 844, JSON.stringify(box));
        }
        await page.locator('.card', { hasText: 'Lime twig' }).tap();
        await until(async () => (await page.textContent('#caption-title')) === 'Lime twig', 'it is opened');
    }));

test('a chip shows its shelf from the beginning, and a search that finds nothing there looks on all shelves', () =>
    withPage({}, async (page) => {
        await open(page);
        await page.evaluate(() => document.querySelector('#shelves')?.scrollTo(0, 900));
        await chip(page, 'Trees').click();
        assert.equal(await page.evaluate(() => document.querySelector('#shelves')?.scrollTop), 0);
        await page.fill('#search', 'Hilbert');
        assert.ok((await titles(page)).includes('Hilbert curve'));
        assert.equal(await chip(page, 'Trees').getAttribute('aria-pressed'), 'false');
    }));

for (const width of some([900, 390, 1280, 1100]))
    test(`no card is alone in the last row of a shelf: ${width} pixels wide`, () =>
        withPage({ options: { viewport: { width, height: 700 } } }, async (page) => {
            await open(page);
            const alone = await page.evaluate(
                () =>
                    [...document.querySelectorAll('#gallery .cards')].filter((shelf) => {
                        const tops = [...shelf.children].map((card) => card.getBoundingClientRect().top);
                        return tops.length > 1 && tops.filter((top) => top === tops.at(-1)).length === 1;
                    }).length,
            );
            assert.equal(alone, 0);
        }));

test('the foot of the gallery takes no room, and lies over the cards while a system is pointed at', () =>
    withPage({}, async (page) => {
        await open(page);
        assert.ok(!(await page.isVisible('#gallery-about')));
        const height = () => page.evaluate(() => document.querySelector('#shelves')?.clientHeight);
        const before = await height();
        await page.hover('#gallery .card >> nth=0');
        assert.ok(await page.isVisible('#gallery-about'));
        assert.equal(await height(), before);
    }));

test('the first surprises are ready, without the tool that makes others', () =>
    withPage({ before: (page) => page.route('**/tools-*.wasm', (route) => route.abort()) }, async (page) => {
        const titles = new Set();
        for (let press = 0; press < 4; press++) {
            const before = await page.textContent('#specimen-title');
            await page.click('#surprise');
            await until(async () => (await page.textContent('#specimen-title')) !== before, 'a new system');
            titles.add(await page.inputValue('#rules'));
        }
        assert.equal(titles.size, 4);
        assert.equal(await page.getAttribute('#surprise', 'aria-busy'), null);
    }));

test('a surprise opens a new system, and undo goes back', () =>
    withPage({}, async (page) => {
        const rules = () => page.inputValue('#rules');
        const first = await rules();
        await page.click('#surprise');
        await until(async () => (await rules()) !== first, 'a new system');
        const second = await rules();
        await page.click('#surprise');
        await until(async () => (await rules()) !== second, 'another one');
        await page.waitForSelector('#refusal', { state: 'hidden' });
        await page.click('#undo');
        assert.equal(await rules(), second);
        await page.click('#undo');
        assert.equal(await rules(), first);
    }));

/** The pixels of the moving picture on a card, as a short text; null if there is none. @param {import('playwright-core').Locator} card */
const frame = (card) =>
    card.evaluate((element) => {
        const moving = element.querySelector('.thumb.moving.inked');
        if (!(moving instanceof HTMLCanvasElement)) return null;
        const copy = document.createElement('canvas');
        copy.width = copy.height = 64;
        copy.getContext('2d')?.drawImage(moving, 0, 0, 64, 64);
        return copy.toDataURL();
    });

test('plants to start with grow under the pointer and with the focus, and stand still again', () =>
    withPage({ options: { viewport: { width: 1280, height: 800 }, reducedMotion: 'no-preference' } }, async (page) => {
        await open(page);
        for (const title of ['Forked tree', 'Koch snowflake']) {
            const card = page.locator('.card', { hasText: title }).first();
            await card.locator('.thumb.inked').waitFor();
            const seen = new Set();
            await card.hover();
            await until(async () => seen.add(await frame(card)).size > 4, `${title} moves`);
            await page.mouse.move(2, 2);
            assert.equal(await card.locator('.moving').count(), 0);
            assert.equal(await card.locator('.thumb.inked').count(), 1);
        }
        // What a line has grown to is its still picture.
        const line = page.locator('.card', { hasText: 'Koch snowflake' }).first();
        await line.hover();
        await until(async () => (await line.locator('.moving').count()) === 0, 'it has grown');
        const first = page.locator('.shelf').first().locator('.card');
        await page.locator('.chip').last().focus();
        await page.keyboard.press('Tab');
        assert.ok(await first.first().evaluate((card) => card === document.activeElement));
        assert.equal(await first.first().locator('.moving').count(), 1);
        await page.keyboard.press('Tab');
        assert.equal(await first.first().locator('.moving').count(), 0);
        assert.equal(await first.nth(1).locator('.moving').count(), 1);
        // Other shelves stand still.
        await page.locator('.shelf').nth(1).locator('.card').first().hover();
        assert.equal(await page.locator('.shelf').nth(1).locator('.moving').count(), 0);
    }));

test('with reduced motion nothing moves in the gallery', () =>
    withPage({}, async (page) => {
        await open(page);
        const card = page.locator('.card', { hasText: 'Forked tree' }).first();
        await card.hover();
        assert.ok(await page.isVisible('#gallery-about'), 'the card is pointed at');
        assert.equal(await card.locator('.moving').count(), 0);
    }));
