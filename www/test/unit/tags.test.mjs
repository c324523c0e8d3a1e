import assert from 'node:assert/strict';
import { test } from 'node:test';
import { choose, count, makingOf, tagsOf } from '../../js/tags.js';

const PLANT = { kinds: ['stochastic', 'parametric'], solid: true, memoised: false, blocks: 40_000 };
const KOCH = { kinds: ['deterministic'], solid: false, memoised: true, blocks: 5 };

test('systems have the tags of their kinds', () => {
    assert.deepEqual(tagsOf(PLANT), ['stochastic', 'parametric', '3D', 'expanded in full']);
    assert.deepEqual(tagsOf(KOCH), ['deterministic', '2D', 'reusable parts']);
    assert.equal(makingOf(PLANT), 'expanded in full');
    assert.equal(makingOf(KOCH), '5 reusable parts');
    assert.equal(makingOf({ ...KOCH, blocks: 1 }), 'one part');
});

test('tags can be combined unless they exclude each other', () => {
    const chosen = choose(choose(new Set(), '2D'), 'stochastic');
    assert.deepEqual([...choose(chosen, '3D')], ['stochastic', '3D']);
    assert.deepEqual([...choose(chosen, '2D')], ['stochastic']);
    assert.deepEqual([...chosen], ['2D', 'stochastic']);
    const tagged = [PLANT, KOCH].map(tagsOf);
    assert.equal(count(tagged, new Set()), 2);
    assert.equal(count(tagged, new Set(['3D', 'stochastic'])), 1);
    assert.equal(count(tagged, new Set(['2D', 'stochastic'])), 0);
});
