/** Exercises whose answer is a program: the page, its sandbox, programs with mistakes, and a class. */

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { GIVEN, GIVEN_PYTHON } from '../../js/programs/given.js';
import { violations } from './axe.mjs';
import { ADDRESS, DESKTOP, PHONE, close, withPage } from './browser.mjs';

after(close);

const EXERCISES = JSON.parse(await readFile(new URL('../../../dist/exercises.json', import.meta.url), 'utf8'));
const codeOf = (/** @type {string} */ id) =>
    EXERCISES.find((/** @type {{id: string}} */ exercise) => exercise.id === id)?.x ?? assert.fail(id);
const ADDRESS_OF = `${ADDRESS}program.html`;
const packed = (/** @type {string} */ language, /** @type {string} */ code) =>
    deflateSync(`${language}\n${code}`).toString('base64url');
const linkOf = (/** @type {string} */ id, /** @type {string} */ language, /** @type {string} */ code) =>
    `#v=1&x=${codeOf(id)}&code=${packed(language, code)}`;
/** The given functions, as a student may write them in JavaScript. */
const SOLUTION = Object.entries(GIVEN)
    .map(([name, made]) => `const ${name} = (${made})(globalThis); globalThis.${name} = ${name};`)
    .join('\n');

/** @typedef {import('playwright-core').Page} Page */

/** Runs the program in the editor, or another one, and returns what is said of it. @param {Page} page @param {string} [code] */
async function run(page, code) {
    if (code !== undefined) await page.fill('#code', code);
    await page.click('#run');
    await page.waitForFunction(() => document.getElementById('result')?.textContent !== '', null, { timeout: 60_000 });
    const asks = page.locator('details[open] .ways button:nth-child(2):visible');
    if (await asks.count()) await asks.first().click();
    return `${await page.textContent('#result')} ${await page.textContent('details[open] .why', { timeout: 500 }).catch(() => '')}`;
}

/** What is said of a function. @param {Page} page @param {string} name */
const toldOf = (page, name) =>
    page.evaluate((name) => {
        const row = [...document.querySelectorAll('.function')].find((one) =>
            one.querySelector('code')?.textContent?.startsWith(`${name}(`),
        );
        const asks = row?.querySelector('.ways button:nth-child(2):not([hidden])');
        if (asks instanceof HTMLElement) asks.click();
        return row?.querySelector('.why')?.textContent ?? '';
    }, name);

/** @param {string} hash @param {(page: Page) => Promise<unknown>} use @param {import('playwright-core').BrowserContextOptions} [options] */
const onPage = (hash, use, options = DESKTOP) =>
    withPage({ address: ADDRESS_OF, also: ADDRESS, hash, drawing: '#functions details', options }, use);

test('the functions of the assignment in JavaScript draw the plant, and the page knows its mark', async () => {
    await onPage(linkOf('assignment-8', 'javascript', SOLUTION), async (page) => {
        assert.match(await run(page), /^Solved/);
        assert.equal(await page.textContent('#plant-words'), 'The same picture, by your own functions.');
        assert.equal(await page.locator('details[data-state=right]').count(), 4);
        assert.deepEqual(await violations(page), []);
        await page.fill('#code', 'function expand(axiom, rules, n) { return axiom; }');
        // It runs again when typing pauses.
        await page.waitForFunction(() => document.getElementById('result')?.textContent?.startsWith('0 of 4'));
        await page.click('#ask-plant');
        await page.waitForFunction(() => document.getElementById('plant-words')?.textContent?.includes('generation 5'));
        await page.reload();
        assert.match(await page.inputValue('#code'), /return axiom/);
    });
});

test('on a phone, keys write brackets and indent, and the link of an exercise leads to the page for programs', async () => {
    const hash = `#v=1&x=${codeOf('practical-1')}`;
    await withPage(
        { address: `${ADDRESS}exercise.html`, also: ADDRESS, hash, drawing: '#functions details', options: PHONE },
        async (page) => {
            assert.match(page.url(), /program\.html/);
            await page.click('#code');
            for (const name of ['[', 'Indent', ':', 'Less indent'])
                await page.click(`.code-keys [aria-label="${name}"]`);
            assert.equal(await page.inputValue('#code'), '[    :');
            await page.keyboard.press('Enter');
            assert.equal(await page.inputValue('#code'), '[    :\n    ');
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
        },
    );
});

/** Programs that try to get out, and what must not come back. */
const ESCAPES = `
const log = [];
const tries = {
    fetch: () => fetch('${ADDRESS}index.html'),
    request: () => { const one = new XMLHttpRequest(); one.open('GET', '${ADDRESS}index.html', false); one.send(); return one.responseText; },
    socket: () => new Promise((yes, no) => { const one = new WebSocket('ws' + '${ADDRESS}'.slice(4)); one.onopen = yes; one.onerror = no; }),
    database: () => new Promise((yes, no) => { const one = indexedDB.open('x'); one.onsuccess = yes; one.onerror = no; }),
    caches: () => caches.open('x'),
    storage: () => localStorage.length,
    parent: () => parent.document,
    message: () => postMessage({ at: -1, own: [] }),
    evaluated: () => eval('1'),
    made: () => new Function('return 1')(),
    script: () => importScripts('${ADDRESS}page.js'),
    module: () => import('${ADDRESS}page.js'),
    prototype: () => WorkerGlobalScope.prototype.importScripts.call(self, '${ADDRESS}page.js'),
};
function told() { return 0; }
`;

test('a program in JavaScript reaches no network, no storage, no page', async () => {
    const task = 'languages: javascript\nheld(name): Tries it.\nheld("x") = "x"';
    const hash = `#v=1&x=${veiled({ title: 'Held', asks: 'program', program: task })}`;
    const names = [...ESCAPES.matchAll(/^ {4}(\w+): \(\)/gm)].map(([, name]) => name);
    await withPage(
        {
            address: ADDRESS_OF,
            also: ADDRESS,
            hash,
            drawing: '#functions details',
            expected: /Content Security Policy|Refused|violates|Failed to load|WebSocket/,
        },
        async (page) => {
            /** @type {string[]} */
            const requests = [];
            page.on('requestfinished', (request) => requests.push(request.url()));
            for (const name of names) {
                await page.fill(
                    '#code',
                    `${ESCAPES}\nlet state = 'held';\ntry { const value = tries['${name}'](); value?.then?.(() => (state = 'out'), () => {}); if (!value?.then) state = 'out'; } catch {}\n` +
                        'function held(name) { const end = performance.now() + 60; while (performance.now() < end); return state; }',
                );
                await page.click('#run');
                await page.waitForFunction(() => document.getElementById('result')?.textContent !== '');
                const got = await page.textContent('details .calls tbody tr td:last-child').catch(() => '');
                assert.notEqual(got, '"out"', name);
            }
            assert.deepEqual(
                requests.filter((url) => /^https?:|^wss?:/.test(url)),
                [],
            );
        },
    );
});

test('endless loops, much output and many calls end in words, and the next program runs', async () => {
    await onPage(`#v=1&x=${codeOf('assignment-8')}`, async (page) => {
        await page.selectOption('#language', 'javascript');
        const head = 'function expandSymbol(symbol, rules) {\n';
        for (const [body, words] of /** @type {[string, RegExp][]} */ ([
            ['for (;;);}', /ended after 5 seconds/],
            ['for (;;) console.log("x".repeat(1e4));}', /Line 2: The program prints too much/],
            ['return expandSymbol(symbol, rules);}', /Line 2: The function calls itself/],
            ['return "x".repeat(2 ** 29);}', /too large/],
            ['return rules[symbol}', /^Line 2: This is not written/],
            ['return rule[symbol];}', /Line 2: The name rule/],
            ['rules[symbol] ??= symbol; return rules[symbol];}', /changes what it is given/],
            // It speaks in the harness's place: what it says is no result.
            [
                "DedicatedWorkerGlobalScope.prototype.postMessage.call(self, { at: 0, value: '{', printed: 5, fault: 3 }); return symbol;}",
                /^0 of 4/,
            ],
            ['return rules[symbol] ?? symbol;}', /^1 of 4/],
        ]))
            assert.match(await run(page, head + body), words, body);
    });
});

/** The functions of an exercise without a set; each must make "FF" of "F". */
const COUNT = 20;
const OWN = Array.from({ length: COUNT }, (_, at) => `f${at}(word): The word twice.\nf${at}("F") = "FF"`).join('\n');
/** Bodies of functions in Python with mistakes, and what is said. @type {[string, RegExp][]} */
const BODIES = [
    ['return nope', /Line \d+: The name nope/],
    ['print("FF")', /prints its result/],
    ['word.upper()', /gives nothing back/],
    ['return list(word)', /a list, and a text/],
    ['return 3', /a number, and a text/],
    ['return {"A": "B"}[word]', /Line \d+: The dictionary has no entry 'F'/],
    ['return word[1]', /Line \d+: The list is shorter/],
    ['return f7(word)', /Line \d+: The function calls itself/],
    ['return "a" * 10 ** 9', /Line \d+: The program takes too much memory/],
    ['while True: print(word * 9999)', /Line \d+: The program prints too much/],
    ['return word + 1', /Line \d+: Values of these kinds/],
    ['return word.length', /Line \d+: A value has not/],
    ['return 1 / 0', /Line \d+: Something is divided/],
    ['out += word; out = ""', /Line \d+: The name out is used before/],
    ['return {1, 2}', /Values of these kinds/],
    ['return int(word)', /Line \d+: A value is not as it must be/],
    ['return len(3)', /Line \d+: Values of these kinds/],
    ['return word + "G"', /Symbol 2 is the first that differs/],
    ['return None + word', /Line \d+: A value is missing/],
    ['return f0()', /Line \d+: A function is called with too few/],
];
/** Programs that do not begin, and what is said. @type {[string, RegExp][]} */
const BROKEN = [
    ['def f0(word)\n    return word', /^Line 1: This is not written/],
    ['def f0(word):\nreturn word', /^Line 2: The indentation/],
    ['def f0(word):\n    if word:\n\treturn word', /^Line 3: Tabs and blanks/],
    ['import turtle_of_others', /^Line 1: An error: No module/],
    ['word = input()', /^Line 1: The program waits for input/],
    ['while True:\n    pass', /ended after 5 seconds/],
];
/** The turtle, with one part in place of another. @param {string} from @param {string} to */
function turtle(from, to) {
    const found = /def axiomtoline2d[^]*?return lines\n/.exec(GIVEN_PYTHON)?.[0] ?? assert.fail();
    assert.ok(found.includes(from), from);
    return found.replace(from, to);
}
/** Functions of practical 1 with mistakes, and what is said. @type {[string, RegExp][]} */
const MISTAKES = [
    ['def derivation(word, rules):\n    return "".join(rules.get(s, "") for s in word)', /without a rule are lost/],
    [
        'def derivation(word, rules):\n    for s in rules:\n        word = word.replace(s, rules[s])\n    return word',
        /one after another/,
    ],
    [
        'def derivation(word, rules):\n    rules["F"] = "F"\n    return "".join(rules.get(s, s) for s in word)',
        /changes what it is given/,
    ],
    ['def derivation(word, rules):\n    for s in word:\n        return rules.get(s, s)', /Symbol \d+ is the first/],
    [
        'def generation(axiom, rules, n):\n    for i in range(n + 1):\n        axiom = axiom if not rules else "".join(rules.get(s, s) for s in axiom)\n    return axiom',
        /one step more/,
    ],
    [
        'def generation(axiom, rules, n):\n    for i in range(1, n):\n        axiom = "".join(rules.get(s, s) for s in axiom)\n    return axiom',
        /one step less/,
    ],
    ['def degreetorad(angle):\n    return angle * 180 / math.pi', /The name math/],
    ['import math\ndef degreetorad(angle):\n    return angle * 180 / math.pi', /degrees of radians/],
    [
        'def multmat(a, b):\n    return [[sum(x[r] * y for x, y in zip(b, c)) for r in range(len(b[0]))] for c in a]',
        /other order/,
    ],
    ['def multmatvector(m, v):\n    return [sum(a * b for a, b in zip(c, v)) for c in m]', /Rows and columns/],
    ['import math\ndef r2d(a):\n    return [[math.cos(a), math.sin(a)], [-math.sin(a), math.cos(a)]]', /take radians/],
    [
        'import math\ndef r2d(a):\n    a = math.radians(a)\n    return [[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]]',
        /clockwise/,
    ],
    [
        'import math\ndef move2d(p, a, d):\n    a = math.radians(a)\n    return [p[0] + d * math.sin(a), p[1] + d * math.cos(a)]',
        /Sine and cosine/,
    ],
    ['def move2d(p, a, d):\n    p[0] += d\n    return p', /changes what it is given/],
    [
        turtle('heading += left', 'heading -= left').replace('heading -= right', 'heading += right'),
        /Line 2 is the first/,
    ],
    [turtle('position, heading = stack.pop()', 'stack.pop()'), /After \]|do nothing/],
    [turtle('position, heading = stack.pop()', 'position, _ = stack.pop()'), /After \]/],
    [turtle('lines.append([position, end])', 'lines = [[position, end]]'), /Line 1 is the first/],
    [turtle('            position = end\n', ''), /Line 2 is the first/],
    [turtle('return lines', 'return None'), /gives nothing back/],
];
const nameOf = (/** @type {string} */ code) => /def (\w+)/.exec(code)?.[1] ?? '';

/** Mistakes of different functions that others use, too, each in a program with only those that it does not disturb. */
function programsOf() {
    /** @type {[string, RegExp][][]} */
    const programs = [];
    const rank = ['degreetorad', 'multmatvector', 'r2d', 'move2d'];
    for (const mistake of MISTAKES) {
        const name = nameOf(mistake[0]);
        const fits = (/** @type {[string, RegExp][]} */ program) =>
            program.every(([code]) => nameOf(code) !== name && !(rank.includes(nameOf(code)) && rank.includes(name))) &&
            !(/^axiom|^r2d|^move2d/.test(name) && program.some(([code]) => rank.includes(nameOf(code))));
        const place = programs.find(fits);
        if (place) place.push(mistake);
        else programs.push([mistake]);
    }
    return programs;
}

test('programs in Python with mistakes are told what is wrong, and the right one solves the exercise', async () => {
    const task = `languages: python\n${OWN}\nset: practical-1`;
    const own = veiled({ title: 'Twice', asks: 'program', program: task });
    await onPage(`#v=1&x=${own}`, async (page) => {
        const code = BODIES.map(([body], at) => `def f${at}(word):\n    ${body}\n`).join('');
        await run(page, code);
        for (const [at, [body, words]] of BODIES.entries()) assert.match(await toldOf(page, `f${at}`), words, body);
        for (const [broken, words] of BROKEN) assert.match(await run(page, broken), words, broken);
        // The module that reaches the worker reaches nothing else, and says nothing for the program.
        const forged = 'import js\njs.postMessage(js.Object.new())\njs.fetch("index.html")';
        assert.match(await run(page, forged), /^0 of 28/);
        for (const program of programsOf()) {
            await run(page, program.map(([code]) => code).join('\n'));
            for (const [code, words] of program) assert.match(await toldOf(page, nameOf(code)), words, code);
        }
        assert.match(await run(page, GIVEN_PYTHON), /^8 of 28/);
        await page.click('#measure');
        await page.waitForSelector('.times-plot');
    });
});

/** An exercise as in links. @param {object} exercise */
function veiled(exercise) {
    const bytes = Buffer.from(JSON.stringify(exercise));
    const veil = Buffer.from('Lindenmayer 1968');
    return deflateSync(bytes.map((byte, at) => byte ^ (veil[at % veil.length] ?? 0))).toString('base64url');
}

test('a class is marked in the page, each program alone', async () => {
    const x = codeOf('assignment-8');
    const spoils = 'globalThis.expand = 1; Array.prototype.map = () => []; String.prototype.split = null;\n';
    const answers = [SOLUTION, spoils, 'function expand(a, r, n) { for (;;); }', SOLUTION].map(
        (code, at) => `Student ${at},${ADDRESS}program.html#v=1&x=${x}&code=${packed('javascript', code)}`,
    );
    await withPage({}, async (page) => {
        await page.click('#tab-save');
        await page.click('#mark-answers');
        await page.fill('#marks-answers', answers.join('\n'));
        await page.waitForFunction(
            () => /of 4 solved/.test(document.getElementById('marks-status')?.textContent ?? ''),
            null,
            { timeout: 60_000 },
        );
        assert.match((await page.textContent('#marks-status')) ?? '', /2 of 4 solved/);
        const words = await page.locator('#class-marks tbody td:nth-child(8)').allTextContents();
        assert.match(words[2] ?? '', /ended after 5 seconds/);
        assert.match(words[3] ?? '', /4 of 4/);
    });
});
