/** Tabs of one browser. A test that only looks at a page gets the tab of the test before it, as good as new. */

import { chromium } from 'playwright-core';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('playwright-core').BrowserContextOptions} Options */

const ARGUMENTS = [
    '--headless',
    '--no-sandbox',
    '--disable-gpu',
    '--disable-quic',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
];

/** Whoever waits for longer than this waits for ever, also on a busy machine. In milliseconds. */
export const DEADLINE = 120_000;
/** What tests listen to. */
const EVENTS = /** @type {const} */ (['console', 'pageerror', 'request', 'dialog']);

/** @type {Promise<import('playwright-core').Browser> | undefined} */
let browser;
/** Free tabs, by their options. Work in a used process costs half as much as in a new one. @type {Map<string, Page>} */
const free = new Map();

/** Closes the browser. */
export async function close() {
    free.clear();
    await (await browser)?.close();
    browser = undefined;
}

/** A tab of its own. `script` runs in every page of it. @param {Options} options @param {() => void} script */
export async function newTab(options, script) {
    browser ??= chromium.launch({
        executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium-headless-shell',
        args: ARGUMENTS,
    });
    const context = await (await browser).newContext(options);
    context.setDefaultTimeout(DEADLINE);
    await context.addInitScript(script);
    const page = await context.newPage();
    waitsForParts(page);
    return page;
}

/** A free tab with these options, or a new one. @param {Options} options @param {() => void} script */
export async function takeTab(options, script) {
    const key = JSON.stringify(options);
    const page = free.get(key);
    free.delete(key);
    return page ?? newTab(options, script);
}

/**
 * Gives a tab back: without its page, and without what its test has stored, changed or listened to. The tab was taken
 * with these options.
 * @param {Page} page
 * @param {Options} options
 * @param {string} blank the address of a small file of the site
 */
export async function returnTab(page, options, blank) {
    const key = JSON.stringify(options);
    if (free.has(key)) return page.context().close();
    for (const event of EVENTS) page.removeAllListeners(event);
    for (const other of page.context().pages()) if (other !== page) await other.close();
    await page.unrouteAll();
    await page.emulateMedia({
        media: null,
        colorScheme: options.colorScheme ?? 'light',
        contrast: options.contrast ?? 'no-preference',
        forcedColors: options.forcedColors ?? 'none',
        reducedMotion: options.reducedMotion ?? 'no-preference',
    });
    if (options.viewport) await page.setViewportSize(options.viewport);
    // The page that is left may store something last.
    await page.goto(blank);
    await page.evaluate(() => sessionStorage.clear());
    const session = await page.context().newCDPSession(page);
    await session.send('Storage.clearDataForOrigin', { origin: new URL(blank).origin, storageTypes: 'all' });
    await session.send('Page.resetNavigationHistory');
    await session.detach();
    free.set(key, page);
}

/**
 * Makes input wait for the part of the page that it opens: parts load late, and what they show is not there at once.
 * @param {Page} page
 */
function waitsForParts(page) {
    for (const [owner, name] of /** @type {[any, string][]} */ ([
        [page, 'click'],
        [page, 'tap'],
        [page.keyboard, 'press'],
    ])) {
        const input = owner[name].bind(owner);
        owner[name] = async (/** @type {any[]} */ ...words) => {
            await input(...words);
            await page.waitForSelector(':root:not([data-opening])', { state: 'attached' });
        };
    }
}
