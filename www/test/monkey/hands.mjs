/** Clicks, keys and gestures on a page or in a frame. No action waits for an element: a missing element is skipped. */

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('playwright-core').Frame} Frame */
/**
 * The place of the monkey: `frame` has the drawing and is the page's main frame or an inner one.
 * @typedef {{page: Page, frame: Frame}} Place
 */

/** Network errors are ignored for this time after the network is back, in milliseconds. */
const ECHO = 5000;

/** When the network was last off; Infinity while off. @type {WeakMap<import('playwright-core').BrowserContext, number>} */
const offline = new WeakMap();

/** Switches the network off or on. @param {import('playwright-core').BrowserContext} context @param {boolean} off */
export async function setOffline(context, off) {
    if (off) offline.set(context, Infinity);
    else if (offline.get(context) === Infinity) offline.set(context, Date.now());
    await context.setOffline(off);
}

/** Whether the network is off or was off recently. @param {import('playwright-core').BrowserContext} context */
export const wasOffline = (context) => Date.now() - (offline.get(context) ?? 0) < ECHO;

/** The result of an action that found no element. */
export const NOTHING = 'nothing there';

/**
 * A visible and reachable element of a selector, or null; of several, the one at an index.
 * @param {Frame} frame
 * @param {string} selector
 * @param {number} [which]
 */
export async function reach(frame, selector, which = 0) {
    const handle = await frame.evaluateHandle(
        ([name, at]) => {
            const seen = [...document.querySelectorAll(String(name))].filter(
                (each) => each.checkVisibility({ visibilityProperty: true }) && each.getClientRects().length > 0,
            );
            const element = seen[Number(at) % Math.max(1, seen.length)];
            if (!(element instanceof HTMLElement)) return null;
            element.scrollIntoView({ block: 'nearest', inline: 'nearest' });
            const box = element.getBoundingClientRect();
            const top = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
            // A label or icon counts as its control; an element on top of another hides it.
            const own =
                top &&
                (element.contains(top) ||
                    top.contains(element) ||
                    /** @type {HTMLLabelElement | null} */ (top.closest('label'))?.control === element);
            return own ? element : null;
        },
        /** @type {const} */ ([selector, which]),
    );
    return handle.asElement();
}

/** @param {Place} place @param {string} selector @param {number} [which] @returns {Promise<string>} */
export async function click({ page, frame }, selector, which = 0) {
    const element = await reach(frame, selector, which);
    const box = await element?.boundingBox();
    if (!element || !box) return NOTHING;
    const name = await element.evaluate(
        (each) => each.id || each.getAttribute('aria-label') || each.textContent?.trim().slice(0, 30) || each.tagName,
    );
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    return `clicked ${name}`;
}

/** Puts the caret into a field by a click, or by focus if the field is covered. @param {Place} place @param {string} selector */
export async function enter(place, selector) {
    // Leave the former field first, as a reader does, so that its change is a separate undo step.
    await leave(place.frame);
    await open(place, selector);
    const done = await click(place, selector);
    if (done === NOTHING) return false;
    return place.frame.evaluate((name) => document.activeElement === document.querySelector(name), selector);
}

/** Opens the panel and the details around an element. @param {Place} place @param {string} selector */
export async function open(place, selector) {
    const tab = await place.frame.evaluate((name) => {
        const element = document.querySelector(name);
        const fold = element?.closest('details');
        if (fold) fold.open = true;
        const section = element?.closest('[data-section]');
        return section && !section.checkVisibility() ? section.getAttribute('data-section') : null;
    }, selector);
    if (tab) await click(place, `#tab-${tab}`);
}

/** Removes the focus from any field. @param {Frame} frame */
export const leave = (frame) =>
    frame.evaluate(() => document.activeElement instanceof HTMLElement && document.activeElement.blur());

/** Longer texts, in UTF-16 units, are set at once: Chromium needs a minute to type some thousand lines. */
const TYPED = 200;

/** Replaces the text of the focused field. @param {Place} place @param {string} selector @param {string} text */
export async function paste({ page, frame }, selector, text) {
    if (text.length > TYPED) {
        return frame.evaluate(
            ([name, all]) => {
                const field = /** @type {HTMLTextAreaElement} */ (document.querySelector(String(name)));
                field.setRangeText(String(all), 0, field.value.length, 'end');
                field.dispatchEvent(new InputEvent('input', { bubbles: true, inputType: 'insertFromPaste' }));
            },
            [selector, text],
        );
    }
    await page.keyboard.press('Control+a');
    await (text === '' ? page.keyboard.press('Delete') : page.keyboard.insertText(text));
}

/** The text of a field. @param {Frame} frame @param {string} selector @returns {Promise<string>} */
export const valueOf = (frame, selector) =>
    frame.evaluate(
        (name) => /** @type {HTMLInputElement | null} */ (document.querySelector(name))?.value ?? '',
        selector,
    );

/** Sets a slider, a choice or a colour with the events of its widget. @param {Frame} frame @param {string} selector @param {(string | number)[]} values one after the other */
export function set(frame, selector, values) {
    return frame.evaluate(
        ([name, all]) => {
            const field = /** @type {HTMLInputElement | null} */ (document.querySelector(String(name)));
            if (!field || field.disabled || !field.checkVisibility()) return false;
            for (const value of /** @type {(string | number)[]} */ (all)) {
                field.value = String(value);
                field.dispatchEvent(new Event('input', { bubbles: true }));
            }
            field.dispatchEvent(new Event('change', { bubbles: true }));
            return true;
        },
        /** @type {const} */ ([selector, values]),
    );
}

/** Drags the pointer over the drawing. @param {Place} place @param {number[]} by fractions of its size: from x, y, to x, y @param {number} steps */
export async function drag({ page, frame }, [fromX = 0, fromY = 0, toX = 0, toY = 0], steps) {
    const box = await (await frame.$('#drawing'))?.boundingBox();
    if (!box) return NOTHING;
    await page.mouse.move(box.x + box.width * fromX, box.y + box.height * fromY);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * toX, box.y + box.height * toY, { steps });
    await page.mouse.up();
    return 'dragged';
}

/** Drops a file onto the page. @param {Frame} frame @param {{name: string, mimeType: string, buffer: Buffer}} file */
export function drop(frame, { name, mimeType, buffer }) {
    return frame.evaluate(
        ([title, type, base64]) => {
            const bytes = Uint8Array.from(atob(String(base64)), (letter) => letter.charCodeAt(0));
            const transfer = new DataTransfer();
            transfer.items.add(new File([bytes], String(title), { type: String(type) }));
            const stage = /** @type {Element} */ (document.querySelector('#stage'));
            for (const kind of ['dragenter', 'dragover', 'drop'])
                stage.dispatchEvent(new DragEvent(kind, { bubbles: true, cancelable: true, dataTransfer: transfer }));
        },
        [name, mimeType, buffer.toString('base64')],
    );
}
