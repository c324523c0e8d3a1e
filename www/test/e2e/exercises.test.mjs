/** Exercises: made, done, handed in; the lesson; programs checked. */

import assert from 'node:assert/strict';
import { mkdtemp, copyFile, readFile, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { sampled, some } from '../effort.mjs';
import { ADDRESS, DESKTOP, PHONE, close, stillPicture, until, withPage } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('playwright-core').Frame} Frame */

after(close);

const DIST = new URL('../../../dist/', import.meta.url);
/** @type {{id: string, shelf: string, title: string, x: string}[]} */
const EXERCISES = JSON.parse(await readFile(new URL('exercises.json', DIST), 'utf8'));

/** @param {string} id */
const codeOf = (id) => EXERCISES.find((exercise) => exercise.id === id)?.x ?? assert.fail(id);
/** @param {string} id */
const linkOf = (id) => `exercise.html#v=1&x=${codeOf(id)}`;

/** @param {Page | Frame} page @param {RegExp} words */
const marked = (page, words) =>
    until(async () => words.test((await page.textContent('#mark-words')) ?? ''), `the mark says ${words}`);

/** The answers of a student to the exercises of the gallery: the rules, and other fields. @type {Record<string, {rules: string, iterations?: string}>} */
const ANSWERS = {
    'left-plant': { rules: 'F -> F[+F]F' },
    crossout: { rules: 'F -> F-FF+F+FF-F' },
    hexerode: { rules: 'F -> F-F++F-F' },
    'flower-plant': { rules: 'T -> F[-T][+T]\nF -> FF' },
    algae: { rules: 'B -> A\nA -> AB' },
    koch: { rules: 'F -> F+F--F+F' },
    thousand: { rules: 'F -> FFFFF[FFFFF]' },
    weed: { rules: 'F -> F[+F]F[-F]F' },
    dragon: { rules: 'F -> F+G\nG -> F-G' },
    twigs: { rules: 'X -> F[+X]F[-X]+X' },
    islands: { rules: 'F -> F+F-f-F+F' },
    hilbert: { rules: 'L -> +RF-LFL-FR+\nR -> -LF+RFR+FL-', iterations: '5' },
    'late-fern': { rules: 'A -> F[+B][-B]A\nB -> C\nC -> A' },
    'random-weed': { rules: 'F -> F[+F]F : 1\nF -> F[+F]F[-F]F : 1' },
    signal: { rules: 'B < A -> B\nB -> A' },
    'trim-hedge': {
        rules: 'shape hedge = box(-3, 0, -1, 3, 4, 1)\n?P(x,y) < A : inside(hedge, x, y) -> F[+?P(0,0)A][-?P(0,0)A]?P(0,0)A',
    },
};

for (const [name, options] of some(
    /** @type {const} */ ([
        ['a desktop', DESKTOP],
        ['a phone', PHONE],
    ]),
)) {
    test(`every exercise of the gallery can be solved on ${name}`, () =>
        withPage({ address: ADDRESS, hash: linkOf('left-plant'), options }, async (page) => {
            const listed = EXERCISES.filter(({ shelf }) => !['lesson', 'program'].includes(shelf));
            assert.equal(listed.length, 16);
            for (const { id, title } of name === 'a phone' ? listed.slice(0, 4) : sampled(listed, 3)) {
                const answer = ANSWERS[id] ?? assert.fail(id);
                await page.goto('about:blank');
                await page.goto(ADDRESS + linkOf(id));
                await page.waitForSelector('#mark:visible');
                assert.equal(await page.textContent('#exercise-title'), title);
                await marked(page, /\S/);
                assert.equal(await page.locator('#mark.solved').count(), 0, id);
                await page.fill('#rules', answer.rules);
                if (answer.iterations) await page.fill('#iterations', answer.iterations);
                await page.waitForSelector('#mark.solved');
                // Chance draws another weed than the target's, which is as good.
                assert.match(
                    (await page.textContent('#mark-percent')) ?? '',
                    id === 'random-weed' ? /^\d\d\.\d %$/ : /^100\.0 %$/,
                );
            }
        }));
}

test('an answer that is begun has strokes as thin as the target', () =>
    withPage({ address: ADDRESS, hash: linkOf('koch') }, async (page) => {
        for (const id of ['koch', 'dragon', 'weed', 'twigs']) {
            await page.goto('about:blank');
            await page.goto(ADDRESS + linkOf(id));
            await page.waitForSelector('#mark:visible');
            await page.fill('#rules', id === 'twigs' ? 'X -> F' : 'F -> F');
            await marked(page, /\S/);
            const { ink } = await stillPicture(page);
            assert.ok(ink > 0 && ink < 0.04, `${id}: ${ink} of the picture is ink`);
        }
    }));

test('a wrong answer gets a hint, the differences, and a link that keeps it', () =>
    withPage(
        {
            address: ADDRESS,
            hash: linkOf('hexerode'),
            options: { ...DESKTOP, permissions: ['clipboard-read', 'clipboard-write'] },
        },
        async (page) => {
            await page.fill('#rules', 'F -> F+F--F+F');
            await marked(page, /of the ink agrees/);
            await page.click('#ask-why');
            await until(
                async () => /The first segment is right/.test((await page.textContent('#mark-why')) ?? ''),
                'a hint',
            );
            await page.check('#show-differences', { force: true });
            const colours = await page.evaluate(() => {
                const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById('target-differences'));
                const { data } = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d')).getImageData(
                    0,
                    0,
                    512,
                    512,
                );
                return new Set(new Uint32Array(data.buffer)).size;
            });
            assert.ok(colours >= 3, 'nothing, missing, too much');
            assert.match((await page.textContent('#ask-hint')) ?? '', /Hint 1 of 3/);
            await page.click('#ask-hint');
            assert.equal(await page.locator('#hints li').count(), 1);
            await page.fill('#student-name', 'Ada & Co');
            await page.click('#hand-in');
            const link = await page.evaluate(() => navigator.clipboard.readText());
            assert.match(link, /rules=F%20-%3E%20F%2BF--F%2BF&by=Ada%20%26%20Co$/);
            await page.reload();
            await page.waitForSelector('#mark:visible');
            assert.equal(await page.inputValue('#rules'), 'F -> F+F--F+F');
            await page.goto('about:blank');
            await page.goto(link);
            await page.waitForSelector('#mark:visible');
            assert.deepEqual(
                [await page.inputValue('#rules'), await page.inputValue('#student-name')],
                ['F -> F+F--F+F', 'Ada & Co'],
            );
        },
    ));

/** Solves the Koch curve and hands the answer in; the link has exercise, answer and name. @param {Page} page @param {Page | Frame} [where] */
async function handsIn(page, where = page) {
    await where.fill('#rules', 'F -> F+F--F+F');
    await where.waitForSelector('#mark.solved');
    await where.fill('#student-name', 'Ada');
    await where.click('#hand-in');
    await until(
        async () => /Your answer is copied/.test((await where.textContent('#toast')) ?? ''),
        'the answer is copied',
    );
    const link = await page.evaluate(() => navigator.clipboard.readText());
    assert.match(link, /exercise\.html#v=1&x=[\w-]+&rules=F%20-%3E%20F%2BF--F%2BF&by=Ada$/);
    assert.ok(link.includes(codeOf('koch')));
}

/** @type {import('playwright-core').BrowserContextOptions} */
const CLIPBOARD = { permissions: ['clipboard-read', 'clipboard-write'] };

test('an answer is handed in on a phone', () =>
    withPage({ address: ADDRESS, hash: linkOf('koch'), options: { ...PHONE, ...CLIPBOARD } }, (page) => handsIn(page)));

test('an answer is handed in from an exercise in another page', () =>
    withPage(
        { address: ADDRESS, hash: 'docs/about.html', drawing: null, options: { ...DESKTOP, ...CLIPBOARD } },
        async (page) => {
            await page.evaluate((source) => {
                const frame = document.createElement('iframe');
                frame.src = source;
                frame.allow = 'clipboard-write';
                frame.style.cssText = 'width: 900px; height: 800px';
                document.body.prepend(frame);
            }, ADDRESS + linkOf('koch'));
            const frame = await until(
                async () => page.frames().find((frame) => frame.url().includes('exercise.html')),
                'the frame',
            );
            await frame.waitForSelector('#mark:visible');
            await handsIn(page, frame);
        },
    ));

for (const [name, options] of some(
    /** @type {const} */ ([
        ['a phone', PHONE],
        ['a desktop', DESKTOP],
    ]),
)) {
    test(`an exercise is made on ${name}, and hides what is to be found`, () =>
        withPage(
            { hash: '#v=1&title=Weed&axiom=X&rules=X%20-%3E%20F%5B%2BX%5D-X%0AF%20-%3E%20FF&n=4&angle=25', options },
            async (page) => {
                await page.click('#tab-save');
                await page.click('#make-exercise');
                await page.fill(
                    '#maker-task',
                    'Find **one** rule. <img src=x onerror=alert(1)> [More](https://example.org/)',
                );
                await page.fill('#maker-hints', 'Look at the tips.\nTwo `X` at most.');
                await page.selectOption('select[name=line-1]', 'hidden');
                await page.selectOption('select[name=n]', 'hidden');
                await page.fill('#maker-symbols', '8');
                // The dialog grows by the link, which moves what is above.
                await page.waitForSelector('#maker-made:visible');
                await page.check('#maker-answer');
                const before = await page.inputValue('#maker-link');
                await page.fill('#maker-title', 'A weed to find');
                const link = await until(async () => {
                    const now = await page.inputValue('#maker-link');
                    return now !== before ? now : '';
                }, 'a new link');
                assert.ok(!/FF|%5B|X%20/.test(link));
                await page.waitForSelector('#maker-qr:visible');
                // A stroke around the modules would fill the gaps between them.
                assert.equal(
                    await page.locator('#maker-qr path').evaluate((path) => getComputedStyle(path).stroke),
                    'none',
                );
                assert.match(await page.inputValue('#maker-code'), /<l-system link="#v=1&amp;x=/);
                await page.goto(link);
                await page.waitForSelector('#mark:visible');
                assert.deepEqual(
                    await page
                        .locator('#exercise-task')
                        .evaluate((task) => [
                            task.querySelectorAll('strong').length,
                            task.querySelectorAll('img').length,
                            task.querySelector('a')?.href,
                        ]),
                    [1, 0, 'https://example.org/'],
                );
                assert.match((await page.textContent('#given-hidden')) ?? '', /the iterations, some rules/);
                assert.ok(!(await page.isVisible('#open-reader')), 'the string would tell');
                assert.equal(await page.inputValue('#rules'), '');
                assert.ok(!((await page.getAttribute('#open', 'href')) ?? '').includes('FF'));
                await page.fill('#rules', 'X -> F[+X]-X+-');
                await marked(page, /10 symbols; at most 8/);
                assert.ok(!(await page.isVisible('#answer')));
                await page.fill('#rules', 'X -> F[+X]-X');
                await marked(page, /Solved/);
                await page.waitForSelector('#answer:visible');
                assert.match((await page.textContent('#answer-rules')) ?? '', /F -> FF/);
            },
        ));
}

test('the meaning of the symbols can be asked for', () =>
    withPage({ hash: '#v=1&axiom=A&rules=A%20-%3E%20A%2BA&n=3&angle=60&turtle=every-letter' }, async (page) => {
        await page.click('#tab-save');
        await page.click('#make-exercise');
        await page.waitForSelector('#maker-made:visible');
        const before = await page.inputValue('#maker-link');
        await page.selectOption('select[name=line-0]', 'shown');
        await page.selectOption('select[name=turtle]', 'free');
        await page.goto(
            await until(async () => {
                const now = await page.inputValue('#maker-link');
                return now !== before ? now : '';
            }, 'a new link'),
        );
        await page.waitForSelector('#meaning:visible');
        assert.ok(!(await page.isVisible('#rules')), 'no rule is to be found');
        assert.equal(await page.locator('#mark.solved').count(), 0);
        await page.selectOption('#dialect', 'every-letter');
        await marked(page, /Solved/);
        assert.match(page.url(), /turtle=every-letter/);
        await page.selectOption('#dialect', 'abop');
        await page.fill('#overrides', 'A: draw');
        await marked(page, /Solved/);
    }));

test('strings stand beside each other, with what differs', () =>
    withPage({ address: ADDRESS, hash: linkOf('algae') }, async (page) => {
        await page.fill('#rules', 'A -> AB\nB -> B');
        await until(async () => (await page.textContent('#own-text')) === 'ABBBBBBB', 'the own string');
        assert.match((await page.textContent('#target-text')) ?? '', /^ABAABABA/);
        assert.equal(await page.textContent('#own-text mark'), 'BBBBBB');
        await page.fill('#rules', 'A -> AB\nB -> A');
        await marked(page, /Solved/);
        assert.equal(await page.locator('#own-text mark').count(), 0);
    }));

test('the lesson works from a disk', () =>
    withPage({ address: new URL('course.html', DIST).href, also: DIST.href, drawing: null }, async (page) => {
        await page.click('#onward');
        await page.frameLocator('.step.now iframe').locator('#rules').fill('F -> FF');
        await until(async () => /Done/.test((await page.textContent('#told')) ?? ''), 'the first step is done');
    }));

test('what a program printed is compared with the system', () =>
    withPage({ hash: '#v=1&axiom=A&rules=A%20-%3E%20AB%0AB%20-%3E%20A&n=4' }, async (page) => {
        await page.click('#tab-save');
        await page.click('#check-program');
        await page.fill('#check-output', 'ABAABABA');
        await page.waitForSelector('#check-result.agrees');
        await page.fill('#check-output', 'ABAABBBA');
        await page.waitForSelector('#check-result.differs');
        assert.match((await page.textContent('#check-result')) ?? '', /symbol 6/i);
        await page.click('#check-show');
        await page.waitForSelector('#reader:visible');
        await until(
            async () => /A at step 4, by rule 1/.test((await page.textContent('#reader')) ?? ''),
            'the string is open there',
        );
        await page.click('#close-reader');
        await page.click('#tab-save');
        await page.click('#check-program');
        await page.setInputFiles('#check-file', {
            name: 'out.txt',
            mimeType: 'text/plain',
            buffer: Buffer.from('ABAABABA\n'),
        });
        await page.waitForSelector('#check-result.agrees');
    }));

test('saved pictures can leave the system out', () =>
    withPage({ hash: '#v=1&axiom=F&rules=F%20-%3E%20F%2BF&n=3&angle=77' }, async (page) => {
        await page.click('#tab-save');
        for (const [bare, expected] of [
            [false, true],
            [true, false],
        ]) {
            await page.click('#open-save');
            await page.setChecked('#option-bare', Boolean(bare));
            await page.click('#save-cancel');
            for (const format of ['svg', 'png']) {
                const [saved] = await Promise.all([page.waitForEvent('download'), page.click(`[data-save=${format}]`)]);
                assert.equal((await readFile(await saved.path(), 'latin1')).includes('F+F'), expected, format);
            }
        }
    }));

test('damaged exercises are refused in words', () =>
    withPage(
        { address: ADDRESS, hash: `exercise.html#v=1&x=${codeOf('koch').slice(0, -9)}`, drawing: null },
        async (page) => {
            await page.waitForSelector('#mistake:visible');
            assert.match((await page.textContent('#mistake')) ?? '', /The exercise is damaged or cut off/);
        },
    ));

test('links of exercises open on their page, whatever page they name', () =>
    withPage({ address: ADDRESS, hash: `embed.html#v=1&x=${codeOf('koch')}`, drawing: null }, async (page) => {
        await page.waitForURL(/exercise\.html/);
        await page.waitForSelector('#mark:visible');
    }));

test('exercises work from a disk', async () => {
    const folder = await mkdtemp(join(tmpdir(), 'on a stick ü '));
    try {
        await copyFile(new URL('exercise.html', DIST), join(folder, 'exercise.html'));
        const address = pathToFileURL(join(folder, 'exercise.html')).href;
        await withPage({ address, hash: `#v=1&x=${codeOf('koch')}`, options: { ...DESKTOP, ...CLIPBOARD } }, (page) =>
            handsIn(page),
        );
    } finally {
        await rm(folder, { recursive: true });
    }
});

for (const [name, options] of some(
    /** @type {const} */ ([
        ['a desktop', DESKTOP],
        ['a phone', PHONE],
    ]),
)) {
    test(`the lesson is walked through on ${name}, and keeps its place`, () =>
        withPage({ address: ADDRESS, hash: 'course.html', drawing: null, options }, async (page) => {
            /** @type {[string, string][]} */
            const fills = [
                ['#rules', 'F -> FF'],
                ['#rules', 'F -> F+F--F+F'],
                ['#rules', 'F -> F[+F]F[-F]F'],
                ['#rules', 'X -> F[+X][-X]FX'],
                ['#angle', '36'],
                ['#iterations', '4'],
                ['#rules', 'F -> F[+F]F : 0.5\nF -> F[-F]F : 0.5'],
                ['#rules', 'B < A -> B'],
                ['#rules', 'A(x) -> F(x)[+A(x*0.65)][-A(x*0.65)]'],
                ['#rules', 'A -> F[&A]////[&A]////[&A]'],
                ['#rules', "F -> F['!+F]F['!-F]F"],
                ['#rules', 'X -> F[+X]F[-X]X\nF -> FF'],
            ];
            await page.click('#onward');
            for (const [at, [field, text]] of fills.entries()) {
                assert.match((await page.textContent('.step.now h2')) ?? '', new RegExp(`^${at + 1}\\. `));
                const frame = page.frameLocator('.step.now iframe');
                await frame.locator(field).fill(text);
                await frame.locator(field).press('Tab');
                await until(async () => /Done/.test((await page.textContent('#told')) ?? ''), `step ${at + 1} is done`);
                if (at < fills.length - 1) await page.click('#onward');
            }
            assert.equal(await page.locator('.places .done').count(), 12);
            await page.goto('about:blank');
            await page.goto(`${ADDRESS}course.html`);
            assert.match((await page.textContent('.step.now h2')) ?? '', /^12\. /);
        }));
}

test('only rules are offered as something to find', () =>
    withPage(
        { hash: '#v=1&axiom=A&rules=%2F%2F%20words%0AA%20-%3E%20AA%0Adraw%3A%0AA%20-%3E%20F&n=3&angle=60' },
        async (page) => {
            await page.click('#tab-save');
            await page.click('#make-exercise');
            await page.waitForSelector('#maker-made:visible');
            assert.deepEqual(await page.locator('#maker-given code').allInnerTexts(), ['A', 'A -> AA', 'A -> F']);
        },
    ));

test('an exercise on a page of its own leads home', () =>
    withPage({ address: ADDRESS, hash: linkOf('koch') }, async (page) => {
        assert.ok(await page.isVisible('.home'));
        assert.equal(
            new URL((await page.getAttribute('.home', 'href')) ?? '', page.url()).href,
            new URL('.', ADDRESS).href,
        );
    }));
