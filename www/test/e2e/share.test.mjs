import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import jsqr from 'jsqr';
import { clean } from '../../js/state/state.js';
import { openLink } from '../../js/state/packed.js';
import { some } from '../effort.mjs';
import { ADDRESS, DESKTOP, PHONE, close, stillPicture, until, withPage } from './browser.mjs';

after(close);

const KOCH = '#v=1&title=Koch&axiom=F&rules=F%20-%3E%20F+F--F+F&n=4&angle=60&heading=0';
const CLIPBOARD = { permissions: ['clipboard-read', 'clipboard-write'] };

/** @param {import('playwright-core').Page} page @param {string} selector */
const text = async (page, selector) => (await page.textContent(selector)) ?? '';
/** @param {import('playwright-core').Page} page */
const copied = (page) => page.evaluate(() => navigator.clipboard.readText());

/** Opens the dialog and waits for its content. @param {import('playwright-core').Page} page */
async function share(page) {
    await page.click('#share');
    await until(
        async () => (await page.inputValue('#share-link')) !== '' && (await text(page, '#qr-note')) !== '',
        'the dialog is filled',
    );
}

test('a system is copied as text for other programs', () =>
    withPage({}, async (page) => {
        await share(page);
        await page.click('#share-as > summary');
        await page.selectOption('#as-notation', 'fractint');
        await until(async () => /^\S.*\{[^]*axiom/i.test(await page.inputValue('#as-text')), 'an entry of Fractint');
        await page.selectOption('#as-notation', 'python');
        await until(async () => /import turtle/.test(await page.inputValue('#as-text')), 'a program');
        assert.ok(await page.isEnabled('#as-copy'));
    }));

/** Opens the part with code for other pages. @param {import('playwright-core').Page} page */
async function embed(page) {
    await page.click('#share-embed > summary');
    await page.waitForSelector('#embed-code:visible');
}

/** The drawing in the preview, once it is shown. @param {import('playwright-core').Page} page */
async function previewed(page) {
    const frame = await (await page.waitForSelector('#embed-preview > iframe')).contentFrame();
    assert.ok(frame);
    await frame.waitForSelector('#stage.inked');
    return frame;
}

/** Decodes the shown QR code. @param {import('playwright-core').Page} page @param {string} [place] */
async function scan(page, place = '#qr-frame') {
    const shot = (await page.locator(place).screenshot()).toString('base64');
    const { dots, width, height } = await page.evaluate(async (png) => {
        const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${png}`)).blob());
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
        const context = /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext('2d'));
        context.drawImage(bitmap, 0, 0);
        const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        // One character per pixel is transferred quickly.
        let dots = '';
        for (let at = 0; at < data.length; at += 4) dots += Number(data[at]) < 128 ? '#' : ' ';
        return { dots, width: bitmap.width, height: bitmap.height };
    }, shot);
    const colours = new Uint8ClampedArray(4 * dots.length).fill(255);
    for (let at = 0; at < dots.length; at++) if (dots[at] === '#') colours.fill(0, 4 * at, 4 * at + 3);
    const read = jsqr(colours, width, height);
    return read?.data;
}

for (const [device, options] of some(
    /** @type {const} */ ([
        ['desktop', { ...DESKTOP, ...CLIPBOARD, deviceScaleFactor: 3 }],
        ['phone, dark', { ...PHONE, ...CLIPBOARD, colorScheme: 'dark' }],
    ]),
)) {
    test(`the link is copied, scanned and sent: ${device}`, () =>
        withPage(
            {
                hash: KOCH,
                options: { ...options, bypassCSP: true },
                before: (page) =>
                    page.addInitScript(() => {
                        const seen = /** @type {any} */ (globalThis);
                        navigator.share = async (data) => {
                            seen.shared = data;
                        };
                    }),
            },
            async (page) => {
                await page.fill('#iterations', '3');
                await share(page);
                const link = ADDRESS + KOCH.replace('n=4', 'n=3');
                assert.equal(await page.inputValue('#share-link'), link);
                await page.click('#copy-share');
                await until(async () => (await text(page, '#share-status')) === 'Link copied', 'it is told');
                assert.equal(await text(page, '#copy-share'), 'Copied');
                assert.equal(await copied(page), link);
                const scanned = await scan(page);
                assert.ok(scanned?.startsWith(`${ADDRESS}#`), scanned);
                assert.deepEqual(
                    (await openLink(new URL(String(scanned)).hash))?.state,
                    (await openLink(new URL(link).hash))?.state,
                );
                await page.click('#share-send');
                assert.deepEqual(await page.evaluate(() => /** @type {any} */ (globalThis).shared), {
                    title: 'Koch',
                    url: link,
                });
                await page.keyboard.press('Escape');
                assert.ok(!(await page.isVisible('#share-dialog')));
                assert.equal(await page.evaluate(() => document.activeElement?.id), 'share');
            },
        ));
}

test('the current view is shared or not', () =>
    withPage({ hash: `${KOCH}&view=0.1,0.2,3` }, async (page) => {
        await share(page);
        assert.match(await page.inputValue('#share-link'), /&view=0\.1,0\.2,3$/);
        await page.uncheck('#share-view');
        await until(async () => (await page.inputValue('#share-link')) === ADDRESS + KOCH, 'the fitted picture');
        assert.doesNotMatch(await page.inputValue('#embed-code'), /view=/);
        await page.click('#close-share');
        await page.click('#fit');
        await share(page);
        assert.ok(!(await page.isVisible('#share-view')));
    }));

test('embed code has the state and the chosen controls', () =>
    withPage(
        {
            hash: `${KOCH}&title=${encodeURIComponent('"Koch" <&>')}&do=X:%20turn%20left%2090%0AY:%20move`,
            options: { ...DESKTOP, ...CLIPBOARD, bypassCSP: true },
        },
        async (page) => {
            await share(page);
            await embed(page);
            await page.check('input[name=controls][value=rules]');
            await page.uncheck('input[name=controls][value=n]');
            await until(
                async () => (await page.inputValue('#embed-code')).includes('controls=angle,rules'),
                'the controls',
            );
            await page.click('#copy-code');
            await until(async () => (await text(page, '#share-status')) === 'Code copied', 'it is told');
            const frame = await copied(page);
            assert.match(frame, /^<iframe .*<\/iframe>$/);
            const parsed = await page.evaluate((code) => {
                const element = new DOMParser().parseFromString(code, 'text/html').querySelector('iframe');
                return { src: String(element?.getAttribute('src')), title: element?.title };
            }, frame);
            assert.equal(parsed.title, '"Koch" <&>');
            assert.ok(parsed.src.startsWith(`${ADDRESS}v1/embed.html#v=1&`));
            const state = (await openLink(new URL(parsed.src).hash))?.state;
            assert.equal(state?.title, '"Koch" <&>');
            assert.equal(state?.overrides, 'X: turn left 90\nY: move');
            assert.equal(state?.iterations, 4);

            await page.check('#embed-element');
            await until(async () => (await page.inputValue('#embed-code')).includes('<l-system'), 'the element');
            const element = await page.evaluate(
                (code) => {
                    const parts = new DOMParser().parseFromString(code, 'text/html');
                    const found = parts.querySelector('l-system');
                    const attributes = Object.fromEntries(
                        [...(found?.attributes ?? [])].map(({ name, value }) => [name, value]),
                    );
                    return {
                        script: parts.querySelector('script')?.getAttribute('src'),
                        rules: found?.textContent?.trim(),
                        attributes,
                    };
                },
                await page.inputValue('#embed-code'),
            );
            assert.deepEqual(element, {
                script: `${ADDRESS}v1/l-system.js`,
                rules: 'F -> F+F--F+F',
                attributes: {
                    caption: '"Koch" <&>',
                    axiom: 'F',
                    n: '4',
                    angle: '60',
                    heading: '0',
                    do: 'X: turn left 90\nY: move',
                    controls: 'angle,rules',
                    style: 'width: 480px; max-width: 100%; height: 360px; aspect-ratio: auto',
                },
            });
        },
    ));

test('the preview is loaded when asked for and follows the choices', () =>
    withPage({ hash: KOCH }, async (page) => {
        await share(page);
        assert.equal(page.frames().length, 1);
        await embed(page);
        const frame = await previewed(page);
        assert.equal(await frame.textContent('#caption-title'), 'Koch');
        const box = () =>
            page.locator('#embed-preview > iframe').evaluate((each) => [each.clientWidth, each.clientHeight]);
        assert.deepEqual(await box(), [480, 360]);
        assert.match(await page.inputValue('#embed-code'), /width="480" height="360"/);
        await page.selectOption('#embed-size', 'small');
        await until(async () => String(await box()) === '320,240', 'a small frame');
        assert.deepEqual(
            [await page.inputValue('#embed-width'), await page.inputValue('#embed-height')],
            ['320', '240'],
        );
        await page.fill('#embed-width', '500');
        await until(
            async () =>
                (await page.inputValue('#embed-size')) === 'custom' &&
                /width="500" height="240"/.test(await page.inputValue('#embed-code')),
            'a size of their own',
        );
        await page.fill('#embed-height', '7');
        await page.locator('#embed-height').blur();
        await until(async () => (await page.inputValue('#embed-height')) === '200', 'the smallest height');

        assert.equal(await frame.evaluate(() => document.documentElement.dataset.theme), 'light');
        await page.selectOption('#embed-theme', 'dark');
        await until(() => frame.evaluate(() => document.documentElement.dataset.theme === 'dark'), 'a dark frame');
        assert.match(await page.inputValue('#embed-code'), /theme=dark/);
        await page.check('input[name=controls][value=play]');
        await until(() => frame.isVisible('#open-playback'), 'the playback button');
        assert.equal(await page.evaluate(() => history.length), 2, 'the preview adds nothing to the history');

        await page.check('#embed-markdown');
        await until(
            async () => (await page.inputValue('#embed-code')) === `[Koch](${ADDRESS}${KOCH})`,
            'a link with the title',
        );
        assert.ok((await page.isHidden('#embed-options')) && (await page.isHidden('#embed-shown')));
        assert.equal(page.frames().length, 1);
        await page.check('#embed-frame');
        await previewed(page);
        const guide = page.locator('#share-embed a');
        assert.deepEqual(
            [await guide.textContent(), await guide.getAttribute('href'), await guide.getAttribute('target')],
            ['How embedding works', 'docs/embedding.html', '_blank'],
        );
        await page.click('#close-share');
        await until(() => page.frames().length === 1, 'the drawing of the preview stops');
    }));

test('a preview wider than its place is scaled down, and has the scheme of the page', () =>
    withPage({ hash: KOCH, options: { ...PHONE, colorScheme: 'dark' } }, async (page) => {
        await share(page);
        await embed(page);
        const frame = await previewed(page);
        assert.equal(await frame.evaluate(() => document.documentElement.dataset.theme), 'dark');
        await page.selectOption('#embed-size', 'large');
        await until(
            async () => /^640 × 480 pixels, shown at \d\d %$/.test(await text(page, '#embed-preview-note')),
            'the scale',
        );
        const box = await page.locator('#embed-preview > iframe').boundingBox();
        assert.ok(box && box.x >= 0 && box.x + box.width <= 390, JSON.stringify(box));
    }));

test('the QR code is enlarged by a click and closed first', () =>
    withPage({ hash: KOCH, options: { ...DESKTOP, bypassCSP: true } }, async (page) => {
        await share(page);
        for (const leave of [() => page.keyboard.press('Escape'), () => page.mouse.click(30, 30)]) {
            await page.click('#qr-frame');
            await page.waitForSelector('#qr-large:visible');
            const box = await page.locator('#qr-large').boundingBox();
            assert.deepEqual(box, { x: 0, y: 0, ...DESKTOP.viewport });
            const code = await page.locator('#qr-full').boundingBox();
            assert.ok(
                code && Math.abs(code.height - DESKTOP.viewport.height) < 2 && Math.abs(code.width - code.height) < 2,
                JSON.stringify(code),
            );
            const scanned = await scan(page, '#qr-full');
            assert.deepEqual((await openLink(new URL(String(scanned)).hash))?.state, (await openLink(KOCH))?.state);
            await leave();
            assert.ok((await page.isHidden('#qr-large')) && (await page.isVisible('#share-dialog')));
            assert.equal(await page.evaluate(() => document.activeElement?.id), 'qr-frame');
        }
        await page.keyboard.press('Escape');
        assert.ok(await page.isHidden('#share-dialog'));
    }));

test('if the clipboard is refused, the older method is tried and the text selected', async () => {
    for (const older of [true, false]) {
        await withPage(
            {
                hash: KOCH,
                before: (page) =>
                    page.addInitScript((works) => {
                        Object.defineProperty(navigator, 'clipboard', {
                            value: { writeText: () => Promise.reject(new DOMException('refused', 'NotAllowedError')) },
                        });
                        if (!works) document.execCommand = () => false;
                    }, older),
            },
            async (page) => {
                await share(page);
                await page.click('#copy-share');
                await until(async () => (await text(page, '#share-status')) !== '', 'it is told');
                if (older) {
                    assert.equal(await text(page, '#share-status'), 'Link copied');
                    await page.click('#close-share');
                    await page.click('#tab-rules');
                    await page.fill('#axiom', '');
                    await page.focus('#axiom');
                    await page.keyboard.press('Control+v');
                    assert.equal(await page.inputValue('#axiom'), ADDRESS + KOCH);
                    return;
                }
                assert.match(await text(page, '#share-status'), /selected: press (Ctrl\+|⌘)C/);
                const selected = () =>
                    page.evaluate(() => {
                        const field = /** @type {HTMLInputElement} */ (document.activeElement);
                        return field.value.slice(field.selectionStart ?? 0, field.selectionEnd ?? 0);
                    });
                assert.equal(await selected(), ADDRESS + KOCH);
            },
        );
    }
});

test('a link too long for a QR code shows a message; the QR code of a long link has its compressed form', () =>
    withPage({ hash: KOCH }, async (page) => {
        await stillPicture(page);
        let seed = 1;
        const noise = Array.from({ length: 4000 }, () =>
            String.fromCharCode(33 + ((seed = (seed * 48271) % 2147483647) % 90)),
        ).join('');
        await page.fill('#rules', `// ${'the same words again, '.repeat(100)}\nF -> F+F`);
        await share(page);
        assert.match(await page.inputValue('#share-link'), /#v=1&z=[\w-]+$/);
        assert.ok(await page.isVisible('#qr'));
        await page.click('#close-share');
        await page.fill('#rules', `// ${noise}\nF -> F+F`);
        await page.click('#share');
        await until(async () => (await text(page, '#qr-note')).includes('too long'), 'the refusal');
        assert.ok(!(await page.isVisible('#qr')) && !(await page.isVisible('#save-qr')));
        assert.match(await text(page, '#share-link-note'), /\d,\d{3} characters/);
        assert.deepEqual(
            (await openLink(new URL(await page.inputValue('#share-link')).hash))?.state,
            clean({ title: 'Koch', axiom: 'F', rules: `// ${noise}\nF -> F+F`, iterations: 4, angle: 60, heading: 0 }),
        );
    }));

test('the QR code can be saved as a picture', () =>
    withPage({ hash: KOCH }, async (page) => {
        await share(page);
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-qr')]);
        assert.equal(download.suggestedFilename(), 'Koch_n4_qr.svg');
        assert.match(
            await readFile(String(await download.path()), 'utf8'),
            /^<svg xmlns="http:\/\/www\.w3\.org\/2000\/svg" .*<\/svg>\n$/,
        );
    }));

test('the keyboard reaches every control of the dialog in order and stays inside', () =>
    withPage({ hash: KOCH }, async (page) => {
        await share(page);
        assert.equal(await page.evaluate(() => document.activeElement?.id), 'copy-share');
        assert.ok(await page.isHidden('#embed-code'), 'the code is shown when asked for');
        await embed(page);
        await previewed(page);
        await page.focus('#copy-share');
        /** @type {string[]} */
        const order = [];
        for (let step = 0; step < 32; step++) {
            await page.keyboard.press('Tab');
            order.push(
                await page.evaluate(
                    () =>
                        document.activeElement?.id ||
                        /** @type {HTMLInputElement | null} */ (document.activeElement)?.value ||
                        document.activeElement?.nodeName ||
                        '',
                ),
            );
        }
        for (const id of [
            'qr-frame',
            'save-qr',
            'SUMMARY',
            'embed-frame',
            'embed-size',
            'embed-width',
            'embed-height',
            'embed-theme',
            'angle',
            'n',
            'rules',
            'string',
            'play',
            'embed-code',
            'copy-code',
            'close-share',
            'share-link',
        ])
            assert.ok(order.includes(id), `${id} in ${order}`);
        assert.ok(!order.some((id) => ['axiom', 'drawing', 'share'].includes(id)));
    }));

test('a page from a disk says where its links work', () =>
    withPage({ address: new URL('../../../dist/playground.html', import.meta.url).href, hash: KOCH }, async (page) => {
        await share(page);
        assert.match(await text(page, '#share-link-note'), /this computer only/);
        assert.match(await text(page, '#qr-note'), /phones cannot reach it/);
        await embed(page);
        assert.match(await text(page, '#embed-note'), /web server/);
        assert.ok(await page.isHidden('#embed-shown'), 'no preview');
        assert.ok(!(await page.isVisible('#qr')));
        assert.match(await page.inputValue('#share-link'), /^file:.*\/playground\.html#v=1&title=Koch/);
    }));
