import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';

const root = new URL('../../', import.meta.url);
/** @param {string} name */
const read = (name) => readFileSync(new URL(name, root), 'utf8');
const files = readdirSync(new URL('js', root), { recursive: true, encoding: 'utf8' }).map((name) => `js/${name}`);
/** The first screen, and the elements of parts that load late. */
const markup = ['index.html', ...files.filter((name) => name.endsWith('.html'))].map(
    (name) => /** @type {const} */ ([name, read(name)]),
);
const whole = markup.map(([, text]) => text).join('');

test('the page loads nothing from other sites and has no inline script or style', () => {
    assert.ok(markup.length > 10);
    assert.doesNotMatch(whole, /(src|href)="(https?:)?\/\//);
    assert.doesNotMatch(whole, / style=| on[a-z]+=|<style/);
    for (const [, inside] of whole.matchAll(/<script[^>]*>([^<]*)</g)) assert.equal(inside, '');
    assert.doesNotMatch(whole, /(src|href)="\//);
});

test('ids are unique, and labels and descriptions name elements that exist', () => {
    const idsOf = (/** @type {string} */ text) => [...text.matchAll(/ id="([^"]+)"/g)].map((match) => match[1]);
    const ids = idsOf(whole);
    assert.equal(new Set(ids).size, ids.length);
    for (const [name, text] of markup) {
        // Late elements may name their own and those of the first screen, which cannot name late ones.
        const known = [...idsOf(text), ...idsOf(read('index.html'))];
        for (const [, list] of text.matchAll(/ (?:for|aria-labelledby|aria-describedby|aria-controls)="([^"]+)"/g)) {
            for (const id of String(list).split(' ')) assert.ok(known.includes(id), `${name}: ${id}`);
        }
    }
});

test('every opener names a part, and every icon exists', () => {
    const parts = [...read('js/parts.js').matchAll(/^ {4}(\w+): create/gm)].map((match) => match[1]);
    const named = [...whole.matchAll(/ data-opens="([^"]+)"/g)].map((match) => match[1]);
    assert.ok(parts.length > 10 && named.length > 10);
    for (const name of named) assert.ok(parts.includes(name), name);
    for (const [, icon] of whole.matchAll(/<use href="#([^"]+)"/g))
        assert.ok(whole.includes(`<symbol id="${icon}"`), icon);
});

test('the page sets HTML from its own files, never from data', () => {
    for (const name of files) {
        if (!name.endsWith('.js')) continue;
        const text = read(name);
        assert.doesNotMatch(text, /innerHTML|outerHTML|insertAdjacentHTML|document\.write|eval\(|new Function/, name);
        // One function parses, and it gets imported files only.
        if (name !== 'js/base/late.js') assert.doesNotMatch(text, /DOMParser|parseHTML|createContextualFragment/, name);
        for (const [, first] of text.matchAll(/(?<!function )addElements\((\w*)/g))
            assert.match(text, new RegExp(`^import ${first} from '\\./[\\w-]+\\.html';`, 'm'), name);
    }
});
