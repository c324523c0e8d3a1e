import assert from 'node:assert/strict';
import test from 'node:test';
import { withShape } from '../../js/dialogs/shape-line.js';

test('a shape is the first line of the rules, with a new name', () => {
    assert.deepEqual(withShape('F -> FF', 'ball(0, 0, 0, 1)'), ['shape form = ball(0, 0, 0, 1)\nF -> FF', 'form']);
    const [rules] = withShape('', 'ball(0, 0, 0, 1)');
    assert.deepEqual(withShape(rules, 'ball(0, 0, 0, 2)')[1], 'form2');
    // Names that only begin alike are other names.
    assert.equal(withShape('shape former = ball(0, 0, 0, 1)', 'ball(0, 0, 0, 2)')[1], 'form');
});
