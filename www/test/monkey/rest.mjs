/** Checks of a page at rest: texts match the link, and the picture matches a fresh load. */

import { openLink } from '../../js/state/packed.js';
import { plain } from '../../js/base/numerals.js';
import { Fault, show } from './actions.mjs';
import { leave, valueOf } from './hands.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('playwright-core').Frame} Frame */
/** @typedef {import('./hands.mjs').Place} Place */
/** @typedef {{width: number, height: number, stage: {width: number, height: number}, ratio: number, digest: number}} Picture */

/** The most time for a drawing, including replacing a stopped worker, in milliseconds: a guess for a busy machine. */
export const PATIENCE = 30_000;
/** A picture is at rest if unchanged for this time, in milliseconds; the address is written after 300 ms. */
const STILL = 600;

/** Closes everything that is open, as a reader does; no dialog may stay. @param {Place} place */
export async function leaveAll({ page, frame }) {
    for (let times = 0; times < 4; times++) {
        if (await frame.evaluate(() => document.querySelector('dialog[open]') === null)) break;
        await page.keyboard.press('Escape');
    }
    const stuck = await frame.evaluate(() => document.querySelector('dialog[open]')?.id);
    if (stuck) throw new Fault(`the dialog ${stuck} does not close`);
    await leave(frame);
    await frame.evaluate(() => {
        const press = (/** @type {string} */ name) => {
            const button = document.querySelector(name);
            if (button instanceof HTMLElement && button.checkVisibility()) button.click();
        };
        press('#grow[aria-pressed=true]');
        press('#wind[aria-pressed=true]');
        press('#turntable[aria-pressed=true]');
        press('#close-playback');
        press('#close-reader');
    });
}

/**
 * Waits until the drawing is at rest and returns the picture; null if nothing was drawn because the system has errors.
 * @param {Frame} frame
 * @param {string} whose
 * @returns {Promise<Picture | null>}
 */
export async function atRest(frame, whose) {
    const end = Date.now() + PATIENCE;
    let last = '';
    let since = Date.now();
    for (;;) {
        const { busy, inked, picture } = await within(frame.evaluate(look), 10_000, `${whose} answers`);
        const now = JSON.stringify([busy, inked, picture]);
        if (now !== last) since = Date.now();
        last = now;
        if (!busy && Date.now() - since >= STILL) return inked ? picture : null;
        if (Date.now() > end)
            throw new Fault(`${whose} does not come to rest in ${PATIENCE} ms${busy ? `: ${busy}` : ''}`);
        await new Promise((resolve) => setTimeout(resolve, 100));
    }
}

/**
 * The picture at rest, of a page that draws. A state that was given up when the monkey stopped a worker is drawn again
 * by “Try again”.
 * @param {Frame} frame
 */
async function recovered(frame) {
    for (let times = 0; ; times++) {
        const picture = await atRest(frame, 'the page');
        const words = await frame.evaluate(() =>
            document.querySelector('#trouble')?.checkVisibility()
                ? document.querySelector('#trouble-words')?.textContent
                : null,
        );
        if (!words) return picture;
        if (times === RETRIES) throw new Fault(`the drawing stays given up: ${words}`);
        await frame.evaluate(() =>
            /** @type {HTMLElement | null} */ (document.querySelector('#trouble-again'))?.click(),
        );
    }
}

/** Runs in the page: a digest of the canvas. */
function look() {
    const began = performance.timeOrigin + performance.now();
    const stage = /** @type {HTMLElement} */ (document.querySelector('#stage'));
    const source = /** @type {HTMLCanvasElement} */ (document.querySelector('#drawing'));
    const copy = document.createElement('canvas');
    copy.width = source.width;
    copy.height = source.height;
    const context = /** @type {CanvasRenderingContext2D} */ (copy.getContext('2d', { willReadFrequently: true }));
    context.drawImage(source, 0, 0);
    let digest = 0;
    for (const word of new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer))
        digest = (Math.imul(digest, 31) + word) | 0;
    const busy = [
        stage.getAttribute('aria-busy') === 'true' && 'a newer drawing is under way',
        document.querySelector('#busy')?.checkVisibility() && 'a finer one is',
    ]
        .filter(Boolean)
        .join(', ');
    const picture = {
        width: source.width,
        height: source.height,
        stage: { width: stage.clientWidth, height: stage.clientHeight },
        ratio: Math.min(3, devicePixelRatio),
        digest,
    };
    /** @type {any} */ (window).monkey?.reads.push([began, performance.timeOrigin + performance.now()]);
    return { busy, inked: stage.classList.contains('inked'), picture };
}

/** Runs in the page: the pixels of the canvas, in base 64. */
function pixels() {
    const source = /** @type {HTMLCanvasElement} */ (document.querySelector('#drawing'));
    const copy = document.createElement('canvas');
    copy.width = source.width;
    copy.height = source.height;
    const context = /** @type {CanvasRenderingContext2D} */ (copy.getContext('2d', { willReadFrequently: true }));
    context.drawImage(source, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    let text = '';
    for (let at = 0; at < data.length; at += 8192) text += String.fromCharCode(...data.subarray(at, at + 8192));
    return btoa(text);
}

/**
 * The difference of two pictures, in levels of 255: the mean, and the largest mean of a square of 8 pixels.
 * @param {Frame} one
 * @param {Frame} other
 * @param {number} width of both, in pixels
 */
export async function difference(one, other, width) {
    const [a, b] = (await Promise.all([one.evaluate(pixels), other.evaluate(pixels)])).map((text) =>
        Buffer.from(text, 'base64'),
    );
    if (!a || !b || a.length !== b.length) return { mean: 255, worst: 255 };
    const columns = Math.ceil(width / SQUARE);
    /** @type {{sum: number, count: number}[]} */
    const squares = [];
    let all = 0;
    for (let at = 0; at < a.length; at += 4) {
        const apart = [0, 1, 2].reduce((sum, part) => sum + Math.abs((a[at + part] ?? 0) - (b[at + part] ?? 0)), 0) / 3;
        const square = (squares[
            Math.floor(at / 4 / width / SQUARE) * columns + Math.floor(((at / 4) % width) / SQUARE)
        ] ??= { sum: 0, count: 0 });
        square.sum += apart;
        square.count += 1;
        all += apart;
    }
    return {
        mean: (4 * all) / a.length,
        worst: squares.reduce((most, { sum, count }) => Math.max(most, sum / count), 0),
    };
}

/** How often “Try again” is pressed. */
const RETRIES = 2;

/** The side of the squares that are compared, in pixels. */
const SQUARE = 8;

/**
 * The tolerance between equal pictures, as in the tests of the core. Which repeated parts are painted once depends on
 * former pictures and on sharing between workers. Random strokes for unexplored parts depend on this as well.
 */
const SAME = { mean: 1, worst: 12 };
const ROUGH = { mean: 3, worst: 24 };

/**
 * The picture must equal that of a fresh load of the same link on a canvas of the same size.
 * @param {Place} place
 * @param {Page} fresh a page of another visit
 * @param {string} link
 */
export async function comparePicture({ page, frame }, fresh, link) {
    const mine = await recovered(frame);
    await fresh.setViewportSize(page.viewportSize() ?? { width: 800, height: 600 });
    await fresh.goto('about:blank');
    await fresh.goto(link);
    await fresh.evaluate((size) => {
        const stage = /** @type {HTMLElement} */ (document.querySelector('#stage'));
        for (const [name, value] of Object.entries({
            position: 'fixed',
            inset: '0 auto auto 0',
            margin: '0',
            border: '0',
            padding: '0',
            'max-width': 'none',
            'max-height': 'none',
            'min-width': '0',
            'min-height': '0',
            width: `${size.width}px`,
            height: `${size.height}px`,
        }))
            stage.style.setProperty(name, value, 'important');
    }, mine?.stage ?? { width: 600, height: 400 });
    const theirs = await atRest(fresh.mainFrame(), `a fresh page with the link ${link}`);
    if (!theirs) {
        // The state has errors: the last good drawing stays, and the page must say why.
        if (!(await frame.evaluate(() => document.querySelector('.problems li, #mistake:not([hidden])'))))
            throw new Fault('nothing can be drawn, and the page does not say why');
        return 'cannot be drawn';
    }
    if (!mine) throw new Fault('nothing is drawn, a fresh page draws');
    if (mine.width !== theirs.width || mine.height !== theirs.height)
        throw new Fault(
            `the picture is ${mine.width} x ${mine.height}, that of a fresh page ${theirs.width} x ${theirs.height}; the stages are ${JSON.stringify([mine.stage, theirs.stage])}`,
        );
    if (mine.digest === theirs.digest) return 'same';
    const { mean, worst } = await difference(frame, fresh.mainFrame(), mine.width);
    const most = (await fresh.evaluate(() => document.querySelector('#rough')?.hasAttribute('hidden') === false))
        ? ROUGH
        : SAME;
    const words = `${mean.toFixed(3)} levels off in the mean, ${worst.toFixed(1)} in the worst square`;
    if (mean > most.mean || worst > most.worst) throw new Fault(`stuck picture: ${words} from that of a fresh page`);
    return words;
}

/**
 * The fields must match the link.
 * @param {Frame} frame
 * @param {string} link
 */
export async function compareTexts(frame, link) {
    const opened = await openLink(new URL(link).hash);
    // The opening plant has the plain address.
    if (!opened) return;
    const { state, problems } = opened;
    if (problems.length > 0) throw new Fault(`the page wrote a link that it cannot read: ${problems.join(' ')}`);
    for (const [selector, text] of [
        ['#axiom', state.axiom],
        ['#rules', state.rules],
        ['#overrides', state.overrides],
        ['#iterations', plain(state.iterations)],
        ['#angle', plain(state.angle)],
        ['#seed', plain(state.seed)],
        ['#step', plain(state.step)],
    ]) {
        if (!selector || text === undefined || !(await frame.$(selector))) continue;
        const shown = await valueOf(frame, selector);
        if (shown !== text)
            throw new Fault(`lost text: ${selector} shows ${show(shown)}, the link holds ${show(text)}`);
    }
}

/**
 * Awaits a promise. Taking longer than the limit is a fault, because no action of a reader may take so long.
 * @template T
 * @param {Promise<T>} promise
 * @param {number} milliseconds
 * @param {string} what
 * @returns {Promise<T>}
 */
export async function within(promise, milliseconds, what) {
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    let timer;
    promise.catch(() => {});
    const late = new Promise(
        (_, reject) =>
            (timer = setTimeout(() => reject(new Fault(`not within ${milliseconds} ms: ${what}`)), milliseconds)),
    );
    try {
        return /** @type {T} */ (await Promise.race([promise, late]));
    } finally {
        clearTimeout(timer);
    }
}
