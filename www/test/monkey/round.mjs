/** One round of the monkey: a fresh profile, some actions, and regular checks. */

import { Fault } from './actions.mjs';
import { EMBEDDED, ask } from './embedded.mjs';
import { NOTHING, setOffline, wasOffline } from './hands.mjs';
import { instrument, longTasks } from './instrument.mjs';
import { PAGE } from './page-actions.mjs';
import { comparePicture, compareTexts, leaveAll, within } from './rest.mjs';
import { file, pick } from './texts.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('playwright-core').Browser} Browser */
/** @typedef {import('./hands.mjs').Place} Place */
/** @typedef {import('./texts.mjs').Roll} Roll */
/**
 * @typedef {object} Round
 * @property {number} seed decides all actions and the place
 * @property {number} actions
 * @property {number} until when to end, in milliseconds since 1970
 * @property {string} address of the playground
 * @property {{address: (element: boolean, controls: string) => string}} host of embedded drawings
 * @property {import('./log.mjs').Log} log
 * @property {(seed: number) => Roll} dice
 */

/** All checks run after this number of actions. */
const EVERY = 10;
/** The time limit of an action, in milliseconds; reloading has its own limit. */
const MOST = 60_000;
/** A responsive page answers within this time, in milliseconds. */
const ANSWER = 10_000;

/** The address contains the last change within this time, also on a busy machine, in milliseconds. */
const WRITTEN = 5000;

const PHONE = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true };
const DESKTOP = { viewport: { width: 1280, height: 800 } };

/** Browser messages while the network is off. */
const OFFLINE = /ERR_INTERNET_DISCONNECTED|Failed to fetch|NetworkError|ERR_FAILED|Failed to load/;
/** Console messages that the monkey causes. */
const OWN = /the monkey/;

/** @param {Browser} browser @param {Round} round */
export async function playRound(browser, round) {
    const { seed, log, dice, address } = round;
    const roll = dice(seed);
    const embedded = seed % 3 === 2;
    const [options, calm, element, controls] = [
        seed % 3 === 1 ? PHONE : DESKTOP,
        roll() < 0.5,
        roll() < 0.5,
        pick(roll, ['all', 'rules,n,angle', '']),
    ];
    log.round(`--seed ${seed}`);
    const motion = /** @type {const} */ ({ reducedMotion: calm ? 'reduce' : 'no-preference' });
    /** @type {Page | undefined} */
    let page;
    const context = await browser.newContext({ ...options, ...motion, acceptDownloads: true });
    const other = await browser.newContext({ ...options, reducedMotion: 'reduce' });
    try {
        await context.addInitScript(instrument);
        page = await context.newPage();
        const fresh = await other.newPage();
        const wrong = listen(page, roll);
        await page.goto(embedded ? round.host.address(element, controls) : address);
        const place = placeOf(page, embedded);
        const shown = page;
        const check = async () => {
            await setOffline(context, false);
            await shown.evaluate(() => window.scrollTo(0, 0));
            const where = await place();
            await leaveAll(where);
            log.picture(await compare(where, fresh, address, embedded));
        };
        await act(round, place, embedded ? EMBEDDED : PAGE, wrong, check);
    } catch (error) {
        const message =
            error instanceof Fault
                ? error.message
                : `the monkey failed: ${error instanceof Error ? error.stack : error}`;
        log.fault(`${message}\n    at ${page?.url().slice(0, 500)}`);
    } finally {
        // Closing the page ends a worker in an endless loop.
        await Promise.all([context.close(), other.close()]);
    }
}

/** Finds the frame with the drawing, because frames come and go. @param {Page} page @param {boolean} embedded @returns {() => Promise<Place>} */
function placeOf(page, embedded) {
    return async () => {
        if (!embedded) return { page, frame: page.mainFrame() };
        const end = Date.now() + ANSWER;
        for (;;) {
            const frame = page.frames().find((each) => each.url().includes('embed.html') && !each.isDetached());
            // The frame accepts messages once it has a theme and a state.
            const there = await frame
                ?.evaluate(() => document.readyState === 'complete' && document.title !== '')
                .catch(() => false);
            if (frame && there) return { page, frame };
            if (Date.now() > end) throw new Fault('the frame of the drawing is not there');
            await page.waitForTimeout(50);
        }
    };
}

/** @param {Round} round @param {() => Promise<Place>} place @param {typeof PAGE} kinds @param {string[]} wrong @param {() => Promise<void>} check */
async function act({ seed, actions, until, log, dice }, place, kinds, wrong, check) {
    const weights = kinds.reduce((sum, { weight }) => sum + weight, 0);
    for (let at = 0; at < actions && Date.now() < until; at++) {
        // Each action has its own random numbers, so that an action does not influence the next one.
        const roll = dice(seed * 1009 + at);
        let left = roll() * weights;
        const kind = kinds.find(({ weight }) => (left -= weight) < 0) ?? kinds[0];
        if (!kind) return;
        const where = await place();
        log.begins(kind.kind);
        const done = await within(attempt(kind, where, roll), MOST, `${kind.kind} is done`);
        log.ends(done ?? 'done', done === NOTHING);
        await settled(place, log);
        if (wrong.length > 0) throw new Fault(wrong.splice(0).join('\n'));
        if (at % EVERY === EVERY - 1 || at === actions - 1) await check();
        if (wrong.length > 0) throw new Fault(wrong.splice(0).join('\n'));
    }
}

/** Runs an action. A page that reloads meanwhile is no fault. @param {import('./actions.mjs').Action} kind @param {Place} where @param {Roll} roll */
async function attempt(kind, where, roll) {
    try {
        return await kind.act(where, roll);
    } catch (error) {
        if (
            error instanceof Error &&
            /context was destroyed|Frame was detached|frame got detached|Target closed|not attached|Execution context/.test(
                error.message,
            )
        )
            return 'the page went away meanwhile';
        throw error;
    }
}

/** Checks that the page answers, and collects its long tasks. @param {() => Promise<Place>} place @param {import('./log.mjs').Log} log */
async function settled(place, log) {
    const { frame } = await place();
    log.long(
        await within(
            frame.evaluate(longTasks).catch(() => []),
            ANSWER,
            'the page answers',
        ),
    );
}

/** @param {Place} place @param {Page} fresh @param {string} address @param {boolean} embedded */
async function compare(place, fresh, address, embedded) {
    if (embedded) {
        const { link } = await ask(place.page);
        await compareTexts(place.frame, `${address}embed.html${link}`);
        return comparePicture(place, fresh, `${address}embed.html${link}`);
    }
    // A dropped file may be opened this late.
    for (;;) {
        await written(place);
        const link = place.page.url();
        try {
            return await comparePicture(place, fresh, link);
        } catch (error) {
            if (place.page.url() === link) throw error;
        }
    }
}

/** The address is written with a delay: a wrong address must become right in time. @param {Place} place */
async function written({ page, frame }) {
    const end = Date.now() + WRITTEN;
    for (;;) {
        await page.waitForTimeout(500);
        try {
            return await compareTexts(frame, page.url());
        } catch (error) {
            if (Date.now() > end) throw error;
        }
    }
}

/** Collects errors of the page; handles file choosers, new windows and downloads. @param {Page} page @param {Roll} roll */
function listen(page, roll) {
    /** @type {string[]} */
    const wrong = [];
    const note = (/** @type {string} */ words) =>
        void (OWN.test(words) || (OFFLINE.test(words) && wasOffline(page.context())) || wrong.push(words));
    page.on(
        'console',
        (message) => ['error', 'warning'].includes(message.type()) && note(`console: ${message.text()}`),
    );
    page.on('pageerror', (error) => note(`uncaught: ${error.stack ?? error}`));
    page.on('crash', () => wrong.push('the page crashed'));
    page.on('dialog', (dialog) => {
        wrong.push(`a dialog of the browser: ${dialog.message()}`);
        dialog.dismiss().catch(() => {});
    });
    page.on('filechooser', (chooser) => chooser.setFiles(file(roll)).catch(() => {}));
    page.on('download', (download) => download.cancel().catch(() => {}));
    page.on('popup', (popup) => popup.close().catch(() => {}));
    return wrong;
}
