/** Actions of the monkey on the page and on embedded drawings. */

import { ENDS, stopWorker } from './instrument.mjs';
import { NOTHING, click, drag, enter, leave, open, paste, set, valueOf } from './hands.mjs';
import { axiomText, numberText, overridesText, pick, rulesText, whole } from './texts.mjs';

/** @typedef {import('./hands.mjs').Place} Place */
/** @typedef {import('./texts.mjs').Roll} Roll */
/**
 * A kind of action: its relative frequency, and a function. The function returns its result in words, for the log,
 * checks conditions that must hold at once, and throws a fault.
 * @typedef {{kind: string, weight: number, act: (place: Place, roll: Roll) => Promise<string | void>}} Action
 */

/** A fault of the page, as opposed to an error of the monkey. */
export class Fault extends Error {}

/** Text fields, with their random texts. @type {readonly (readonly [string, (roll: Roll) => string, number])[]} */
const TEXTS = [
    ['#rules', rulesText, 50_000],
    ['#rules', rulesText, 50_000],
    ['#axiom', axiomText, 1 << 20],
    ['#overrides', overridesText, 20_000],
    ['#title', (roll) => pick(roll, ['Weed', '', '<b>x</b>', 'T'.repeat(300), '\u202ename'.repeat(3)]), 200],
];

const NUMBERS = [
    '#iterations',
    '#angle',
    '#right',
    '#length-factor',
    '#angle-variation',
    '#length-variation',
    '#seed',
    '#heading',
    '#step',
    '#start-x',
    '#start-y',
    '#elasticity',
    '#tropism-x',
    '#tropism-y',
    '#pitch-down',
    '#roll-right',
    '#exposure',
    '#width',
    '#width-factor',
    '#min-width',
    '#max-width',
    '#left-colour',
    '#play-place',
    '#reader-goto',
    '#constants-list .number',
];
const SLIDERS = [
    '#iterations-slider',
    '#angle-slider',
    '#right-slider',
    '#length-factor-slider',
    '#angle-variation-slider',
    '#width-slider',
    '#min-width-slider',
    '#exposure-slider',
    '#fade',
    '#play-slider',
    '#play-speed',
    '#reader-step',
    '#constants-list input[type=range]',
];
/** The part of a slider’s range that is used, because high values make drawings too slow for a test. */
const REACH = 0.35;

const KEYS = [
    'ArrowLeft',
    'ArrowRight',
    'ArrowUp',
    'ArrowDown',
    '+',
    '-',
    '0',
    ' ',
    'Escape',
    'Enter',
    'Tab',
    'Home',
    'End',
    'PageDown',
    '?',
    'Shift+ArrowLeft',
    'Shift+ArrowUp',
    'Alt+ArrowRight',
    'Control+z',
    'Control+Shift+z',
    'Control+y',
    'Backspace',
    'Delete',
    'a',
    'F',
];

/** @param {string} text as a text area keeps it */
const asKept = (text) => text.replace(/\r\n?/g, '\n');

/**
 * Types into a field, and sometimes undoes and redoes, which must lose nothing.
 * @param {Place} place
 * @param {Roll} roll
 */
async function write(place, roll) {
    const [selector, make, most] = pick(roll, TEXTS);
    const text = make(roll).replace(/\p{Surrogate}/gu, '\ufffd');
    const way = roll();
    const [takesBack, howLong] = [roll() < 0.3, whole(roll, 120)];
    const { page, frame } = place;
    const before = await valueOf(frame, selector);
    if (!(await enter(place, selector))) return NOTHING;
    if (way < 0.2) {
        await page.keyboard.press(pick(roll, ['Control+End', 'Home', 'End']));
        await page.keyboard.type(text.slice(0, 60).replace(/\n/g, ' '), { delay: whole(roll, 3) });
    } else if (way < 0.3) {
        for (let at = 0; at < 6; at++) await page.keyboard.press('Backspace');
    } else {
        await paste(place, selector, text);
    }
    const after = await valueOf(frame, selector);
    const one = selector === '#rules' || selector === '#overrides';
    if (way >= 0.3 && one && text.length <= most && after !== asKept(text))
        throw new Fault(`${selector} holds other text than was typed: ${show(after)} for ${show(text)}`);
    await page.waitForTimeout(howLong);
    await same(place, selector, after, 'a while after it was typed');
    // An embedded drawing has no undo.
    if (takesBack && before !== after && after.length <= most && (await frame.$('#undo'))) {
        await leave(frame);
        await page.keyboard.press('Control+z');
        await same(place, selector, before, 'after undo');
        await page.keyboard.press('Control+Shift+z');
        await same(place, selector, after, 'after redo');
    }
    return `${selector} ${takesBack ? 'and back ' : ''}${show(text)}`;
}

/** @param {Place} place @param {string} selector @param {string} expected @param {string} when */
async function same({ frame }, selector, expected, when) {
    const now = await valueOf(frame, selector);
    if (now !== expected)
        throw new Fault(`lost text: ${selector} ${when} holds ${show(now)} and not ${show(expected)}`);
}

/** A text for the log. @param {string} text */
export const show = (text) =>
    `${JSON.stringify(text.slice(0, 50))}${text.length > 50 ? ` (${text.length} characters)` : ''}`;

/** @type {readonly Action[]} */
export const COMMON = [
    { kind: 'write', weight: 14, act: write },
    {
        kind: 'number',
        weight: 8,
        async act(place, roll) {
            const [selector, text, end] = [
                pick(roll, NUMBERS),
                numberText(roll),
                pick(roll, ['Enter', 'Tab', 'ArrowUp', 'ArrowDown', 'Shift+ArrowUp', '']),
            ];
            if (!(await enter(place, selector))) return NOTHING;
            await place.page.keyboard.press('Control+a');
            await (text === '' ? place.page.keyboard.press('Delete') : place.page.keyboard.insertText(text));
            if (end) await place.page.keyboard.press(end);
            return `${selector} ${text} ${end}`;
        },
    },
    {
        kind: 'slider',
        weight: 8,
        async act(place, roll) {
            const { frame } = place;
            const selector = pick(roll, SLIDERS);
            await open(place, selector);
            const most = Number(
                await frame.evaluate(
                    (name) => /** @type {HTMLInputElement | null} */ (document.querySelector(name))?.max ?? 0,
                    selector,
                ),
            );
            const positions = Array.from({ length: 1 + whole(roll, 20) }, () => Math.floor(roll() * REACH * most));
            return (await set(frame, selector, positions)) ? `${selector} to ${positions.at(-1)} of ${most}` : NOTHING;
        },
    },
    {
        kind: 'keys',
        weight: 8,
        async act(place, roll) {
            const keys = Array.from({ length: 1 + whole(roll, 5) }, () => pick(roll, KEYS));
            if (roll() < 0.7)
                await place.frame.evaluate(() =>
                    /** @type {HTMLElement | null} */ (document.querySelector('#drawing'))?.focus(),
                );
            for (const key of keys) await place.page.keyboard.press(key);
            return keys.join(' ');
        },
    },
    {
        kind: 'drag',
        weight: 6,
        act: (place, roll) => drag(place, [roll(), roll(), roll(), roll()], 1 + whole(roll, 8)),
    },
    {
        kind: 'wheel',
        weight: 5,
        async act({ page, frame }, roll) {
            const box = await (await frame.$('#drawing'))?.boundingBox();
            if (!box) return NOTHING;
            await page.mouse.move(box.x + box.width * roll(), box.y + box.height * roll());
            for (let turn = 1 + whole(roll, 4); turn > 0; turn--) await page.mouse.wheel(0, (roll() - 0.5) * 800);
            return 'turned';
        },
    },
    {
        kind: 'click anywhere',
        weight: 8,
        async act({ page }, roll) {
            const { width, height } = page.viewportSize() ?? { width: 800, height: 600 };
            const [x, y] = [whole(roll, width), whole(roll, height)];
            await page.mouse.click(x, y, { clickCount: roll() < 0.1 ? 2 : 1 });
            return `${x}, ${y}`;
        },
    },
    {
        kind: 'playback',
        weight: 4,
        async act(place, roll) {
            const opened = await click(place, '#open-playback');
            return `${opened}, ${await click(place, pick(roll, ['#play', '#grow', '#wind', '#play-ten', '#close-playback']))}`;
        },
    },
    {
        kind: 'string view',
        weight: 4,
        async act(place, roll) {
            const opened = await click(place, '#open-reader');
            const done = await click(
                place,
                pick(roll, ['#reader-back', '#reader-on', '#reader-text span', '#reader-bar', '#close-reader']),
                whole(roll, 50),
            );
            await place.page.keyboard.press(pick(roll, ['ArrowRight', 'PageDown', 'End', 'Home', 'ArrowDown']));
            return `${opened}, ${done}`;
        },
    },
    {
        kind: 'view',
        weight: 3,
        act: (place, roll) => click(place, pick(roll, ['#zoom-in', '#zoom-out', '#fit', '#turntable', '#perspective'])),
    },
    { kind: 'reset', weight: 1, act: (place) => click(place, '#reset') },
    {
        kind: 'stop a worker',
        weight: 3,
        act: async ({ frame }, roll) => {
            const how = pick(roll, ENDS);
            return `${how}: ${await frame.evaluate(stopWorker, /** @type {const} */ ([whole(roll, 8), how]))}`;
        },
    },
];
