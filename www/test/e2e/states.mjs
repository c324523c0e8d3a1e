/** The page's states that differ in what can be seen and reached. */

import assert from 'node:assert/strict';
import { until } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */

export const RULES = '// so\nr = 0.9\nb = 2*r\nA(l) : l > 0.1 -> F(l)[+A(l*r)][-A(l*r)] : 0.7\nA(l) -> F(l) : 0.3';
export const TREE = `#v=1&title=Tree&axiom=A(1)&rules=${encodeURIComponent(RULES)}&n=5&angle=25`;

/** A tab of the controls, on a phone as well. @param {string} name */
export const tab = (name) => async (/** @type {Page} */ page) => {
    // Clicking a selected tab closes its section.
    const other = page.locator(`#tab-${name}:visible:not([aria-selected="true"])`);
    if (await other.count()) await other.click();
};

/** The page's states that differ in what can be seen and reached. @type {Record<string, (page: Page) => Promise<unknown>>} */
export const STATES = {
    'as it opens': async () => {},
    rules: async (page) => {
        await tab('rules')(page);
        const folded = page.locator('#section-rules details:not([open]) > summary:visible');
        while ((await folded.count()) > 0) await folded.first().click();
    },
    mistakes: async (page) => {
        await tab('rules')(page);
        await page.fill('#rules', `${RULES}\nG = = 1\nX -> F\nX -> G`);
        await page.waitForSelector('#rules-problems .error');
        await page.waitForSelector('#rules-problems .warning');
    },
    'nothing drawn': async (page) => {
        await tab('rules')(page);
        await page.fill('#axiom', 'Q');
        await page.waitForSelector('#empty:visible');
    },
    turtle: tab('turtle'),
    look: tab('look'),
    save: tab('save'),
    'save dialog with sizes': async (page) => {
        await tab('save')(page);
        await page.click('#open-save');
        await page.click('.save-tile:has([value=png])');
        await page.waitForSelector('#save-preview img');
        await page.selectOption('#option-size', 'own');
    },
    'save dialog with a text': async (page) => {
        await tab('save')(page);
        await page.click('#open-save');
        await page.click('.save-tile:has([value=data])');
        await page.waitForSelector('#save-preview pre');
    },
    gallery: async (page) => {
        await page.click('#open-gallery');
        await page.waitForSelector('.thumb.inked:visible');
        await page.click('.chip >> nth=1');
    },
    'gallery without results': async (page) => {
        await page.click('#open-gallery');
        await page.waitForSelector('.card', { state: 'attached' });
        await page.fill('#search', 'zzz');
        await page.waitForSelector('#clear-search:visible');
    },
    'gallery with cards without pictures': async (page) => {
        await page.click('#open-gallery');
        // A filter may be chosen.
        await page.fill('#search', 'zzz');
        await page.click('#clear-search');
        await page.fill('#search', 'doubling');
        await page.waitForSelector('.card-missing:visible');
    },
    'rules to be found': async (page) => {
        await tab('save')(page);
        await page.click('#section-save [data-opens=find]');
        await until(async () => (await page.locator('#find-examples .thumb.inked').count()) === 4, 'four pictures');
    },
    'rules found': async (page) => {
        await tab('save')(page);
        await page.click('#section-save [data-opens=find]');
        await page.click('[data-example=hexerode]');
        await page.waitForSelector('#find-verdict.found');
        await page.waitForSelector('.find-card .thumb.inked');
    },
    shortcuts: (page) => page.keyboard.press('?'),
    share: (page) => page.click('#share'),
    'share with a preview': async (page) => {
        await page.click('#share');
        await page.click('#share-embed > summary');
        await page.waitForSelector('#embed-preview > iframe');
    },
    'QR code enlarged': async (page) => {
        await page.click('#share');
        await page.click('#qr-frame');
        await page.waitForSelector('#qr-large:visible');
    },
    'a symbol traced': async (page) => {
        await tab('rules')(page);
        await page.focus('#axiom');
        await page.keyboard.press('Home');
        await page.keyboard.press('ArrowRight');
        await until(
            async () => /marked in the drawing/.test((await page.textContent('#symbol-note')) ?? ''),
            'the part is marked',
        );
    },
    'refused on the drawing': async (page) => {
        await tab('rules')(page);
        await page.fill('#rules', 'A = F[+A]');
        // The controls tell it as well, where they show it.
        await tab('look')(page);
        await page.waitForSelector('#refusal:visible');
    },
    'nothing in view': async (page) => {
        await page.focus('#drawing');
        for (let press = 0; press < 12; press++) await page.keyboard.press('Shift+ArrowLeft');
        await page.waitForSelector('#nothing-here:visible');
    },
    growth: async (page) => {
        await page.click('#open-playback');
        await page.click('#grow');
        await page.waitForSelector('#grow[aria-pressed=true]');
        await until(async () => (await page.textContent('#play-total')) !== '', 'growth is shown');
        await page.click('#play');
    },
    favourites: async (page) => {
        await tab('save')(page);
        await page.click('#open-favourites');
    },
    'angles in space': async (page) => {
        await tab('rules')(page);
        await page.fill('#rules', 'A(l) -> F(l)[&A(l)][^A(l)]');
        await tab('turtle')(page);
        await page.click('#bends summary');
        await page.waitForSelector('#space:visible');
    },
    string: async (page) => {
        await page.click('#open-reader');
        await page.waitForSelector('#reader:visible');
        await page.focus('#reader-text');
        await page.keyboard.press('ArrowRight');
        await until(async () => ((await page.textContent('#reader-path')) ?? '').length > 3, 'a symbol is chosen');
    },
    playback: async (page) => {
        await page.click('#open-playback');
        await page.waitForSelector('#playback:visible');
    },
};

/**
 * Enters states one after another in an open page, and returns to its drawing after each.
 * @param {Page} page
 * @param {string} hash the address of the drawing, with the axiom and the rules of the tree
 * @param {string[]} names
 * @param {(name: string) => Promise<unknown>} look
 */
export async function inStates(page, hash, names, look) {
    for (const name of names) {
        const enter = STATES[name];
        assert.ok(enter, name);
        await enter(page);
        await look(name);
        await leave(page, hash);
    }
}

/** Closes everything and shows the tree again. @param {Page} page @param {string} hash */
async function leave(page, hash) {
    while (await page.isVisible('dialog[open]')) await page.keyboard.press('Escape');
    if (await page.isVisible('#nothing-here')) await page.click('#nothing-here-fit');
    for (const close of ['#close-reader', '#close-playback']) if (await page.isVisible(close)) await page.click(close);
    if ((await page.inputValue('#rules')) === RULES && (await page.inputValue('#axiom')) === 'A(1)') return;
    await until(async () => {
        // The address of an edit may still be that of the tree, and is set a moment later.
        await page.evaluate((address) => (location.hash = address), hash);
        return (await page.inputValue('#rules')) === RULES && page.isVisible('#stage.inked');
    }, 'the tree is shown again');
}
