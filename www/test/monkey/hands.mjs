/** What a hand can do on a page or in a frame of it. Nothing waits for an element: what is not there is not touched. */

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('playwright-core').Frame} Frame */
/**
 * Where the monkey is: `frame` holds the drawing and is the page's own, or one in it.
 * @typedef {{page: Page, frame: Frame}} Place
 */

/** Told of an action that found nothing to act on. */
export const NOTHING = 'nothing there';

/**
 * The element of a selector that can be seen and reached, or null; with several, the one counted round.
 * @param {Frame} frame
 * @param {string} selector
 * @param {number} [which]
 */
export async function reach(frame, selector, which = 0) {
    const handle = await frame.evaluateHandle(
        ([name, at]) => {
            const seen = [...document.querySelectorAll(String(name))].filter((each) => each.checkVisibility({ visibilityProperty: true }) && each.getClientRects().length > 0);
            const element = seen[Number(at) % Math.max(1, seen.length)];
            if (!(element instanceof HTMLElement)) return null;
            element.scrollIntoView({ block: 'nearest', inline: 'nearest' });
            const box = element.getBoundingClientRect();
            const top = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
            // Labels and icons belong to what they stand for; what lies above another hides it.
            const own = top && (element.contains(top) || top.contains(element) || /** @type {HTMLLabelElement | null} */ (top.closest('label'))?.control === element);
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
    const name = await element.evaluate((each) => each.id || each.getAttribute('aria-label') || each.textContent?.trim().slice(0, 30) || each.tagName);
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    return `clicked ${name}`;
}

/** Puts the caret into a field by a click, or by focus where it is hidden behind another. @param {Place} place @param {string} selector */
export async function enter(place, selector) {
    // What was written elsewhere is a change of its own, as it is when a reader goes from field to field.
    await leave(place.frame);
    await open(place, selector);
    const done = await click(place, selector);
    if (done === NOTHING) return false;
    return place.frame.evaluate((name) => document.activeElement === document.querySelector(name), selector);
}

/** Opens the panel and the fold that an element stands in, where it has any. @param {Place} place @param {string} selector */
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

/** Takes the caret out of whatever field it is in. @param {Frame} frame */
export const leave = (frame) => frame.evaluate(() => document.activeElement instanceof HTMLElement && document.activeElement.blur());

/** The text of a field. @param {Frame} frame @param {string} selector @returns {Promise<string>} */
export const valueOf = (frame, selector) => frame.evaluate((name) => /** @type {HTMLInputElement | null} */ (document.querySelector(name))?.value ?? '', selector);

/** Sets a slider, a choice or a colour the way its own widget does. @param {Frame} frame @param {string} selector @param {(string | number)[]} values one after the other */
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

/** Drags the pointer over the drawing. @param {Place} place @param {number[]} by parts of its size: from x, y, to x, y @param {number} steps */
export async function drag({ page, frame }, [fromX = 0, fromY = 0, toX = 0, toY = 0], steps) {
    const box = await (await frame.$('#drawing'))?.boundingBox();
    if (!box) return NOTHING;
    await page.mouse.move(box.x + box.width * fromX, box.y + box.height * fromY);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * toX, box.y + box.height * toY, { steps });
    await page.mouse.up();
    return 'dragged';
}

/** Lets files fall onto the page. @param {Frame} frame @param {{name: string, mimeType: string, buffer: Buffer}} file */
export function drop(frame, { name, mimeType, buffer }) {
    return frame.evaluate(
        ([title, type, base64]) => {
            const bytes = Uint8Array.from(atob(String(base64)), (letter) => letter.charCodeAt(0));
            const transfer = new DataTransfer();
            transfer.items.add(new File([bytes], String(title), { type: String(type) }));
            const stage = /** @type {Element} */ (document.querySelector('#stage'));
            for (const kind of ['dragenter', 'dragover', 'drop']) stage.dispatchEvent(new DragEvent(kind, { bubbles: true, cancelable: true, dataTransfer: transfer }));
        },
        [name, mimeType, buffer.toString('base64')],
    );
}
