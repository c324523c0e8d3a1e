/**
 * Workers that stop: they hang, crash or end silently, over a drawing, a small picture, a file, or before they have
 * started. The page soon works again, reports what was given up, and loses no typed text.
 */

import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { after, test } from 'node:test';
import { SILENCE } from '../../js/engine/watchdog.js';
import { sampled, some } from '../effort.mjs';
import { ADDRESS, close, nextPicture, picture, ready, stillPicture, until, withPage } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('playwright-core').Frame} Frame */

after(close);

const WEED = '#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5DF%5B-F%5DF&n=4&angle=25';

/** Ways to stop, as words in an axiom. In capitals the definition stops the worker, in small letters its file does. */
const WAYS = ['HANG', 'CRASH', 'CLOSE'];

/** How long the page waits for a silent worker, in milliseconds of its clock, with some beats of the watchdog. */
const SILENT_FOR = SILENCE + 1000;

/** Appended to the scripts of the page's worker and of the tool for files. The symbols of these words draw nothing in most systems. */
const FAULTS = `
(() => {
    const fault = (text, [hang, crash, gone]) => {
        if (text.includes(hang)) {
            self.postMessage('fault');
            for (;;);
        }
        if (text.includes(crash)) throw new WebAssembly.RuntimeError('unreachable');
        if (!text.includes(gone)) return;
        self.postMessage('fault');
        // The worker sends no more messages, not even about its failure.
        self.postMessage = () => {};
        self.close();
        throw new Error('gone');
    };
    const { make_file, Playground } = wasm_bindgen;
    if (make_file) {
        for (const name of ['make_file', 'make_picture']) {
            const make = wasm_bindgen[name];
            wasm_bindgen[name] = (asked, tell) => {
                fault(asked.definition.axiom, ['hang', 'crash', 'close']);
                return make(asked, tell);
            };
        }
        return;
    }
    let axiom = '';
    const { prototype } = Playground;
    const { define, pick } = prototype;
    prototype.define = function (definition) {
        axiom = definition.axiom;
        fault(axiom, ['HANG', 'CRASH', 'CLOSE']);
        return define.call(this, definition);
    };
    prototype.pick = function (...how) {
        fault(axiom, ['pickhang', 'pickcrash', 'pickclose']);
        return pick.apply(this, how);
    };
})();
`;

/** Adds the faults to the workers of a page, from files or inside a single-file page, and counts the workers that are silent. @param {Page} page */
async function withFaults(page) {
    await page.addInitScript(() => {
        const site = /** @type {any} */ (globalThis);
        site.faults = 0;
        const Own = Worker;
        site.Worker = class extends Own {
            /** @param {[string]} how */
            constructor(...how) {
                super(...how);
                this.addEventListener('message', (event) => {
                    if (event.data !== 'fault') return;
                    site.faults += 1;
                    // The page does not hear this message, so that the worker stays silent.
                    event.stopImmediatePropagation();
                });
            }
        };
    });
    await page.route(/\/(worker|tools)\.js$/, async (route) => {
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

/** Adds the faults, and lets the test move the page's clock. @param {Page} page */
async function withFaultsAndClock(page) {
    await page.clock.install();
    await withFaults(page);
}

/** The workers that have been silent before. @type {WeakMap<Page | Frame, number>} */
const before = new WeakMap();

/**
 * Waits until one more worker is silent, and then lets the page's clock pass the time after which the page replaces it.
 * Such a worker never answers, so a test need not live through this time. A crash is told at once.
 * @param {string} way
 * @param {Page} page
 * @param {Page | Frame} [frame] the page of the worker
 */
async function passSilence(way, page, frame = page) {
    if (way === 'CRASH') return;
    const known = before.get(frame) ?? 0;
    await until(
        async () => (await frame.evaluate(() => /** @type {any} */ (globalThis).faults)) > known,
        'a worker is silent',
    );
    before.set(frame, known + 1);
    await page.clock.runFor(SILENT_FOR);
}

/** Types an axiom that stops the worker in this way, and waits for the page's message. @param {Page} page @param {string} way @param {string} axiom */
async function typeUntilTold(page, way, axiom) {
    await page.fill('#axiom', axiom);
    await passSilence(way, page);
    await page.waitForSelector('#trouble:not([hidden])');
}

/** @param {string} what @param {number} milliseconds */
const tell = (what, milliseconds) => console.log(`${what}: ${(milliseconds / 1000).toFixed(1)} s`);

for (const way of some(WAYS)) {
    test(`${way}: a drawing that stops its worker is given up, and no typed text is lost`, () =>
        withPage({ hash: WEED, before: withFaultsAndClock }, async (page) => {
            const before = await stillPicture(page);
            await typeUntilTold(page, way, way);
            assert.match(await page.innerText('#trouble'), /Your text is kept/);
            assert.equal(await page.inputValue('#axiom'), way);
            assert.equal((await stillPicture(page)).digest, before.digest);
            await page.fill('#axiom', 'FF');
            await nextPicture(page, before);
            await page.waitForSelector('#trouble', { state: 'hidden' });

            await typeUntilTold(page, way, `${way}F`);
            await page.click('#trouble-back');
            assert.equal(await page.inputValue('#axiom'), 'FF');
            await page.waitForSelector('#trouble', { state: 'hidden' });
            await page.click('#undo');
            assert.equal(await page.inputValue('#axiom'), `${way}F`);
            await passSilence(way, page);
            await page.waitForSelector('#trouble:not([hidden])');
        }));
}

// Here the clock is the machine's own.
test('a text typed while a worker hangs is drawn by the next worker', () =>
    withPage({ hash: WEED, before: withFaults }, async (page) => {
        const before = await stillPicture(page);
        await page.fill('#axiom', 'HANG');
        const begun = Date.now();
        await page.waitForFunction(() => /** @type {any} */ (globalThis).faults === 1);
        await page.fill('#axiom', 'F+F');
        await until(async () => (await picture(page)).digest !== before.digest, 'the system is drawn');
        tell('HANG, page, a system typed meanwhile is drawn after', Date.now() - begun);
        assert.ok(await page.isHidden('#trouble'));
    }));

test('a state that stopped a worker is not drawn at once on the next visit or from a link', () =>
    withPage({ hash: WEED, before: withFaultsAndClock }, async (page) => {
        await typeUntilTold(page, 'HANG', 'FHANG');
        await until(
            () =>
                page.evaluate(
                    () =>
                        location.hash.includes('FHANG') &&
                        Object.keys(localStorage).some((name) => /sessions .*FHANG/.test(name)),
                ),
            'the address and the visit are saved',
        );
        for (const address of [page.url(), ADDRESS]) {
            await page.goto('about:blank');
            await page.goto(address);
            await page.waitForSelector('#trouble:not([hidden])');
            assert.match(await page.innerText('#trouble'), /was not started/);
            assert.equal(await page.inputValue('#axiom'), 'FHANG');
            assert.equal(await page.locator('#stage.inked').count(), 0);
            assert.equal(await page.evaluate(() => /** @type {any} */ (globalThis).faults), 0);
        }
        await page.fill('#axiom', 'F+F');
        await ready(page);
        await page.waitForSelector('#trouble', { state: 'hidden' });
    }));

test('a link that hangs is reported, and a reload meanwhile does not draw it again', () =>
    withPage(
        { hash: WEED.replace('axiom=F', 'axiom=FHANG'), drawing: null, before: withFaultsAndClock },
        async (page) => {
            await passSilence('HANG', page);
            await page.waitForSelector('#trouble:not([hidden])');
            assert.ok(await page.isHidden('#trouble-back'));
            await page.click('#trouble-again');
            await until(
                async () => (await page.evaluate(() => /** @type {any} */ (globalThis).faults)) === 2,
                'the worker hangs again',
            );
            // Long enough for a doubt, too short for a message.
            await page.clock.runFor(SILENCE / 2);
            assert.ok(await page.isHidden('#trouble'));
            await page.reload();
            await page.waitForSelector('#trouble:not([hidden])');
            assert.match(await page.innerText('#trouble'), /was not started/);
            before.delete(page);
            await page.click('#trouble-again');
            await passSilence('HANG', page);
            await until(async () => /restarted/.test(await page.innerText('#trouble')), 'it is told again');
        },
    ));

test('a worker that ends while idle is replaced when it is needed', () =>
    withPage(
        {
            hash: WEED,
            before: async (page) => {
                await page.clock.install();
                await page.addInitScript(() => {
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
                });
            },
        },
        async (page) => {
            const before = await stillPicture(page);
            await page.evaluate(() =>
                /** @type {any} */ (globalThis).workers.forEach((/** @type {Worker} */ worker) => worker.terminate()),
            );
            await page.fill('#axiom', 'F+F');
            await page.clock.runFor(SILENT_FOR);
            await until(async () => (await picture(page)).digest !== before.digest, 'the system is drawn');
            assert.ok(await page.isHidden('#trouble'));
        },
    ));

for (const way of sampled(WAYS, 3, 1)) {
    test(`${way}: one bad thumbnail does not affect the others`, () =>
        withPage(
            {
                hash: WEED,
                before: async (page) => {
                    await withFaultsAndClock(page);
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
                await page.click('#open-gallery');
                await passSilence(way, page);
                await until(
                    async () => (await page.locator('#gallery [data-path] .thumb.inked').count()) === 5,
                    'all but one',
                );
                assert.ok(await page.isHidden('#trouble'));
                await page.keyboard.press('Escape');
                assert.equal((await stillPicture(page)).digest, before.digest);
                await page.fill('#axiom', 'F+F');
                await nextPicture(page, before);
            },
        ));

    test(`${way}: a file that cannot be written is refused`, () =>
        withPage({ hash: WEED, before: withFaultsAndClock }, async (page) => {
            const first = await stillPicture(page);
            await page.fill('#axiom', `F+F${way.toLowerCase()}`);
            await nextPicture(page, first);
            const before = await stillPicture(page);
            await page.click('[role=tab][aria-controls=section-save]').catch(() => {});
            for (const format of ['svg', 'png']) {
                await page.locator(`[data-save=${format}]`).click();
                await passSilence(way, page);
                await until(async () => /Not saved/.test(await page.innerText('#toast')), 'it is refused');
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
    withPage({ hash: WEED.replace('axiom=F', 'axiom=Fpickhang'), before: withFaultsAndClock }, async (page) => {
        const before = await stillPicture(page);
        await page.hover('#drawing');
        await passSilence('HANG', page);
        await until(async () => /could not be read/.test(await page.innerText('#toast')), 'it is told');
        assert.equal((await stillPicture(page)).digest, before.digest);
        await page.hover('#drawing', { position: { x: 200, y: 200 } });
        await page.fill('#axiom', 'FF');
        await nextPicture(page, before);
    }));

for (const way of sampled(WAYS, 3, 2)) {
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
            await withPage(
                { address: host, also: ADDRESS, drawing: null, before: withFaultsAndClock },
                async (page) => {
                    const frame = await until(
                        () => page.frames().find((each) => each.url().includes('embed.html')),
                        'the frame',
                    );
                    await until(
                        () =>
                            frame.evaluate(
                                () => document.querySelector('#stage.inked')?.getAttribute('aria-busy') === 'false',
                            ),
                        'the drawing',
                    );
                    const before = await picture(frame);
                    /** @param {object} message */
                    const say = (message) =>
                        page.evaluate(
                            (what) =>
                                /** @type {HTMLIFrameElement} */ (
                                    document.querySelector('#frame')
                                ).contentWindow?.postMessage(what, '*'),
                            message,
                        );
                    const errors = () =>
                        page.evaluate(
                            () =>
                                /** @type {any} */ (globalThis).heard.filter(
                                    (/** @type {any} */ { lsystem }) => lsystem === 'error',
                                ).length,
                        );
                    let told = 0;
                    for (const link of [
                        WEED.replace('axiom=F', `axiom=${way}`),
                        WEED.replace('axiom=F', `axiom=F${way}`),
                    ]) {
                        await say({ lsystem: 'open', link });
                        await passSilence(way, page, frame);
                        await until(async () => (await errors()) > told, 'the page is told');
                        told = await errors();
                        assert.ok(await frame.isVisible('#trouble'));
                        await until(async () => (await picture(frame)).digest === before.digest, 'the former drawing');
                    }
                    await say({ lsystem: 'open', link: '#v=1&axiom=F+F&n=0&angle=60' });
                    await until(async () => (await picture(frame)).digest !== before.digest, 'the next drawing');
                    await until(() => frame.isHidden('#trouble'), 'the note is gone');
                },
            );
        } finally {
            server.close();
        }
    });
}
