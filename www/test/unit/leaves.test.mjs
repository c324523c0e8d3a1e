import assert from 'node:assert/strict';
import { test } from 'node:test';
import { withLeaves } from '../../js/state/leaves.js';
import { DEFAULTS } from '../../js/state/state.js';

/** @param {Partial<typeof DEFAULTS>} state */
const given = (state) => ({ ...DEFAULTS, colourBy: /** @type {const} */ ('level'), ...state });

test('leaves grow at buds, or else at the ends of branches', () => {
    const bud = given({ axiom: 'X', rules: 'X -> F[+X]X\nF -> FF' });
    assert.deepEqual(withLeaves(bud, 'oak'), { overrides: 'X: leaf oak 1.2' });
    const plain = given({ axiom: 'F', rules: 'F -> F[+F]F[-F]' });
    assert.deepEqual(withLeaves(plain, 'heart'), { rules: 'F -> F[+FL]F[-FL]', overrides: 'L: leaf heart 1.2' });
    const alone = given({ axiom: 'F', rules: 'F -> F+F' });
    assert.deepEqual(withLeaves(alone, 'heart'), { axiom: 'FL', overrides: 'L: leaf heart 1.2' });
    const taken = given({ axiom: 'FL', rules: 'F -> F[+F]', overrides: 'L: move' });
    assert.deepEqual(withLeaves(taken, 'lance'), { rules: 'F -> F[+FK]', overrides: 'L: move\nK: leaf lance 1.2' });
});

test('another press changes the leaves, and a drawing of one colour gets green ones', () => {
    const leafy = given({ axiom: 'F', rules: 'F -> F[+FL]', overrides: 'G: move\nL: leaf heart 1.2' });
    assert.deepEqual(withLeaves(leafy, 'needle'), { overrides: 'G: move\nL: leaf needle 1.2' });
    const plain = given({ axiom: 'X', rules: 'X -> F[+X]X', colourBy: 'single', palette: ['#553311'] });
    assert.deepEqual(withLeaves(plain, 'petal'), {
        palette: ['#553311', '#4f8a34'],
        overrides: 'X: colour 1, leaf petal 1.2',
    });
});
