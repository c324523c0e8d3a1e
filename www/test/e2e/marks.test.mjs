/** Answers of a class: marked in the page, and variants of an exercise. */

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { ADDRESS, DESKTOP, PHONE, close, until, withPage } from './browser.mjs';

after(close);

/** @type {{id: string, x: string}[]} */
const EXERCISES = JSON.parse(await readFile(new URL('../../../dist/exercises.json', import.meta.url), 'utf8'));
const KOCH = EXERCISES.find(({ id }) => id === 'koch')?.x ?? assert.fail('koch');

/** @param {string} rules @param {string} by */
const answer = (rules, by) =>
    `https://example.org/exercise.html#v=1&x=${KOCH}&rules=${encodeURIComponent(rules)}&by=${by}`;

for (const [name, options] of some(
    /** @type {const} */ ([
        ['a desktop', DESKTOP],
        ['a phone', PHONE],
    ]),
)) {
    test(`answers of a class are marked on ${name}`, () =>
        withPage({ options }, async (page) => {
            await page.click('#tab-save');
            await page.click('#mark-answers');
            const rows = [
                'name,link',
                `Ada,${answer('F -> F+F--F+F', 'Ada')}`,
                `Emmy,${answer('F -> F+F--FF', 'Emmy')}`,
                `Grace,${answer('F -> F+F--FF', 'Grace')}`,
                `Alan,${answer('F -> F(', 'Alan')}`,
                `"<b>Kurt</b>, G.",${answer('F -> F-F++F-F', 'x')}`,
            ];
            await page.fill('#marks-answers', rows.join('\n'));
            await until(
                async () => /1 of 5 solved/.test((await page.textContent('#marks-status')) ?? ''),
                'all are marked',
            );
            const names = () =>
                page.$$eval('#marks-result tbody tr:not([hidden]) td:first-child', (cells) =>
                    cells.map((cell) => cell.textContent),
                );
            assert.deepEqual(await names(), ['Ada', 'Emmy', 'Grace', 'Alan', '<b>Kurt</b>, G.']);
            assert.equal(await page.locator('#marks-result b').count(), 0, 'names are text');
            assert.match(
                (await page.textContent('#marks-mistakes')) ?? '',
                /2 of 5 A turn is missing in the rule of F\./,
            );
            await page.click('#marks-mistakes button');
            assert.deepEqual(await names(), ['Emmy', 'Grace']);
            await page.click('#marks-mistakes button');
            await page.click('.sorts:has-text("Name")');
            assert.deepEqual((await names())[1], 'Ada');
            await page.selectOption('#marks-shown', 'yes');
            assert.deepEqual(await names(), ['Ada']);
            await page.selectOption('#marks-shown', '');
            await page.fill('#marks-search', 'f++');
            assert.deepEqual(await names(), ['<b>Kurt</b>, G.']);
            const inks = await page.$$eval('#marks-result canvas', (all) =>
                all.map((canvas) => {
                    const context = canvas instanceof HTMLCanvasElement ? canvas.getContext('2d') : null;
                    return new Set(new Uint32Array(context?.getImageData(0, 0, 128, 128).data.buffer ?? [])).size;
                }),
            );
            assert.ok(inks.length >= 4 && Math.max(...inks) === 4, `${inks}`);
            const [file] = await Promise.all([page.waitForEvent('download'), page.click('#marks-save')]);
            const table = await readFile(await file.path(), 'utf8');
            assert.match(table, /^\ufeffname,by,solved,/);
            assert.equal(table.trim().split('\n').length, 6);
            const edges = await page.evaluate(() => {
                const dialog = document.getElementById('class-marks')?.getBoundingClientRect();
                return [dialog?.left ?? -1, (dialog?.right ?? 1e9) - innerWidth];
            });
            assert.ok((edges[0] ?? -1) >= 0 && (edges[1] ?? 1) <= 0, `${edges}`);
        }));
}

test('what is no answer is told', () =>
    withPage({}, async (page) => {
        await page.click('#tab-save');
        await page.click('#mark-answers');
        for (const [text, words] of /** @type {const} */ ([
            ['nothing of use', /no link of an exercise/],
            ['https://example.org/exercise.html#v=1&x=AAAA', /The exercise is damaged/],
        ])) {
            await page.fill('#marks-answers', text);
            await until(async () => words.test((await page.textContent('#marks-status')) ?? ''), String(words));
        }
        await page.fill('#marks-exercise', `#v=1&x=${KOCH}`);
        await page.fill('#marks-answers', 'A table\nwithout links');
        await until(
            async () => /There is no answer/.test((await page.textContent('#marks-status')) ?? ''),
            'no answer',
        );
    }));

test('each student gets a variant by name, and the answers are marked by it', () =>
    withPage(
        { hash: '#v=1&axiom=X&rules=X%20-%3E%20F%5B%2BX%5DF%5B-X%5D%2BX%0AF%20-%3E%20FF&n=3&angle=20' },
        async (page) => {
            await page.click('#tab-save');
            await page.click('#make-exercise');
            await page.check('#maker-varied input[value=mirrored]');
            await page.check('#maker-varied input[value=angle]');
            await until(
                async () => /^\d\d targets/.test((await page.textContent('#maker-variants')) ?? ''),
                'the number of targets',
            );
            const link = await until(async () => {
                const now = await page.inputValue('#maker-link');
                return now !== '' && (await page.locator('#maker-made:visible').count()) > 0 ? now : null;
            }, 'the link');
            /** @type {Set<string>} */
            const variants = new Set();
            const answers = [];
            for (const student of ['Ada', 'Emmy', 'Sophie', 'Grace']) {
                await page.goto('about:blank');
                await page.goto(link);
                await page.fill('#variant-name', student);
                assert.equal(await page.locator('#rules:visible').count(), 0, 'first the name');
                await page.click('.variant-form button');
                await page.waitForSelector('#mark:visible');
                const words = (await page.textContent('#variant')) ?? '';
                assert.match(words, new RegExp(`Variant \\d+ of \\d+, for ${student}`));
                variants.add(words.replace(/,.*/, ''));
                // One of the two ways round solves it, at the angle that is given.
                const rules = ['X -> F[+X]F[-X]+X\nF -> FF', 'X -> F[-X]F[+X]-X\nF -> FF'];
                const percent = () => page.textContent('#mark-percent');
                const blank = await until(percent, 'the mark of no rules');
                await page.fill('#rules', rules[0] ?? '');
                const isSolved = async () => (await page.locator('#mark.solved').count()) > 0;
                await until(async () => (await percent()) !== blank, 'the mark of the first way');
                if (!(await isSolved())) await page.fill('#rules', rules[1] ?? '');
                await page.waitForSelector('#mark.solved');
                answers.push(page.url());
            }
            assert.ok(variants.size > 1, [...variants].join());
            await page.goto('about:blank');
            await page.goto(ADDRESS);
            await page.click('#tab-save');
            await page.click('#mark-answers');
            await page.fill('#marks-answers', answers.join('\n'));
            await until(
                async () => /4 of 4 solved/.test((await page.textContent('#marks-status')) ?? ''),
                'all solve their variants',
            );
            assert.match((await page.textContent('#marks-result thead')) ?? '', /Variant$/);
        },
    ));
