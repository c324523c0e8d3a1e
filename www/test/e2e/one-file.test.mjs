/** The playground as a single file, opened from a disk without a server. */

import assert from 'node:assert/strict';
import { copyFile, mkdtemp, readFile, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { some } from '../effort.mjs';
import { PHONE, close, nextPicture, picture, saveFile, stillPicture, until, withPage } from './browser.mjs';

const KOCH = '#v=1&title=Koch&axiom=F&rules=F%20-%3E%20F+F--F+F&n=4&angle=60&heading=0';

let folder = '';
let address = '';

before(async () => {
    // The file alone, in a folder whose name has a blank and a non-ASCII letter.
    folder = await mkdtemp(join(tmpdir(), 'on a stick ü '));
    const file = join(folder, 'playground.html');
    await copyFile(new URL('../../../dist/playground.html', import.meta.url), file);
    address = pathToFileURL(file).href;
});
after(async () => {
    await close();
    await rm(folder, { recursive: true });
});

for (const [name, options] of some(
    /** @type {const} */ ([
        ['a desktop', {}],
        ['a phone', { options: PHONE }],
    ]),
)) {
    test(`draws from a file on ${name}, and the address contains the state`, () =>
        withPage({ address, hash: KOCH, ...options }, async (page) => {
            assert.equal(page.url(), address + KOCH);
            const before = await stillPicture(page);
            assert.ok(before.ink > 0.001);
            if (!(await page.isVisible('#iterations'))) await page.click('#tab-rules');
            await page.fill('#iterations', '5');
            await nextPicture(page, before);
            await until(async () => (await page.evaluate(() => location.hash)).includes('n=5'), 'the address follows');
        }));
}

test('requests nothing, and contains the gallery and the exports', () =>
    withPage({ address }, async (page) => {
        /** @type {string[]} */
        const asked = [];
        page.on('request', (request) => !/^(blob|data):/.test(request.url()) && asked.push(request.url()));
        const before = await stillPicture(page);
        await page.click('#open-gallery');
        await page.waitForSelector('.thumb.inked');
        await page.fill('#search', 'dragon');
        await page.locator('.card:visible').first().click();
        await nextPicture(page, before);
        await page.click('#tab-save');
        const saved = await saveFile(page, 'json');
        assert.ok(JSON.parse(await readFile(await saved.path(), 'utf8')).initial);
        const [svg] = await Promise.all([page.waitForEvent('download'), page.click('[data-save=svg]')]);
        assert.match(await readFile(await svg.path(), 'utf8'), /^(<\?xml[^>]*>\s*)?<svg/);
        assert.deepEqual(asked, []);
    }));

test('finds the rules of a picture', () =>
    withPage({ address }, async (page) => {
        await page.click('#tab-save');
        await page.click('#section-save [data-opens=find]');
        await page.click('[data-example=hexerode]');
        await page.waitForSelector('#find-verdict.found');
    }));

test('has no links to files that are not beside it', () =>
    withPage({ address, hash: KOCH }, async (page) => {
        const links = await page.locator('a').evaluateAll((all) => all.map((link) => link.getAttribute('href') ?? ''));
        assert.deepEqual(
            links.filter((link) => !/^(#|https?:|data:)/.test(link)),
            [],
        );
        assert.equal(await page.isVisible('.foot'), false);
    }));

test('its policy forbids other scripts and requests', () =>
    withPage({ address, hash: KOCH, expected: /Content Security Policy/ }, async (page) => {
        const policy = (await page.getAttribute('meta[http-equiv="Content-Security-Policy"]', 'content')) ?? '';
        assert.doesNotMatch(policy, /unsafe-inline|'unsafe-eval'|https?:|\*|'self'/);
        const ran = await page.evaluate(async () => {
            /** @type {string[]} */
            const refused = [];
            document.addEventListener('securitypolicyviolation', (event) => refused.push(event.effectiveDirective));
            const script = document.createElement('script');
            script.textContent = 'window.foreign = true';
            document.body.append(script);
            await fetch('data:text/plain,x').catch(() => {});
            while (refused.length < 2) await new Promise(requestAnimationFrame);
            return { foreign: 'foreign' in window, refused };
        });
        assert.equal(ran.foreign, false);
        assert.deepEqual(ran.refused.sort(), ['connect-src', 'script-src-elem']);
    }));

test('the engine starts again after a failure', () =>
    withPage({ address, hash: KOCH }, async (page) => {
        const before = await stillPicture(page);
        // A worker that is gone, because the page replaced it, cannot be asked.
        const fail = () => self.postMessage({ type: 'fatal', message: 'a test' });
        const failed = await Promise.allSettled(page.workers().map((worker) => worker.evaluate(fail)));
        assert.ok(failed.some(({ status }) => status === 'fulfilled'));
        await page.fill('#iterations', '3');
        const after = await nextPicture(page, before);
        assert.notEqual((await picture(page)).digest, before.digest);
        assert.ok(after.ink > 0.001);
    }));
