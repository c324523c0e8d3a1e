/** Derivations and turtles step by step, and what the mathematics says. */

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { ADDRESS, DESKTOP, PHONE, close, until, withPage } from './browser.mjs';

after(close);

const ALGAE = '#v=1&axiom=A&rules=A%20-%3E%20AB%0AB%20-%3E%20A&n=6&turtle=every-letter';

/** @param {import('playwright-core').Page} page */
const parents = (page) => page.locator('.family .parent').allTextContents();
/** @param {import('playwright-core').Page} page @param {RegExp} words */
const says = (page, words) =>
    until(async () => words.test((await page.textContent('#steps-words')) ?? ''), `the bar says ${words}`);

for (const [name, options] of some(
    /** @type {const} */ ([
        ['a desktop', DESKTOP],
        ['a phone', PHONE],
    ]),
)) {
    test(`each symbol stands above what it becomes on ${name}`, () =>
        withPage({ hash: ALGAE, options }, async (page) => {
            await page.locator('#open-steps').scrollIntoViewIfNeeded();
            await page.click('#open-steps');
            await says(page, /Generation 0: 1 symbols/);
            assert.deepEqual(await parents(page), ['A']);
            for (const expected of ['AB', 'ABA', 'ABAAB']) {
                await page.click('#steps-on');
                await until(async () => (await parents(page)).join('') === expected, expected);
            }
            assert.deepEqual(
                await page.locator('.family').evaluateAll((all) => all.map((each) => each.getAttribute('aria-label'))),
                ['A becomes AB', 'B becomes A', 'A becomes AB', 'A becomes AB', 'B becomes A'],
            );
            await page.locator('.family').first().focus();
            await page.keyboard.press('ArrowRight');
            assert.match(
                (await page.textContent('#steps-told')) ?? '',
                /^B is symbol 2 of generation 3\. It becomes symbol 3 of generation 4\.$/,
            );
            await page.keyboard.press('Escape');
            assert.ok(!(await page.isVisible('#steps')));
        }));
}

test('rows are read anywhere in a generation that nothing could hold', () =>
    withPage({ hash: '#v=1&axiom=F&rules=F%20-%3E%20F%2BF--F%2BF&n=40&angle=60' }, async (page) => {
        await page.click('#open-steps');
        await says(page, /Generation 0/);
        await page.fill('#steps-at', '40');
        await says(page, /Generation 40: [\d,]{20,} symbols/);
        await page.click('#steps-later');
        await until(
            async () => /Symbols 61 to 120/.test((await page.textContent('#steps-told')) ?? ''),
            'the next symbols',
        );
        assert.equal((await parents(page)).length, 60);
    }));

test('one symbol at a time is another way of rewriting', () =>
    withPage(
        {
            address: ADDRESS,
            hash: 'embed.html#v=1&axiom=S&rules=S%20-%3E%20SS&n=4&turtle=every-letter&controls=n,steps',
        },
        async (page) => {
            await page.waitForURL(/exercise\.html/);
            await page.click('#open-steps');
            await page.check('#steps-single');
            await says(page, /16 symbols all at once, 5 one at a time/);
            assert.deepEqual(await page.locator('#steps-table td:nth-child(2)').allTextContents(), [
                '1',
                '2',
                '4',
                '8',
                '16',
            ]);
            assert.deepEqual(await page.locator('#steps-table td:nth-child(4)').allTextContents(), [
                '1',
                '2',
                '3',
                '4',
                '5',
            ]);
            await page.selectOption('#steps-order', 'rightmost');
            await until(
                async () =>
                    (await page.textContent('#steps-table tr.now mark')) === 'SS' &&
                    /^SSSSS$/.test((await page.textContent('#steps-table tr.now td:nth-child(5)')) ?? ''),
                'the last one is replaced',
            );
        },
    ));

test('the turtle is followed symbol by symbol', () =>
    withPage({ hash: '#v=1&axiom=F%5B%2BF%5DF&n=0&angle=90' }, async (page) => {
        await page.click('#open-steps');
        await page.check('#steps-turtle');
        await says(page, /1 of 6 symbols read/);
        await page.click('#steps-on');
        await page.click('#steps-on');
        assert.match((await page.textContent('#steps-state')) ?? '', /Heading180°Stack1: \(0, 1\)/);
        await page.locator('#steps-string .symbol').nth(5).click();
        assert.match((await page.textContent('#steps-state')) ?? '', /SymbolF.*Position\(0, 2\)Heading90°Stackempty/);
        await page.click('#steps-back');
        await page.click('#steps-play');
        await says(page, /6 of 6/);
        await until(async () => (await page.textContent('#steps-play')) === 'Play', 'it ends');
        // Whoever has just moved the slider sees it move on.
        await page.focus('#steps-at');
        await page.keyboard.press('Home');
        await says(page, /0 of 6/);
        await page.evaluate(() => document.getElementById('steps-play')?.click());
        await says(page, /6 of 6/);
        assert.equal(await page.evaluate(() => document.activeElement?.id), 'steps-at');
    }));

test('what cannot be shown says why', () =>
    withPage({ hash: '#v=1&axiom=A(1)&rules=A(x)%20-%3E%20F(x)A(x)&n=3' }, async (page) => {
        await page.click('#open-steps');
        await page.check('#steps-single');
        await until(
            async () => /need all symbols at once/.test((await page.textContent('#steps-problem')) ?? ''),
            'why',
        );
        await page.check('#steps-rows');
        await says(page, /Generation 0/);
        assert.equal(await page.textContent('#steps-problem'), '');
        await page.click('#close-steps');
        await page.click('#mathematics summary');
        await until(async () => /have parameters/.test((await page.textContent('#math-words')) ?? ''), 'why');
        assert.ok(!(await page.isVisible('#math-known')));
    }));

test('the mathematics is told in words, a plot, a matrix, a table and files', () =>
    withPage({ hash: ALGAE }, async (page) => {
        await page.click('#mathematics summary');
        await until(
            async () => /\(1 \+ √5\)\/2, about 1\.618/.test((await page.textContent('#math-words')) ?? ''),
            'the golden section',
        );
        assert.equal(await page.locator('#math-plot polyline').count(), 2);
        assert.deepEqual(await page.locator('#math-matrix td').allTextContents(), ['', '1', '1', '1', '0']);
        assert.match((await page.textContent('#math-table tr.now')) ?? '', /^62121/);
        const [saved] = await Promise.all([page.waitForEvent('download'), page.click('#math-csv')]);
        assert.match(
            await readFile(await saved.path(), 'utf8'),
            /^n,symbols,segments,width,height,length,turning_degrees,"A","B"\n0,1,1,/,
        );
        await page.fill('#rules', 'A -> AA');
        await until(async () => /by 2\./.test((await page.textContent('#math-words')) ?? ''), 'it follows');
    }));

test('the keys of the slider go from one generation to the next', () =>
    withPage({ hash: ALGAE }, async (page) => {
        await page.click('#open-steps');
        await says(page, /Generation/);
        await page.focus('#steps-at');
        await page.keyboard.press('Home');
        await says(page, /^Generation 0:/);
        assert.ok(await page.isDisabled('#steps-back'));
        await page.keyboard.press('ArrowRight');
        await says(page, /^Generation 1:/);
        assert.ok(await page.isEnabled('#steps-back'));
    }));
