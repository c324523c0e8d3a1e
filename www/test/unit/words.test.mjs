import assert from 'node:assert/strict';
import { test } from 'node:test';
import { linesOf } from '../../js/controls/editor.js';
import { even, nearest } from '../../js/controls/slider.js';
import { grouped, plain, readNumber, short, shortText, zoomText } from '../../js/numerals.js';
import { tints } from '../../js/tint.js';
import { dice, randomState } from './random.mjs';

test('counts are whole up to nine digits and shortened beyond', () => {
    assert.equal(grouped('1234567'), '1,234,567');
    assert.deepEqual(short('999999999'), { mantissa: '999,999,999', exponent: null });
    assert.deepEqual(short('1234567890'), { mantissa: '1.23', exponent: 9 });
    assert.deepEqual(short('9996000000'), { mantissa: '1.00', exponent: 10 });
    assert.deepEqual(short(`1235${'0'.repeat(42)}`), { mantissa: '1.24', exponent: 45 });
    assert.equal(shortText(`18${'0'.repeat(23)}`), '1.80\u2009×\u200910²⁴');
});

test('numbers are read as people write them', () => {
    for (const [text, value] of /** @type {[string, number | null][]} */ ([['25,7', 25.7], [' 22.5° ', 22.5], ['−30', -30], ['.5', 0.5], ['1e3', 1000], ['2 px', 2], ['', null], ['1.2.3', null], ['ten', null], ['0x10', null], ['Infinity', null]])) {
        assert.equal(readNumber(text), value, text);
    }
    assert.equal(plain(0.1 + 0.2), '0.3');
    assert.equal(plain(1e-9), '1e-9');
    assert.equal(zoomText(1), '100\u2009%');
    assert.equal(zoomText(1234), '×1,234');
    assert.equal(zoomText(1.5e6), '×1.5·10⁶');
});

test('sliders find the nearest stop', () => {
    assert.deepEqual(even(0, 1, 0.25), [0, 0.25, 0.5, 0.75, 1]);
    assert.equal(nearest([0, 1, 5, 10], 7), 2);
    assert.equal(nearest([0, 1, 5, 10], 1e9), 3);
});

test('tints are in order, within the line, and never overlap', () => {
    const roll = dice(11);
    for (let round = 0; round < 300; round++) {
        for (const line of randomState(roll).rules.split('\n')) {
            for (const kind of /** @type {const} */ (['rules', 'axiom', 'overrides'])) {
                let last = 0;
                for (const { start, end } of tints(line, kind)) {
                    assert.ok(start >= last && end > start && end <= line.length);
                    last = end;
                }
            }
        }
    }
});

test('tints tell the parts of a production', () => {
    /** @param {string} line */
    const parts = (line) => tints(line, 'rules').map(({ start, end, tint }) => `${tint}:${line.slice(start, end).trim()}`);
    assert.deepEqual(parts('// a comment'), ['comment:// a comment']);
    assert.deepEqual(parts('F -> F[+F] : 0.5'), ['name:F', 'arrow:->', 'bracket:[', 'turn:+', 'bracket:]', 'weight:: 0.5']);
});

test('mistakes are cut at line ends, and one without width marks the symbol before it', () => {
    /** @param {string} text @param {number} start @param {number} end */
    const marked = (text, start, end) => linesOf(text, [{ field: 'rules', severity: 'error', message: '', hint: null, start, end }]).flatMap((line) => line.marks.map((mark) => line.text.slice(mark.start, mark.end)));
    assert.deepEqual(marked('ab\ncd', 1, 4), ['b\n', 'c']);
    assert.deepEqual(marked('ab\ncd', 5, 5), ['d']);
    assert.deepEqual(marked('ab', 0, 0), ['a']);
    assert.deepEqual(marked('', 0, 0), []);
    assert.deepEqual(marked('ab', 7, 9), []);
    const roll = dice(5);
    for (let round = 0; round < 200; round++) {
        const { rules } = randomState(roll);
        assert.equal(linesOf(rules, []).map((line) => line.text).join(''), rules);
    }
});
