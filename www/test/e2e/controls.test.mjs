import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { PHONE, close, drag, nextPicture, picture, ready, stillPicture, until, withPage } from './browser.mjs';

after(close);

const RULES = '// lengths\nr = .9 \nb = 2*r\n#define a 40\nA(l) : l > 0.1 -> F(l)[+(a)A(l*r)][-(b)A(l*r)]';
const TREE = `#v=1&title=Tree&axiom=A(1)&rules=${encodeURIComponent(RULES)}&n=5&angle=25`;

/** @param {import('playwright-core').Page} page @param {string} name */
const dial = (page, name) =>
    page.locator('#constants .dial').filter({ has: page.locator('label', { hasText: new RegExp(`^${name}$`) }) });
/** @param {import('playwright-core').Page} page */
const constantRows = async (page) => (await page.locator('#constants .dial').allTextContents()).join('|');

test('named constants have sliders that edit the value in the rules', () =>
    withPage({ hash: TREE }, async (page) => {
        const before = await stillPicture(page);
        await page.waitForSelector('#constants:visible');
        assert.equal(await page.locator('#constants .dial').count(), 3);
        assert.equal(await dial(page, 'r').locator('.number').inputValue(), '0.9');
        assert.equal(await dial(page, 'b').locator('output').textContent(), '1.8');
        assert.equal(await dial(page, 'b').locator('input').count(), 0);
        // The caret keeps its place in the text, though the text before it becomes longer.
        await page.evaluate(
            (at) => /** @type {HTMLTextAreaElement} */ (document.querySelector('#rules')).setSelectionRange(at, at),
            RULES.indexOf('A(l)'),
        );
        await dial(page, 'r')
            .locator('input[type=range]')
            .evaluate((element) => (element.id = 'r-slider'));
        await drag(page, '#r-slider', [100, 110, 120, 125]);
        const text = RULES.replace('.9 ', '.625 ');
        await until(
            async () => (await page.inputValue('#rules')) === text,
            'the value stands in the text, written as before',
        );
        assert.equal(
            await page.evaluate(
                () => /** @type {HTMLTextAreaElement} */ (document.querySelector('#rules')).selectionStart,
            ),
            text.indexOf('A(l)'),
        );
        await until(
            async () => (await dial(page, 'b').locator('output').textContent()) === '1.25',
            'what is computed from it follows',
        );
        assert.equal(await dial(page, 'r').locator('.number').inputValue(), '0.625');
        assert.notEqual((await nextPicture(page, before)).digest, before.digest);
        await until(() => page.evaluate(() => location.hash.includes('.625')), 'the address follows');
        // A whole drag is one undo step.
        await page.click('#undo');
        assert.equal(await page.inputValue('#rules'), RULES);
        await until(async () => (await dial(page, 'r').locator('.number').inputValue()) === '0.9', 'the field is back');
        await until(async () => (await picture(page)).digest === before.digest, 'the drawing is back');
        await page.click('#redo');
        assert.equal(await page.inputValue('#rules'), text);
    }));

test('editing the rules moves the sliders and their ranges', () =>
    withPage({ hash: TREE }, async (page) => {
        await page.waitForSelector('#constants:visible');
        const slider = dial(page, 'a').locator('input[type=range]');
        assert.equal(await slider.getAttribute('aria-valuetext'), 'a = 40');
        assert.equal(await slider.getAttribute('max'), '80');
        await page.fill('#rules', RULES.replace('40', '500'));
        await until(async () => (await slider.getAttribute('aria-valuetext')) === 'a = 500', 'the slider follows');
        const at = Number(await slider.inputValue()) / Number(await slider.getAttribute('max'));
        assert.ok(at > 0.45 && at < 0.55, String(at));
        await page.fill('#rules', RULES.replace('40', '-7.5'));
        await until(async () => (await slider.getAttribute('aria-valuetext')) === 'a = -7.5', 'below zero, too');
        // The number field, with its arrow keys.
        const field = dial(page, 'a').locator('.number');
        await field.focus();
        await page.keyboard.press('ArrowUp');
        assert.match(await page.inputValue('#rules'), /#define a -7\.45\n/);
        await field.fill('12');
        assert.match(await page.inputValue('#rules'), /#define a 12\n/);
        assert.equal(await page.evaluate(() => document.activeElement?.className), 'number');
        await page.fill('#rules', 'F -> FF');
        await until(async () => !(await page.isVisible('#constants')), 'without constants there is nothing to slide');
        await page.fill('#rules', 'F -> FF\nq = ');
        await until(async () => (await constantRows(page)) === 'q–', 'one without a value is named');
    }));

test('rules with errors keep their sliders', () =>
    withPage({ hash: TREE }, async (page) => {
        await page.waitForSelector('#constants:visible');
        await page.fill('#rules', `${RULES}\nG = = 1`);
        await page.waitForSelector('#rules-problems .error');
        await dial(page, 'r').locator('.number').fill('0.5');
        assert.match(await page.inputValue('#rules'), /^\/\/ lengths\nr = \.5 \n/);
        assert.equal(await page.locator('#rules-problems .error').count(), 1);
    }));

test('on a phone the sliders of constants are under Rules', () =>
    withPage({ hash: TREE, options: PHONE }, async (page) => {
        await page.waitForSelector('#constants:visible');
        const box = await dial(page, 'r').locator('input[type=range]').boundingBox();
        assert.ok(box && box.x >= 0 && box.x + box.width <= 390 && box.width > 100, JSON.stringify(box));
    }));

test('the parts of the notation are coloured in place', () =>
    withPage({ hash: TREE }, async (page) => {
        const rules = 'ignore: +-\nr = 0.9\nA < B(x) > C : x > r -> F[+B(x)] : 0.5\n// so\ndraw:\nC -> F\n';
        await page.fill('#rules', rules);
        /** @param {string} tint */
        const parts = (tint) => page.locator(`[data-editor=rules] .t-${tint}`).allTextContents();
        await until(async () => (await parts('heading')).join('|') === 'ignore:|draw:', 'headings');
        assert.deepEqual(await parts('context'), ['A', 'C']);
        assert.equal((await parts('condition')).join(''), ' > ');
        assert.deepEqual(await parts('constant'), ['r', 'r']);
        assert.deepEqual(await parts('weight'), ['0.5']);
        assert.deepEqual(await parts('comment'), ['// so']);
        assert.deepEqual(await parts('bracket'), ['[', ']']);
        assert.deepEqual(await parts('number'), ['0.9']);
        // The layer shows exactly the same text, its lines in the same places.
        assert.equal(await page.locator('[data-editor=rules] > pre').evaluate((layer) => layer.textContent), rules);
        const [layer, area] = await page.evaluate(() =>
            ['#rules', '[data-editor=rules] > pre'].map((name) => document.querySelector(name)?.scrollHeight),
        );
        assert.equal(layer, area);
    }));

test('wrapped and blank lines are in the same place in the text and in its layer', () =>
    withPage({ hash: TREE }, async (page) => {
        for (const text of [
            '',
            '\n',
            '\n\nF -> F\n\n',
            `F -> ${'F[+F]'.repeat(60)}\nX -> ${'long '.repeat(40)}`,
            'F -> F   \n\t\tX -> 🌿 ',
        ]) {
            await page.fill('#rules', text);
            const [area, layer] = await page.evaluate(() =>
                ['#rules', '[data-editor=rules] > pre'].map((name) => document.querySelector(name)?.scrollHeight),
            );
            assert.equal(area, layer, JSON.stringify(text));
        }
    }));

test('a text that is too long is cut, with a message', () =>
    withPage({ hash: TREE }, async (page) => {
        await page.locator('#axiom').evaluate((area) => {
            /** @type {HTMLTextAreaElement} */ (area).value = 'F+'.repeat(600_000);
            area.dispatchEvent(new Event('input', { bubbles: true }));
        });
        await until(
            async () =>
                (await page.textContent('#toast')) ===
                'Axiom must be a text of at most 1,048,576 characters; the rest was cut.',
            'it is said',
        );
        assert.equal((await page.inputValue('#axiom')).length, 1 << 20);
    }));

test('a derived string as the axiom is drawn, linked and kept', () =>
    withPage({ hash: '#v=1&axiom=F&rules=F%20-%3E%20F' }, async (page) => {
        let derived = 'F';
        for (let n = 0; n < 9; n++) derived = derived.replaceAll('F', 'F+F--F+F');
        await page.fill('#angle', '60');
        await page.locator('#axiom').evaluate((area, text) => {
            /** @type {HTMLTextAreaElement} */ (area).value = text;
            area.dispatchEvent(new Event('input', { bubbles: true }));
        }, derived);
        await until(async () => (await page.textContent('#segments'))?.includes('262,144'), 'all of it is drawn');
        await until(() => page.evaluate(() => location.hash.includes('z=')), 'it is in the link');
        await page.reload();
        await ready(page);
        assert.equal(await page.inputValue('#axiom'), derived);
    }));

test('fifty thousand characters can be typed in', () =>
    withPage({ hash: TREE }, async (page) => {
        const line = 'A(l) : l > 0.1 -> F(l)[+(a)A(l*r)]';
        const text = `r = 0.5\na = 20\n${`${line}\n`.repeat(Math.floor(49_000 / (line.length + 1)))}`;
        // Typing through the driver would take longer than the page.
        await page.locator('#rules').evaluate((area, all) => {
            /** @type {HTMLTextAreaElement} */ (area).value = all;
            area.dispatchEvent(new Event('input', { bubbles: true }));
        }, text);
        await until(
            async () => (await page.locator('[data-editor=rules] .t-condition').count()) > 1000,
            'all of it is tinted',
        );
        const times = await page.evaluate(async () => {
            const area = /** @type {HTMLTextAreaElement} */ (document.querySelector('#rules'));
            area.focus();
            area.setSelectionRange(area.value.length, area.value.length);
            const times = [];
            for (const letter of 'F -> FFFFFFF') {
                const start = performance.now();
                document.execCommand('insertText', false, letter);
                await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
                times.push(performance.now() - start);
            }
            return times;
        });
        assert.match(await page.inputValue('#rules'), /\nF -> FFFFFFF$/);
        const middle = times.sort((a, b) => a - b)[Math.floor(times.length / 2)];
        console.log(
            `# a key in a text of ${text.length} characters: ${middle?.toFixed(0)} ms to the next frame, in the middle`,
        );
    }));

test('angles in space are shown for drawings in space, and tropism for drawings that bend', () =>
    withPage({ hash: '#v=1&axiom=A&rules=A%20-%3E%20F%5B%26A%5D%5B/%5EA%5D&n=4&angle=30' }, async (page) => {
        await page.click('#tab-turtle');
        await page.waitForSelector('#space:visible');
        assert.equal(await page.getAttribute('#pitch-down', 'placeholder'), '30');
        await page.fill('#pitch-down', '20');
        assert.equal(await page.getAttribute('#pitch-up', 'placeholder'), '20');
        await page.focus('#roll-left');
        await page.keyboard.press('Shift+ArrowUp');
        assert.equal(await page.inputValue('#roll-left'), '40');
        await until(() => page.evaluate(() => /down=20&roll=40/.test(location.hash)), 'the address holds them');
        await page.fill('#pitch-down', '');
        assert.equal(await page.getAttribute('#pitch-up', 'placeholder'), '30');
        await page.fill('#roll-left', '');
        await until(async () => /in space/.test((await page.textContent('#status')) ?? ''), 'the announcement says so');
        assert.ok(!(await page.isVisible('#elasticity')));
        await page.click('#bends summary');
        await page.fill('#elasticity', '0.2');
        await page.fill('#tropism-x', '1');
        await until(
            () => page.evaluate(() => /tropism=1,-1,0&elasticity=0\.2/.test(location.hash)),
            'the address holds it',
        );
        await page.click('#tab-rules');
        await page.fill('#rules', 'A -> F[+A][-A]');
        await page.click('#tab-turtle');
        await until(async () => !(await page.isVisible('#space')), 'in the plane there are two angles');
        const link = await page.evaluate(() => location.hash);
        await withPage({ hash: link }, async (other) => {
            await other.click('#tab-turtle');
            assert.ok(await other.isVisible('#elasticity'), 'what bends is shown');
            assert.equal(await other.inputValue('#elasticity'), '0.2');
        });
    }));
