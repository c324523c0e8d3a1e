/** The page in other languages: all words are told in them, and they fit. */

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { sampled } from '../effort.mjs';
import { collect } from '../words/collect.mjs';
import { plainWords, pseudo } from '../words/pseudo.mjs';
import { ADDRESS, DESKTOP, PHONE, close, until, withPage } from './browser.mjs';
import { STATES, TREE, inStates, tab } from './states.mjs';

after(close);

/** @typedef {import('playwright-core').Page} Page */

/** A title without vowels, which is the reader's own. */
const OWN = TREE.replace('title=Tree', 'title=Krk');
const FOUND = collect();
const NOBODYS = pseudo(FOUND);

/** Gives the page the language that no one speaks, in place of German. @param {Page} page */
const nobodys = (page) => page.route('**/lang/de/words.json', (route) => route.fulfill({ json: NOBODYS }));

/** Names of programs, formats and people, and what is typed: not translated. */
const NAMES = /\b(L[-‑\u2011]systems?|SVG|PNG|JSON|Ctrl|Shift|Alt|Esc|Tab|Space|Deutsch|English|Français)\b/g;

/** The English words that a person can see or hear. @param {Page} page */
async function english(page) {
    const texts = await page.evaluate(() => {
        const same = 'script, style, svg, code, kbd, pre, textarea, input, [translate="no"], [lang]:not(html), cite';
        /** @type {string[]} */
        const found = [];
        for (const element of document.body.querySelectorAll('*')) {
            if (element.closest(same) || !element.checkVisibility()) continue;
            for (const node of element.childNodes)
                if (node.nodeType === Node.TEXT_NODE && node.nodeValue?.trim()) found.push(node.nodeValue.trim());
            for (const name of ['title', 'aria-label', 'placeholder', 'alt']) {
                const text = element.getAttribute(name);
                if (text) found.push(text);
            }
        }
        return found;
    });
    const plain = texts.map((text) => [text, plainWords(text.replace(/`[^`]*`|\S+\.json/g, '').replace(NAMES, ''))]);
    return plain.filter(([, words]) => words?.length).map(([text]) => text);
}

/** The words that stand out of their place, by more than rounding. @param {Page} page */
const tooWide = (page) =>
    page.evaluate(() => {
        const found = [
            ...document.querySelectorAll('button, label, summary, h2, h3, [role=tab], .note, dt, legend, th'),
        ];
        const wide = found.filter((element) => {
            if (!(element instanceof HTMLElement) || !element.checkVisibility({ visibilityProperty: true }))
                return false;
            const { left, right, width } = element.getBoundingClientRect();
            const cut =
                getComputedStyle(element).overflowX !== 'visible' && element.scrollWidth > element.clientWidth + 1;
            const scrolled = element.closest('.symbol-keys, .chips, pre, table');
            return (
                width > 1 &&
                ((cut && !element.closest('.unseen')) || ((right > innerWidth + 1 || left < -1) && !scrolled))
            );
        });
        return wide.map(
            (element) =>
                `${element.tagName} ${element.id || element.className}: ${element.textContent?.trim().slice(0, 60)}`,
        );
    });

/** States that are reached by English words, or that only draw. */
const ENGLISH = new Set(['a symbol traced', 'gallery with cards without pictures', 'rules found']);

/**
 * Enters the states of the page, and lists what `look` finds there.
 * @param {string} language
 * @param {(page: Page) => Promise<unknown[]>} look
 * @param {Pick<import('./browser.mjs').How, 'options' | 'before'>} how
 */
async function inAllStates(language, look, how) {
    /** @type {Record<string, unknown>} */
    const all = {};
    const names = Object.keys(STATES).filter((name) => !ENGLISH.has(name));
    const chosen = look === english ? sampled(names, 2) : sampled(names, 3, language === 'de' ? 0 : 1);
    await withPage({ address: `${ADDRESS}?lang=${language}`, also: ADDRESS, hash: OWN, ...how }, (page) =>
        inStates(page, OWN, chosen, async (name) => {
            const found = await look(page);
            if (found.length) all[name] = found;
        }),
    );
    return all;
}

test('no English word is left in a language that no one speaks', async () => {
    assert.deepEqual(await inAllStates('de', english, { before: nobodys }), {});
});

for (const [language, words] of /** @type {const} */ ([
    ['de', { rules: 'Regeln', mistake: /wird nie geschlossen/, symbols: '1.234,5' }],
    ['fr', { rules: 'Règles', mistake: /jamais fermée/, symbols: '1\u202f234,5' }],
])) {
    test(`the page, its mistakes and its numbers are in ${language}; links and rules are not`, () =>
        withPage({ address: `${ADDRESS}?lang=${language}`, also: ADDRESS, hash: OWN }, async (page) => {
            assert.equal(await page.getAttribute('html', 'lang'), language);
            assert.equal(await page.inputValue('#language'), language);
            assert.match((await page.textContent('label[for=rules]')) ?? '', new RegExp(words.rules));
            await page.fill('#rules', 'A(l) -> F(l');
            await page.waitForSelector('#rules-problems .error');
            assert.match((await page.textContent('#rules-problems')) ?? '', words.mistake);
            await page.fill('#rules', 'A(l) -> F(l*0.5)A(l*0.5)');
            await until(async () => /l\*0\.5/.test(decodeURIComponent(page.url())), 'the link has points');
            // The choice is kept, and the system with it.
            await page.selectOption('#language', 'en');
            await page.waitForSelector('html[lang=en] #stage.inked');
            assert.match(await page.inputValue('#rules'), /0\.5/);
            assert.equal(await page.textContent('label[for=rules]'), 'Rules');
        }));

    test(`words fit on a phone in ${language}`, async () => {
        assert.deepEqual(await inAllStates(language, tooWide, { options: PHONE }), {});
    });
}

test('the built catalogues have all texts of the page, and no texts of the program', async () => {
    const words = async (/** @type {string} */ name) =>
        JSON.parse(await readFile(new URL(`../../../dist/lang/de/${name}.json`, import.meta.url), 'utf8'));
    const built = { ...(await words('words')), ...(await words('programs')) };
    const missing = [...FOUND].filter(([text, { place }]) => /^(www|data_in)\//.test(place) && !(text in built));
    assert.deepEqual(missing, []);
    assert.ok(!('Print the derived string' in built));
});

test('frames of the lesson have the language of the reader', () =>
    withPage(
        { address: `${ADDRESS}course.html`, also: ADDRESS, drawing: null, options: { ...DESKTOP, locale: 'de-DE' } },
        async (page) => {
            await page.waitForSelector('html[lang=de]');
            await page.locator('.places a').nth(1).click();
            const frame = page.frameLocator('.step.now iframe');
            await frame.locator('html[lang=de] #mark-percent:not(:empty)').waitFor();
            assert.match((await frame.locator('#ask-hint').textContent()) ?? '', /^Hinweis/);
        },
    ));

test('the lesson and the documents have the language of the page', () =>
    withPage(
        { address: `${ADDRESS}course.html?lang=fr`, also: ADDRESS, drawing: null, options: DESKTOP },
        async (page) => {
            await page.waitForSelector('html[lang=fr]');
            assert.match((await page.title()) ?? '', /leçon/i);
            await page.goto(`${ADDRESS}?lang=fr`);
            await page.waitForSelector('#stage.inked');
            await tab('save')(page);
            const document = await page.getAttribute('.foot a[href^="docs/notation"]', 'href');
            assert.equal(document, 'docs/notation.fr.html');
            await page.goto(`${ADDRESS}${document}`);
            assert.equal(await page.getAttribute('html', 'lang'), 'fr');
        },
    ));
