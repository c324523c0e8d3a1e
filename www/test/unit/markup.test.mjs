import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';

const root = new URL('../../', import.meta.url);
const page = readFileSync(new URL('index.html', root), 'utf8');

test('the page loads nothing from other sites and has no inline script or style', () => {
    assert.doesNotMatch(page, /(src|href)="(https?:)?\/\//);
    assert.doesNotMatch(page, / style=| on[a-z]+=|<style/);
    for (const [, inside] of page.matchAll(/<script[^>]*>([^<]*)</g)) assert.equal(inside, '');
    assert.doesNotMatch(page, /(src|href)="\//);
});

test('ids are unique, and labels and descriptions name elements that exist', () => {
    const ids = [...page.matchAll(/ id="([^"]+)"/g)].map((match) => match[1]);
    assert.equal(new Set(ids).size, ids.length);
    for (const [, list] of page.matchAll(/ (?:for|aria-labelledby|aria-describedby|aria-controls)="([^"]+)"/g)) {
        for (const id of String(list).split(' ')) assert.ok(ids.includes(id), id);
    }
});

test('the page never sets HTML from data', () => {
    for (const name of readdirSync(new URL('js', root), { recursive: true, encoding: 'utf8' })) {
        if (!name.endsWith('.js')) continue;
        assert.doesNotMatch(readFileSync(new URL(`js/${name}`, root), 'utf8'), /innerHTML|outerHTML|insertAdjacentHTML|document\.write|eval\(|new Function/, name);
    }
});
