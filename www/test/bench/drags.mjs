/**
 * Measures pictures while a slider is dragged and while the turtle plays: how many were fine at once, and how
 * responsive the page's thread stays. Prints a table.
 */

import { close, stillPicture, withPage } from '../e2e/browser.mjs';

/** @typedef {import('playwright-core').Page} Page */

/** The number of changes in a drag, and its duration in milliseconds. */
const CHANGES = 200;
const DURATION = 2000;

const PLANT = '#v=1&axiom=X&rules=X%20-%3E%20F%5B+X%5D%5B-X%5DFX%0AF%20-%3E%20FF&angle=25.7';
const TREE = `#v=1&axiom=A(1)&rules=${encodeURIComponent('r = 0.7\nA(l) : l > 0.01 -> F(l)[+A(l*r)][-A(l*r)]')}&n=10&angle=25`;

/** @type {[string, string, (page: Page) => Promise<unknown>][]} */
const GESTURES = [
    ['angle, memoised, n = 7', `${PLANT}&n=7`, (page) => slide(page, '#angle-slider')],
    ['angle, memoised, n = 40', `${PLANT}&n=40`, (page) => slide(page, '#angle-slider')],
    [
        'angle, by chance, n = 6',
        `#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5DF%20:%200.5%0AF%20-%3E%20F%5B-F%5DF%20:%200.5&n=6&angle=25`,
        (page) => slide(page, '#angle-slider'),
    ],
    ['angle, parametric, n = 10', TREE, (page) => slide(page, '#angle-slider')],
    ['constant, parametric, n = 10', TREE, (page) => slide(page, '#constants input[type=range]')],
    ['playback, n = 7', `${PLANT}&n=7`, play],
];

/** @param {Page} page @param {string} selector */
function slide(page, selector) {
    return page.evaluate(
        async ({ name, changes, duration }) => {
            const slider = /** @type {HTMLInputElement} */ (document.querySelector(name));
            const [from, reach] = [Number(slider.value), Number(slider.max) / 4];
            const start = performance.now();
            for (let change = 0; change < changes; change++) {
                const due = start + (duration * change) / changes;
                while (performance.now() < due)
                    await new Promise((resolve) => setTimeout(resolve, Math.max(0, due - performance.now())));
                slider.value = String(Math.round(from + reach * Math.sin((change / changes) * 2 * Math.PI)));
                slider.dispatchEvent(new Event('input', { bubbles: true }));
            }
            slider.dispatchEvent(new Event('change', { bubbles: true }));
        },
        { name: selector, changes: CHANGES, duration: DURATION },
    );
}

/** Runs in the page: counts the pictures that a worker sends. */
function countFine() {
    const seen = { tasks: /** @type {number[]} */ ([]), pictures: 0, fine: 0 };
    Object.assign(globalThis, { seen });
    const Plain = Worker;
    globalThis.Worker = class extends Plain {
        /** @param {string | URL} address */
        constructor(address) {
            super(address);
            this.addEventListener(
                'message',
                ({ data }) => (seen.fine += Number(data.type === 'drawn' && data.complete)),
            );
        }
    };
}

/** @param {Page} page */
async function play(page) {
    await page.click('#open-playback');
    await page.waitForTimeout(DURATION);
}

console.log(
    `${CHANGES} changes in ${DURATION / 1000} s             pictures  fine  long tasks  longest   over 50 ms in all`,
);
for (const [name, hash, gesture] of GESTURES) {
    await withPage(
        {
            hash,
            options: { viewport: { width: 1280, height: 800 }, reducedMotion: 'no-preference' },
            before: (page) => page.addInitScript(countFine),
        },
        async (page) => {
            await stillPicture(page);
            await page.waitForTimeout(500);
            await page.evaluate(() => {
                const { seen } = /** @type {any} */ (globalThis);
                seen.fine = 0;
                new PerformanceObserver((list) =>
                    seen.tasks.push(...list.getEntries().map(({ duration }) => duration)),
                ).observe({ type: 'longtask' });
                const transfer = ImageBitmapRenderingContext.prototype.transferFromImageBitmap;
                ImageBitmapRenderingContext.prototype.transferFromImageBitmap = function (bitmap) {
                    seen.pictures += 1;
                    return transfer.call(this, bitmap);
                };
            });
            await gesture(page);
            await page.waitForTimeout(300);
            const { tasks, pictures, fine } = await page.evaluate(() => /** @type {any} */ (globalThis).seen);
            const longest = Math.max(0, ...tasks);
            const over = tasks.reduce((/** @type {number} */ sum, /** @type {number} */ task) => sum + task - 50, 0);
            console.log(
                `${name.padEnd(30)}${String(pictures).padStart(10)}${String(fine).padStart(6)}${String(tasks.length).padStart(12)}${longest.toFixed(0).padStart(6)} ms${over.toFixed(0).padStart(17)} ms`,
            );
        },
    );
}
await close();
