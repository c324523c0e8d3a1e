/** Use without a network, and updates. A copy of the site is served under a name that is not local. */

import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { cp, mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, picture, quiet, ready, saveFile, stillPicture, until, withPage } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */

const KOCH = '#v=1&title=Koch&axiom=F&rules=F%20-%3E%20F+F--F+F&n=4&angle=60&heading=0';
const TYPES = {
    html: 'text/html; charset=utf-8',
    js: 'text/javascript; charset=utf-8',
    css: 'text/css; charset=utf-8',
    wasm: 'application/wasm',
    svg: 'image/svg+xml',
    json: 'application/json',
    png: 'image/png',
    webmanifest: 'application/manifest+json',
};

let site = '';
let origin = '';
/** The requests since the list was last cleared. @type {string[]} */
let asked = [];
let down = false;

const server = createServer(async (request, response) => {
    const path = String(request.url)
        .replace(/[?#].*$/, '')
        .replace(/\/$/, '/index.html');
    asked.push(path);
    if (down) {
        response.destroy();
        return;
    }
    try {
        const body = await readFile(join(site, path.replace(/^\/play\//, '')));
        response.writeHead(200, {
            'content-type': TYPES[/** @type {keyof typeof TYPES} */ (path.split('.').pop())] ?? 'text/plain',
            'cache-control': 'max-age=600',
        });
        response.end(body);
    } catch {
        response.writeHead(404);
        response.end();
    }
});

before(async () => {
    await new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(null)));
    const address = server.address();
    origin = `http://l-systems.localhost:${typeof address === 'object' ? address?.port : ''}/play/`;
});
after(async () => {
    await close();
    server.close();
});

/** A fresh copy of the site for a test. @param {() => Promise<unknown>} use */
async function withSite(use) {
    site = await mkdtemp(join(tmpdir(), 'site-'));
    down = false;
    try {
        await cp(new URL('../../../dist/', import.meta.url), site, { recursive: true });
        await use();
    } finally {
        await rm(site, { recursive: true });
    }
}

/** Publishes another version of the page: another title. @param {string} title */
async function publish(title) {
    const page = join(site, 'index.html');
    const old = await readFile(page);
    const fresh = old.toString().replace(/<h1>.*?<\/h1>/, `<h1>${title}</h1>`);
    await writeFile(page, fresh);
    const hash = (/** @type {string | Buffer} */ text) => createHash('sha256').update(text).digest('hex');
    const worker = join(site, 'service-worker.js');
    const text = (await readFile(worker, 'utf8'))
        .replace(hash(old), hash(fresh))
        .replace(/BUILD = "\w+"/, `BUILD = "${hash(title).slice(0, 16)}"`);
    await writeFile(worker, text);
}

/** Waits until this version is completely cached. @param {Page} page */
const kept = (page) =>
    page.evaluate(async () => {
        await navigator.serviceWorker.ready;
    });
/** The paths of the cached files. @param {Page} page */
const keptFiles = (page) =>
    page.evaluate(async () => {
        const [name] = await caches.keys();
        const { scope } = await navigator.serviceWorker.ready;
        return (await (await caches.open(String(name))).keys()).map(({ url }) => url.slice(scope.length));
    });
/** @param {Page} page */
const update = (page) =>
    page.evaluate(async () => {
        await (await navigator.serviceWorker.getRegistration())?.update();
    });
/** @param {Page} page */
const title = (page) => page.textContent('h1');

/** Opens the page again once it is cached. Returns its title. @param {Page} page */
async function reopened(page) {
    await kept(page);
    await page.reload();
    await ready(page);
    return title(page);
}

const how = () => ({
    address: origin,
    hash: KOCH,
    expected: /ERR_EMPTY_RESPONSE|Failed to load resource|ERR_FAILED|unknown error occurred when fetching the script/,
});

test('after one visit, the first screen works without a network, and so does what was used', () =>
    withSite(() =>
        withPage(how(), async (page) => {
            const before = await stillPicture(page);
            await kept(page);
            const names = await keptFiles(page);
            assert.ok(names.includes('') && names.includes('lsystem.wasm') && names.includes('page.js'), names.join());
            assert.ok(!names.some((name) => /tools|video|docs|parts|gallery/.test(name)), names.join());
            await until(
                () => page.evaluate(() => navigator.serviceWorker.controller !== null),
                'the version serves the page',
            );
            await page.click('#open-gallery');
            await page.waitForSelector('.thumb.inked');
            down = true;
            await page.reload();
            await ready(page);
            assert.equal((await stillPicture(page)).digest, before.digest);
            await page.click('#open-gallery');
            await page.waitForSelector('.thumb.inked');
            await page.click('#close-gallery');
            // What was not used is told, and comes once there is a network.
            await page.click('#tab-save');
            await page.context().setOffline(true);
            await page.click('[data-save=svg]');
            await page.waitForSelector('#toast:has-text("you are offline")');
            await page.context().setOffline(false);
            down = false;
            await saveFile(page, 'json');
        }),
    ));

test('kept completely, the page, gallery, exports, embedded drawings, course page and documents work without a network', () =>
    withSite(() =>
        withPage(how(), async (page) => {
            const before = await stillPicture(page);
            await kept(page);
            await page.click('#open-offline');
            await page.waitForSelector('#keep-words:has-text("MB")');
            await page.click('#keep-all');
            await page.waitForSelector('#keep-words:has-text("Everything is kept")');
            assert.equal(await page.isVisible('#keep-all'), false);
            await page.click('#close-offline');
            down = true;
            await page.reload();
            await ready(page);
            assert.equal((await stillPicture(page)).digest, before.digest);
            asked = [];
            await page.click('#open-gallery');
            await page.waitForSelector('.thumb.inked');
            await page.click('#close-gallery');
            await page.click('#tab-save');
            const saved = await saveFile(page, 'json');
            assert.ok(JSON.parse(await readFile(await saved.path(), 'utf8')).initial);
            await page.goto(`${origin}index.html`);
            await ready(page);
            await page.goto(`${origin}embed.html${KOCH}`);
            await ready(page);
            await page.goto(`${origin}course.html`);
            // Drawings out of view wait.
            await until(async () => {
                const frames = page.frames().filter((frame) => frame.url().includes('exercise.html'));
                return (await Promise.all(frames.map((frame) => frame.locator('#stage.inked').count()))).some(
                    (count) => count > 0,
                );
            }, 'a drawing of the course page is there');
            await page.goto(`${origin}docs/lesson.html`);
            await page.frameLocator('iframe').first().locator('#stage.inked').waitFor();
            await page.click('text=About');
            await until(
                () => page.evaluate(() => document.querySelector('img')?.naturalWidth),
                'the picture of a document is there',
            );
            assert.deepEqual(
                asked.filter((path) => path !== '/play/service-worker.js'),
                [],
            );
        }),
    ));

test('a new version is announced, and opens with the next visit', () =>
    withSite(() =>
        withPage(how(), async (page) => {
            const old = await reopened(page);
            await publish('Second');
            // The browser checks by itself, but at its own time.
            await update(page);
            await page.waitForSelector('#renewal:visible');
            assert.equal(await title(page), old);
            await page.reload();
            await until(async () => (await title(page)) === 'Second', 'the new version is open');
            await ready(page);
            assert.equal(await page.isVisible('#renewal'), false);
            assert.equal((await page.evaluate(() => caches.keys())).length, 1);
            // The new version stays.
            down = true;
            await page.reload();
            await ready(page);
            assert.equal(await title(page), 'Second');
        }),
    ));

test('a new version opens at once on request, and keeps the drawing', () =>
    withSite(() =>
        withPage(how(), async (page) => {
            await reopened(page);
            await publish('Third');
            await update(page);
            await page.waitForSelector('#renewal:visible');
            await page.fill('#iterations', '3');
            await until(async () => (await page.evaluate(() => location.hash)).includes('n=3'), 'the address follows');
            await page.click('#renew');
            await until(async () => (await title(page)) === 'Third', 'the new version is open');
            await ready(page);
            assert.equal(await page.inputValue('#iterations'), '3');
            assert.ok((await picture(page)).ink > 0.001);
        }),
    ));

test('an incomplete upload is not cached, and neither are files of other sites', () =>
    withSite(() =>
        withPage(how(), async (page) => {
            const old = await reopened(page);
            await publish('Fourth');
            await writeFile(join(site, 'page.js'), 'not yet');
            const worker = join(site, 'service-worker.js');
            // The list names a file that is not uploaded yet.
            const text = (await readFile(worker, 'utf8')).replace(/"page.js":"\w+"/, `"page.js":"${'0'.repeat(64)}"`);
            await writeFile(worker, text);
            const state = await page.evaluate(async () => {
                const registration = await navigator.serviceWorker.getRegistration();
                await registration?.update();
                const fresh = registration?.installing;
                if (!fresh) return 'none';
                return new Promise((resolve) => fresh.addEventListener('statechange', () => resolve(fresh.state)));
            });
            assert.equal(state, 'redundant');
            await page.reload();
            await ready(page);
            assert.equal(await title(page), old);
            const names = await page.evaluate(async () => {
                await fetch('elsewhere.json').catch(() => {});
                const [name] = await caches.keys();
                return (await (await caches.open(String(name))).keys()).map(({ url }) => url);
            });
            assert.ok(names.length > 6 && names.every((name) => name.startsWith(origin)), names.join('\n'));
            assert.ok(!names.some((name) => /elsewhere|playground\.html|service-worker/.test(name)));
        }),
    ));

test('a development server’s page caches nothing', () =>
    withPage({ hash: KOCH }, async (page) => {
        await quiet(300, 'a service worker would be registered');
        assert.deepEqual(
            await page.evaluate(async () => [
                (await navigator.serviceWorker.getRegistrations()).length,
                (await caches.keys()).length,
            ]),
            [0, 0],
        );
    }));

/**
 * Sends a form to the address of the share target, as a system does that shares something with the installed page.
 * @param {Page} page
 * @param {{text?: string, file?: {name: string, mimeType: string, buffer: Buffer}}} what
 */
async function shareWith(page, { text = '', file }) {
    await page.goto('about:blank');
    await page.setContent(
        `<form action="${origin}shared" method="post" enctype="multipart/form-data"><input name="title"><textarea name="text"></textarea>${file ? '<input name="file" type="file">' : ''}<button>Share</button></form>`,
    );
    await page.fill('textarea', text);
    if (file) await page.setInputFiles('input[type=file]', file);
    await page.click('button');
    await page.waitForURL((url) => url.href.startsWith(origin) && !url.pathname.endsWith('shared'));
    await ready(page);
    assert.doesNotMatch(page.url(), /shared/);
}

test('what other programs share opens: a picture in the search of rules, a text in the importer, a file as a system', () =>
    withSite(() =>
        withPage(how(), async (page) => {
            await kept(page);
            const buffer = await readFile(join(site, 'icons/icon-192.png'));
            await shareWith(page, { file: { name: 'leaf.png', mimeType: 'image/png', buffer } });
            await page.waitForSelector('#find[open]');
            await shareWith(page, { text: 'Dragon {\n  Angle 4\n  Axiom FX\n  F=\n  y=+FX--FY+\n  x=-FX++FY-\n}' });
            await page.waitForSelector('#import[open]');
            const system = {
                name: 'sent',
                title: 'Sent',
                initial: 'F',
                rules: ['F -> F+F'],
                num_iters: 2,
                angle_deg: 90,
            };
            const own = {
                name: 'sent.json',
                mimeType: 'application/json',
                buffer: Buffer.from(JSON.stringify(system)),
            };
            await shareWith(page, { file: own });
            await until(async () => (await page.textContent('#caption-title')) === 'Sent', 'the file opens');
            // What was opened is not kept.
            assert.equal(
                await page.evaluate(async () => (await caches.keys()).some((name) => /shared$/.test(name))),
                false,
            );
        }),
    ));
