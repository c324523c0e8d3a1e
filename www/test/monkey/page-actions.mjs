/** Actions of the monkey only on the page: history, links, panels, dialogs, files, network and workers. */

import { Fault, COMMON } from './actions.mjs';
import { NOTHING, click, drop, enter, open, set, setOffline, valueOf } from './hands.mjs';
import { axiomText, file, hash, numberText, pick, rulesText, whole } from './texts.mjs';

/** @typedef {import('./actions.mjs').Action} Action */

const SIZES = [
    [1280, 800],
    [390, 844],
    [844, 390],
    [700, 500],
    [320, 480],
    [1000, 1400],
];

const BUTTONS = [
    '#undo',
    '#redo',
    '#start-anew',
    '#two-angles',
    '#symbols',
    '#segments',
    '#dice',
    '#theme',
    '#add-colour',
    '#remove-colour',
    '#inks button',
    '#palette-holds',
    '#tapers',
    '#shadows',
    '#shapes',
    '#add-favourite',
    'summary',
    '#renew-later',
    '.toast-act',
    '.toast-close',
    '.problems button',
    '#legend button',
];
const CHOICES = /** @type {const} */ ([
    ['#dialect', ['abop', 'every-letter', 'practical', 'lowercase', 'axes']],
    ['#colour-by', ['symbol', 'level', 'generation', 'path', 'turn', 'density', 'single']],
    ['#ink', ['auto', 'solid', 'density']],
    ['#background', ['#ffffff', '#000000', '#336699']],
    ['#wells input', ['#ff0000', '#00ff00']],
]);
const TABS = ['rules', 'turtle', 'look', 'save'];
const SAVES = ['[data-save=svg]', '[data-save=png]', '#open-save'];

/** The texts in the fields, by field. @param {import('playwright-core').Frame} frame */
export async function texts(frame) {
    const found = [];
    for (const field of ['#axiom', '#rules', '#overrides', '#title']) found.push(await valueOf(frame, field));
    return found;
}

/** @type {Action['act']} */
async function pressButton(place, roll) {
    const [selector, which] = [pick(roll, BUTTONS), whole(roll, 8)];
    await open(place, selector);
    return click(place, selector, which);
}

/** Parts that are dialogs with much to press. */
const PARTS = [
    'find',
    'find',
    'film',
    'film',
    'save',
    'steps',
    'check',
    'maker',
    'share',
    'seeds',
    'breed',
    'surprise',
];

/**
 * Runs in the page: uses a control of the dialog on top. Returns the control, or nothing if there is none.
 * @param {{which: number, way: number, text: string}} choice
 */
function poke({ which, way, text }) {
    const dialog = [...document.querySelectorAll('dialog[open]')].at(-1);
    const all = [...(dialog?.querySelectorAll('button, input, select, textarea, summary') ?? [])];
    const seen = all.filter((one) => one.checkVisibility() && !one.matches(':disabled, [type=file]'));
    const one = seen[Math.floor(which * seen.length)];
    if (!(one instanceof HTMLElement)) return '';
    if (one instanceof HTMLSelectElement) one.selectedIndex = Math.floor(way * one.options.length);
    else if (one.matches('[type=number], [type=range]'))
        /** @type {HTMLInputElement} */ (one).value = String(Math.floor(way * 2000) / 10 - 50);
    else if (one.matches('[type=color]')) /** @type {HTMLInputElement} */ (one).value = '#336699';
    else if (one.matches('textarea, input:not([type=checkbox], [type=radio], [type=button])'))
        /** @type {HTMLInputElement} */ (one).value = text;
    else one.click();
    for (const type of ['input', 'change']) one.dispatchEvent(new Event(type, { bubbles: true }));
    return one.id || one.getAttribute('name') || (one.textContent ?? '').trim().slice(0, 30);
}

/** @type {readonly Action[]} */
export const PAGE = [
    ...COMMON,
    { kind: 'button', weight: 8, act: pressButton },
    { kind: 'panel', weight: 8, act: (place, roll) => click(place, `#tab-${pick(roll, TABS)}`) },
    {
        kind: 'choice',
        weight: 4,
        async act(place, roll) {
            const { frame } = place;
            const [selector, values] = pick(roll, CHOICES);
            await open(place, selector);
            const value = pick(roll, /** @type {readonly string[]} */ (values));
            return (await set(frame, selector, [value])) ? `${selector} ${value}` : NOTHING;
        },
    },
    {
        kind: 'undo and redo',
        weight: 5,
        async act({ page }, roll) {
            const keys = Array.from({ length: 1 + whole(roll, 8) }, () =>
                pick(roll, ['Control+z', 'Control+z', 'Control+y']),
            );
            for (const key of keys) await page.keyboard.press(key);
            return keys.join(' ');
        },
    },
    {
        kind: 'address',
        weight: 4,
        async act({ frame }, roll) {
            const next = hash(roll);
            await frame.evaluate((link) => void (location.hash = link), next);
            return next.slice(0, 100);
        },
    },
    {
        kind: 'back and forward',
        weight: 3,
        act: ({ frame }, roll) =>
            frame.evaluate((back) => {
                const { canGoBack, canGoForward } = /** @type {{canGoBack: boolean, canGoForward: boolean}} */ (
                    /** @type {any} */ (window).navigation
                );
                if (back ? !canGoBack : !canGoForward) return 'no more pages there';
                if (back) history.back();
                else history.forward();
                return back ? 'back' : 'forward';
            }, roll() < 0.6),
    },
    {
        kind: 'gallery',
        weight: 4,
        async act(place, roll) {
            const [which, searches, card] = [whole(roll, 90), roll() < 0.3, roll() < 0.85];
            if ((await click(place, '#open-gallery')) === NOTHING) return NOTHING;
            if (searches && (await enter(place, '#search')))
                await place.page.keyboard.type(pick(roll, ['koch', 'tree', 'zzz', 'space', '<b>']));
            // The cards appear once the gallery's list is loaded.
            await place.page.waitForTimeout(100);
            return click(place, card ? '#gallery .card' : pick(roll, ['#chips button', '#close-gallery']), which);
        },
    },
    {
        kind: 'share',
        weight: 2,
        async act(place, roll) {
            if ((await click(place, '#share')) === NOTHING) return NOTHING;
            return click(
                place,
                pick(roll, [
                    '#copy-share',
                    '#share-view',
                    '#embed-element',
                    '#share-dialog input[name=controls]',
                    '#save-qr',
                    '#close-share',
                ]),
                whole(roll, 5),
            );
        },
    },
    {
        kind: 'other dialog',
        weight: 2,
        async act(place, roll) {
            const which = pick(roll, ['#open-shortcuts', '#seed-sheet', '#open-favourites']);
            if ((await click(place, which)) === NOTHING) return NOTHING;
            return `${which}: ${await click(place, pick(roll, ['dialog[open] .card', '#more-cards', '.keep input', 'dialog[open] button']), whole(roll, 12))}`;
        },
    },
    {
        kind: 'inside a dialog',
        weight: 8,
        async act(place, roll) {
            const opener = `[data-opens=${pick(roll, PARTS)}]`;
            await open(place, opener);
            const opened = await click(place, opener);
            // Parts load late.
            await place.page.waitForTimeout(200);
            const done = [];
            for (let step = whole(roll, 8); step >= 0; step--) {
                const [which, way] = [roll(), roll()];
                const text = pick(roll, [rulesText, axiomText, numberText])(roll);
                done.push(await place.frame.evaluate(poke, { which, way, text }));
                await place.page.waitForTimeout(50);
            }
            return opened === NOTHING && done.every((one) => one === '') ? NOTHING : `${opener}: ${done.join(', ')}`;
        },
    },
    {
        kind: 'save',
        weight: 2,
        async act(place, roll) {
            const save = pick(roll, SAVES);
            await open(place, save);
            const clicked = await click(place, save);
            if (save !== '#open-save' || clicked === NOTHING) return clicked;
            await click(
                place,
                pick(roll, ['#save-purposes .save-tile', '#save-formats .save-tile', '#save-options input']),
                whole(roll, 5),
            );
            return click(place, pick(roll, ['#save-now', '#save-cancel', '#close-save']));
        },
    },
    {
        kind: 'file',
        weight: 3,
        async act({ frame }, roll) {
            const [given, dropped] = [file(roll), roll() < 0.5];
            if (dropped) await drop(frame, given);
            else {
                // The dialog of favourites loads late.
                const others = roll() < 0.8 ? null : await frame.$('#favourites-file');
                await frame.setInputFiles(others ? '#favourites-file' : '#file', given, { timeout: 3000 });
            }
            return `${given.name}, ${given.buffer.length} bytes, ${dropped ? 'dropped' : 'chosen'}`;
        },
    },
    {
        kind: 'size',
        weight: 3,
        async act({ page }, roll) {
            const [width = 800, height = 600] = pick(roll, SIZES);
            await page.setViewportSize({ width, height });
            return `${width} x ${height}`;
        },
    },
    {
        kind: 'network',
        weight: 2,
        async act({ page }, roll) {
            const off = roll() < 0.5;
            await setOffline(page.context(), off);
            return off ? 'off' : 'on';
        },
    },
    {
        kind: 'reload',
        weight: 2,
        async act({ page, frame }) {
            const served = await frame.evaluate(() => navigator.onLine || Boolean(navigator.serviceWorker?.controller));
            if (!served) return 'there is no network and no copy of the page';
            const before = await texts(frame);
            await page.reload({ waitUntil: 'load', timeout: 20_000 });
            const after = await texts(frame);
            if (JSON.stringify(before) !== JSON.stringify(after))
                throw new Fault(
                    `lost text: a reload made ${JSON.stringify(after).slice(0, 400)} of ${JSON.stringify(before).slice(0, 400)}`,
                );
            return 'loaded anew';
        },
    },
];
