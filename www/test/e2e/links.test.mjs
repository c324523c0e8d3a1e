import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { clean } from '../../js/state/state.js';
import { bestLink } from '../../js/state/packed.js';
import { DAMAGED, SCRIPTS } from '../unit/hostile.mjs';
import { close, picture, stillPicture, until, withModules, withPage } from './browser.mjs';

after(close);

const LONG = clean({
    title: 'Long',
    axiom: 'F',
    rules: `${'// 100 % of this is a comment & nothing else\n'.repeat(80)}F -> F+F--F+F`,
    iterations: 3,
    angle: 60,
    view: { x: 0.1, y: 0.05, zoom: 2 },
});

/** @param {import('playwright-core').Page} page */
const hash = (page) => page.evaluate(() => location.hash);
/** @param {import('playwright-core').Page} page @param {string} selector */
const text = async (page, selector) => (await page.textContent(selector)) ?? '';

test('a long system has a compressed address, which opens the same system', async () => {
    const link = await bestLink(LONG);
    assert.match(link, /^#v=1&z=/);
    await withPage({ hash: link }, async (page) => {
        assert.equal(await page.inputValue('#rules'), LONG.rules);
        assert.match(await text(page, '#zoom'), /^200/);
        const shown = await stillPicture(page);
        await page.fill('#angle', '61');
        await until(async () => (await hash(page)) !== link, 'the address follows');
        const turned = await hash(page);
        assert.match(turned, /^#v=1&z=[\w-]+$/);
        await page.fill('#angle', '60');
        await until(async () => (await stillPicture(page)).digest === shown.digest, 'the same picture');
        const again = await until(
            async () => ((await hash(page)) === turned ? null : hash(page)),
            'the address follows',
        );
        await withPage({ hash: again }, async (other) =>
            assert.equal((await stillPicture(other)).digest, shown.digest),
        );
    });
});

test('a compressed link pasted into an open page opens, and undo returns', async () => {
    const link = await bestLink(LONG);
    await withPage({ hash: '#v=1&axiom=F&n=2' }, async (page) => {
        await page.evaluate((pasted) => (location.hash = pasted), link);
        await until(async () => (await page.inputValue('#rules')) === LONG.rules, 'the link is open');
        await page.click('#undo');
        assert.equal(await page.inputValue('#rules'), '');
    });
});

test('a cut compressed link shows a message and the defaults', async () => {
    const link = await bestLink(LONG);
    await withPage({ hash: `#axiom=F+F&${link.slice(1, -8)}` }, async (page) => {
        assert.match(await text(page, '#toast'), /damaged or cut off/);
        assert.equal(await page.inputValue('#axiom'), 'F+F');
        assert.equal(await page.inputValue('#rules'), '');
    });
});

test('every system of the gallery reads back from its readable and compressed links', () =>
    withPage({ before: withModules }, async (page) => {
        const wrong = await page.evaluate(async () => {
            /** @param {string} path */
            const load = (path) => import(new URL(path, document.baseURI).href);
            const [{ clean, FIELDS, same }, { writeLink }, { openLink, shortestLink }] = await Promise.all(
                ['js/state/state.js', 'js/state/link.js', 'js/state/packed.js'].map(load),
            );
            const entries = await (await fetch('gallery.json')).json();
            /** @type {string[]} */
            const failed = entries.length > 80 ? [] : ['few systems'];
            for (const { path, definition } of entries) {
                for (const view of [null, { x: 0.1, y: -1 / 3, zoom: 40 }]) {
                    const state = clean({ ...definition, view });
                    if (Object.keys(definition).some((field) => !same(definition[field], state[field])))
                        failed.push(`${path} is not a valid state`);
                    for (const link of [writeLink(state), await shortestLink(state)]) {
                        const opened = await openLink(link);
                        if (
                            opened.problems.length > 0 ||
                            !FIELDS.every((/** @type {string} */ field) => same(opened.state[field], state[field]))
                        )
                            failed.push(`${path} ${link}`);
                    }
                }
            }
            return failed;
        });
        assert.deepEqual(wrong, []);
    }));

test('hostile links cost little time and memory in this browser', () =>
    withPage({ before: withModules }, async (page) => {
        const links = DAMAGED.map(({ hash }) => hash);
        const { unsaid, slowest, megabytes } = await page.evaluate(async (hashes) => {
            const { openLink } = await import(new URL('js/state/packed.js', document.baseURI).href);
            const heap = () => /** @type {any} */ (performance).memory.usedJSHeapSize;
            const before = heap();
            let slowest = 0;
            let most = before;
            const unsaid = [];
            for (const hash of hashes) {
                const start = performance.now();
                const link = await openLink(hash);
                slowest = Math.max(slowest, performance.now() - start);
                most = Math.max(most, heap());
                if (link.problems.length === 0) unsaid.push(hash.slice(0, 80));
            }
            return { unsaid, slowest, megabytes: (most - before) / 2 ** 20 };
        }, links);
        assert.deepEqual(unsaid, []);
        console.log(`${links.length} hostile links: at most ${slowest.toFixed(0)} ms and ${megabytes.toFixed(0)} MB`);
        assert.ok(megabytes < 200, `${megabytes} MB`);
    }));

test('the content of a link is shown and never run', () =>
    withPage({ hash: '#axiom=F' }, async (page) => {
        page.on('dialog', (dialog) => assert.fail(`a script ran: ${dialog.message()}`));
        for (const script of SCRIPTS) {
            const words = encodeURIComponent(script);
            await page.evaluate(
                (pasted) => (location.hash = pasted),
                `#v=1&axiom=${words}&rules=${words}&title=${words}&name=${words}&source=${words}&do=${words}&notes=${words}`,
            );
            await until(async () => (await page.inputValue('#axiom')) === script, script);
            assert.equal(await text(page, '#specimen-title'), script);
            assert.equal(await page.locator('main script, main img, main iframe').count(), 0);
            await page.evaluate(() => new Promise(requestAnimationFrame));
        }
    }));

test('a link that is a compression bomb leaves the page working', async () => {
    const bomb = DAMAGED.find(({ name }) => name === 'packed: a bomb of letters');
    await withPage({ hash: String(bomb?.hash) }, async (page) => {
        assert.match(await text(page, '#toast'), /more than any drawing needs/);
        await page.fill('#axiom', 'F+F');
        await page.fill('#angle', '90');
        await until(async () => (await picture(page)).ink > 0, 'it draws');
    });
});

test('the address matches the shown state, even after a reload before the address was written', () =>
    withPage({ hash: '#v=1&axiom=F&rules=F%20-%3E%20F+F&n=3&angle=60' }, async (page) => {
        await page.fill('#angle', '39');
        await until(async () => (await hash(page)).includes('angle=39'), 'the address follows');
        await Promise.all([
            page.waitForEvent('load'),
            page.evaluate(() => {
                const field = /** @type {HTMLInputElement} */ (document.querySelector('#angle'));
                field.value = '22.5';
                field.dispatchEvent(new Event('input', { bubbles: true }));
                location.reload();
            }),
        ]);
        await until(async () => (await page.inputValue('#angle')) === '22.5', 'the last change is there');
        await until(async () => (await hash(page)).includes('angle=22.5'), 'the address says so');
    }));
