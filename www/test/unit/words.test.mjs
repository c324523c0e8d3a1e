import assert from 'node:assert/strict';
import { test } from 'node:test';
import { linesOf } from '../../js/controls/editor.js';
import { stopsOf } from '../../js/controls/dial.js';
import { needsNewScale, scaleAbout, writtenAs } from '../../js/controls/scale.js';
import { even, nearest } from '../../js/controls/slider.js';
import { grouped, plain, readNumber, short, shortText, zoomText } from '../../js/base/numerals.js';
import { carryOver, spansOf } from '../../js/controls/tint.js';
import { dice, randomState } from './random.mjs';

test('counts are shown in full up to nine digits, and shortened beyond', () => {
    assert.equal(grouped('1234567'), '1,234,567');
    assert.deepEqual(short('999999999'), { mantissa: '999,999,999', exponent: null });
    assert.deepEqual(short('1234567890'), { mantissa: '1.23', exponent: 9 });
    assert.deepEqual(short('9996000000'), { mantissa: '1.00', exponent: 10 });
    assert.deepEqual(short(`1235${'0'.repeat(42)}`), { mantissa: '1.24', exponent: 45 });
    assert.equal(shortText(`18${'0'.repeat(23)}`), '1.80\u2009×\u200910²⁴');
});

test('numbers are read as people write them', () => {
    for (const [text, value] of /** @type {[string, number | null][]} */ ([
        ['25,7', 25.7],
        [' 22.5° ', 22.5],
        ['−30', -30],
        ['.5', 0.5],
        ['1e3', 1000],
        ['2 px', 2],
        ['50 %', 50],
        ['', null],
        ['1.2.3', null],
        ['ten', null],
        ['0x10', null],
        ['Infinity', null],
    ])) {
        assert.equal(readNumber(text), value, text);
    }
    assert.equal(plain(0.1 + 0.2), '0.3');
    assert.equal(plain(1e-9), '1e-9');
    assert.equal(zoomText(1), '100\u2009%');
    assert.equal(zoomText(1234), '×1,234');
    assert.equal(zoomText(1.5e6), '×1.5·10⁶');
});

test('sliders offer the values of the table', () => {
    assert.deepEqual(stopsOf('lengthFactor'), even(0, 2, 0.05));
    assert.deepEqual(stopsOf('angleVariation'), [...even(0, 30, 1), ...even(35, 100, 5)]);
    assert.deepEqual(stopsOf('iterations').slice(-9), [95, 100, 120, 150, 200, 300, 500, 700, 1000]);
    assert.deepEqual(stopsOf('exposure'), even(-4, 4, 0.25));
});

test('sliders find the nearest stop', () => {
    assert.deepEqual(even(0, 1, 0.25), [0, 0.25, 0.5, 0.75, 1]);
    assert.equal(nearest([0, 1, 5, 10], 7), 2);
    assert.equal(nearest([0, 1, 5, 10], 1e9), 3);
});

test('runs of equal letters become tinted spans', () => {
    assert.deepEqual(spansOf('pp_mm__bt'), [
        { start: 0, end: 2, tint: 'predecessor' },
        { start: 3, end: 5, tint: 'mark' },
        { start: 7, end: 8, tint: 'bracket' },
        { start: 8, end: 9, tint: 'turn' },
    ]);
    assert.deepEqual(spansOf(''), []);
});

test('an edit carries over the class letters', () => {
    assert.equal(carryOver('k_m_nnn', 'r = 0.9', 'r = 0.95'), 'k_m_nnnn');
    assert.equal(carryOver('k_m_nnn', 'r = 0.9', 'r = 1'), 'k_m__');
    assert.equal(carryOver('k_m_nnn', 'r = 0.9', 'r = 0.'), 'k_m_nn');
    assert.equal(carryOver('k_m_n_k_m_n', 'r = 1\ns = 2', 'r = 13\ns = 2'), 'k_m_nn_k_m_n');
    assert.equal(carryOver('', 'never read', 'new'), '___');
    const roll = dice(11);
    for (let round = 0; round < 300; round++) {
        const [before, after] = [randomState(roll).rules, randomState(roll).rules];
        assert.equal(carryOver('x'.repeat(before.length), before, after).length, after.length);
    }
});

test('scales follow the value', () => {
    const ends = (/** @type {number} */ value) => [scaleAbout(value)[0], scaleAbout(value).at(-1)];
    assert.deepEqual(ends(0.9), [0, 1.8]);
    assert.deepEqual(ends(-0.9), [-1.8, 0]);
    assert.deepEqual(ends(0), [-1, 1]);
    assert.deepEqual(ends(137.5), [0, 275]);
    assert.ok(scaleAbout(0.9).includes(0.9));
    assert.deepEqual(scaleAbout(45), even(0, 90, 1));
    const roll = dice(5);
    for (let round = 0; round < 500; round++) {
        const value = (roll() - 0.5) * 10 ** Math.floor(roll() * 40 - 20);
        const stops = scaleAbout(value);
        assert.ok(stops.length >= 50 && stops.length <= 600, `${value}: ${stops.length}`);
        stops.forEach((stop, at) => assert.ok(at === 0 || stop > /** @type {number} */ (stops[at - 1]), String(value)));
        assert.ok(!needsNewScale(stops, value), String(value));
        assert.ok(
            Math.abs(/** @type {number} */ (stops[nearest(stops, value)]) - value) <= Math.abs(value) / 50,
            String(value),
        );
    }
    for (const value of [5e-324, 1e-300, Number.MAX_VALUE, -Number.MAX_VALUE])
        assert.ok(scaleAbout(value).every(Number.isFinite), String(value));
    assert.ok(
        needsNewScale(scaleAbout(1), 2) &&
            needsNewScale(scaleAbout(1), -0.1) &&
            needsNewScale(scaleAbout(1), 0.01) &&
            !needsNewScale(scaleAbout(1), 0),
    );
});

test('numbers are written in the style of the numbers they replace', () => {
    assert.equal(writtenAs(0.85, '0.9'), '0.85');
    assert.equal(writtenAs(0.85, '.9'), '.85');
    assert.equal(writtenAs(-0.5, '−.9'), '-.5');
    assert.equal(writtenAs(12, '.9'), '12');
});

test('problems are cut at line ends, and a problem without width marks the symbol before it', () => {
    /** @param {string} text @param {number} start @param {number} end */
    const marked = (text, start, end) =>
        linesOf(text, [{ field: 'rules', severity: 'error', message: '', hint: null, fix: null, start, end }]).flatMap(
            (line) => line.marks.map((mark) => line.text.slice(mark.start, mark.end)),
        );
    assert.deepEqual(marked('ab\ncd', 1, 4), ['b\n', 'c']);
    assert.deepEqual(marked('ab\ncd', 5, 5), ['d']);
    assert.deepEqual(marked('ab', 0, 0), ['a']);
    assert.deepEqual(marked('', 0, 0), []);
    assert.deepEqual(marked('ab', 7, 9), []);
    const roll = dice(5);
    for (let round = 0; round < 200; round++) {
        const { rules } = randomState(roll);
        assert.equal(
            linesOf(rules, [])
                .map((line) => line.text)
                .join(''),
            rules,
        );
    }
});
