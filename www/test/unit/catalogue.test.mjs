import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';
import { LANGUAGES } from '../../js/languages.js';
import { collect } from '../words/collect.mjs';
import { plainWords, pseudo } from '../words/pseudo.mjs';

const root = new URL('../../lang/', import.meta.url);
const found = collect();
const catalogues = readdirSync(root).map((name) => ({
    name,
    /** @type {Record<string, string | Record<string, string>>} */
    words: JSON.parse(readFileSync(new URL(`${name}/words.json`, root), 'utf8')),
}));

/** The values that a text has room for, sorted. @param {string} text */
function holes(text) {
    let next = 0;
    const numbers = [...text.matchAll(/\{(\d*)\}/g)].map(([, digits]) => (digits === '' ? next++ : Number(digits)));
    return numbers.sort().join();
}

/** The code in a text, sorted. @param {string} text */
const code = (text) =>
    [...text.matchAll(/`[^`]*`/g)]
        .map(([part]) => part.replace(/\{\d*\}/g, '{}'))
        .sort()
        .join(' ');

test('the list of languages is that of the folders', () => {
    assert.deepEqual(Object.keys(LANGUAGES).sort(), ['en', ...catalogues.map(({ name }) => name)].sort());
    for (const { name, words } of catalogues) assert.equal(words.English, LANGUAGES[/** @type {'de'} */ (name)]);
});

for (const { name, words } of catalogues) {
    test(`${name} has all texts and no others`, () => {
        const missing = [...found.keys()].filter((text) => !words[text]);
        assert.deepEqual(missing, [], 'missing: run node test/words/update.mjs');
        const unused = Object.keys(words).filter((text) => !found.has(text));
        assert.deepEqual(unused, [], 'unused');
    });

    test(`${name} has the values, the code and the forms of each text`, () => {
        const categories = new Intl.PluralRules(name).resolvedOptions().pluralCategories;
        /** @type {string[]} */
        const wrong = [];
        for (const [text, { isCounted }] of found) {
            const entry = words[text];
            if (!entry) continue;
            if (isCounted !== (typeof entry === 'object')) wrong.push(`${text}: forms`);
            const forms = typeof entry === 'object' ? entry : { other: entry };
            if (isCounted && !('one' in forms && 'other' in forms)) wrong.push(`${text}: forms`);
            for (const [category, form] of Object.entries(forms)) {
                if (isCounted && !categories.includes(/** @type {'one'} */ (category)))
                    wrong.push(`${text}: ${category}`);
                if (holes(form) !== holes(text)) wrong.push(`${text}: values of ${form}`);
                if (code(form) !== code(text)) wrong.push(`${text}: code in ${form}`);
            }
        }
        assert.deepEqual(wrong, []);
    });
}

test('texts are found in scripts, in the core, in markup, tables and files', () => {
    const places = [...found.values()].map(({ place }) => place);
    for (const start of [
        'www/js/',
        'crates/lsystem-syntax/',
        'www/index.html',
        'www/js/tables.js',
        'data_in/',
        'www/exercises.json',
    ])
        assert.ok(
            places.some((place) => place.startsWith(start)),
            start,
        );
    assert.ok([...found.values()].some(({ isCounted }) => isCounted));
});

test('plain English words stand out of the language that no one speaks', () => {
    const words = pseudo(found);
    for (const [text, entry] of Object.entries(words)) {
        if (text.includes('`') || typeof entry !== 'string') continue;
        assert.deepEqual(plainWords(entry.replace(/[-a-z0-9_.]+\.[a-z]+|[A-Z]\w*[A-Z]\w*/g, '')), [], entry);
    }
    assert.deepEqual(plainWords('Nöw one is plain, F-F+ 12 pïxëls'), ['one', 'plain']);
});
