import assert from 'node:assert/strict';
import { test } from 'node:test';
import { at, duration } from '../../js/motion/growing.js';
import { DEFAULTS, definitionOf } from '../../js/state/state.js';

test('generations are a continuous value', () => {
    const definition = { ...definitionOf(DEFAULTS), iterations: 7 };
    const found = [0, 0.25, 1, 2.5, 7]
        .map((grown) => at(definition, grown))
        .map(({ iterations, growth }) => [iterations, growth]);
    assert.deepEqual(found, [
        [0, 1],
        [1, 0.25],
        [1, 1],
        [3, 0.5],
        [7, 1],
    ]);
});

test('growth takes a few seconds for any number of iterations', () => {
    for (const iterations of [0, 1, 7, 1000]) assert.ok(duration(iterations) >= 3 && duration(iterations) <= 14);
});
