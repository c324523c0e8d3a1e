import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { FRESH, leavesIn, missingFrom, numbersOf, withCurve } from '../../js/curves/leaf.js';

const LEAF = numbersOf(FRESH);

test('a leaf is read as it is written', () => {
    const surfaces = `p: 1 2 3\n l : ${LEAF.replaceAll(' ', ', ')}\r\nm: ${LEAF}`;
    const [leaf, second, ...others] = leavesIn(surfaces);
    assert.ok(leaf && second);
    assert.deepEqual([leaf.name, second.name, others], ['l', 'm', []]);
    assert.equal(surfaces.slice(second.start, second.end), LEAF);
    assert.equal(surfaces.slice(leaf.start, leaf.end), LEAF.replaceAll(' ', ', '));
    const near = (/** @type {number} */ a, /** @type {number} */ b) => assert.ok(Math.abs(a - b) < 1e-5, `${a} ${b}`);
    leaf.curves.forEach((curve, part) => {
        curve.forEach((point, at) => {
            point.forEach((c, axis) => {
                near(c, FRESH[part]?.[at]?.[axis] ?? Number.NaN);
            });
        });
    });
});

test('the control points are rows across the midrib, the left margin first', () => {
    const numbers = LEAF.split(' ').map(Number);
    assert.equal(numbers.length, 48);
    assert.deepEqual(
        numbers.slice(12, 24),
        [0.3, 0.4, 0.08, 0.3, 0.133333, -0.04, 0.3, -0.133333, -0.04, 0.3, -0.4, 0.08],
    );
});

test('a change of one curve moves the others along the midrib only', () => {
    const points = (FRESH[1] ?? []).map(([x, y], at) => /** @type {[number, number]} */ ([at === 1 ? 0.5 : x, y - 1]));
    const [outline, midrib, margins] = withCurve(FRESH, 1, points);
    assert.deepEqual(midrib, points);
    assert.deepEqual(
        outline,
        FRESH[0]?.map(([x, y], at) => [at === 1 ? 0.5 : x, y]),
    );
    assert.deepEqual(
        margins,
        FRESH[2]?.map(([x, y], at) => [at === 1 ? 0.5 : x, y]),
    );
});

test('the petal of the tulips is a leaf, and other surfaces are left alone', () => {
    const { surfaces } = JSON.parse(
        readFileSync(new URL('../../../data_in/garden/tulips.json', import.meta.url), 'utf8'),
    ).turtle;
    // Their leaves have two patches.
    assert.deepEqual(
        leavesIn(surfaces).map(({ name, curves }) => [name, curves[1]?.[1]]),
        [['p', [0.25, -0.438]]],
    );
    const skew = LEAF.split(' ').map((number, at) => (at === 13 ? '0.7' : number));
    const wrong = [skew.join(' '), LEAF.replace('0.3', 'x'), `${LEAF} ${LEAF}`, LEAF.split(' ').reverse().join(' ')];
    for (const numbers of wrong) assert.deepEqual(leavesIn(`l: ${numbers}`), []);
});

test('surfaces that custom symbols draw and nobody made', () => {
    assert.deepEqual(missingFrom('K: surface l 2\nM: open tube, surface p\nN: surface l', 'p: 1'), ['l']);
    assert.deepEqual(missingFrom('K: draw 5', ''), []);
});
