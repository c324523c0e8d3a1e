/**
 * Workers that stop: they hang, crash or end silently, over a drawing, a small picture, a file, or before they have
 * started. The page soon works again, reports what was given up, and loses no typed text.
 */

import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { after, test } from 'node:test';
import { ADDRESS, close, nextPicture, picture, ready, stillPicture, until, withPage } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */

after(close);

const WEED = '#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5DF%5B-F%5DF&n=4&angle=25';

/** Ways to stop, as words in an axiom. In capitals the definition stops the worker, in small letters its file does. */
const WAYS = ['HANG', 'CRASH', 'CLOSE'];

/** Appended to the scripts of the page's worker and of the tool for files. The symbols of these words draw nothing in most systems. */
const FAULTS = `
(() => {
    const fault = (text, [hang, crash, gone]) => {
        if (text.includes(hang)) for (;;);
        if (text.includes(crash)) throw new WebAssembly.RuntimeError('unreachable');
        if (!text.includes(gone)) return;
        // The worker sends no more messages, not even about its failure.
        self.postMessage = () => {};
        self.close();
        throw new Error('gone');
    };
    const small = ['hang', 'crash', 'close'];
    const { Export, Playground } = wasm_bindgen;
    if (Export) {
        wasm_bindgen.Export = class extends Export {
            constructor(asked) {
                fault(asked.definition.axiom, small);
                super(asked);
            }
        };
        return;
    }
    let axiom = '';
    const { prototype } = Playground;
    const { define, snapshot, pick } = prototype;
    prototype.define = function (definition) {
        axiom = definition.axiom;
        fault(axiom, ['HANG', 'CRASH', 'CLOSE']);
        return define.call(this, definition);
    };
    prototype.snapshot = function (...how) {
        fault(axiom, small);
        return snapshot.apply(this, how);
    };
    prototype.pick = function (...how) {
        fault(axiom, ['pickhang', 'pickcrash', 'pickclose']);
        return pick.apply(this, how);
    };
})();
`;

/** Adds the faults to the workers of a page, from files or inside a single-file page. @param {Page} page */
async function withFaults(page) {
    await page.route(/\/(worker|export)\.js$/, async (route) => {
        try {
            const response = await route.fetch();
            await route.fulfill({ response, body: (await response.text()) + FAULTS });
        } catch {
            // The page was closed.
        }
    });
    await page.route(/\/embed\.html$/, async (route) => {
        const response = await route.fetch();
        const text = await response.text();
        const at = text.indexOf('</script>', text.indexOf('data-file="worker.js"'));
        assert.ok(at > 0);
        await route.fulfill({ response, body: text.slice(0, at) + FAULTS + text.slice(at) });
    });
}

/** Types an axiom and waits for the page's message. @param {Page} page @param {string} axiom @returns {Promise<number>} the time until then, in milliseconds */
async function typeUntilTold(page, axiom) {
    const begun = Date.now();
    await page.fill('#axiom', axiom);
    await page.waitForSelector('#trouble:not([hidden])');
    return Date.now() - begun;
}

/** @param {string} what @param {number} milliseconds */
const tell = (what, milliseconds) => console.log(`${what}: ${(milliseconds / 1000).toFixed(1)} s`);

for (const way of WAYS) {
    test(`${way}: a drawing that stops its worker is given up, and no typed text is lost`, () =>
        withPage({ hash: WEED, before: withFaults }, async (page) => {
            const before = await stillPicture(page);
            tell(`${way}, page, until it is told`, await typeUntilTold(page, way));
            assert.match(await page.innerText('#trouble'), /Your text is kept/);
            assert.equal(await page.inputValue('#axiom'), way);
            assert.equal((await stillPicture(page)).digest, before.digest);
            const begun = Date.now();
            await page.fill('#axiom', 'FF');
            await nextPicture(page, before);
            tell(`${way}, page, the next system is drawn after`, Date.now() - begun);
            await page.waitForSelector('#trouble', { state: 'hidden' });

            await typeUntilTold(page, `${way}F`);
            await page.click('#trouble-back');
            assert.equal(await page.inputValue('#axiom'), 'FF');
            await page.waitForSelector('#trouble', { state: 'hidden' });
            await page.click('#undo');
            assert.equal(await page.inputValue('#axiom'), `${way}F`);
            await page.waitForSelector('#trouble:not([hidden])');
        }));
}

test('a text typed while a worker hangs is drawn by the next worker', () =>
    withPage({ hash: WEED, before: withFaults }, async (page) => {
        const before = await stillPicture(page);
        await page.fill('#axiom', 'HANG');
        const begun = Date.now();
        await page.waitForTimeout(800);
        await page.fill('#axiom', 'F+F');
        await until(async () => (await picture(page)).digest !== before.digest, 'the system is drawn', 12_000);
        tell('HANG, page, a system typed meanwhile is drawn after', Date.now() - begun);
        assert.ok(await page.isHidden('#trouble'));
    }));

test('a state that stopped a worker is not drawn at once on the next visit or from a link', () =>
    withPage({ hash: WEED, before: withFaults }, async (page) => {
        await typeUntilTold(page, 'FHANG');
        await page.waitForTimeout(600);
        for (const address of [page.url(), ADDRESS]) {
            await page.goto('about:blank');
            await page.goto(address);
            await page.waitForSelector('#trouble:not([hidden])');
            assert.match(await page.innerText('#trouble'), /was not started/);
            assert.equal(await page.inputValue('#axiom'), 'FHANG');
            assert.equal(await page.getAttribute('#stage', 'class'), await page.getAttribute('#stage', 'class'));
            assert.equal(await page.locator('#stage.inked').count(), 0);
        }
        await page.fill('#axiom', 'F+F');
        await ready(page);
        await page.waitForSelector('#trouble', { state: 'hidden' });
    }));

test('a link that hangs is reported, and a reload meanwhile does not draw it again', () =>
    withPage({ hash: WEED.replace('axiom=F', 'axiom=FHANG'), drawing: '#trouble:not([hidden])', before: withFaults }, async (page) => {
        assert.ok(await page.isHidden('#trouble-back'));
        await page.click('#trouble-again');
        await page.waitForTimeout(2000);
        await page.reload();
        await page.waitForSelector('#trouble:not([hidden])');
        assert.match(await page.innerText('#trouble'), /was not started/);
        await page.click('#trouble-again');
        await until(async () => /restarted/.test(await page.innerText('#trouble')), 'it is told again');
    }));

test('a worker that ends while idle is replaced when it is needed', () =>
    withPage(
        {
            hash: WEED,
            before: (page) =>
                page.addInitScript(() => {
                    const site = /** @type {any} */ (globalThis);
                    site.workers = [];
                    const Own = Worker;
                    site.Worker = class extends Own {
                        /** @param {[string]} how */
                        constructor(...how) {
                            super(...how);
                            site.workers.push(this);
                        }
                    };
                }),
        },
        async (page) => {
            const before = await stillPicture(page);
            await page.evaluate(() => /** @type {any} */ (globalThis).workers.forEach((/** @type {Worker} */ worker) => worker.terminate()));
            const begun = Date.now();
            await page.fill('#axiom', 'F+F');
            await until(async () => (await picture(page)).digest !== before.digest, 'the system is drawn', 12_000);
            tell('terminated, page, the next system is drawn after', Date.now() - begun);
            assert.ok(await page.isHidden('#trouble'));
        },
    ));

for (const way of WAYS) {
    test(`${way}: one bad thumbnail does not affect the others`, () =>
        withPage(
            {
                hash: WEED,
                before: async (page) => {
                    await withFaults(page);
                    await page.route(/gallery\.json$/, async (route) => {
                        const response = await route.fetch();
                        const entries = await response.json();
                        entries.splice(6);
                        // On one shelf, all of them are in sight.
                        for (const entry of entries) entry.path = `one shelf/${entry.path}`;
                        entries[1].definition.axiom = way;
                        await route.fulfill({ response, json: entries });
                    });
                },
            },
            async (page) => {
                const before = await stillPicture(page);
                const begun = Date.now();
                await page.click('#open-gallery');
                await until(async () => (await page.locator('#gallery [data-path] .thumb.inked').count()) === 5, 'all but one', 20_000);
                tell(`${way}, small pictures, the others are there after`, Date.now() - begun);
                assert.ok(await page.isHidden('#trouble'));
                await page.keyboard.press('Escape');
                assert.equal((await stillPicture(page)).digest, before.digest);
                await page.fill('#axiom', 'F+F');
                await nextPicture(page, before);
            },
        ));

    test(`${way}: a file that cannot be written is refused`, () =>
        withPage({ hash: WEED, before: withFaults }, async (page) => {
            const first = await stillPicture(page);
            await page.fill('#axiom', `F+F${way.toLowerCase()}`);
            await nextPicture(page, first);
            const before = await stillPicture(page);
            await page.click('[role=tab][aria-controls=section-save]').catch(() => {});
            for (const format of ['svg', 'png']) {
                const begun = Date.now();
                await page.locator(`[data-save=${format}]`).click();
                await until(async () => /Not saved/.test(await page.innerText('#toast')), 'it is refused', 20_000);
                tell(`${way}, ${format}, it is refused after`, Date.now() - begun);
                await page.waitForSelector(`[data-save=${format}]:enabled`);
                await page.evaluate(() => document.querySelector('#toast')?.replaceChildren());
            }
            assert.equal(await page.inputValue('#axiom'), `F+F${way.toLowerCase()}`);
            assert.equal((await stillPicture(page)).digest, before.digest);
            await page.click('#tab-rules');
            await page.fill('#axiom', 'FF');
            await nextPicture(page, before);
        }));
}

test('a question that stops its worker is not asked again about the same drawing', () =>
    withPage({ hash: WEED.replace('axiom=F', 'axiom=Fpickhang'), before: withFaults }, async (page) => {
        const before = await stillPicture(page);
        await page.hover('#drawing');
        await until(async () => /could not be read/.test(await page.innerText('#toast')), 'it is told', 12_000);
        assert.equal((await stillPicture(page)).digest, before.digest);
        await page.hover('#drawing', { position: { x: 200, y: 200 } });
        await page.fill('#axiom', 'FF');
        await nextPicture(page, before);
    }));

for (const way of WAYS) {
    test(`${way}: an embedded drawing recovers and tells its host`, async () => {
        const server = createServer((_request, response) => {
            response.writeHead(200, { 'content-type': 'text/html' });
            response.end(`<!doctype html><title>host</title><script>
                var heard = [];
                addEventListener('message', ({ data }) => heard.push(data));
            </script><iframe id="frame" style="width: 640px; height: 480px" src="${ADDRESS}embed.html${WEED}&controls=rules"></iframe>`);
        });
        await new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(null)));
        const address = server.address();
        const host = `http://localhost:${typeof address === 'object' ? address?.port : ''}/`;
        try {
            await withPage({ address: host, also: ADDRESS, drawing: null, before: withFaults }, async (page) => {
                const frame = await until(() => page.frames().find((each) => each.url().includes('embed.html')), 'the frame');
                await until(() => frame.evaluate(() => document.querySelector('#stage.inked')?.getAttribute('aria-busy') === 'false'), 'the drawing', 20_000);
                const before = await picture(frame);
                /** @param {object} message */
                const say = (message) => page.evaluate((what) => /** @type {HTMLIFrameElement} */ (document.querySelector('#frame')).contentWindow?.postMessage(what, '*'), message);
                const errors = () => page.evaluate(() => /** @type {any} */ (globalThis).heard.filter((/** @type {any} */ { lsystem }) => lsystem === 'error').length);
                let told = 0;
                for (const link of [WEED.replace('axiom=F', `axiom=${way}`), WEED.replace('axiom=F', `axiom=F${way}`)]) {
                    const begun = Date.now();
                    await say({ lsystem: 'open', link });
                    await until(async () => (await errors()) > told, 'the page is told', 12_000);
                    told = await errors();
                    tell(`${way}, embed, its page is told after`, Date.now() - begun);
                    assert.ok(await frame.isVisible('#trouble'));
                    assert.equal((await picture(frame)).digest, before.digest);
                }
                const begun = Date.now();
                await say({ lsystem: 'open', link: '#v=1&axiom=F+F&n=0&angle=60' });
                await until(async () => (await picture(frame)).digest !== before.digest, 'the next drawing', 12_000);
                tell(`${way}, embed, the next drawing is there after`, Date.now() - begun);
                await until(() => frame.isHidden('#trouble'), 'the note is gone');
            });
        } finally {
            server.close();
        }
    });
}
