import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { sampled } from '../effort.mjs';
import {
    PHONE,
    close,
    drag,
    nextPicture,
    picture,
    ready,
    sameAgain,
    saveFile,
    stillPicture,
    until,
    withPage,
} from './browser.mjs';

after(close);

const KOCH = '#v=1&title=Koch&axiom=F&rules=F%20-%3E%20F+F--F+F&n=4&angle=60&heading=0';
const CHANCE = '#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5DF%20:%200.5%0AF%20-%3E%20F%5B-F%5DF%20:%200.5&n=5&angle=25';

/** @param {import('playwright-core').Page} page */
const hash = (page) => page.evaluate(() => location.hash);
/** @param {import('playwright-core').Page} page @param {string} selector */
const text = async (page, selector) => (await page.textContent(selector)) ?? '';

test('a first visit shows a plant at once, with its title', () =>
    withPage({}, async (page) => {
        assert.ok((await picture(page)).ink > 0.003);
        assert.match(await text(page, '#symbols'), /^[\d,]{3,}$/);
        assert.match(await text(page, '#segments'), /^[\d,]{3,}$/);
        await until(async () => (await text(page, '#description')).length > 10, 'the drawing is described');
        assert.match(String(await page.getAttribute('#drawing', 'aria-label')), /^Drawing: ./);
        assert.ok((await page.locator('#legend tr').count()) > 3);
    }));

test('every control has a name', () =>
    withPage({}, async (page) => {
        const nameless = await page.evaluate(() =>
            [...document.querySelectorAll('button, input, select, textarea')]
                .filter((element) => {
                    const labels = 'labels' in element ? /** @type {HTMLInputElement} */ (element).labels : null;
                    const named = element.getAttribute('aria-labelledby') ?? '';
                    const words =
                        element.getAttribute('aria-label') ??
                        document.getElementById(named)?.textContent ??
                        [...(labels ?? [])].map((label) => label.textContent).join('') + element.textContent;
                    return element.getAttribute('type') !== 'file' && words.trim() === '';
                })
                .map((element) => element.outerHTML),
        );
        assert.deepEqual(nameless, []);
    }));

test('a first picture needs only the files that are weighed as such', async () => {
    /** @type {string[]} */
    const asked = [];
    await withPage(
        { before: async (page) => void page.on('request', (request) => asked.push(request.url())) },
        async (page) => {
            const base = page.url().replace(/[#?].*/, '');
            const worker = await (await fetch(`${base}service-worker.js`)).text();
            // The list that `cargo xtask ledger` weighs, and what is fetched after the picture (parts.test.mjs).
            const [first, soon] = [/const FIRST = (.*);/, /const SOON = (.*);/].map((list) =>
                JSON.parse(list.exec(worker)?.[1] ?? '[]'),
            );
            const names = asked.map((url) => url.replace(base, ''));
            assert.ok(names.includes('lsystem.wasm'), asked.join('\n'));
            assert.deepEqual(
                names.filter((name) => ![...first, ...soon].includes(name)),
                [],
            );
        },
    );
});

test('the page says when lines are not exact, until they are exact again', () =>
    withPage({ hash: '#v=1&axiom=A&rules=A%20-%3E%20F%5B+A%5D%5B-A%5D&n=40&angle=20' }, async (page) => {
        await until(() => page.isVisible('#rough'), 'it is told');
        await page.fill('#iterations', '5');
        await page.press('#iterations', 'Enter');
        await until(async () => !(await page.isVisible('#rough')), 'the finer picture is there');
    }));

test('printing shows the drawing and its system, without controls', () =>
    withPage({ hash: KOCH }, async (page) => {
        assert.equal(await page.isVisible('#sheet'), false);
        await page.emulateMedia({ media: 'print' });
        for (const hidden of ['#panel', '.tools-view', '#undo'])
            assert.equal(await page.isVisible(hidden), false, hidden);
        assert.match(await page.innerText('#sheet'), /F -> F\+F--F\+F/);
        const [stage, canvas] = await Promise.all(
            ['#stage', '#drawing'].map((name) => page.locator(name).boundingBox()),
        );
        assert.ok(
            canvas &&
                stage &&
                canvas.width > 1200 &&
                canvas.width <= stage.width + 1 &&
                canvas.height <= stage.height + 1,
        );
        assert.match(await page.innerText('.caption'), /Koch/);
    }));

test('a drawing on a dark ground is printed on paper', () =>
    withPage({ hash: `${KOCH}&bg=102030&palette=ffe080` }, async (page) => {
        await stillPicture(page);
        await page.emulateMedia({ media: 'print' });
        const shown = (await page.screenshot()).toString('base64');
        const [paper = 0, ink = 0] = await page.evaluate(async (shown) => {
            const bytes = Uint8Array.from(atob(shown), (char) => char.charCodeAt(0));
            const image = await createImageBitmap(new Blob([bytes]));
            const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
            context?.drawImage(image, 0, 0);
            const levels = context?.getImageData(0, 0, image.width, image.height / 2).data ?? [];
            let least = 255;
            for (let at = 2; at < levels.length; at += 4) least = Math.min(least, levels[at] ?? 255);
            return [levels[0] ?? 0, least];
        }, shown);
        assert.ok(paper > 200 && ink < 150, `${paper}, ${ink}`);
    }));

test('a system can be opened from the gallery', () =>
    withPage({}, async (page) => {
        const before = await stillPicture(page);
        await page.click('#open-gallery');
        await page.waitForSelector('#gallery .card');
        assert.ok((await page.locator('#gallery .card').count()) > 30);
        await page.waitForSelector('.thumb.inked');
        await page.fill('#search', 'dragon');
        const card = page.locator('.card:visible').first();
        const title = await card.locator('.card-title').textContent();
        await card.click();
        assert.ok(!(await page.isVisible('#gallery')));
        const picked = await nextPicture(page, before);
        assert.ok(picked.ink > 0.001);
        assert.equal(await text(page, '#specimen-title'), title);
        await page.click('#undo');
        await sameAgain(page, before);
        assert.ok(
            (await page.isHidden('#edited')) && (await page.isDisabled('#reset')),
            'the first plant is as it was',
        );
    }));

test('every system of the gallery draws or says why it does not', () =>
    withPage({}, async (page) => {
        const entries = await page.evaluate(async () => (await fetch('gallery.json')).json());
        assert.ok(entries.length > 30);
        await page.click('#open-gallery');
        await page.waitForSelector('.card');
        await page.click('#close-gallery');
        // All of it runs in the page: the driver's part would take longer than the page's. The cards of the gallery show
        // whether the others draw.
        const wrong = await page.evaluate(
            async (paths) => {
                const element = (/** @type {string} */ name) =>
                    /** @type {HTMLElement} */ (document.querySelector(name));
                const sheet = new OffscreenCanvas(1, 1);
                const context = /** @type {OffscreenCanvasRenderingContext2D} */ (
                    sheet.getContext('2d', { willReadFrequently: true })
                );
                const digest = () => {
                    const source = /** @type {HTMLCanvasElement} */ (element('#drawing'));
                    [sheet.width, sheet.height] = [source.width, source.height];
                    context.drawImage(source, 0, 0);
                    return new Uint32Array(context.getImageData(0, 0, sheet.width, sheet.height).data.buffer).reduce(
                        (hash, word) => (Math.imul(hash, 31) + word) | 0,
                        0,
                    );
                };
                // The note of the former system stays until the page has drawn the next one.
                const isEmpty = () =>
                    !element('#empty').hidden && element('#stage').getAttribute('aria-busy') !== 'true';
                const wrong = [];
                let before = digest();
                for (const path of paths) {
                    const site = /** @type {any} */ (globalThis);
                    const { pictures } = site;
                    element(`.card[data-path="${path}"]`).click();
                    const begun = performance.now();
                    let now = before;
                    do {
                        await new Promise(requestAnimationFrame);
                        if (site.pictures > pictures) now = digest();
                    } while (now === before && !isEmpty() && performance.now() - begun < site.deadline);
                    if (now === before && !isEmpty()) wrong.push(`${path} is not drawn`);
                    if (document.querySelector('.problems .error')) wrong.push(`${path} has errors`);
                    before = now;
                }
                return wrong;
            },
            sampled(
                entries.map((/** @type {{path: string}} */ { path }) => path),
                4,
            ),
        );
        assert.deepEqual(wrong, []);
    }));

test('editing the rules changes the picture and the counts', () =>
    withPage({ hash: KOCH }, async (page) => {
        const before = await stillPicture(page);
        assert.equal(await text(page, '#segments'), '256');
        await page.fill('#rules', 'F -> F+F-F-F+F');
        await nextPicture(page, before);
        await until(async () => (await text(page, '#segments')) === '625', 'five to the fourth segments');
        await page.fill('#axiom', 'F+F');
        await until(async () => (await text(page, '#segments')) === '1,250', 'twice as many');
        assert.equal(await text(page, '#caption-title'), 'Koch, edited');
    }));

test('rules typed over the first plant draw plain lines, and New starts with one line', () =>
    withPage({}, async (page) => {
        const plant = await stillPicture(page);
        await page.fill('#axiom', 'F--F--F');
        await page.fill('#rules', 'F -> F+F--F+F');
        await page.fill('#angle', '60');
        await page.fill('#iterations', '4');
        const koch = await nextPicture(page, plant);
        assert.ok(koch.ink > 0.001 && koch.ink < 0.1, `${koch.ink} of the picture is ink`);
        await page.click('#start-anew');
        await until(async () => (await text(page, '#segments')) === '1', 'a line');
        assert.equal(await text(page, '#specimen-title'), 'Untitled system');
        assert.equal(await page.evaluate(() => document.activeElement?.id), 'rules');
        await page.keyboard.type('F -> F+F--F+F');
        await until(async () => (await text(page, '#segments')) === '256', 'what was typed is drawn');
        for (let steps = 0; steps < 9 && (await page.inputValue('#axiom')) !== 'F--F--F'; steps++)
            await page.click('#undo');
        await sameAgain(page, koch);
    }));

test('an error is underlined and explained, and the picture stays', () =>
    withPage({ hash: KOCH }, async (page) => {
        const before = await stillPicture(page);
        await page.fill('#rules', 'F -> F+F--F+F\nG = = 2');
        await page.waitForSelector('#rules-problems .error');
        const underlined = await page.locator('[data-editor=rules] .wrong').allTextContents();
        assert.ok(underlined.length > 0 && 'G = = 2'.includes(underlined.join('')), underlined.join('|'));
        assert.match(await text(page, '#rules-problems'), /Line 2, column/);
        assert.equal(await page.getAttribute('#rules', 'aria-invalid'), 'true');
        await page.click('#rules-problems .problem');
        assert.ok(
            (await page.evaluate(
                () => /** @type {HTMLTextAreaElement} */ (document.querySelector('#rules')).selectionStart,
            )) >= 14,
        );
        assert.equal(await page.evaluate(() => document.activeElement?.id), 'rules');
        assert.equal((await stillPicture(page)).digest, before.digest);
        await page.fill('#rules', 'F -> F+F--F+F');
        await until(async () => (await page.locator('#rules-problems li').count()) === 0, 'the list is empty again');
        assert.equal((await stillPicture(page)).digest, before.digest);
    }));

test('when the drawing is empty, the page says why', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.fill('#axiom', 'X');
        await page.waitForSelector('#empty:visible');
        assert.match(await text(page, '#empty'), /X/);
        await page.fill('#axiom', 'F');
        await until(async () => !(await page.isVisible('#empty')), 'the note is gone');
    }));

test('the address contains the whole state and opens the same picture', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.fill('#iterations', '3');
        await page.fill('#angle', '59,5');
        await page.click('#tab-look');
        await page.selectOption('#colour-by', 'single');
        await page.fill('#width', '0.3');
        await page.hover('#stage');
        await page.mouse.wheel(0, -300);
        await until(async () => /n=3&angle=59\.5.*&view=/.test(await hash(page)), 'the address follows');
        const shown = await stillPicture(page);
        const link = await hash(page);
        await withPage({ hash: link }, async (other) => {
            assert.equal((await stillPicture(other)).digest, shown.digest);
            assert.equal(await other.inputValue('#angle'), '59.5');
            await until(async () => (await hash(other)) === link, 'the address stays');
        });
    }));

test('a link pasted into an open page opens, and undo returns', () =>
    withPage({ hash: KOCH }, async (page) => {
        const before = await stillPicture(page);
        await page.evaluate(() => (location.hash = '#v=1&axiom=F-F-F-F&rules=F%20-%3E%20F-F+F+FF-F-F+F&n=2&angle=90'));
        await nextPicture(page, before);
        assert.equal(await page.inputValue('#axiom'), 'F-F-F-F');
        await page.click('#undo');
        await until(async () => (await page.inputValue('#axiom')) === 'F', 'the former system is back');
        assert.equal((await stillPicture(page)).digest, before.digest);
    }));

test('the valid parts of a damaged link open, with a message', () =>
    withPage({ hash: '#v=1&axiom=F&rules=F%20-%3E%20FF%zz&n=99999&angle=abc&bg=zzz' }, async (page) => {
        assert.equal(await page.inputValue('#axiom'), 'F');
        assert.equal(await page.inputValue('#iterations'), '1000');
        assert.match(await text(page, '#toast'), /damaged/);
    }));

test('dragging a slider queues no states: the last state is shown', () =>
    withPage(
        {
            hash: KOCH,
            before: (page) =>
                page.addInitScript(() => {
                    const post = Worker.prototype.postMessage;
                    const seen = /** @type {any} */ (globalThis);
                    seen.defines = [];
                    Worker.prototype.postMessage = function (/** @type {any[]} */ ...message) {
                        if (message[0].type === 'define') seen.defines.push(message[0].definition.angle);
                        return post.apply(this, /** @type {any} */ (message));
                    };
                }),
        },
        async (page) => {
            await stillPicture(page);
            const first = await page.evaluate(() => /** @type {any} */ (globalThis).defines.length);
            await drag(
                page,
                '#angle-slider',
                Array.from({ length: 300 }, (_, at) => at + 1),
            );
            await until(
                async () => (await page.evaluate(() => /** @type {any} */ (globalThis).defines.at(-1))) === 150,
                'the last angle is sent',
            );
            const sent = (await page.evaluate(() => /** @type {any} */ (globalThis).defines.length)) - first;
            assert.ok(sent <= 5, `${sent} of 300 were sent`);
            const shown = await stillPicture(page);
            await withPage({ hash: KOCH.replace('angle=60', 'angle=150') }, async (other) => {
                assert.equal((await stillPicture(other)).digest, shown.digest);
            });
            await page.click('#undo');
            assert.equal(await page.inputValue('#angle'), '60');
        },
    ));

test('a long drag shows pictures on the way, of systems with and without shared blocks', async () => {
    for (const hash of [KOCH, CHANCE]) {
        await withPage({ hash }, async (page) => {
            await stillPicture(page);
            const pictures = await page.evaluate(async () => {
                const slider = /** @type {HTMLInputElement} */ (document.querySelector('#angle-slider'));
                const transfer = ImageBitmapRenderingContext.prototype.transferFromImageBitmap;
                let count = 0;
                ImageBitmapRenderingContext.prototype.transferFromImageBitmap = function (bitmap) {
                    count += 1;
                    return transfer.call(this, bitmap);
                };
                for (let position = 1; position <= 60; position++) {
                    await new Promise(requestAnimationFrame);
                    slider.value = String(position);
                    slider.dispatchEvent(new Event('input', { bubbles: true }));
                }
                return count;
            });
            assert.ok(pictures >= 6, `${pictures} pictures in 60 frames`);
            const shown = await stillPicture(page);
            await withPage({ hash: hash.replace(/angle=\d+/, 'angle=30') }, async (other) => {
                assert.equal((await stillPicture(other)).digest, shown.digest);
            });
        });
    }
});

test('undo and redo cover every control', () =>
    withPage({ hash: KOCH }, async (page) => {
        const start = await stillPicture(page);
        /** @type {[string, () => Promise<unknown>][]} */
        const edits = [
            ['#axiom', () => page.fill('#axiom', 'F+F')],
            ['#rules', () => page.fill('#rules', 'F -> FF+F : 1\nF -> F+F : 2')],
            ['#seed', () => page.fill('#seed', '7')],
            ['#iterations', () => page.fill('#iterations', '5')],
            ['#angle', () => page.fill('#angle', '33.3')],
            [
                '#two-angles',
                async () => {
                    await page.click('#tab-turtle');
                    await page.check('#two-angles');
                },
            ],
            [
                '#dialect',
                async () => {
                    await page.click('#tab-turtle');
                    await page.selectOption('#dialect', 'every-letter');
                },
            ],
            ['#overrides', () => page.fill('#overrides', 'G: move')],
            ['#heading', () => page.fill('#heading', '45')],
            ['#step', () => page.fill('#step', '2')],
            ['#start-x', () => page.fill('#start-x', '3')],
            ['look', () => page.click('#tab-look')],
            ['#colour-by', () => page.selectOption('#colour-by', 'level')],
            ['.ink', () => page.click('.ink >> nth=2')],
            ['#width', () => page.fill('#width', '0.5')],
            ['#min-width', () => page.fill('#min-width', '2')],
            ['#add-colour', () => page.click('#add-colour')],
        ];
        for (const [, edit] of edits) {
            await edit();
            await page.evaluate(() => /** @type {HTMLElement} */ (document.activeElement)?.blur());
        }
        const end = await stillPicture(page);
        assert.notEqual(end.digest, start.digest);
        for (let step = 1; step < edits.length; step++) await page.keyboard.press('Control+z');
        assert.ok(await page.isDisabled('#undo'));
        await sameAgain(page, start);
        for (let step = 1; step < edits.length; step++) await page.keyboard.press('Control+Shift+z');
        assert.ok(await page.isDisabled('#redo'));
        await sameAgain(page, end);
        await page.click('#reset');
        await sameAgain(page, start);
    }));

test('undo works inside a text field too', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.focus('#axiom');
        await page.keyboard.press('End');
        await page.keyboard.type('+F');
        assert.equal(await page.inputValue('#axiom'), 'F+F');
        await page.keyboard.press('Control+z');
        assert.equal(await page.inputValue('#axiom'), 'F');
        await page.keyboard.press('Control+y');
        assert.equal(await page.inputValue('#axiom'), 'F+F');
    }));

test('wheel, drag, keys and buttons move the picture, and Fit restores the view', () =>
    withPage({ hash: KOCH }, async (page) => {
        const fitted = await stillPicture(page);
        await page.mouse.move(400, 400);
        await page.mouse.wheel(0, -400);
        const zoomed = await nextPicture(page, fitted);
        assert.match(await text(page, '#zoom'), /205/);
        await page.mouse.down();
        await page.mouse.move(500, 350, { steps: 4 });
        await page.mouse.up();
        await nextPicture(page, zoomed);
        await page.click('#fit');
        await sameAgain(page, fitted);
        await page.click('#zoom-in');
        await nextPicture(page, fitted);
        await page.dblclick('#drawing', { position: { x: 300, y: 300 } });
        await until(async () => (await picture(page)).digest === fitted.digest, 'a double click fits');
        await page.focus('#drawing');
        await page.keyboard.press('Shift+ArrowRight');
        await nextPicture(page, fitted);
        await page.keyboard.press('0');
        await until(async () => (await picture(page)).digest === fitted.digest, 'zero fits');
        await page.keyboard.press('ArrowRight');
        assert.equal(await page.inputValue('#angle'), '61');
        await page.keyboard.press('ArrowUp');
        assert.equal(await page.inputValue('#iterations'), '5');
        await page.keyboard.press('+');
        await until(async () => /150/.test(await text(page, '#zoom')), 'plus zooms in');
    }));

test('Safari’s events for a pinch on a track pad zoom the picture, not the page', () =>
    withPage({ hash: KOCH }, async (page) => {
        const zooms = await page.evaluate(() => {
            const canvas = /** @type {HTMLElement} */ (document.querySelector('#drawing'));
            const pinch = (/** @type {string} */ type, /** @type {number} */ scale) => {
                const event = new MouseEvent(type, { clientX: 400, clientY: 400, bubbles: true, cancelable: true });
                return canvas.dispatchEvent(Object.assign(event, { scale }))
                    ? null
                    : parseInt(String(document.querySelector('#zoom')?.textContent), 10);
            };
            return [
                pinch('gesturestart', 1),
                pinch('gesturechange', 1.5),
                pinch('gesturechange', 2),
                pinch('gesturestart', 1),
                pinch('gesturechange', 0.5),
            ];
        });
        assert.deepEqual(zooms, [100, 150, 200, 200, 100]);
    }));

test('the picture moves with the pointer before a new picture is drawn', () =>
    withPage({ hash: KOCH }, async (page) => {
        await stillPicture(page);
        const transform = await page.evaluate(() => {
            const canvas = /** @type {HTMLElement} */ (document.querySelector('#drawing'));
            const at = { pointerId: 1, button: 0, clientX: 300, clientY: 300, bubbles: true };
            canvas.setPointerCapture = () => {};
            canvas.dispatchEvent(new PointerEvent('pointerdown', at));
            canvas.dispatchEvent(new PointerEvent('pointermove', { ...at, clientX: 340, clientY: 310 }));
            canvas.dispatchEvent(new PointerEvent('pointerup', at));
            return canvas.style.transform;
        });
        const [x, y] = (/translate\(([-\d.e]+)px, ([-\d.e]+)px\)/.exec(transform) ?? []).slice(1).map(Number);
        assert.ok(Math.abs(Number(x) - 40) < 0.01 && Math.abs(Number(y) - 10) < 0.01, transform);
        await until(
            async () =>
                (await page.evaluate(
                    () => /** @type {HTMLElement} */ (document.querySelector('#drawing')).style.transform,
                )) === 'none',
            'the new picture stands where the old one was moved',
        );
    }));

test('the view stays while angle and iterations change', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.mouse.move(400, 400);
        await page.mouse.wheel(0, -400);
        await until(async () => /view=/.test(await hash(page)), 'the view is in the address');
        const view = /view=[^&]*/.exec(await hash(page))?.[0];
        await page.fill('#iterations', '6');
        await until(async () => (await hash(page)).includes('n=6'), 'the address follows');
        assert.ok((await hash(page)).includes(String(view)));
    }));

test('a new seed changes a random plant, and the same seed grows the same plant', () =>
    withPage({ hash: CHANCE }, async (page) => {
        const first = await stillPicture(page);
        assert.match(String(await page.getAttribute('#seed-row', 'title')), /same seed grows the same plant/);
        await page.click('#dice');
        assert.match(await page.inputValue('#seed'), /^\d{1,4}$/);
        const second = await nextPicture(page, first);
        assert.notEqual(second.digest, first.digest);
        await page.fill('#seed', '0');
        await sameAgain(page, first);
    }));

test('a system above a limit is refused with a message, and the picture stays', () =>
    withPage({ hash: CHANCE }, async (page) => {
        const before = await stillPicture(page);
        await page.fill('#iterations', '60');
        await until(async () => (await text(page, '#numbers-problems')).length > 10, 'the refusal');
        assert.equal((await stillPicture(page)).digest, before.digest);
        assert.equal(await page.isVisible('#busy'), false, 'nothing is on its way any more');
        await page.fill('#iterations', '5');
        await until(async () => (await page.locator('#numbers-problems li').count()) === 0, 'the list is empty again');
        assert.equal((await stillPicture(page)).digest, before.digest);
        // The limit is known: the slider does not go beyond, and the status says why.
        assert.match(await text(page, '#status'), /At most n = \d+\. Above: .{10,}/);
        const highest = Number(await page.getAttribute('#iterations-slider', 'max'));
        assert.ok(highest <= Number(/n = (\d+)/.exec(await text(page, '#status'))?.[1]), String(highest));
    }));

test('a view that returns to the former one is drawn again', () =>
    withPage({ hash: KOCH }, async (page) => {
        await stillPicture(page);
        for (let times = 0; times < 5; times++) {
            await page.evaluate(() => ['zoom-in', 'fit'].forEach((name) => document.getElementById(name)?.click()));
            await until(async () => (await page.getAttribute('#stage', 'aria-busy')) === 'false', 'it is at rest');
        }
    }));

test('after an error the picture stays and can be moved', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.fill('#rules', 'F = = F');
        await until(async () => (await page.locator('#rules-problems li').count()) > 0, 'the mistake is told');
        const former = await stillPicture(page);
        assert.ok(former.ink > 0.001);
        await page.click('#zoom-in');
        await nextPicture(page, former);
    }));

test('counts are exact for any number of iterations, in short form and in full', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.fill('#iterations', '40');
        await until(async () => (await text(page, '#segments')).startsWith('1.21'), 'four to the fortieth');
        assert.equal(await text(page, '#segments'), '1.21 × 1024');
        await page.click('#segments');
        assert.equal(await text(page, '#digits'), '1,208,925,819,614,629,174,706,176 segments');
    }));

test('files are saved under descriptive names', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.click('#tab-save');
        for (const [format, starts] of /** @type {[import('../../js/protocol.js').Format, RegExp][]} */ ([
            ['svg', /^<(\?xml|svg)/],
            ['png', /^.PNG/],
            ['csv', /^x0,y0,x1,y1,level,colour\n/],
            ['txt', /^F\+F--F\+F\+F\+F--F\+F--.*\n$/],
            ['json', /^\{/],
            ['obj', /^# x, y, z/],
            ['glb', /^glTF/],
        ])) {
            const download = await saveFile(page, format);
            assert.equal(download.suggestedFilename(), `Koch_n4.${format}`);
            const content = (await readFile(String(await download.path()))).toString('latin1');
            assert.match(content, starts, format);
        }
        const compact = await saveFile(page, 'svg-compact');
        assert.equal(compact.suggestedFilename(), 'Koch_n4_compact.svg');
        assert.match(await readFile(String(await compact.path()), 'utf8'), /<use/);
        await page.click('#open-save');
        await page.click('.save-tile:has([value=png])');
        await page.selectOption('#option-size', '2048');
        await page.click('#save-cancel');
        // Files saved at once have the options last chosen.
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('[data-save=png]')]);
        const bytes = await readFile(String(await download.path()));
        assert.equal(Math.max(bytes.readUInt32BE(16), bytes.readUInt32BE(20)), 2048);
    }));

test('a title is shown under the drawing, in its link and in file names', () =>
    withPage({ hash: `${KOCH}&name=course-1` }, async (page) => {
        await page.click('#tab-save');
        assert.equal(await page.inputValue('#title'), 'Koch');
        await page.fill('#title', 'Snow, by Ada');
        assert.equal(await text(page, '#caption-title'), 'Snow, by Ada');
        assert.ok(await page.isHidden('#edited'));
        await until(async () => (await hash(page)).includes('title=Snow,%20by%20Ada'), 'the link says so');
        const download = await saveFile(page, 'json');
        assert.equal(download.suggestedFilename(), 'Snow_by_Ada_n4.json');
        await page.click('#undo');
        assert.deepEqual([await page.inputValue('#title'), await text(page, '#specimen-title')], ['Koch', 'Koch']);
    }));

test('files of drawings in space have three dimensions', () =>
    withPage({ hash: '#v=1&title=Corner&axiom=F%26F&n=0&angle=90' }, async (page) => {
        await stillPicture(page);
        await page.click('#tab-save');
        for (const [format, holds] of /** @type {[import('../../js/protocol.js').Format, RegExp][]} */ ([
            ['csv', /^x0,y0,z0,x1,y1,z1,level,colour\n0,0,0,0,1,0,0,0\n/],
            ['svg', /<path/],
            ['obj', /\no Corner\n/],
        ])) {
            const download = await saveFile(page, format);
            assert.match(await readFile(String(await download.path()), 'utf8'), holds, format);
        }
    }));

test('saved files open again, and other files are refused with a message', () =>
    withPage({ hash: KOCH }, async (page) => {
        const before = await stillPicture(page);
        await page.click('#tab-save');
        const download = await saveFile(page, 'json');
        const saved = String(await download.path());
        await page.click('#tab-rules');
        await page.fill('#axiom', 'F+F');
        await nextPicture(page, before);
        await page.setInputFiles('#file', saved);
        await until(async () => (await page.inputValue('#axiom')) === 'F', 'the file is open');
        assert.equal((await stillPicture(page)).digest, before.digest);
        // A picture contains its system.
        for (const format of /** @type {const} */ (['svg', 'svg-compact', 'png'])) {
            await page.click('#tab-save');
            const picture = await saveFile(page, format);
            const bytes = await readFile(String(await picture.path()));
            await page.click('#tab-rules');
            await page.fill('#axiom', 'F+F');
            await page.setInputFiles('#file', {
                name: picture.suggestedFilename(),
                mimeType: 'image/any',
                buffer: bytes,
            });
            await until(async () => (await page.inputValue('#axiom')) === 'F', `the ${format} is open`);
            assert.equal((await stillPicture(page)).digest, before.digest, format);
        }
        const course =
            '{"name": "course", "initial": "A", "rules": {"A": "AB", "B": [{"p": 0.5, "e": "A"}, {"p": 0.5, "e": "B"}],}, "num_iters": 3, "angle_deg": 90}';
        await page.setInputFiles('#file', {
            name: 'course.json',
            mimeType: 'application/json',
            buffer: Buffer.from(course),
        });
        await until(async () => (await page.inputValue('#axiom')) === 'A', 'the course file is open');
        assert.equal(await page.inputValue('#dialect'), 'every-letter');
        await page.setInputFiles('#file', {
            name: 'broken.json',
            mimeType: 'application/json',
            buffer: Buffer.from('{"initial": '),
        });
        await until(async () => (await text(page, '#toast')).includes('broken.json could not be read'), 'the refusal');
        const wide = Buffer.from('\ufeff{"initial": "F",\r\n "angle_deg": "60"}', 'utf16le');
        for (const [name, buffer] of /** @type {const} */ ([
            ['little', wide],
            ['big', Buffer.from(wide).swap16()],
        ])) {
            await page.setInputFiles('#file', { name: `${name}.json`, mimeType: 'application/json', buffer });
            await until(
                async () =>
                    (await text(page, '#toast')).startsWith(
                        `${name}.json could not be read. Line 2, column 15: angle_deg must be a number`,
                    ),
                'the refusal of UTF-16 says where',
            );
        }
        await page.setInputFiles('#file', {
            name: 'words.json',
            mimeType: 'application/json',
            buffer: Buffer.from('{"initial": "F",\r\n "angle_deg": "60"}'),
        });
        await until(
            async () =>
                (await text(page, '#toast')).startsWith(
                    'words.json could not be read. Line 2, column 15: angle_deg must be a number',
                ),
            'the refusal says where',
        );
        assert.match(await text(page, '#file-problems'), /Line 2, column 15/);
        assert.equal(await page.inputValue('#axiom'), 'A');
    }));

test('a dropped file opens', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.evaluate(() => {
            const dataTransfer = new DataTransfer();
            dataTransfer.items.add(new File(['{"initial": "FF", "rules": {}, "num_iters": 1}'], 'two.json'));
            for (const type of ['dragenter', 'dragover', 'drop'])
                document.body.dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true }));
        });
        await until(async () => (await page.inputValue('#axiom')) === 'FF', 'the file is open');
        assert.equal(await text(page, '#specimen-title'), 'two');
    }));

test('Copy link copies the address of the shown picture', () =>
    withPage(
        {
            hash: KOCH,
            options: { viewport: { width: 1280, height: 800 }, permissions: ['clipboard-read', 'clipboard-write'] },
        },
        async (page) => {
            await page.fill('#iterations', '2');
            await page.click('#share');
            await page.click('#copy-share');
            await until(async () => (await text(page, '#share-status')) === 'Link copied', 'the note');
            const copied = await page.evaluate(() => navigator.clipboard.readText());
            assert.equal(new URL(copied).hash, KOCH.replace('n=4', 'n=2'));
        },
    ));

test('a worker that fails is replaced, and the page continues', () =>
    withPage(
        {
            hash: KOCH,
            before: (page) =>
                page.addInitScript(() => {
                    const Real = Worker;
                    /** @type {any} */ (globalThis).workers = [];
                    globalThis.Worker = class extends Real {
                        constructor(/** @type {string | URL} */ url) {
                            super(url);
                            /** @type {any} */ (globalThis).workers.push(this);
                        }
                    };
                }),
        },
        async (page) => {
            const before = await stillPicture(page);
            const started = () => page.evaluate(() => /** @type {any} */ (globalThis).workers.length);
            const hired = await started();
            await page.evaluate(() =>
                /** @type {any} */ (globalThis).workers[0].onmessage({
                    data: { type: 'fatal', message: 'unreachable' },
                }),
            );
            await until(async () => (await started()) > hired, 'a fresh worker starts');
            assert.equal((await stillPicture(page)).digest, before.digest);
            await page.fill('#iterations', '2');
            await nextPicture(page, before);
        },
    ));

test('on a phone in landscape the middle of the drawing is free, and the panel fits', () =>
    withPage({ options: { ...PHONE, viewport: { width: 844, height: 390 } } }, async (page) => {
        const left = async (/** @type {string} */ part) => (await page.locator(part).boundingBox())?.x ?? 0;
        const right = async (/** @type {string} */ part) =>
            (await left(part)) + ((await page.locator(part).boundingBox())?.width ?? 0);
        const middle = (await right('#stage')) / 2;
        assert.ok((await left('.tools-read')) > middle + 60);
        for (const control of ['#undo', '#fit']) assert.ok(!(await page.isVisible(control)), control);
        assert.ok(Math.abs((await right('#surprise')) - (await right('#axiom'))) <= 1);
    }));

test('on a phone everything is within reach', () =>
    withPage({ options: PHONE }, async (page) => {
        assert.ok((await picture(page)).ink > 0.002);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.equal(wide, 390);
        // Phones zoom into fields with smaller type.
        const small = await page.evaluate(() =>
            [...document.querySelectorAll('[inputmode], [type=text], [type=search], textarea')]
                .filter((field) => field.matches(':read-write') && parseFloat(getComputedStyle(field).fontSize) < 16)
                .map(({ id }) => id),
        );
        assert.deepEqual(small, []);
        for (const [tab, control] of [
            ['rules', '#rules'],
            ['turtle', '#length-factor-slider'],
            ['turtle', '#dialect'],
            ['look', '#background'],
            ['save', '[data-save=svg]'],
        ]) {
            if ((await page.getAttribute(`#tab-${tab}`, 'aria-selected')) !== 'true') await page.tap(`#tab-${tab}`);
            await page.locator(String(control)).scrollIntoViewIfNeeded();
            const box = await page.locator(String(control)).boundingBox();
            assert.ok(
                box && box.x >= 0 && box.x + box.width <= 390 && box.y > 300 && box.y + box.height <= 844,
                `${control} ${JSON.stringify(box)}`,
            );
        }
        assert.ok(!(await page.isVisible('#fit')), 'the drawing is fitted');
        // Undo is hidden while there is nothing to undo.
        assert.ok(!(await page.isVisible('#undo')));
        assert.ok(((await page.locator('.tools-read').boundingBox())?.x ?? 0) > 195 + 40, 'the stem is in sight');
        const whole = await stillPicture(page);
        await page.tap('#tab-rules');
        await page.fill('#angle', '30');
        const before = await nextPicture(page, whole);
        for (const control of ['#reset', '#undo', '#redo']) assert.ok(await page.isVisible(control), control);
        await page.tap('#open-gallery');
        await page.waitForSelector('.thumb.inked');
        await page.locator('.card').nth(3).tap();
        await nextPicture(page, before);
    }));

test('two fingers zoom about the point between them', () =>
    withPage({ hash: KOCH, options: PHONE }, async (page) => {
        const before = await stillPicture(page);
        const touch = await page.context().newCDPSession(page);
        /** @param {'touchStart' | 'touchMove' | 'touchEnd'} type @param {number[]} xs */
        const send = (type, ...xs) =>
            touch.send('Input.dispatchTouchEvent', { type, touchPoints: xs.map((x, id) => ({ x, y: 200, id })) });
        await send('touchStart', 150, 250);
        for (let apart = 60; apart <= 100; apart += 10) await send('touchMove', 200 - apart, 200 + apart);
        await send('touchEnd');
        await nextPicture(page, before);
        assert.match(await text(page, '#zoom'), /^200/);
        await page.tap('#fit');
        await until(async () => (await picture(page)).digest === before.digest, 'Fit brings it back');
    }));

test('the skip link and unknown hashes do not change the drawing’s address', () =>
    withPage({ hash: KOCH }, async (page) => {
        await page.focus('#skip');
        await page.keyboard.press('Enter');
        assert.equal(await page.evaluate(() => document.activeElement?.id), 'drawing');
        await page.evaluate(() => (location.hash = '#elsewhere'));
        await until(async () => (await hash(page)) === KOCH, 'the address is back');
        assert.equal(await page.inputValue('#axiom'), 'F');
    }));

test('the dark theme follows the system, can be chosen, and is remembered', () =>
    withPage({ options: { viewport: { width: 1280, height: 800 }, colorScheme: 'dark' } }, async (page) => {
        const dark = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        const night = await dark();
        assert.equal(await page.getAttribute('#theme', 'aria-pressed'), 'true');
        await page.click('#theme');
        assert.notEqual(await dark(), night);
        await page.reload();
        await ready(page);
        assert.equal(await page.getAttribute('#theme', 'aria-pressed'), 'false');
        assert.notEqual(await dark(), night);
    }));

test('the page works if storage and clipboard are refused', () =>
    withPage(
        {
            hash: KOCH,
            before: (page) =>
                page.addInitScript(() => {
                    Object.defineProperty(globalThis, 'localStorage', {
                        get() {
                            throw new DOMException('refused', 'SecurityError');
                        },
                    });
                    Object.defineProperty(navigator, 'clipboard', { value: undefined });
                }),
        },
        async (page) => {
            await page.click('#theme');
            await page.click('#share');
            await page.click('#copy-share');
            await until(async () => (await text(page, '#share-status')) === 'Link copied', 'the older method');
            await page.click('#close-share');
            assert.ok((await picture(page)).ink > 0.001);
        },
    ));
