import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { ADDRESS, DESKTOP, PHONE, close, drag, quiet, ready, stillPicture, until, withPage } from './browser.mjs';

after(close);

const KOCH = '#v=1&title=Koch&axiom=F&rules=F%20-%3E%20F+F--F+F&n=4&angle=60&heading=0';
const ISLAND = '#v=1&title=Island&axiom=F-F-F-F&rules=F%20-%3E%20F-F+F+FF-F-F+F&n=2&angle=90';

/** @typedef {import('playwright-core').Page} Page */

/** @param {Page} page @param {string} selector */
const text = async (page, selector) => (await page.textContent(selector)) ?? '';

/** Another page of the same browser, with the same storage. @param {Page} page @param {string} hash */
async function another(page, hash) {
    const other = await page.context().newPage();
    await other.goto(ADDRESS + hash);
    await ready(other);
    return other;
}

/** Waits until this visit is saved. @param {Page} page @param {string} part of its link */
const kept = (page, part) =>
    until(async () => (await stored(page, 'sessions')).some(({ link }) => link.includes(part)), `${part} is kept`);

/** @param {Page} page @param {string} name */
async function keep(page, name) {
    await page.fill('#favourite-name', name);
    await page.click('#add-favourite');
    await until(async () => (await text(page, '#toast')).includes('favourites'), 'it is told');
}

/** @param {Page} page */
const names = (page) => page.locator('#favourite-cards .card-title').allTextContents();

/** What is kept, newest first. @param {Page} page @param {string} [key] @returns {Promise<{name: string, link: string, made: number}[]>} */
const stored = (page, key = 'favourites') =>
    page.evaluate((key) => {
        const start = `l-systems:${key} `;
        const names = Object.keys(localStorage).filter((name) => name.startsWith(start));
        const rows = names.map((name) => JSON.parse(name.slice(start.length))).filter((row) => !row.gone);
        return rows.sort((a, b) => b.made - a.made);
    }, key);

for (const [device, options] of some(
    /** @type {const} */ ([
        ['desktop', DESKTOP],
        ['phone', PHONE],
    ]),
)) {
    test(`a returning reader finds the last state: ${device}`, () =>
        withPage({ options }, async (page) => {
            await page.fill('#angle', '31');
            await page.fill('#iterations', '4');
            await kept(page, 'angle=31');
            const shown = await stillPicture(page);
            const back = await another(page, '');
            assert.equal((await stillPicture(back)).digest, shown.digest);
            assert.equal(await back.inputValue('#angle'), '31');
            assert.match(await text(back, '#toast'), /where you left off/);
            await until(
                () => back.evaluate(() => location.hash.includes('angle=31')),
                'the address says what is shown',
            );
            await back.reload();
            await ready(back);
            assert.equal(await back.locator('#toast.shown').count(), 0);
            // Reset still returns to the original system.
            await back.click('#reset');
            assert.equal(await back.inputValue('#angle'), '22');
        }));

    test(`an opened link keeps the last visit and offers to continue it: ${device}`, () =>
        withPage({ hash: KOCH, options }, async (page) => {
            await page.fill('#angle', '77');
            await kept(page, 'angle=77');
            const other = await another(page, ISLAND);
            assert.equal(await other.inputValue('#axiom'), 'F-F-F-F');
            const offer = other.locator('#toast button', { hasText: 'Continue where you left off' });
            assert.ok(await offer.isVisible());
            // Moving the view is no change.
            await other.click('#fit');
            await other.mouse.move(150, 200);
            if (options === DESKTOP) await other.mouse.wheel(0, -300);
            await quiet(700, 'the visit would be saved');
            const third = await another(page, '');
            assert.equal(await third.inputValue('#angle'), '77');
            await offer.click();
            assert.equal(await other.inputValue('#angle'), '77');
            assert.equal(await text(other, '#specimen-title'), 'Koch');
            await other.click('#undo');
            assert.equal(await other.inputValue('#axiom'), 'F-F-F-F');
        }));

    test(`favourites are saved, opened, renamed, deleted and restored: ${device}`, () =>
        withPage({ hash: KOCH, options }, async (page) => {
            await page.click('#tab-save');
            await keep(page, '');
            await page.fill('#favourite-name', 'Koch');
            await page.click('#add-favourite');
            await until(async () => (await text(page, '#toast')).includes('already'), 'not twice');
            await page.evaluate((hash) => (location.hash = hash), ISLAND);
            await until(async () => (await page.inputValue('#axiom')) === 'F-F-F-F', 'the link is open');
            await keep(page, '  An   island ');
            assert.equal(await text(page, '#favourites-count'), '2');

            await page.click('#open-favourites');
            await page.waitForSelector('#favourites[open]');
            assert.deepEqual(await names(page), ['An island', 'Koch']);
            await until(
                async () => (await page.locator('#favourite-cards .thumb.inked').count()) === 2,
                'the small pictures',
            );
            await page.locator('#favourite-cards .card', { hasText: 'Koch' }).click();
            assert.equal(await page.inputValue('#axiom'), 'F');
            await page.click('#undo');
            assert.equal(await page.inputValue('#axiom'), 'F-F-F-F');

            await page.click('#open-favourites');
            await page.waitForSelector('#favourites[open]');
            await page.getByRole('button', { name: 'Rename Koch' }).click();
            assert.equal(
                await page.evaluate(() => /** @type {HTMLInputElement} */ (document.activeElement).value),
                'Koch',
            );
            await page.keyboard.type('Snow');
            await page.keyboard.press('Escape');
            assert.ok(await page.isVisible('#favourites'));
            assert.deepEqual(await names(page), ['An island', 'Koch']);
            await page.getByRole('button', { name: 'Rename Koch' }).click();
            await page.keyboard.type('Snow');
            await page.keyboard.press('Enter');
            assert.deepEqual(await names(page), ['An island', 'Snow']);
            assert.equal(await page.evaluate(() => document.activeElement?.getAttribute('aria-label')), 'Rename Snow');

            await page.getByRole('button', { name: 'Delete An island' }).click();
            assert.deepEqual(await names(page), ['Snow']);
            assert.match(await text(page, '#favourites-status'), /Deleted “An island”/);
            assert.equal((await stored(page)).length, 1);
            await page.click('#favourites-undo');
            assert.deepEqual(await names(page), ['An island', 'Snow']);
            assert.ok(!(await page.isVisible('#favourites-undo')));
            await page.keyboard.press('Escape');
            await page.reload();
            await until(async () => (await text(page, '#favourites-count')) === '2', 'the count is shown again');
        }));
}

test('a reload continues the same visit, even with changes that are not yet in the address', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.fill('#angle', '50');
        await kept(page, 'angle=50');
        await page.fill('#angle', '51');
        await page.reload();
        await ready(page);
        assert.equal(await page.inputValue('#angle'), '51');
        assert.equal(await page.locator('#toast.shown').count(), 0);
        assert.ok(await page.isVisible('#edited'));
        await page.click('#reset');
        assert.equal(await page.inputValue('#angle'), '60');
        await kept(page, 'angle=60');
        assert.equal((await stored(page, 'sessions')).length, 1);
    }));

test('two tabs do not overwrite each other’s visits', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.fill('#angle', '10');
        await kept(page, 'angle=10');
        const other = await another(page, '');
        await other.fill('#angle', '20');
        await kept(other, 'angle=20');
        await page.fill('#angle', '11');
        await kept(page, 'angle=11');
        const third = await another(page, '');
        assert.equal(await third.inputValue('#angle'), '11');
        await third.click('#tab-save');
        await third.click('#open-favourites');
        await third.waitForSelector('#favourites[open]');
        // This tab restored the newest visit, and both visits stay.
        assert.equal(await third.locator('#visit-cards .card').count(), 2);
        await third.locator('#visit-cards .card').nth(1).click();
        assert.equal(await third.inputValue('#angle'), '20');
    }));

test('a visit without changes is not saved', () =>
    withPage({ hash: ISLAND }, async (page) => {
        await page.click('#zoom-in');
        await quiet(700, 'the visit would be saved');
        assert.deepEqual(await stored(page, 'sessions'), []);
    }));

test('favourites are exported to one file and imported from it: chosen, opened and dropped', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.click('#tab-save');
        await page.click('#zoom-in');
        await until(() => page.evaluate(() => location.hash.includes('view=')), 'the view is in the address');
        await keep(page, 'Close up');
        await page.evaluate((hash) => (location.hash = hash), ISLAND);
        await until(async () => (await page.inputValue('#axiom')) === 'F-F-F-F', 'the link is open');
        await keep(page, 'Island');
        await page.click('#open-favourites');
        await page.waitForSelector('#favourites[open]');
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export-favourites')]);
        assert.equal(download.suggestedFilename(), 'favourites.json');
        const file = await readFile(String(await download.path()));
        const before = await stored(page);
        const links = (/** @type {{name: string, link: string}[]} */ list) =>
            list.map(({ name, link }) => ({ name, link }));
        assert.match(before[1]?.link ?? '', /view=/);

        const clear = async () => {
            await page.evaluate(() => localStorage.clear());
            await page.click('#close-favourites');
        };
        await clear();
        await page.click('#open-favourites');
        await page.waitForSelector('#favourites[open]');
        assert.ok(await page.isVisible('#no-favourites'));
        assert.ok(await page.isDisabled('#export-favourites'));
        await page.setInputFiles('#favourites-file', {
            name: 'favourites.json',
            mimeType: 'application/json',
            buffer: file,
        });
        await until(async () => (await text(page, '#favourites-status')) === 'Added 2 favourites.', 'they are back');
        assert.deepEqual(links(await stored(page)), links(before));
        await page.setInputFiles('#favourites-file', {
            name: 'favourites.json',
            mimeType: 'application/json',
            buffer: file,
        });
        await until(async () => (await text(page, '#favourites-status')).includes('2 were already there'), 'not twice');
        await page.setInputFiles('#favourites-file', {
            name: 'x.json',
            mimeType: 'application/json',
            buffer: Buffer.from('{"initial": "F"}'),
        });
        await until(
            async () => (await text(page, '#favourites-status')).includes('contains no favourites'),
            'the refusal',
        );
        await clear();
        await page.setInputFiles('#file', { name: 'mine.json', mimeType: 'application/json', buffer: file });
        await until(async () => (await text(page, '#toast')).includes('Added 2'), 'opened like a system');
        assert.deepEqual(links(await stored(page)), links(before));
        await page.evaluate(() => localStorage.clear());
        await page.evaluate((content) => {
            const dataTransfer = new DataTransfer();
            dataTransfer.items.add(new File([content], 'mine.json'));
            for (const type of ['dragenter', 'dragover', 'drop'])
                document.body.dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true }));
        }, file.toString());
        await until(async () => (await stored(page)).length === 2, 'dropped');
        assert.equal(await page.inputValue('#axiom'), 'F-F-F-F');
    }));

test('names and storage may contain anything', () =>
    withPage({ hash: KOCH }, async (page) => {
        page.on('dialog', (dialog) => assert.fail(dialog.message()));
        await page.click('#tab-save');
        await keep(page, '<img src=x onerror=alert(1)>');
        await page.click('#open-favourites');
        await page.waitForSelector('#favourites[open]');
        assert.deepEqual(await names(page), ['<img src=x onerror=alert(1)>']);
        assert.equal(await page.locator('#favourites img').count(), 0);
        await page.click('#close-favourites');
        await page.evaluate(() => {
            localStorage.clear();
            localStorage.setItem(
                'l-systems:favourites',
                '[{"id": "a\\"]", "name": "odd", "link": "nothing"}, 7, null]',
            );
            localStorage.setItem('l-systems:sessions', '{"not": "a list"');
        });
        await page.goto('about:blank');
        await page.goto(ADDRESS);
        await ready(page);
        await page.click('#tab-save');
        await page.click('#open-favourites');
        await page.waitForSelector('#favourites[open]');
        assert.deepEqual(await names(page), ['odd']);
        await page.getByRole('button', { name: 'Delete odd' }).click();
        assert.deepEqual(await names(page), []);
    }));

for (const [what, area] of some(
    /** @type {const} */ ([
        ['full', 'full'],
        ['refused', 'refused'],
    ]),
)) {
    test(`storage that is ${what} is no error`, () =>
        withPage(
            {
                hash: KOCH,
                before: (page) =>
                    page.addInitScript((kind) => {
                        if (kind === 'full') {
                            Storage.prototype.setItem = () => {
                                throw new DOMException('full', 'QuotaExceededError');
                            };
                            Object.defineProperty(Storage.prototype, 'length', { value: 1 });
                            return;
                        }
                        for (const name of ['localStorage', 'sessionStorage']) {
                            Object.defineProperty(globalThis, name, {
                                get() {
                                    throw new DOMException('refused', 'SecurityError');
                                },
                            });
                        }
                    }, area),
            },
            async (page) => {
                await page.fill('#angle', '50');
                await page.click('#tab-save');
                if (area === 'refused') {
                    assert.ok(!(await page.isVisible('#add-favourite')));
                    assert.match(await text(page, '#favourites-refused'), /stores nothing/);
                    assert.ok(await page.isVisible('#favourites-refused'));
                    await page.setInputFiles('#file', {
                        name: 'mine.json',
                        mimeType: 'application/json',
                        buffer: Buffer.from('{"format": "l-systems favourites", "favourites": []}'),
                    });
                    await until(
                        async () => (await text(page, '#toast')).includes('cannot store favourites'),
                        'the refusal',
                    );
                } else {
                    await page.click('#add-favourite');
                    await until(
                        async () => (await text(page, '#toast')).includes('storage for this page is full'),
                        'the refusal',
                    );
                }
                await until(() => page.evaluate(() => location.hash.includes('angle=50')), 'the address follows');
                await page.reload();
                await ready(page);
                assert.equal(await page.inputValue('#angle'), '50');
            },
        ));
}

test('a sandboxed frame without storage works and says so', () =>
    withPage({ hash: KOCH, expected: /Permissions policy/ }, async (page) => {
        const frame = `${ADDRESS}frame.html`;
        await page.route(frame, (route) =>
            route.fulfill({
                contentType: 'text/html',
                body: `<iframe sandbox="allow-scripts" width="1200" height="700" src="playground.html${KOCH}"></iframe>`,
            }),
        );
        await page.goto(frame);
        const inside = page.frameLocator('iframe');
        await inside.locator('#stage.inked').waitFor();
        await inside.locator('#angle').fill('50');
        await inside.locator('#tab-save').click();
        assert.ok(await inside.locator('#favourites-refused').isVisible());
        await inside.locator('#share').click();
        await inside.locator('#copy-share').click();
        await until(
            async () => (await inside.locator('#share-status').textContent()) !== '',
            'the dialog, or the clipboard',
        );
        assert.match(await inside.locator('#share-link').inputValue(), /angle=50/);
    }));

test('undo and redo cover the gallery, links, favourites, files and changes between them', () =>
    withPage({ hash: KOCH }, async (page) => {
        const axiom = () => page.inputValue('#axiom');
        await page.click('#tab-save');
        await keep(page, 'Koch');
        await page.click('#open-gallery');
        await page.waitForSelector('.card');
        await page.fill('#search', 'dragon');
        await page.locator('#gallery .card:visible').first().click();
        const dragon = await page.inputValue('#rules');
        await drag(page, '#angle-slider', [10, 20, 30]);
        const angle = await page.inputValue('#angle');
        await page.evaluate((hash) => (location.hash = hash), ISLAND);
        await until(async () => (await axiom()) === 'F-F-F-F', 'the link is open');
        await page.setInputFiles('#file', {
            name: 'a.json',
            mimeType: 'application/json',
            buffer: Buffer.from('{"initial": "A+A", "turtle": {}}'),
        });
        await until(async () => (await axiom()) === 'A+A', 'the file is open');
        await page.click('#open-favourites');
        await page.waitForSelector('#favourites[open]');
        await page.locator('#favourite-cards .card').click();
        assert.equal(await text(page, '#specimen-title'), 'Koch');
        const end = await page.inputValue('#rules');

        await page.click('#undo');
        assert.equal(await axiom(), 'A+A');
        await page.click('#undo');
        assert.equal(await axiom(), 'F-F-F-F');
        await page.click('#undo');
        assert.deepEqual([await page.inputValue('#rules'), await page.inputValue('#angle')], [dragon, angle]);
        await page.click('#undo');
        await page.click('#undo');
        assert.equal(await text(page, '#specimen-title'), 'Koch');
        assert.ok(await page.isDisabled('#undo'));
        for (let step = 0; step < 5; step++) await page.click('#redo');
        assert.ok(await page.isDisabled('#redo'));
        assert.equal(await page.inputValue('#rules'), end);
    }));

test('two tabs: favourites and choices of both stay, and the other tab shows them', () =>
    withPage({ hash: KOCH }, async (page) => {
        const other = await another(page, ISLAND);
        for (const tab of [page, other]) {
            await tab.click('#tab-save');
            await keep(tab, '');
        }
        await until(async () => (await text(page, '#favourites-count')) === '2', 'the number of both');
        for (const tab of [page, other]) {
            await tab.click('#open-favourites');
            await tab.waitForSelector('#favourites[open]');
            assert.deepEqual(await names(tab), ['Island', 'Koch']);
        }
        await other.getByRole('button', { name: 'Delete Koch' }).click();
        await until(async () => (await names(page)).join() === 'Island', 'the other list is shorter');
        await page.getByRole('button', { name: 'Rename Island' }).click();
        await page.keyboard.type('Isle');
        await page.keyboard.press('Enter');
        await until(async () => (await names(other)).join() === 'Isle', 'the new name');
        await other.click('#favourites-undo');
        await until(async () => (await names(page)).join() === 'Isle,Koch', 'it is back in its place');
        for (const tab of [page, other]) await tab.click('#close-favourites');
        // Each tab changes another choice, and has its own old value of the other's.
        for (const tab of [page, other]) {
            await tab.click('#open-save');
            await tab.click('.save-tile:has([value=print])');
        }
        await page.selectOption('#poster-sheet', 'a4');
        await other.selectOption('#poster-dpi', '150');
        for (const tab of [page, other]) await tab.click('#close-save');
        const third = await another(page, KOCH);
        await third.click('#tab-save');
        await third.click('#open-save');
        assert.equal(await third.inputValue('#poster-sheet'), 'a4');
        assert.equal(await third.inputValue('#poster-dpi'), '150');
        await page.click('#theme');
        const theme = await page.getAttribute('html', 'data-theme');
        await until(async () => (await other.getAttribute('html', 'data-theme')) === theme, 'the theme of both');
    }));
