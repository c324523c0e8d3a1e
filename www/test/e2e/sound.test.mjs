import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { close, stillPicture, quiet, until, withPage } from './browser.mjs';

after(close);

const ARC = '#v=1&axiom=A&rules=A%20-%3E%20A+A&n=5&angle=5&do=A:%20draw';
const PLANT = `#v=1&axiom=X&rules=${encodeURIComponent('X -> F[+X][-X]FX\nF -> FF')}&n=4&angle=25`;

/** @typedef {import('playwright-core').Page} Page */
/** A tone that the page has started: Hertz, from left (-1) to right, and seconds on the sound card. @typedef {{frequency: number, pan: number, at: number}} Tone */

/** Notes the tones that the page starts, and its contexts. @param {Page} page */
const noting = (page) =>
    page.addInitScript(() => {
        const all = { tones: /** @type {Tone[]} */ ([]), contexts: /** @type {AudioContext[]} */ ([]) };
        Object.assign(window, { heard: all });
        let pan = 0;
        const { connect } = AudioNode.prototype;
        AudioNode.prototype.connect = function (/** @type {any[]} */ ...words) {
            if (this instanceof StereoPannerNode) pan = this.pan.value;
            return /** @type {any} */ (connect).apply(this, words);
        };
        const { start } = OscillatorNode.prototype;
        OscillatorNode.prototype.start = function (at = 0) {
            all.tones.push({ frequency: this.frequency.value, pan, at });
            return start.call(this, at);
        };
        const Context = AudioContext;
        window.AudioContext = class extends Context {
            constructor() {
                super();
                all.contexts.push(this);
            }
        };
    });

/** @param {Page} page @returns {Promise<Tone[]>} */
const tones = (page) => page.evaluate(() => /** @type {any} */ (window).heard.tones);
/** @param {Page} page @returns {Promise<string[]>} */
const contexts = (page) =>
    page.evaluate(() =>
        /** @type {any} */ (window).heard.contexts.map((/** @type {AudioContext} */ { state }) => state),
    );
/** @param {Page} page */
const pressed = (page) => page.getAttribute('#listen', 'aria-pressed');

test('the drawing can be heard by hand: its height as the pitch, left and right as the side', () =>
    withPage({ hash: ARC, before: noting }, async (page) => {
        await page.click('#open-playback');
        assert.deepEqual(await contexts(page), [], 'no sound by itself');
        await page.click('#listen');
        assert.equal(await pressed(page), 'true');
        await page.focus('#play-slider');
        await page.keyboard.press('Home');
        const heard = /** @type {Tone[]} */ ([]);
        for (let key = 0; key < 8; key++) {
            const before = (await tones(page)).length;
            await page.keyboard.press('PageUp');
            await until(async () => (await tones(page)).length > before, 'another place sounds');
            heard.push(/** @type {Tone} */ ((await tones(page)).at(-1)));
        }
        const [frequency, pan] = [heard.map((tone) => tone.frequency), heard.map((tone) => tone.pan)];
        assert.ok(new Set(frequency).size > 3 && new Set(pan).size > 5, 'pitch and side follow the turtle');
        // The arc rises first, then bends to the left.
        assert.ok((frequency[3] ?? 0) > (frequency[0] ?? 0));
        assert.ok((pan.at(-1) ?? 0) < (pan[0] ?? 0));
        // Pentatonic on C, three octaves about middle C.
        for (const each of frequency) {
            const key = 69 + 12 * Math.log2(each / 440);
            assert.ok(Math.abs(key - Math.round(key)) < 1e-3 && [0, 2, 4, 7, 9].includes(Math.round(key) % 12));
            assert.ok(key > 47.9 && key < 84.1);
        }
        await page.click('#listen');
        assert.equal(await pressed(page), 'false');
        await until(async () => (await contexts(page)).every((state) => state === 'closed'), 'the sound ends');
    }));

test('playback sounds line after line, until the bar is closed', () =>
    withPage({ hash: ARC, before: noting }, async (page) => {
        await stillPicture(page);
        await page.click('#open-playback');
        await page.click('#listen');
        // 32 lines in ten seconds.
        await until(async () => (await tones(page)).length > 4, 'it sounds');
        const heard = await tones(page);
        const gaps = heard.slice(1).map(({ at }, place) => at - (heard[place]?.at ?? 0));
        assert.ok(Math.max(...gaps) > 0.15, `about three a second: ${gaps}`);
        assert.ok(
            heard.every(({ frequency }, place) => place === 0 || frequency >= (heard[place - 1]?.frequency ?? 0)),
        );
        await page.click('#close-playback');
        assert.equal(await pressed(page), 'false');
        await until(async () => (await contexts(page)).every((state) => state === 'closed'), 'the sound ends');
        const after = (await tones(page)).length;
        await page.click('#open-playback');
        await until(async () => Number(await page.inputValue('#play-slider')) > 500, 'it plays again');
        assert.equal((await tones(page)).length, after, 'without sound');
    }));

test('branches sound together by length, with their places marked', () =>
    withPage({ hash: PLANT, before: noting }, async (page) => {
        await stillPicture(page);
        await page.click('#open-playback');
        await page.click('#listen');
        await page.selectOption('#sound-time', 'length');
        await until(
            async () => /^0:\d\d of 0:\d\d min$/.test((await page.textContent('#play-total')) ?? ''),
            'it plays',
        );
        const dots = async () => ((await page.getAttribute('#mark-sounding', 'd')) ?? '').split('M').length - 1;
        let most = 0;
        await until(async () => (most = Math.max(most, await dots())) > 2, 'three branches sound');
        const heard = await tones(page);
        const together = new Set(heard.map(({ at }) => at.toFixed(6)));
        assert.ok(together.size < heard.length, 'notes begin together');
        // Pause, and on.
        await page.click('#play');
        const part = await page.inputValue('#play-slider');
        const before = (await tones(page)).length;
        await quiet(300, 'it would play on');
        assert.deepEqual([await page.inputValue('#play-slider'), (await tones(page)).length], [part, before]);
        await page.click('#play');
        await until(async () => (await tones(page)).length > before, 'it goes on');
        // Another pitch begins anew.
        await page.selectOption('#sound-pitch', 'letter');
        await until(
            async () => (await dots()) > 0 && Number(await page.inputValue('#play-slider')) < 5000,
            'from the start',
        );
        await page.click('#listen');
        assert.equal(await dots(), 0);
        assert.ok(!/min$/.test((await page.textContent('#play-total')) ?? ''), 'the segments are back');
    }));

test('a walk of 10^24 lines is heard without delay, and the choices are kept', () =>
    withPage(
        {
            hash: `#v=1&axiom=A&rules=${encodeURIComponent('A -> +BF-AFA-FB+\nB -> -AF+BFB+FA-')}&n=40&angle=90`,
            before: noting,
        },
        async (page) => {
            await page.click('#open-playback');
            await page.click('#listen');
            await until(async () => (await tones(page)).length > 10, 'it sounds');
            assert.ok(new Set((await tones(page)).map(({ frequency }) => frequency)).size > 2);
            await page.selectOption('#sound-scale', 'minor');
            await page.fill('#sound-volume', '20');
            await page.reload();
            await page.click('#open-playback');
            await page.click('#listen');
            assert.deepEqual(
                [await page.inputValue('#sound-scale'), await page.inputValue('#sound-volume')],
                ['minor', '20'],
            );
        },
    ));
