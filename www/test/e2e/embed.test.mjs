/** Embedded drawings: in a frame, a sandbox, an element, a file. The host is another site. */

import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { copyFile, mkdtemp, rm } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { some } from '../effort.mjs';
import { ADDRESS, DESKTOP, PHONE, close, picture, quiet, ready, until, withPage } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('playwright-core').Frame} Frame */

const WEED = 'v=1&title=Weed&axiom=F&rules=F%20-%3E%20F%5B+F%5DF%5B-F%5DF&n=4&angle=25';
const ELEMENT = `<script src="${ADDRESS}l-system.js"></script>`;

/** The host's style, and its hash for the content security policy. */
const STYLE =
    'iframe, l-system { display: block; width: 600px; max-width: 100%; height: 400px; border: 0; aspect-ratio: auto }';
const STYLE_HASH = createHash('sha256').update(STYLE).digest('base64');

/** The host's pages, by path. @type {Map<string, string>} */
const pages = new Map();
const server = createServer((request, response) => {
    const page = pages.get(String(request.url));
    response.writeHead(page === undefined ? 404 : 200, { 'content-type': 'text/html; charset=utf-8' });
    response.end(page);
});
let host = '';
let folder = '';

before(async () => {
    await new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(null)));
    const address = server.address();
    // Another host name than the playground's makes the host another site, not only another origin.
    host = `http://localhost:${typeof address === 'object' ? address?.port : ''}/`;
    folder = await mkdtemp(join(tmpdir(), 'on a stick ü '));
    await copyFile(new URL('../../../dist/embed.html', import.meta.url), join(folder, 'embed.html'));
});
after(async () => {
    await close();
    server.close();
    await rm(folder, { recursive: true });
});

/**
 * Opens a page of another site with this body.
 * @param {string} body
 * @param {(page: Page) => Promise<unknown>} use
 * @param {{options?: import('playwright-core').BrowserContextOptions, expected?: RegExp, head?: string}} [how]
 */
function withHost(body, use, { options = DESKTOP, expected, head = '' } = {}) {
    const path = `/${pages.size}`;
    pages.set(
        path,
        `<!doctype html><html lang="en"><title>Host</title><link rel="icon" href="data:,">${head}<style>${STYLE}</style><body>${body}</body></html>`,
    );
    return withPage({ address: host, hash: path.slice(1), also: ADDRESS, drawing: null, options, expected }, use);
}

/** @param {string} hash @param {string} [more] attributes */
const frameOf = (hash, more = '') =>
    `<iframe title="A drawing" src="${ADDRESS}embed.html#${hash.replaceAll('&', '&amp;')}" ${more}></iframe>`;

/** The frame of a drawing. @param {Page} page @param {number} [index] @returns {Promise<Frame>} */
function drawn(page, index = 0) {
    return until(async () => {
        const frame = embedded(page)[index];
        const rests = await frame?.evaluate(
            () => document.querySelector('#stage.inked')?.getAttribute('aria-busy') === 'false',
        );
        return rests ? frame : null;
    }, 'the drawing comes to rest');
}

/** The frames that have begun to load. @param {Page} page */
const embedded = (page) => page.frames().filter((frame) => frame.url().includes('embed.html'));

/** Waits for another picture. @param {Frame} frame @param {{digest: string}} before */
const changes = (frame, before) =>
    until(
        async () =>
            (await picture(frame)).digest !== before.digest &&
            (await frame.getAttribute('#stage', 'aria-busy')) === 'false',
        'the picture changes',
    );

/** A script after an element that collects its events. */
const LISTEN = `<script>
    var heard = [];
    for (const kind of ['ready', 'change', 'error']) document.querySelector('l-system').addEventListener(kind, ({ detail }) => heard.push([kind, detail]));
</script>`;
/** @param {Page} page @returns {Promise<[string, any][]>} */
const heard = (page) => page.evaluate(() => /** @type {any} */ (window).heard);

test('a frame draws, has a name, and shows only the requested controls', () =>
    withHost(frameOf(`${WEED}&controls=n,angle`) + frameOf(WEED), async (page) => {
        const [first, second] = [await drawn(page), await drawn(page, 1)];
        assert.ok((await picture(first)).ink > 0.002);
        assert.equal(await first.title(), 'Weed – L-system');
        assert.equal(await first.getAttribute('#drawing', 'aria-label'), 'Drawing: Weed');
        await until(
            async () => ((await first.textContent('#description')) ?? '').length > 10,
            'the drawing is described',
        );
        const shown = async (/** @type {Frame} */ frame) =>
            Object.fromEntries(
                await Promise.all(
                    [
                        '#iterations',
                        '#angle',
                        '#right',
                        '#rules',
                        '#open-reader',
                        '#open-playback',
                        '#reset',
                        '#open',
                    ].map(async (name) => [name, await frame.isVisible(name)]),
                ),
            );
        assert.deepEqual(await shown(first), {
            '#iterations': true,
            '#angle': true,
            '#right': false,
            '#rules': false,
            '#open-reader': false,
            '#open-playback': false,
            '#reset': true,
            '#open': true,
        });
        assert.deepEqual(await shown(second), {
            '#iterations': false,
            '#angle': false,
            '#right': false,
            '#rules': false,
            '#open-reader': false,
            '#open-playback': false,
            '#reset': false,
            '#open': true,
        });
        // Keys change the same fields as the controls.
        const before = await picture(second);
        await second.focus('#drawing');
        await page.keyboard.press('ArrowUp');
        await page.keyboard.press('ArrowRight');
        await page.keyboard.press('Shift+ArrowRight');
        await changes(second, before);
        assert.match((await second.textContent('#caption-text')) ?? '', /^n = 4, 25°/);
        await first.focus('#drawing');
        await page.keyboard.press('ArrowUp');
        await until(async () => /^n = 5/.test((await first.textContent('#caption-text')) ?? ''), 'one iteration more');
        await first.fill('#angle', '30');
        await until(async () => /30°/.test((await first.textContent('#caption-text')) ?? ''), 'another angle');
        await first.click('#reset');
        await until(
            async () => /^n = 4, 25°/.test((await first.textContent('#caption-text')) ?? ''),
            'as it was embedded',
        );
    }));

test('string and playback work in a frame', () =>
    withHost(frameOf(`${WEED}&controls=string,play,rules`, 'style="height: 700px"'), async (page) => {
        const frame = await drawn(page);
        const whole = await picture(frame);
        await frame.click('#open-reader');
        await until(async () => /F/.test((await frame.textContent('#reader-text')) ?? ''), 'the string is shown');
        await frame.click('#close-reader');
        await frame.click('#open-playback');
        await frame.click('#play');
        await frame.fill('#play-place', '5');
        await frame.press('#play-place', 'Enter');
        await until(async () => {
            const now = await picture(frame);
            return now.ink > 0 && now.ink < whole.ink / 2;
        }, 'five segments are drawn');
        await frame.click('#close-playback');
        await frame.fill('#rules', 'F -> FF');
        await until(
            async () => /16 segments/.test((await frame.textContent('#caption-text')) ?? ''),
            'the edited rules are drawn',
        );
    }));

test('a low frame shows its drawing with the playback bar, and symbols of its string', () =>
    withHost(frameOf(`${WEED}&controls=all`, 'style="width: 400px; height: 300px"'), async (page) => {
        const frame = await drawn(page);
        assert.ok(await frame.isHidden('#start-anew'), 'a frame begins no other system');
        await frame.click('#open-playback');
        await until(
            async () => Number((await frame.locator('#drawing').boundingBox())?.height) > 120,
            'there is room for the drawing',
        );
        await frame.click('#close-playback');
        await frame.click('#open-reader');
        await until(
            async () => /^1 to [1-9]/.test((await frame.textContent('#reader-where')) ?? ''),
            'rows of symbols can be seen',
        );
        await until(
            async () => (await frame.locator('#reader-text .cells').allTextContents()).every((row) => row.length > 20),
            'every row is full',
        );
    }));

test('a low frame shows at least six rows of its string', async () => {
    for (const size of some([
        'width: 320px; height: 240px',
        'width: 640px; height: 300px',
        'width: 420px; height: 300px',
        'width: 480px; height: 360px',
    ])) {
        await withHost(frameOf(`${WEED}&controls=string`, `style="${size}"`), async (page) => {
            const frame = await drawn(page);
            await frame.click('#open-reader');
            await until(async () => {
                const window = await frame.locator('#reader-text').boundingBox();
                const boxes = await Promise.all(
                    (await frame.locator('#reader-text .row-line').all()).map((row) => row.boundingBox()),
                );
                return (
                    window &&
                    boxes.filter(
                        (box) => box && box.y >= window.y - 1 && box.y + box.height <= window.y + window.height + 1,
                    ).length >= 6
                );
            }, `six rows in ${size}`);
            const close = await frame.locator('#close-reader').boundingBox();
            const whole = await page.locator('iframe').boundingBox();
            assert.ok(close && whole && close.x + close.width <= whole.x + whole.width, size);
            await frame.click('#close-reader');
            assert.ok(await frame.isHidden('#reader'));
        });
    }
});

for (const colorScheme of some(/** @type {const} */ (['dark', 'light']))) {
    test(`embedded drawings have the scheme of the host, not of the reader's system: ${colorScheme} system`, async () => {
        const system = colorScheme === 'dark';
        for (const [head, dark] of /** @type {[string, boolean][]} */ ([
            ['', false],
            ['<meta name="color-scheme" content="light">', false],
            ['<meta name="color-scheme" content="light dark">', system],
            ['<style>:root { color-scheme: light dark }</style>', system],
            ['<style>:root { color-scheme: dark }</style>', true],
        ])) {
            const element = '<l-system axiom="F" n="3" controls="n"><pre>F -&gt; F+F</pre></l-system>';
            await withHost(
                frameOf(`${WEED}&controls=n`) + element + frameOf(`${WEED}&controls=n&theme=dark`),
                async (page) => {
                    await until(() => embedded(page).length === 3, 'three frames');
                    const themes = async () => {
                        const frames = await Promise.all(
                            ['body > iframe >> nth=0', 'l-system iframe', 'body > iframe >> nth=1'].map(async (name) =>
                                (await page.waitForSelector(name)).contentFrame(),
                            ),
                        );
                        return Promise.all(
                            frames.map((frame) =>
                                frame?.evaluate(() => {
                                    const [red = 0] = (
                                        getComputedStyle(
                                            /** @type {Element} */ (document.querySelector('#panel')),
                                        ).backgroundColor.match(/\d+/g) ?? []
                                    ).map(Number);
                                    return red < 100 ? 'dark' : 'light';
                                }),
                            ),
                        );
                    };
                    // A frame of another site cannot see the scheme of its host, and stays light.
                    await until(
                        async () =>
                            assert.deepEqual(await themes(), ['light', dark ? 'dark' : 'light', 'dark']) ?? true,
                        head,
                    );
                },
                { head: head + ELEMENT, options: { ...DESKTOP, colorScheme } },
            );
        }
    });
}

test('an element follows a host that switches its scheme, and keeps the visitor’s changes', () =>
    withHost(
        '<l-system axiom="F" n="3" controls="n"><pre>F -&gt; F+F</pre></l-system>',
        async (page) => {
            const frame = await drawn(page);
            const theme = () => frame.evaluate(() => document.documentElement.dataset.theme);
            assert.equal(await theme(), 'light');
            await frame.fill('#iterations', '2');
            await page.evaluate(() => (document.documentElement.className = 'night'));
            await until(async () => (await theme()) === 'dark', 'dark');
            await page.evaluate(() => document.querySelector('l-system')?.setAttribute('theme', 'light'));
            await until(async () => (await theme()) === 'light', 'light');
            assert.equal(await frame.inputValue('#iterations'), '2');
        },
        { head: `<style>.night { color-scheme: dark }</style>${ELEMENT}` },
    ));

test('a drawing in space turns with the pointer', () =>
    withHost(
        frameOf('v=1&axiom=A&rules=A%20-%3E%20F%5B%26A%5D%2FF%5B%5EA%5D%2FA&n=4&angle=35&controls=n,play'),
        async (page) => {
            const frame = await drawn(page);
            const before = await picture(frame);
            assert.ok(before.ink > 0.001);
            assert.equal(await frame.locator('#stage.space').count(), 1);
            await page.mouse.move(250, 200);
            await page.mouse.down();
            await page.mouse.move(330, 200, { steps: 4 });
            await page.mouse.up();
            await changes(frame, before);
            await until(
                async () => (await frame.getAttribute('#open', 'href'))?.includes('camera='),
                'the address tells from where',
            );
            await frame.click('#reset');
            await until(
                async () => !(await frame.getAttribute('#open', 'href'))?.includes('camera='),
                'and it turns back',
            );
        },
    ));

test('the wheel scrolls the page until the drawing has the focus', () =>
    withHost(`${frameOf(WEED)}<p style="height: 3000px">text</p>`, async (page) => {
        const frame = await drawn(page);
        await page.mouse.move(300, 200);
        await page.mouse.wheel(0, 100);
        await until(() => page.evaluate(() => scrollY > 50), 'the page scrolls');
        assert.equal(await frame.evaluate(() => document.querySelector('#zoom')?.textContent?.includes('100')), true);
        await page.evaluate(() => scrollTo(0, 0));
        const before = await picture(frame);
        await page.mouse.click(300, 200);
        await page.mouse.wheel(0, -300);
        await changes(frame, before);
        assert.equal(await page.evaluate(() => scrollY), 0);
        // Escape gives the wheel back to the page.
        await page.keyboard.press('Escape');
        await page.mouse.wheel(0, 100);
        await until(() => page.evaluate(() => scrollY > 50), 'the page scrolls again');
    }));

test('touch scrolls the page until the drawing is tapped', () =>
    withHost(
        `<meta name="viewport" content="width=device-width">${frameOf(WEED)}<p style="height: 3000px">text</p>`,
        async (page) => {
            const frame = await drawn(page);
            const action = () =>
                frame.evaluate(
                    () => getComputedStyle(/** @type {Element} */ (document.querySelector('#drawing'))).touchAction,
                );
            assert.equal(await action(), 'pan-x pan-y');
            const before = await picture(frame);
            const session = await page.context().newCDPSession(page);
            const touch = (
                /** @type {'touchStart' | 'touchMove' | 'touchEnd'} */ type,
                /** @type {number[]} */ ...ys
            ) => session.send('Input.dispatchTouchEvent', { type, touchPoints: ys.map((y) => ({ x: 150, y })) });
            await touch('touchStart', 250);
            for (let y = 240; y >= 100; y -= 10) await touch('touchMove', y);
            await touch('touchEnd');
            await until(() => page.evaluate(() => scrollY > 50), 'the page scrolls');
            assert.equal((await picture(frame)).digest, before.digest);
            await page.evaluate(() => scrollTo(0, 0));
            await page.tap('iframe', { position: { x: 150, y: 200 } });
            await until(async () => (await action()) === 'none', 'the drawing takes the finger');
        },
        { options: PHONE },
    ));

test('a sandbox without origin, storage or popups works', () =>
    withHost(
        frameOf(`${WEED}&controls=n,angle,rules,string,play`, 'sandbox="allow-scripts"'),
        async (page) => {
            const frame = await drawn(page);
            assert.equal(await frame.evaluate(() => self.origin), 'null');
            const before = await picture(frame);
            await frame.fill('#iterations', '3');
            await changes(frame, before);
            await frame.click('#open');
            await frame.waitForSelector('#away:visible');
            const address = await frame.inputValue('#away-address');
            assert.ok(address.startsWith(`${ADDRESS}#v=1&title=Weed`) && address.includes('&n=3'), address);
            assert.equal(await frame.evaluate(() => document.activeElement?.id), 'away-address');
        },
        { expected: /Blocked opening/ },
    ));

test('the playground opens with the visitor’s changes', () =>
    withHost(frameOf(`${WEED}&controls=n`), async (page) => {
        const frame = await drawn(page);
        await frame.fill('#iterations', '3');
        await until(async () => (await frame.getAttribute('#open', 'href'))?.includes('&n=3'), 'the address follows');
        const [opened] = await Promise.all([page.context().waitForEvent('page'), frame.click('#open')]);
        await ready(opened);
        assert.ok(opened.url().startsWith(`${ADDRESS}#v=1`), opened.url());
        assert.equal(await opened.inputValue('#iterations'), '3');
        assert.equal(await opened.textContent('#specimen-title'), 'Weed');
        assert.equal(await opened.evaluate(() => window.opener), null);
    }));

test('errors are shown in words', () =>
    withHost(
        frameOf('v=1&axiom=F&rules=F%20%3D%20FF&n=3') +
            frameOf('') +
            frameOf('v=1&axiom=F&rules=F%20-%3E%20FF&n=2&angle=x'),
        async (page) => {
            const all = await until(() => {
                const frames = embedded(page);
                return frames.length === 3 && frames;
            }, 'three frames');
            const [wrong, nothing, damaged] = /** @type {[Frame, Frame, Frame]} */ (all);
            await until(
                async () =>
                    /->/.test((await wrong.textContent('#mistake')) ?? '') && (await wrong.isVisible('#mistake')),
                'the wrong arrow',
            );
            assert.match((await nothing.textContent('#mistake')) ?? '', /contains no drawing/);
            await page.evaluate(() => scrollTo(0, document.body.scrollHeight));
            await ready(damaged);
            assert.match((await damaged.textContent('#toast')) ?? '', /“angle”/);
        },
    ));

test('a drawing out of view waits, and stops playing when scrolled away', () =>
    withHost(`${frameOf(WEED)}<p style="height: 6000px">text</p>${frameOf(`${WEED}&controls=play`)}`, async (page) => {
        await drawn(page);
        const far = await until(() => embedded(page)[1], 'the second frame');
        await far.waitForSelector('#app');
        await quiet(400, 'a worker would start');
        assert.equal(page.workers().length, 1);
        assert.equal(await far.locator('#stage.inked').count(), 0);
        await page.evaluate(() => scrollTo(0, document.body.scrollHeight));
        await drawn(page, 1);
        assert.equal(page.workers().length, 2);
        await far.click('#open-playback');
        await far.click('#play');
        await until(async () => (await far.getAttribute('#play', 'aria-label')) === 'Pause', 'it plays');
        await page.evaluate(() => scrollTo(0, 0));
        await until(async () => (await far.getAttribute('#play', 'aria-label')) === 'Play', 'it pauses');
    }));

test('a frame from a disk draws', () =>
    withPage(
        {
            address: pathToFileURL(join(folder, 'embed.html')).href,
            hash: `#${WEED}&controls=n`,
            drawing: '#stage.inked',
        },
        async (page) => {
            assert.ok((await picture(page)).ink > 0.001);
            await page.fill('#iterations', '3');
            await until(
                async () => (await page.getAttribute('#open', 'href'))?.includes('playground.html#v=1'),
                'the playground is the file beside it',
            );
        },
    ));

test('printing shows picture and system, without controls', () =>
    withPage(
        {
            address: `${ADDRESS}embed.html`,
            hash: `#${WEED}&controls=n,angle,rules,string,play`,
            options: { viewport: { width: 600, height: 400 } },
        },
        async (page) => {
            await page.emulateMedia({ media: 'print' });
            for (const name of ['#panel', '.tools-read', '.tools-view'])
                assert.equal(await page.isVisible(name), false, name);
            assert.match((await page.textContent('#sheet')) ?? '', /Start \(axiom\)FRulesF -> F\[\+F\]F\[-F\]F/);
            const box = (await page.locator('#drawing').boundingBox()) ?? { height: 0, y: -1 };
            const sheet = (await page.locator('#sheet').boundingBox()) ?? { y: 0, height: 0 };
            assert.ok(
                box.height > 200 && box.y >= 0 && sheet.y >= box.y + box.height - 1 && sheet.y + sheet.height <= 401,
                JSON.stringify({ box, sheet }),
            );
            assert.ok((await page.pdf()).length > 2000);
        },
    ));

test('an element draws a whole system from its text', () =>
    withHost(
        `<l-system n="3"><pre>caption: Weed
            axiom: F
            n: 4
            angle: 25
            palette: #aa3300, #0033aa
            do: X: move
            do: Y: draw
            controls: n

            // a comment
            F -&gt; F[+F]F</pre></l-system>
        <l-system><pre>axiom: F&#10;stroke: 0.2&#10;rules:&#10;p1: F -&gt; FF</pre></l-system>`,
        async (page) => {
            const frame = await drawn(page);
            await drawn(page, 1);
            assert.ok((await frame.isVisible('#iterations')) && !(await frame.isVisible('#angle')));
            const values = await page.$$eval('l-system', (elements) =>
                elements.map((element) => /** @type {any} */ (element).values),
            );
            const [{ title, axiom, n, angle, auto, rules, do: meanings, palette }, second] = values;
            // Attributes override the text.
            assert.deepEqual([title, axiom, n, angle, auto], ['Weed', 'F', 3, 25, true]);
            assert.deepEqual([rules, meanings], ['// a comment\nF -> F[+F]F', 'X: move\nY: draw']);
            assert.deepEqual(palette, ['#aa3300', '#0033aa']);
            assert.deepEqual([second.rules, second.width, second.auto], ['p1: F -> FF', 0.2, false]);
            await page.$eval('l-system', (element) => {
                const text = element.querySelector('pre');
                if (text) text.textContent = 'axiom: F\nn: 4\nangle: 30\ncontrols: angle\nF -> FF';
            });
            await until(async () => await frame.isVisible('#angle'), 'other controls');
            assert.equal(await frame.inputValue('#angle'), '30');
        },
        { head: ELEMENT },
    ));

test('an element draws from attributes and text, which can be changed', () =>
    withHost(
        `<l-system caption="Weed" axiom="F" angle="25" n="4" controls="n" stroke="0.2">
            F -&gt; F[+F]F[-F]F
        </l-system>${LISTEN}`,
        async (page) => {
            const frame = await drawn(page);
            assert.equal(
                await page.evaluate(
                    () => document.querySelector('l-system')?.shadowRoot?.querySelector('iframe')?.title,
                ),
                'L-system: Weed',
            );
            await until(async () => (await heard(page)).some(([kind]) => kind === 'ready'), 'it is ready');
            const [, ready] = /** @type {[string, any]} */ ((await heard(page)).find(([kind]) => kind === 'ready'));
            assert.equal(ready.values.rules, 'F -> F[+F]F[-F]F');
            assert.equal(ready.values.width, 0.2);
            assert.equal(ready.segments, '625');
            assert.match(ready.link, /^#v=1&title=Weed&axiom=F/);

            let before = await picture(frame);
            await page.evaluate(() => document.querySelector('l-system')?.setAttribute('angle', '40'));
            await changes(frame, before);
            before = await picture(frame);
            await page.evaluate(() => {
                const element = document.querySelector('l-system');
                if (element) element.textContent = 'F -> F[+F]F';
            });
            await changes(frame, before);
            await page.evaluate(() => document.querySelector('l-system')?.setAttribute('controls', 'angle,string'));
            await until(
                async () =>
                    !(await frame.isVisible('#iterations')) &&
                    (await frame.isVisible('#angle')) &&
                    (await frame.isVisible('#open-reader')),
                'other controls',
            );
            const told = await until(async () => {
                const changes = (await heard(page)).filter(([kind]) => kind === 'change');
                return (
                    changes.length > 1 &&
                    changes.map(([, detail]) => [detail.by, detail.values.angle, detail.values.rules])
                );
            }, 'both changes are told');
            assert.deepEqual(told, [
                ['host', 40, 'F -> F[+F]F[-F]F'],
                ['host', 40, 'F -> F[+F]F'],
            ]);

            await frame.fill('#angle', '10');
            await until(
                async () =>
                    (await heard(page)).some(
                        ([kind, detail]) => kind === 'change' && detail.by === 'visitor' && detail.values.angle === 10,
                    ),
                'the visitor is told of',
            );
            assert.equal(
                await page.evaluate(() => /** @type {any} */ (document.querySelector('l-system')).values.angle),
                10,
            );
            const now = await page.evaluate(() => /** @type {any} */ (document.querySelector('l-system')).get());
            assert.ok(
                now.values.angle === 10 && now.description.length > 10 && now.segments === '81',
                JSON.stringify(now),
            );
            await page.evaluate(() => /** @type {any} */ (document.querySelector('l-system')).reset());
            await until(async () => (await frame.inputValue('#angle')) === '40', 'back to what the page says');
            await page.evaluate(() => document.querySelector('l-system')?.removeAttribute('angle'));
            await until(
                async () => (await frame.inputValue('#angle')) === '0',
                'what is no longer said has its default',
            );
            assert.equal(await page.evaluate(() => history.length), 2);
        },
        { head: ELEMENT },
    ));

test('an element reports errors, opens links, plays, moves and restarts', () =>
    withHost(
        `<l-system axiom="F" n="3" controls="play"><pre>F = FF</pre></l-system><div id="elsewhere"></div>${LISTEN}`,
        async (page) => {
            await until(
                async () =>
                    (await heard(page)).some(
                        ([kind, { problems }]) =>
                            kind === 'error' && problems[0]?.field === 'rules' && /->/.test(problems[0].hint),
                    ),
                'the mistake and its place',
            );
            await page.evaluate(
                (link) =>
                    /** @type {any} */ (document.querySelector('l-system')).open(`https://example.org/play/#${link}`),
                WEED,
            );
            const frame = await drawn(page);
            assert.equal(await frame.isVisible('#mistake'), false);
            await page.evaluate(() =>
                /** @type {any} */ (document.querySelector('l-system')).set({
                    n: 5,
                    angle: 'wide',
                    colour: 'level',
                    other: 1,
                }),
            );
            await until(
                async () =>
                    (await heard(page)).some(
                        ([kind, { message }]) => kind === 'error' && /“angle”/.test(message) && /“other”/.test(message),
                    ),
                'what cannot be set',
            );
            await until(
                async () => /^n = 5, 25°/.test((await frame.textContent('#caption-text')) ?? ''),
                'and what can',
            );
            await page.evaluate(() => /** @type {any} */ (document.querySelector('l-system')).play());
            await until(async () => (await frame.getAttribute('#play', 'aria-label')) === 'Pause', 'it plays');
            await page.evaluate(() => /** @type {any} */ (document.querySelector('l-system')).pause());
            await until(async () => (await frame.getAttribute('#play', 'aria-label')) === 'Play', 'it pauses');
            await page.evaluate(() => {
                const element = document.querySelector('l-system');
                if (!element) return;
                const pre = element.querySelector('pre');
                if (pre) pre.textContent = 'F -> FF';
                document.querySelector('#elsewhere')?.append(element);
            });
            const moved = await drawn(page);
            await until(
                async () => /8 segments/.test((await moved.textContent('#caption-text')) ?? ''),
                'what it says is drawn anew',
            );
        },
        { head: ELEMENT },
    ));

test('an element works in a page with a content security policy', () =>
    withHost(
        '<l-system axiom="F" n="3"><pre>F -&gt; F+F</pre></l-system>',
        async (page) => {
            await drawn(page);
            assert.equal(
                await page.evaluate(
                    () =>
                        document.querySelector('l-system')?.shadowRoot?.querySelector('iframe')?.getBoundingClientRect()
                            .width,
                ),
                600,
            );
        },
        {
            head: `<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'sha256-${STYLE_HASH}'; script-src ${ADDRESS}; frame-src ${ADDRESS}">${ELEMENT}`,
        },
    ));

test('without JavaScript the element shows its text', () =>
    withHost(
        '<l-system axiom="F"><pre>F -&gt; FF</pre></l-system>',
        async (page) => {
            assert.equal(await page.isVisible('pre'), true);
            assert.equal(page.frames().length, 1);
        },
        { head: ELEMENT, options: { ...DESKTOP, javaScriptEnabled: false } },
    ));

test('a frame accepts messages only from its host, and answers only a known origin', () =>
    withHost(
        `${frameOf(`${WEED}&host=https%3A%2F%2Fexample.org`)}${frameOf(WEED)}<script>
        var heard = [];
        addEventListener('message', (event) => heard.push([event.source === frames[0] ? 0 : 1, event.data]));
    </script>`,
        async (page) => {
            const [strict, open] = [await drawn(page), await drawn(page, 1)];
            const kinds = async (/** @type {number} */ which) =>
                (await heard(page)).filter(([from]) => Number(from) === which).map(([, data]) => data.lsystem);
            assert.ok((await kinds(1)).every((kind) => kind === 'hello'));
            const say = (/** @type {number} */ which, /** @type {unknown} */ message) =>
                page.evaluate(([to, what]) => window.frames[Number(to)]?.postMessage(what, '*'), [which, message]);
            for (const junk of [
                null,
                'set',
                7,
                {},
                { lsystem: 'toString' },
                { lsystem: 'constructor' },
                { lsystem: 'set' },
                { lsystem: 'set', values: null },
                { lsystem: 'open', link: 5 },
                { lsystem: 'set', values: { __proto__: null, constructor: 1 } },
            ])
                await say(1, junk);
            await say(0, { lsystem: 'set', values: { n: 2 } });
            await say(1, { lsystem: 'set', values: { n: 2 } });
            await say(1, { lsystem: 'get', id: 'mine' });
            await until(async () => (await kinds(1)).includes('state'), 'an answer');
            const answer = (await heard(page)).map(([, data]) => data).find(({ lsystem }) => lsystem === 'state');
            assert.ok(answer.id === 'mine' && answer.values.n === 2, JSON.stringify(answer));
            assert.ok((await kinds(1)).includes('ready'));
            await until(async () => /^n = 2/.test((await open.textContent('#caption-text')) ?? ''), 'the one changes');
            assert.match((await strict.textContent('#caption-text')) ?? '', /^n = 4/);
            assert.deepEqual([...new Set(await kinds(0))], ['hello']);
            // A frame beside it is not its host.
            await open.evaluate(() => parent.frames[0]?.postMessage({ lsystem: 'set', values: { n: 1 } }, '*'));
            await strict.evaluate(() => parent.frames[1]?.postMessage({ lsystem: 'set', values: { n: 1 } }, '*'));
            await quiet(300, 'a message that is not refused would change the drawing');
            assert.match((await open.textContent('#caption-text')) ?? '', /^n = 2/);
        },
        { expected: /does not match the recipient window's origin/ },
    ));

test('the addresses of version 1 lead to the drawing', () =>
    withHost(
        `<script src="${ADDRESS}v1/l-system.js"></script><l-system axiom="F" n="3" angle="25"><pre>F -&gt; F[+F]F</pre></l-system><iframe title="A drawing" sandbox="allow-scripts" src="${ADDRESS}v1/embed.html#${WEED.replaceAll('&', '&amp;')}"></iframe>`,
        async (page) => {
            await page.evaluate(
                () =>
                    new Promise((resolve) => {
                        const element = /** @type {any} */ (document.querySelector('l-system'));
                        if (element.ready) resolve(null);
                        else element.addEventListener('ready', resolve, { once: true });
                    }),
            );
            const got = await page.evaluate(() => /** @type {any} */ (document.querySelector('l-system')).get());
            assert.equal(got.segments, '27');
            for (const index of [0, 1]) {
                const frame = await drawn(page, index);
                assert.doesNotMatch(frame.url(), /v1/);
                assert.ok((await picture(frame)).ink > 0.002);
            }
        },
    ));
