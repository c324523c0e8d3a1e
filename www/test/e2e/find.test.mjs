/** The rules of pictures and strings: dropped, pasted, opened, cropped, found, opened; and what cannot be read. */

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test, { after } from 'node:test';
import { some } from '../effort.mjs';
import { DESKTOP, PHONE, close, nextPicture, quiet, sameAgain, stillPicture, until, withPage } from './browser.mjs';

after(close);

/** @typedef {import('playwright-core').Page} Page */

/** @param {Page} page @param {string} selector */
const text = async (page, selector) => (await page.textContent(selector)) ?? '';

/**
 * A picture of the Koch curve F -> F-F++F-F after three steps, as the browser encodes it.
 * @param {Page} page
 * @param {{type?: string, ink?: string, paper?: string, frame?: boolean, scribble?: boolean, twig?: boolean, photograph?: boolean}} [how]
 */
async function koch(
    page,
    {
        type = 'image/png',
        ink = '#000',
        paper = '#fff',
        frame = false,
        scribble = false,
        twig = false,
        photograph = false,
    } = {},
) {
    const address = await page.evaluate(
        ({ type, ink, paper, frame, scribble, twig, photograph }) => {
            const canvas = document.createElement('canvas');
            [canvas.width, canvas.height] = [700, 320];
            const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
            context.fillStyle = paper;
            context.fillRect(0, 0, 700, 320);
            context.strokeStyle = ink;
            context.lineWidth = 3;
            context.lineCap = 'round';
            if (frame) context.strokeRect(20, 20, 660, 280);
            let word = 'F';
            for (let n = 0; n < 3; n++) word = word.replaceAll('F', 'F-F++F-F');
            let [x, y, heading] = [80, 240, 0];
            context.beginPath();
            context.moveTo(x, y);
            for (const symbol of word) {
                if (symbol === '+') heading += Math.PI / 3;
                else if (symbol === '-') heading -= Math.PI / 3;
                else context.lineTo((x += 20 * Math.cos(heading)), (y += 20 * Math.sin(heading)));
            }
            // Lines to places that no rule gives.
            if (scribble)
                for (let at = 1; at < 14; at++)
                    context.lineTo(350 + 320 * Math.sin(at * at), 160 + 140 * Math.cos(3 * at * at));
            // A twig that the curve does not have.
            if (twig) {
                context.moveTo(350, 240);
                context.lineTo(350, 220);
            }
            context.stroke();
            if (photograph) {
                // Light from the left, and grain: the paper at the right is darker than the ink at the left.
                const pixels = context.getImageData(0, 0, 700, 320);
                let chance = 1;
                for (let at = 0; at < pixels.data.length; at++) {
                    chance = (chance * 16807) % 2147483647;
                    const light = 1 - (0.75 * ((at >> 2) % 700)) / 700;
                    const level = (60 + 0.7 * (pixels.data[at] ?? 0)) * light + (chance % 12);
                    if (at % 4 < 3) pixels.data[at] = level;
                }
                context.putImageData(pixels, 0, 0);
            }
            return canvas.toDataURL(type, 0.9);
        },
        { type, ink, paper, frame, scribble, twig, photograph },
    );
    return Buffer.from(address.split(',')[1] ?? '', 'base64');
}

/** Drops or pastes a file. @param {Page} page @param {'drop' | 'paste'} event @param {Buffer} bytes @param {string} name @param {string} type */
const give = (page, event, bytes, name, type) =>
    page.evaluate(
        ({ event, bytes, name, type }) => {
            const data = new DataTransfer();
            data.items.add(new File([new Uint8Array(bytes)], name, { type }));
            const target = document.querySelector('dialog[open]') ?? document.querySelector('#drawing');
            const init = { bubbles: true, cancelable: true };
            target?.dispatchEvent(
                event === 'drop'
                    ? new DragEvent('drop', { ...init, dataTransfer: data })
                    : new ClipboardEvent('paste', { ...init, clipboardData: data }),
            );
        },
        { event, bytes: [...bytes], name, type },
    );

/** @param {Page} page @param {{axiom?: string, angle?: string, n?: string}} known */
async function ask(page, known) {
    for (const [name, value] of Object.entries(known)) await page.fill(`#find-${name}`, value);
}

/** Opens the dialog. @param {Page} page */
async function begin(page) {
    await page.click('#tab-save');
    await page.click('#section-save [data-opens=find]');
    await page.waitForSelector('#find[open]');
}

/** @param {Page} page */
const found = (page) =>
    until(
        async () => /draws? (this|the same) picture\./.test(await text(page, '#find-verdict.found')),
        'a system is found',
    );

test('a photograph is straightened, and can be searched as it is', () =>
    withPage({}, async (page) => {
        await begin(page);
        const taken = await koch(page, { type: 'image/jpeg', photograph: true });
        await give(page, 'drop', taken, 'Taken.jpg', 'image/jpeg');
        await page.waitForSelector('#find-photograph:not([hidden])');
        assert.equal(await page.isChecked('#find-straight'), true);
        const straight = await page.getAttribute('#find-frame', 'style');
        await page.uncheck('#find-straight');
        await until(async () => (await page.getAttribute('#find-frame', 'style')) !== straight, 'the picture as it is');
        await page.check('#find-straight');
        await page.click('#find-start');
        await found(page);
        // A drawing is none.
        await give(page, 'drop', await koch(page), 'Drawn.png', 'image/png');
        await page.waitForSelector('#find-photograph[hidden]', { state: 'attached' });
    }));

test('a dropped outline becomes a shape that is drawn faintly, one undo away', () =>
    withPage({ hash: '#v=1&axiom=F&rules=F%20-%3E%20F' }, async (page) => {
        const svg = "<svg viewBox='0 0 10 20'><path d='M0 0 10 0 10 20 0 20Z'/></svg>";
        await give(page, 'drop', Buffer.from(svg), 'tall.svg', 'image/svg+xml');
        const line = 'shape form = outline(-5, 20, 5, 20, 5, 0, -5, 0)';
        await until(async () => (await page.inputValue('#rules')) === `${line}\nF -> F`, 'the line');
        assert.match(await text(page, '#toast'), /tall\.svg is the shape form now/);
        // The row of the choice is there only while there is a shape.
        await page.click('#tab-look');
        assert.equal(await page.isChecked('#shapes'), true);
        const faint = await stillPicture(page);
        await page.uncheck('#shapes');
        const plain = await nextPicture(page, faint);
        assert.ok(plain.digest !== faint.digest);
        await page.click('#undo');
        await sameAgain(page, faint);
        await page.click('#undo');
        assert.equal(await page.inputValue('#rules'), 'F -> F');
    }));

test('a dropped picture without a system is offered, its rules are found and opened', () =>
    withPage({}, async (page) => {
        await give(page, 'drop', await koch(page), 'curve.png', 'image/png');
        await until(async () => /curve\.png has no system inside/.test(await text(page, '#toast')), 'the offer');
        await page.click('#toast .toast-act');
        await page.waitForSelector('#find-picture:visible');
        await ask(page, { axiom: 'F', angle: '60', n: '3' });
        await page.click('#find-start');
        await found(page);
        assert.match(await text(page, '#find-searched'), /^Searched.*one rule for F up to \d+ symbols/);
        assert.match(await text(page, '.find-percent.found'), /^(9[89]|100)\.\d %$/);
        await page.waitForSelector('.find-card .thumb.inked');
        await page.click('.find-card >> nth=0 >> text=Open');
        await until(
            async () => /^F -> F[-+]F(\+\+|--)F[-+]F$/.test(await page.inputValue('#rules')),
            'the rules are open',
        );
        assert.equal(await text(page, '#specimen-title'), 'Rules of curve');
        await page.click('#undo');
        assert.notEqual(await text(page, '#specimen-title'), 'Rules of curve');
        // The dialog keeps what it had.
        await page.click('#tab-save');
        await page.click('#section-save [data-opens=find]');
        await page.waitForSelector('.find-card:visible');
    }));

for (const [type, ink, paper] of some(
    /** @type {const} */ ([
        ['image/jpeg', '#fff', '#123'],
        ['image/webp', '#206030', '#eee'],
    ]),
)) {
    test(`a pasted picture is taken: ${type}, ${ink} on ${paper}`, () =>
        withPage({}, async (page) => {
            await give(page, 'paste', await koch(page, { type, ink, paper }), 'image.bin', type);
            await page.waitForSelector('#find-picture:visible');
            assert.equal(await page.inputValue('#find-ink'), ink === '#fff' ? 'light' : 'dark');
            await ask(page, { axiom: 'F', angle: '120/2', n: '3' });
            await page.click('#find-start');
            await found(page);
        }));
}

test('a frame is cropped away by keys and by dragging', () =>
    withPage({}, async (page) => {
        await begin(page);
        await page.setInputFiles('#find-file', {
            name: 'slide.png',
            mimeType: 'image/png',
            buffer: await koch(page, { frame: true }),
        });
        await page.waitForSelector('#find-picture:visible');
        const corner = page.locator('.find-corner.top.left');
        await corner.focus();
        for (const key of ['Shift+ArrowRight', 'Shift+ArrowDown']) await page.keyboard.press(key);
        await until(
            async () => /5 % from the left, 11 % from the top/.test((await corner.getAttribute('aria-label')) ?? ''),
            'the corner has moved',
        );
        const frame = /** @type {{x: number, y: number, width: number, height: number}} */ (
            await page.locator('#find-preview').boundingBox()
        );
        const handle = /** @type {typeof frame} */ (await page.locator('.find-corner.bottom.right').boundingBox());
        await page.mouse.move(handle.x + handle.width / 2, handle.y + handle.height / 2);
        await page.mouse.down();
        await page.mouse.move(frame.x + 0.95 * frame.width, frame.y + 0.88 * frame.height, { steps: 4 });
        await page.mouse.up();
        await ask(page, { axiom: 'F', angle: '60', n: '3' });
        await page.keyboard.press('Enter');
        await found(page);
        await page.click('#find-whole');
        assert.ok(!(await page.isVisible('#find-results')), 'what was found is no longer about what is shown');
    }));

for (const [device, options] of some(
    /** @type {const} */ ([
        ['desktop', DESKTOP],
        ['phone', PHONE],
    ]),
)) {
    test(`the pictures of the assignment are tried with one click: ${device}`, () =>
        withPage({ options }, async (page) => {
            await page.click('#tab-save');
            await page.click('#section-save [data-opens=find]');
            await until(async () => (await page.locator('#find-examples .thumb.inked').count()) === 4, 'four pictures');
            await page.click('[data-example=hexerode]');
            await found(page);
            assert.match(await text(page, '.find-rules >> nth=0'), /^F -> /);
            assert.match(await text(page, '.find-name >> nth=0'), /, in the gallery$/);
            // The searched picture stays in sight while the results are read.
            await page.locator('#find-searched').scrollIntoViewIfNeeded();
            const { top, bottom } = await page
                .locator('#find-searched-picture')
                .evaluate((shown) => shown.getBoundingClientRect());
            assert.ok(
                top >= 0 && bottom > top + 40 && bottom <= (page.viewportSize()?.height ?? 0),
                `${top} ${bottom}`,
            );
            assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
        }));
}

test('a picture that is nearly the same is told so, and the differences are shown', () =>
    withPage({}, async (page) => {
        await begin(page);
        await page.setInputFiles('#find-file', {
            name: 'twig.png',
            mimeType: 'image/png',
            buffer: await koch(page, { twig: true }),
        });
        await page.waitForSelector('#find-picture:visible');
        await ask(page, { axiom: 'F', angle: '60', n: '3' });
        await page.click('#find-start');
        await page.waitForSelector('.find-differences');
        await page.click('#find-stop');
        assert.match(await text(page, '#find-verdict'), /^Nearly the same: 9\d\.\d %$/);
        assert.ok(await page.isVisible('#find-legend'));
        // The twig is in the picture only.
        const colours = await page.locator('.find-differences >> nth=0').evaluate((shown) => {
            const canvas = /** @type {HTMLCanvasElement} */ (shown);
            const pixels = canvas.getContext('2d')?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
            /** @type {Record<string, number>} */
            const counts = {};
            for (let at = 0; at < pixels.length; at += 4)
                if (pixels[at + 3]) {
                    const colour = [pixels[at], pixels[at + 1], pixels[at + 2]].join();
                    counts[colour] = (counts[colour] ?? 0) + 1;
                }
            return counts;
        });
        assert.ok((colours['0,98,178'] ?? 0) > 10, JSON.stringify(colours));
        assert.ok((colours['176,176,170'] ?? 0) > 500, JSON.stringify(colours));
    }));

test('the page answers while the search runs, and the search stops at once', () =>
    withPage({}, async (page) => {
        await begin(page);
        await page.setInputFiles('#find-file', {
            name: 'scribble.png',
            mimeType: 'image/png',
            buffer: await koch(page, { scribble: true }),
        });
        await page.waitForSelector('#find-picture:visible');
        await page.click('#find-start');
        await page.waitForSelector('#find-results:visible');
        // A search on the page's own thread would end before the frames.
        await page.evaluate(async () => {
            for (let left = 60; left > 0; left--) await new Promise(requestAnimationFrame);
        });
        assert.ok(await page.isVisible('#find-stop'), 'the search still runs');
        const isStopped = await page.evaluate(() => {
            document.getElementById('find-stop')?.click();
            return document.getElementById('find-stop')?.hidden;
        });
        assert.ok(isStopped, 'the search stops at once');
        const work = await text(page, '#find-work');
        assert.match(work, /[\d,]+ systems tried/);
        assert.match(await text(page, '#find-verdict'), /None of the searched systems/);
        await quiet(600, 'a worker that searches on would tell its work');
        assert.equal(await text(page, '#find-work'), work);
        await page.click('#find-longer');
        await until(async () => (await text(page, '#find-work')) !== work, 'the search goes on');
        await page.keyboard.press('Escape');
        assert.ok(await page.isHidden('#find'));
    }));

test('a string is searched for the shortest rules', () =>
    withPage({}, async (page) => {
        await page.click('#tab-save');
        await page.click('#section-save [data-opens=find]');
        await page.waitForSelector('#find[open]');
        await page.check('#find-of-string', { force: true });
        await page.fill('#find-string', 'ABAABABA\nABAAB');
        await page.click('#find-start');
        await until(async () => /derives? the string/.test(await text(page, '#find-verdict.found')), 'rules are found');
        assert.equal(await text(page, '.find-rules >> nth=0'), 'A -> AB\nB -> A');
        assert.match(await text(page, '#find-searched'), /from A/);
        await page.click('.find-card >> nth=0 >> text=Open');
        await until(
            async () => (await page.inputValue('#axiom')) === 'A' && (await page.inputValue('#iterations')) === '5',
            'the system is open',
        );
    }));

test('what cannot be searched is told where it stands', () =>
    withPage({}, async (page) => {
        await begin(page);
        await page.setInputFiles('#find-file', { name: 'curve.png', mimeType: 'image/png', buffer: await koch(page) });
        await page.waitForSelector('#find-picture:visible');
        for (const [field, value, said] of [
            ['angle', 'wide', /angle is expected/],
            ['n', '2.5', /whole number/],
            ['n', '99', /1 to 12/],
            ['axiom', 'F(1)', /letters, turns/],
            ['axiom', 'F]', /closed/],
        ]) {
            await ask(page, { axiom: 'F', angle: '60', n: '3' });
            await page.fill(`#find-${field}`, String(value));
            await page.click('#find-start');
            await until(
                async () => /** @type {RegExp} */ (said).test(await text(page, '#find-problem')),
                `${field} ${value}`,
            );
        }
        await page.fill('#find-axiom', 'F');
        assert.equal(await text(page, '#find-problem'), '');
    }));

/** A PNG that says it is as large, and has no such pixels. @param {number} width @param {number} height */
function hollowPng(width, height) {
    const bytes = Buffer.from(
        'iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg==',
        'base64',
    );
    bytes.writeUInt32BE(width, 16);
    bytes.writeUInt32BE(height, 20);
    // The check sum of the header, so that decoders believe it.
    let sum = 0xffffffff;
    for (const byte of bytes.subarray(12, 29)) {
        sum ^= byte;
        for (let bit = 0; bit < 8; bit++) sum = sum & 1 ? (sum >>> 1) ^ 0xedb88320 : sum >>> 1;
    }
    bytes.writeUInt32BE((sum ^ 0xffffffff) >>> 0, 29);
    return bytes;
}

/** @param {string} inside */
const svg = (inside) =>
    Buffer.from(
        `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 100 50">${inside}</svg>`,
    );
/** @param {string} name */
const hostile = (name) => readFileSync(new URL(`../../../crates/lsystem-svg/tests/hostile/${name}`, import.meta.url));
const USES = Array.from(
    { length: 30 },
    (_, at) => `<g id="g${at + 1}"><use href="#g${at}"/><use href="#g${at}"/></g>`,
).join('');

test('hostile pictures get a clear answer, and nothing of them runs or loads', () =>
    withPage({}, async (page) => {
        await begin(page);
        const cases = /** @type {const} */ ([
            ['text.png', Buffer.from('no picture at all'), /no PNG, JPEG, WebP, GIF or SVG/],
            ['empty.png', Buffer.from(''), /no PNG, JPEG, WebP, GIF or SVG/],
            ['cut.png', (await koch(page)).subarray(0, 40), /damaged/],
            ['bomb.png', hollowPng(60_000, 60_000), /60,000 × 60,000 pixels/],
            ['broken.svg', Buffer.from('<svg xmlns="http://www.w3.org/2000/svg"><g></svg>'), /damaged/],
            ['page.svg', Buffer.from('<html xmlns="http://www.w3.org/1999/xhtml"/>'), /damaged/],
            ['uses.svg', svg(`<path id="g0" d="M0 0H9"/>${USES}<use href="#g30"/>`), /too long to draw/],
            ['circle.svg', svg('<g id="a"><use xlink:href="#a"/></g>'), /draws itself/],
            ['deep.svg', svg('<g>'.repeat(2000) + '</g>'.repeat(2000)), /500 levels/],
            [
                'laughs.svg',
                Buffer.from(
                    '<!DOCTYPE svg [<!ENTITY a "ha"><!ENTITY b "&a;&a;">]><svg xmlns="http://www.w3.org/2000/svg">&b;</svg>',
                ),
                /one shade of grey/,
            ],
            ['white.svg', svg(''), /one shade of grey/],
            ['attributes.svg', hostile('svgatt.svg'), /too many|one shade|draws itself/],
            ['entities.svg', hostile('svgentuse2.svg'), /too many|one shade|draws itself|damaged/],
            [
                'blur.svg',
                svg('<g style="filter:blur(40px)"><text>F</text></g>'.repeat(2000)),
                /Left out: filters, text/,
            ],
            [
                'dashes.svg',
                svg('<path d="M0 0H100" stroke="#000" stroke-dasharray=".00001"/>'.repeat(6000)),
                /too long to draw/,
            ],
            ['large.svg', svg('<path d="M0 0H100V50H0z" opacity=".9"/>'.repeat(20_000)), /too long to draw/],
            ['declarations.svg', Buffer.from('<!a>'.repeat(240_000)), /damaged/],
            ['jpeg.jpg', Buffer.from('ffd8ffc0001108ffffffff03', 'hex'), /65,535 × 65,535 pixels/],
        ]);
        for (const [name, buffer, said] of cases) {
            await page.evaluate(() => document.getElementById('find-problem')?.replaceChildren());
            await page.setInputFiles('#find-file', { name, mimeType: '', buffer });
            await until(
                async () => said.test(await text(page, '#find-problem')),
                `${name}: ${await text(page, '#find-problem')}`,
            );
            assert.ok(await page.isVisible('#find-empty'), name);
        }
        const evil = svg(
            '<script>top.evil = 1</script><image href="https://a.example/b.png" width="9" height="9"/><style>@import url(https://a.example/c.css);</style><path d="M0 0L100 50L100 0" fill="none" stroke="#000" onload="top.evil = 1"/>',
        );
        await page.setInputFiles('#find-file', { name: 'evil.svg', mimeType: 'image/svg+xml', buffer: evil });
        await page.waitForSelector('#find-picture:visible');
        assert.equal(await page.evaluate(() => 'evil' in window), false);
        assert.match(await text(page, '#find-left-out'), /images/);
        // The examples can be reached again.
        await page.click('#find-back');
        assert.ok(await page.isVisible('#find-examples'));
        await page.evaluate((text) => {
            const data = new DataTransfer();
            data.setData('text/plain', text);
            document.dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, cancelable: true }));
        }, evil.toString());
        await page.waitForSelector('#find-picture:visible');
    }));

test('a search that does not load is told, and tried again', () =>
    withPage({ expected: /tools-first\.wasm|Failed to load/ }, async (page) => {
        await page.route(/tools-first\.wasm$/, (route) => route.abort());
        await begin(page);
        await page.setInputFiles('#find-file', { name: 'curve.png', mimeType: 'image/png', buffer: await koch(page) });
        await page.waitForSelector('#find-picture:visible');
        await ask(page, { axiom: 'F', angle: '60', n: '3' });
        await page.click('#find-start');
        await until(async () => (await text(page, '#find-problem')) !== '', 'the reason');
        await page.unroute(/tools-first\.wasm$/);
        await page.click('#find-start');
        await found(page);
    }));

// Like any search of an exercise, this one tries a million systems; these draw few segments.
test('an exercise is searched for other answers', () =>
    withPage({ hash: '#v=1&title=Weed&axiom=F&rules=F%20-%3E%20F%5B%2BF%5D%5B%5D&n=3&angle=60' }, async (page) => {
        await page.click('#tab-save');
        await page.click('#make-exercise');
        await page.waitForSelector('#maker-made:visible');
        await page.click('#maker-unique');
        await until(async () => /shorter than yours/.test(await text(page, '#maker-unique-words')), 'the answers');
        assert.match(await text(page, '#maker-unique-words'), /Searched: [\d,]+ systems tried/);
        assert.match(await text(page, '#maker-unique-cards .find-rules >> nth=0'), /^F -> F\[\+F\]$/);
        await page.fill('#maker-title', 'Another weed');
        assert.equal(await text(page, '#maker-unique-words'), '');
        await page.click('#maker-unique');
        await page.click('#maker-unique-stop');
        assert.equal(await text(page, '#maker-unique-words'), 'Stopped.');
    }));
