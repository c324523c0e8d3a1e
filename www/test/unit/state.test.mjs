import assert from 'node:assert/strict';
import { test } from 'node:test';
import { DEFAULTS, FIELDS, clean, merged, problemOf, sameSystem } from '../../js/state/state.js';

test('defaults are valid and unchanged by cleaning', () => {
    assert.deepEqual(clean({}), DEFAULTS);
    assert.deepEqual(clean(DEFAULTS), DEFAULTS);
});

test('a value out of range becomes the nearest valid value', () => {
    const state = clean({
        iterations: 1e9,
        seed: -5,
        step: 0,
        minWidth: 1e9,
        angle: 25.7,
        view: { x: 0, y: 9e99, zoom: 1e99 },
    });
    assert.equal(state.iterations, 1000);
    assert.equal(state.seed, 0);
    assert.equal(state.step, 1e-9);
    assert.equal(state.minWidth, 10_000);
    assert.equal(state.angle, 25.7);
    assert.deepEqual(state.view, { x: 0, y: 1e6, zoom: 1e25 });
    assert.equal(clean({ iterations: 3.6 }).iterations, 4);
    assert.ok(Object.is(clean({ heading: -0 }).heading, 0));
});

test('an invalid value keeps the value of the base', () => {
    const base = clean({ axiom: 'F', palette: ['#112233'] });
    for (const nonsense of [null, undefined, {}, [], 'text', NaN, Infinity, () => 1, Symbol('x')]) {
        const wrong = Object.fromEntries(FIELDS.map((field) => [field, nonsense]));
        const state = clean(wrong, base);
        assert.equal(state.iterations, base.iterations);
        assert.deepEqual(state.palette, base.palette);
        assert.equal(state.dialect, base.dialect);
        assert.deepEqual(state.start, [0, 0]);
    }
    assert.equal(Object.hasOwn(clean(JSON.parse('{"__proto__": {"axiom": "X"}, "more": 1}')), 'more'), false);
    assert.equal(clean(JSON.parse('{"__proto__": {"axiom": "X"}}')).axiom, '');
});

test('problems of values are described in words', () => {
    assert.equal(problemOf('iterations', 1001), 'must be a whole number from 0 to 1,000; the nearest value was taken');
    assert.equal(problemOf('iterations', 2.5), 'must be a whole number from 0 to 1,000; the nearest value was taken');
    assert.equal(problemOf('growth', 'half'), 'must be a number from 0 to 1; it was left out');
    assert.match(problemOf('palette', []) ?? '', /^must be a list of 1 to 256 colours/);
    assert.match(problemOf('notes', 'x'.repeat(10_001)) ?? '', /at most 10,000 characters; the nearest/);
    for (const [field, value] of /** @type {[import('../../js/state/state.js').FieldName, unknown][]} */ ([
        ['angle', 1e9],
        ['rightAngle', null],
        ['rules', 'a\r\nb'],
        ['background', '#ABCDEF'],
        ['start', [-0, 1]],
        ['view', { x: 0, y: 1, zoom: 2 }],
        ['view', null],
    ])) {
        assert.equal(problemOf(field, value), null, field);
    }
});

test('texts are well formed, with plain line ends and a maximum length', () => {
    assert.equal(clean({ rules: 'a\r\nb\rc' }).rules, 'a\nb\nc');
    assert.equal(clean({ axiom: 'F\ud800F' }).axiom, 'F\ufffdF');
    assert.equal(clean({ axiom: '🌿' }).axiom, '🌿');
    assert.ok(clean({ rules: 'x'.repeat(1e6) }).rules.length <= 50_000);
});

test('the view is not part of the system', () => {
    assert.ok(sameSystem(clean({ axiom: 'F' }), clean({ axiom: 'F', view: { x: 1, y: 1, zoom: 2 } })));
    assert.ok(!sameSystem(clean({ axiom: 'F' }), clean({ axiom: 'G' })));
});

test('changes of different fields go together, and of the same field do not', () => {
    const base = clean({ axiom: 'F', angle: 25, seed: 1 });
    const mine = { ...base, angle: 30, seed: 2 };
    assert.deepEqual(merged(base, mine, { ...base, axiom: 'G', seed: 2 }), { ...mine, axiom: 'G' });
    assert.equal(merged(base, mine, { ...base, angle: 31 }), null);
    const view = { x: 1, y: 1, zoom: 2 };
    assert.deepEqual(merged(base, { ...base, view }, { ...base, axiom: 'G' }), { ...base, axiom: 'G', view });
});
