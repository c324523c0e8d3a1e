/** Systems of other programs and of papers: pasted, dropped and opened. */

import assert from 'node:assert/strict';
import { readFile, readdir } from 'node:fs/promises';
import test, { after } from 'node:test';
import { sampled, some } from '../effort.mjs';
import { DESKTOP, PHONE, answered, close, quiet, until, withPage } from './browser.mjs';

after(close);

/** @typedef {import('playwright-core').Page} Page */

const FRACTINT = `; a file
Koch1 { ; a curve
  Angle 6
  Axiom F--F--F
  F=F+F--F+F
}
Dragon { Angle 4
  Axiom FX
  X=X+YF+
  Y=-FX-Y
}
Odd { Angle 8
  Axiom F+D\\30D
  D=D
}`;
const PROSE =
    'Fractal plant\nvariables : X F\nconstants : + − [ ]\nstart : X\nrules : (X → F+[[X]-X]-F[-FX]+X), (F → FF)\nangle : 25°';

/** @param {Page} page @param {string} selector */
const text = async (page, selector) => (await page.textContent(selector)) ?? '';

/** Pastes text into an element, or into the page. @param {Page} page @param {string} selector @param {string} pasted */
async function paste(page, selector, pasted) {
    await page.evaluate(
        ([where = '', words = '']) => {
            const target = /** @type {HTMLElement} */ (document.querySelector(where));
            target.focus();
            const data = new DataTransfer();
            data.setData('text/plain', words);
            const event = new ClipboardEvent('paste', { clipboardData: data, bubbles: true, cancelable: true });
            if (target.dispatchEvent(event) && target instanceof HTMLTextAreaElement)
                document.execCommand('insertText', false, words);
        },
        [selector, pasted],
    );
}

for (const [device, options] of some(
    /** @type {const} */ ([
        ['phone', PHONE],
        ['desktop', DESKTOP],
    ]),
)) {
    test(`a pasted description is offered, opened, and one undo away: ${device}`, () =>
        withPage({ options }, async (page) => {
            const before = await page.inputValue('#rules');
            await paste(page, '#drawing', PROSE);
            await page.waitForSelector('#import[open]');
            assert.match(await text(page, '#h-import'), /a description/);
            assert.equal(await text(page, '#import-name'), 'Fractal plant');
            await until(() => page.isVisible('.import .thumb.inked'), 'a picture');
            await page.click('#import-open');
            await until(
                async () => (await page.inputValue('#rules')) === 'X -> F+[[X]-X]-F[-FX]+X\nF -> FF',
                'the system is open',
            );
            assert.equal(await page.inputValue('#angle'), '25');
            await page.click('#undo');
            assert.equal(await page.inputValue('#rules'), before);
        }));
}

test('a whole system pasted into the rules is offered, and may stay a text', () =>
    withPage({}, async (page) => {
        await paste(page, '#rules', FRACTINT);
        await page.waitForSelector('#import-offer:visible');
        assert.match(await text(page, '#import-what'), /looks like Fractint \(3 systems\)/);
        await page.click('#import-dismiss');
        assert.match(await page.inputValue('#rules'), /Koch1/);
        await page.fill('#rules', '');
        await paste(page, '#rules', FRACTINT);
        await page.click('#import-accept');
        await page.waitForSelector('#import[open]');
        await page.keyboard.press('Escape');
        assert.ok(!(await page.isVisible('#import')));
    }));

test('readers that do not load are told, and loaded with the next text', () =>
    withPage({ expected: /tools-first\.wasm|Failed to load/ }, async (page) => {
        await page.route(/tools-first\.wasm$/, (route) => route.abort());
        await paste(page, '#drawing', PROSE);
        await until(async () => /did not load/.test(await text(page, '#toast')), 'the reason');
        await page.unroute(/tools-first\.wasm$/);
        await paste(page, '#drawing', PROSE);
        await page.waitForSelector('#import[open]');
    }));

test('a file of many systems is a list of pictures, and says what cannot be opened', () =>
    withPage({}, async (page) => {
        await page.setInputFiles('#file', { name: 'old.l', mimeType: 'text/plain', buffer: Buffer.from(FRACTINT) });
        await page.waitForSelector('#import[open]');
        assert.equal(await page.locator('#import-cards .card').count(), 3);
        await until(async () => (await page.locator('#import-cards .thumb.inked').count()) === 2, 'two pictures');
        await page.click('#import-cards .card >> text=Odd');
        assert.ok(await page.isDisabled('#import-open'));
        assert.match(await text(page, '#import-parts'), /Line 13.*one heading/s);
        await page.click('#import-cards .card >> text=Dragon');
        await page.click('#import-open');
        await until(async () => (await page.inputValue('#axiom')) === 'FX', 'the dragon is open');
    }));

test('the account shows what became of every part, and pointing at one shows the other', () =>
    withPage({}, async (page) => {
        await paste(page, '#drawing', `${PROSE}\nWritten in a hurry, on paper.\nn = 4`);
        await page.waitForSelector('#import[open]');
        assert.match(await text(page, '#import-source'), /^variables|Fractal plant/);
        const rule = page.locator('#import-source mark.read', { hasText: 'F → FF' });
        await rule.hover();
        assert.equal(await text(page, '#import-parts .pointed'), 'F -> FF');
        await page.locator('#import-parts li', { hasText: 'angle 25' }).hover();
        assert.match(await text(page, '#import-source .pointed'), /25/);
        assert.match(await text(page, '#import-parts .noted >> nth=-1'), /Line 7.*not understood/s);
    }));

test('our own JSON opens where it is pasted, and other words are answered', () =>
    withPage({}, async (page) => {
        await paste(page, '#drawing', '{"initial": "A", "rules": {"A": "A+A"}, "angle_deg": 33, "num_iters": 3}');
        await until(async () => (await page.inputValue('#angle')) === '33', 'the system is open');
        assert.ok(!(await page.isVisible('#import')));
        await paste(page, '#drawing', 'Nothing to be seen here, dear reader.');
        await until(async () => /No L-system was found/.test(await text(page, '#toast')), 'an answer');
    }));

/** Lets the page load its readers. @param {Page} page */
async function loadReaders(page) {
    await paste(page, '#drawing', PROSE);
    await page.waitForSelector('#import[open]');
    await page.click('#import-cancel');
}

test('rules of our own and ordinary text stay texts', () =>
    withPage({}, async (page) => {
        await loadReaders(page);
        for (const pasted of ['F -> F[+F]F', 'A < B > C -> D\nr = 0.9', 'The course begins on Monday.']) {
            await page.fill('#rules', '');
            await paste(page, '#rules', pasted);
            await answered(page);
            assert.ok(!(await page.isVisible('#import-offer')), pasted);
        }
    }));

test('every case of the readers opens or is refused in the page', () =>
    withPage({}, async (page) => {
        await loadReaders(page);
        const folder = new URL('../../../crates/lsystem/tests/data/import/', import.meta.url);
        const texts = await Promise.all((await readdir(folder)).map((name) => readFile(new URL(name, folder), 'utf8')));
        const cases = texts
            .flatMap((text) => text.split('=== ').slice(1))
            .map((each) => {
                const [given = '', read = ''] = each.split('--- read\n');
                const [title = '', ...lines] = given.split('\n');
                const expected = read.trim() === 'nothing' ? 'nothing' : /, n \d+/.test(read) ? 'opened' : 'refused';
                return { title, text: lines.join('\n').trimEnd(), expected, isOurs: read.startsWith('our own JSON') };
            })
            // Our own files open without the dialog.
            .filter(({ expected, isOurs }) => !(isOurs && expected === 'opened'));
        // Native tests read all of them.
        const chosen = sampled(cases, 4);
        // All of it runs in the page: the driver's part would take longer than the page's.
        const became = await page.evaluate(async (all) => {
            const element = (/** @type {string} */ name) => /** @type {HTMLElement} */ (document.querySelector(name));
            const dialog = /** @type {HTMLDialogElement} */ (element('#import'));
            const frame = () => new Promise(requestAnimationFrame);
            /** Waits for frames until this is so. @param {() => boolean} check */
            const so = async (check) => {
                const begun = performance.now();
                do await frame();
                while (!check() && performance.now() - begun < /** @type {any} */ (globalThis).deadline);
                return check();
            };
            const found = [];
            for (const { title, text, expected } of all) {
                element('#drawing').focus();
                const data = new DataTransfer();
                data.setData('text/plain', text);
                element('#drawing').dispatchEvent(
                    new ClipboardEvent('paste', { clipboardData: data, bubbles: true, cancelable: true }),
                );
                await frame();
                // A text too short to be read asks nothing.
                await so(() => (expected === 'nothing' || dialog.open) && /** @type {any} */ (globalThis).asked === 0);
                let what = 'nothing';
                if (dialog.open) {
                    const button = /** @type {HTMLButtonElement} */ (element('#import-open'));
                    what = button.disabled ? 'refused' : 'opened';
                    element(button.disabled ? '#import-cancel' : '#import-open').click();
                    const rests = await so(
                        () => !dialog.open && element('#stage').getAttribute('aria-busy') !== 'true',
                    );
                    if (!rests) what = 'stays';
                    if (document.querySelector('#rules-problems .error')) what = 'has errors';
                }
                found.push({ title, what });
            }
            return found;
        }, chosen);
        assert.deepEqual(
            became,
            chosen.map(({ title, expected }) => ({ title, what: expected })),
        );
        const opened = became.filter(({ what }) => what === 'opened').length;
        assert.ok(opened >= chosen.length / 3, `${opened} opened`);
    }));

test('an offer for pasted text is alone: no mistakes of the text, on the drawing or in the controls', () =>
    withPage({}, async (page) => {
        await loadReaders(page);
        await page.fill('#rules', '');
        /** Whether a mistake was ever in sight. */
        await page.evaluate(() => {
            const site = /** @type {any} */ (globalThis);
            site.mistakes = 0;
            const look = () => {
                for (const name of ['#rules-problems li', '#refusal', '#rules-problems'])
                    for (const element of document.querySelectorAll(name))
                        if (element.getBoundingClientRect().height > 0) site.mistakes += 1;
                requestAnimationFrame(look);
            };
            look();
        });
        await paste(page, '#rules', FRACTINT);
        await page.waitForSelector('#import-offer:visible');
        await until(async () => (await page.locator('#rules-problems li').count()) > 0, 'the mistakes are known');
        await quiet(1200, 'a mistake would be shown on the drawing after a pause');
        assert.equal(await page.evaluate(() => /** @type {any} */ (globalThis).mistakes), 0);
        await page.click('#import-dismiss');
        assert.ok(await page.isVisible('#rules-problems li'), 'they are mistakes of a text that stays');
        await paste(page, '#rules', FRACTINT);
        await page.waitForSelector('#import-offer:visible');
        await page.focus('#rules');
        await page.keyboard.type('F');
        await page.waitForSelector('#import-offer', { state: 'hidden' });
        assert.ok(await page.isVisible('#rules-problems li'));
    }));

test('our own JSON is offered where it is pasted into a field', () =>
    withPage({}, async (page) => {
        await page.fill('#rules', '');
        await paste(page, '#rules', '{"initial": "A", "rules": {"A": "A+A"}, "angle_deg": 33, "num_iters": 3}');
        await page.click('#import-accept');
        await page.click('#import-open');
        await until(async () => (await page.inputValue('#angle')) === '33', 'the system is open');
    }));

test('a description without a heading has no title, and its minus signs raise no warning', () =>
    withPage({}, async (page) => {
        await paste(page, '#drawing', PROSE.split('\n').slice(1).join('\n'));
        await page.waitForSelector('#import[open]');
        assert.equal(await text(page, '#import-name'), 'Untitled system');
        await page.click('#import-cancel');
        await page.fill('#rules', 'F -> F[+F]F[\u2212F]F');
        await until(async () => /, 3,125 segments/.test(await text(page, '#caption-text')), 'it is drawn');
        assert.equal(await text(page, '#rules-problems'), '');
        await page.fill('#rules', 'F -> F[\u2795F]F[\u2212F]F');
        await until(async () => /U\+2795/.test(await text(page, '#rules-problems')), 'other characters are told');
        assert.equal(await page.locator('#rules-problems li').count(), 1);
    }));

test('a pasted text that is too long to be read is answered', () =>
    withPage({}, async (page) => {
        await paste(page, '#drawing', 'F'.repeat((1 << 20) + 1));
        await until(async () => /more than 1 MB/.test(await text(page, '#toast')), 'an answer');
    }));
