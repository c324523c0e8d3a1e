/** The lesson of the site: keeps the place and what is done in this browser. */

import { copyText } from '../base/copy.js';
import { html, setText } from '../base/dom.js';
import { createRows } from '../state/rows.js';
import { createStorage } from '../state/storage.js';
import { say } from '../base/words.js';
import { createSteps } from './steps.js';

/** A row for each step that is done, and one for the place. @typedef {import('../state/rows.js').Row & {at?: number}} Place */

/** Reads the rows, also from before there were any. @param {unknown} stored */
function readPlace(stored) {
    if (Array.isArray(stored)) return stored.filter((row) => typeof row?.id === 'string' && !row.gone);
    const { at, done, steps } = /** @type {any} */ (stored ?? {});
    // Pages without a number of steps began with step 1.
    const shift = steps === undefined ? 1 : 0;
    if (!Number.isInteger(at) || !Array.isArray(done)) return [];
    return [{ id: 'at', at: at + shift }, ...done.map((step) => ({ id: String(step + shift) }))];
}

/** @type {ReturnType<typeof createRows<Place>>} */
const rows = createRows(
    createStorage(() => localStorage, 'l-system-'),
    'lesson',
    { read: readPlace, changed: () => steps.restore({ at, done: kept().done }) },
);
/** The shown step. */
let at = 0;
const steps = createSteps((place) => {
    const there = kept();
    ({ at } = place);
    const news = place.done.filter((step) => !there.done.includes(step)).map((step) => ({ id: String(step) }));
    rows.put(at === there.at ? news : [{ id: 'at', at }, ...news]);
});

function kept() {
    const list = rows.list();
    const done = list.map((row) => Number(row.id)).filter(Number.isInteger);
    return { at: Number(list.find((row) => row.id === 'at')?.at ?? 0), done };
}

// The own plant leaves by its link.
const own = /** @type {(HTMLElement & {state: string | null}) | null} */ (document.querySelector('l-system.own'));
const plant = () => new URL(own?.state ?? '', new URL('./', location.href)).href;
document.getElementById('take')?.addEventListener('click', () => open(plant(), '_blank', 'noopener'));
document.getElementById('copy')?.addEventListener('click', async () => {
    setText(html('told'), (await copyText(plant())) ? say`The link is copied.` : plant());
});
steps.restore(kept());
steps.begin();
