import assert from 'node:assert/strict';
import test from 'node:test';
import { valueOf } from '../../js/controls/arithmetic.js';

test('number fields take arithmetic', () => {
    for (const [text, value] of /** @type {[string, number | null][]} */ ([
        ['360/7', 360 / 7],
        ['22.5', 22.5],
        ['-1', -1],
        ['2*(3+4)-1', 13],
        ['2^3^2', 512],
        ['-2^2', -4],
        ['180 − 36', 144],
        ['3 × 30', 90],
        ['1e3/4', 250],
        ['.5+.5', 1],
        ['2--3', 5],
        ['', null],
        ['1/0', null],
        ['2+', null],
        ['(1', null],
        ['1)', null],
        ['a', null],
        ['1 2', null],
        ['1..2', null],
        ['('.repeat(300), null],
    ]))
        assert.equal(valueOf(text), value, text);
});
