/** The page's states that differ in what can be seen and reached. */

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
        await page.waitForSelector('.thumb.inked');
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
        await tab('rules')(page);
        await page.click('#section-rules [data-opens=find]');
        await until(async () => (await page.locator('#find-examples .thumb.inked').count()) === 4, 'four pictures');
    },
    'rules found': async (page) => {
        await tab('rules')(page);
        await page.click('#section-rules [data-opens=find]');
        await page.click('[data-example=hexerode]');
        await page.waitForSelector('#find-verdict.found', { timeout: 90_000 });
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
