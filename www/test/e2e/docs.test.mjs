/** The documents as pages: without errors and barriers, with drawings that draw and links that lead somewhere. */

import assert from 'node:assert/strict';
import { access, readFile, readdir } from 'node:fs/promises';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { LANGUAGES } from '../../js/languages.js';
import { sampled, some } from '../effort.mjs';
import { COLOURS, violations } from './axe.mjs';
import { ADDRESS, DESKTOP, PHONE, close, picture, until, withPage } from './browser.mjs';

after(close);

const SITE = new URL('../../../dist/', import.meta.url);
const DOCS = new URL('docs/', SITE);
const ALL = (await readdir(DOCS)).filter((name) => name.endsWith('.html')).sort();
/** Those in English; the others have the same form. */
const NAMES = ALL.filter((name) => name.split('.').length === 2);

/** @param {string} name */
const at = (name) => ({ address: `${ADDRESS}docs/${name}`, also: ADDRESS, drawing: null });

test('the documents for readers are pages, and no others', () => {
    assert.deepEqual(NAMES, [
        'about.html',
        'access.html',
        'assistants.html',
        'books.html',
        'classroom.html',
        'embedding.html',
        'exercises.html',
        'films.html',
        'find.html',
        'growth.html',
        'hosting.html',
        'imports.html',
        'lesson.html',
        'links.html',
        'marking.html',
        'meshes.html',
        'notation.html',
        'notebooks.html',
        'papers.html',
        'plotting.html',
        'scale.html',
        'security.html',
        'sound.html',
    ]);
});

test('each language has all documents', () => {
    for (const language of Object.keys(LANGUAGES).filter((name) => name !== 'en')) {
        const own = ALL.filter((name) => name.endsWith(`.${language}.html`));
        assert.deepEqual(
            own,
            NAMES.map((name) => name.replace('.html', `.${language}.html`)),
        );
    }
});

/** The documents that the line of links does not name. */
const UNLISTED = [
    'access.html',
    'assistants.html',
    'books.html',
    'hosting.html',
    'notebooks.html',
    'classroom.html',
    'security.html',
    'imports.html',
    'growth.html',
    'films.html',
    'find.html',
    'marking.html',
    'meshes.html',
    'papers.html',
    'plotting.html',
    'scale.html',
    'sound.html',
];

/** @typedef {import('playwright-core').Page} Page */

/** The violations of a document. A table of two kinds of messages has no name for its second column. @param {Page} page @param {string[]} [rules] */
const found = async (page, rules) =>
    (await violations(page, rules)).filter(({ id }) => id !== 'empty-table-header').map(({ words }) => words);

/** @param {Page} page */
const scrollsSideways = (page) =>
    page.evaluate(() => document.documentElement.scrollWidth > document.documentElement.clientWidth);

// A document has the same elements and layout in both schemes, so the dark one is looked at for its colours.
for (const [size, options, narrow] of some(
    /** @type {[string, import('playwright-core').BrowserContextOptions, boolean][]} */ ([
        ['desktop, also dark, and a narrow window', DESKTOP, true],
        ['phone, also dark', PHONE, false],
    ]),
)) {
    test(`axe-core finds no violation, and nothing but tables and code scrolls sideways: ${size}`, () =>
        withPage(
            { ...at(String(NAMES[0])), also: ADDRESS, options: { ...options, colorScheme: 'light' } },
            async (page) => {
                for (const name of sampled(NAMES, 6)) {
                    await page.goto(`${ADDRESS}docs/${name}`);
                    assert.deepEqual(await found(page), [], name);
                    assert.ok(!(await scrollsSideways(page)), name);
                    assert.equal(await page.locator('.line [aria-current]').count(), UNLISTED.includes(name) ? 0 : 1);
                    assert.ok(((await page.getAttribute('meta[name=description]', 'content')) ?? '').length > 20);
                    await page.emulateMedia({ colorScheme: 'dark' });
                    assert.deepEqual(await found(page, COLOURS), [], `${name}, dark`);
                    await page.emulateMedia({ colorScheme: 'light' });
                    if (!narrow) continue;
                    await page.setViewportSize({ width: 320, height: 256 });
                    assert.deepEqual(await found(page), [], `${name}, narrow`);
                    assert.ok(!(await scrollsSideways(page)), `${name}, narrow`);
                    await page.setViewportSize(DESKTOP.viewport);
                }
            },
        ));
}

test('the lesson has five drawings that draw and follow its words', () =>
    withPage(at('lesson.html'), async (page) => {
        const frames = page.locator('iframe');
        assert.equal(await frames.count(), 5);
        for (let index = 0; index < 5; index++) {
            const place = frames.nth(index);
            await place.scrollIntoViewIfNeeded();
            const frame = await (await place.elementHandle())?.contentFrame();
            assert.ok(frame);
            await frame.waitForSelector('#stage.inked');
            assert.ok((await picture(frame)).ink > 0.001, `drawing ${index + 1}`);
            assert.equal(await frame.locator('#mistake:visible').count(), 0);
            assert.equal(await place.getAttribute('title'), `Drawing: ${await frame.textContent('#caption-title')}`);
        }
        // The numbers that the first step names.
        const first = page.frameLocator('iframe').first();
        await frames.first().scrollIntoViewIfNeeded();
        for (const [n, segments] of [
            ['1', '5 segments'],
            ['2', '25 segments'],
            ['5', '3,125 segments'],
        ]) {
            await first.locator('#iterations').fill(String(n));
            await until(
                async () => ((await first.locator('#caption-text').textContent()) ?? '').includes(`, ${segments}`),
                `n = ${n} has ${segments}`,
            );
        }
    }));

test('the rules in the lesson’s words are rules', () =>
    withPage(at('lesson.html'), async (page) => {
        const rules = (await page.locator('main code').allTextContents()).filter((text) => text.includes('->'));
        assert.ok(rules.length >= 6, rules.join('\n'));
        const koch = page.frameLocator('iframe').nth(2);
        await page.locator('iframe').nth(2).scrollIntoViewIfNeeded();
        await koch.locator('#stage.inked').waitFor();
        for (const rule of rules) {
            await koch.locator('#rules').fill(`${rule}\nG = = 1`);
            // The mistake in the next line shows that the text has been read.
            await until(
                async () => (await koch.locator('#rules-problems .error').count()) === 1,
                `one mistake below ${rule}`,
            );
        }
    }));

test('every link, picture and frame of every page leads somewhere', async () => {
    /** The ids of a page. @type {Map<string, Set<string>>} */
    const ids = new Map();
    const idsOf = async (/** @type {string} */ file) => {
        const known =
            ids.get(file) ??
            new Set([...(await readFile(file, 'utf8')).matchAll(/ id="([^"]*)"/g)].map(([, id]) => String(id)));
        ids.set(file, known);
        return known;
    };
    const pages = [
        ...ALL.map((name) => new URL(name, DOCS)),
        new URL('index.html', SITE),
        new URL('course.html', SITE),
    ];
    for (const page of pages) {
        const text = await readFile(page, 'utf8');
        for (const [, , link] of text.matchAll(/ (href|src)="([^"]*)"/g)) {
            const url = String(link).replaceAll('&amp;', '&');
            if (/^https?:/.test(url)) continue;
            assert.ok(!url.startsWith('/') && !/^[a-z]+:/i.test(url), `${url} in ${page.href} is relative`);
            const target = new URL(url, page);
            assert.ok(target.href.startsWith(SITE.href), `${url} in ${page.href} stays within the site`);
            const { hash } = target;
            target.hash = '';
            const file = fileURLToPath(target.href.endsWith('/') ? new URL('index.html', target) : target);
            await access(file);
            if (hash.length > 1 && !hash.startsWith('#v='))
                assert.ok((await idsOf(file)).has(decodeURIComponent(hash.slice(1))), `${url} in ${page.href}`);
        }
    }
});

test('pages have no scripts or styles of their own, and links to other sites do not give the page away', async () => {
    for (const name of NAMES) {
        const text = await readFile(new URL(name, DOCS), 'utf8');
        for (const [tag] of text.matchAll(/<[^>]*>/g)) {
            assert.doesNotMatch(tag, /^<(script|style)| (style|on[a-z]+)=/i, name);
            if (/^<a .*href="https?:/.test(tag)) assert.match(tag, / rel="noopener"/, name);
        }
    }
});

test('the controls end with links to the documents, which open in a new tab', async () => {
    await withPage({ hash: '#v=1&axiom=F&rules=F%20-%3E%20FF&n=2' }, async (page) => {
        const links = page.locator('.foot > a');
        assert.deepEqual(await links.allTextContents(), ['Lesson', 'Notation', 'About']);
        for (const link of await links.all()) {
            const [opened] = await Promise.all([page.waitForEvent('popup'), link.click()]);
            await opened.waitForLoadState();
            const isLesson = (await link.textContent()) === 'Lesson';
            if (isLesson) assert.match(await opened.title(), /a lesson$/);
            else assert.equal(await opened.textContent('.line [aria-current]'), await link.textContent());
            await opened.close();
        }
    });
    await withPage({ options: PHONE }, async (page) => {
        assert.ok(await page.isVisible('.foot'));
        // Folded controls have no links.
        await page.click('#tab-rules');
        assert.equal(await page.isVisible('.foot'), false);
    });
});

for (const name of ['course.html', 'docs/lesson.html'])
    test(`a page of its own leads home: ${name}`, () =>
        withPage({ address: new URL(name, ADDRESS).href, also: ADDRESS, drawing: null }, async (page) => {
            const home = page.locator('.home');
            assert.ok(await home.isVisible());
            assert.equal(new URL((await home.getAttribute('href')) ?? '', page.url()).href, new URL('.', ADDRESS).href);
        }));

test('the lesson in twelve steps begins with the introduction, which leads to it', () =>
    withPage({ address: new URL('course.html', ADDRESS).href, also: ADDRESS, drawing: null }, async (page) => {
        await page.click('a[href="docs/lesson.html"]');
        await page.click('a[href="../course.html"] >> nth=0');
        assert.match(await page.title(), /a lesson$/);
    }));
