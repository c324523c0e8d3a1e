import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CONTROLS, readControls, readOptions } from '../../js/embed/options.js';
import { schemeOf } from '../../js/embed/scheme.js';
import { fieldsOf, valuesOf } from '../../js/embed/values.js';
import { KEYS } from '../../js/state/link.js';
import { DEFAULTS, clean } from '../../js/state/state.js';
import { ATTRIBUTES } from '../../js/tables.js';
import { dice, randomState } from './random.mjs';

test('options are read from the address beside the system', () => {
    const none = { controls: [], theme: null, host: null };
    assert.deepEqual(readOptions(''), none);
    assert.deepEqual(readOptions('#v=1&axiom=controls&rules=theme'), none);
    assert.deepEqual(readOptions('#controls=n,angle&theme=dark&host=https%3A%2F%2Fa.example%2Fpage'), {
        controls: ['angle', 'n'],
        theme: 'dark',
        host: 'https://a.example',
    });
    assert.deepEqual(readOptions('controls=rules&controls=play'), { ...none, controls: ['play'] });
    for (const bad of [
        '#controls=%',
        '#theme=blue',
        '#host=javascript:alert(1)',
        '#host=https%3A%2F%2F',
        '#host=null',
        '#host=*',
        '#controls=__proto__,toString',
        `#controls=${'n,'.repeat(10_000)}x`.replace('n', 'x'),
    ]) {
        const { theme, host } = readOptions(bad);
        assert.deepEqual([theme, host], [null, null], bad.slice(0, 40));
    }
});

test('controls are read in any order and case', () => {
    assert.deepEqual(readControls('Play  string,N'), ['n', 'string', 'play']);
    assert.deepEqual(
        readControls('all'),
        CONTROLS.filter((control) => control !== 'steps'),
    );
    assert.deepEqual(readControls('all,steps'), CONTROLS);
    assert.deepEqual(readControls('all-of-them'), []);
});

test('a host without a dark colour scheme is light, whatever the reader’s system is', () => {
    for (const declared of ['', 'normal', 'light', 'only light', 'sepia'])
        for (const dark of [false, true]) assert.equal(schemeOf(declared, dark), 'light', declared);
    for (const dark of [false, true]) assert.equal(schemeOf('only dark', dark), 'dark');
    assert.deepEqual([schemeOf('light dark', false), schemeOf('Dark  Light', true)], ['light', 'dark']);
});

test('values contain the whole state and read back the same', () => {
    for (let seed = 1; seed <= 200; seed++) {
        const state = randomState(dice(seed));
        const { fields, problems } = fieldsOf(structuredClone(valuesOf(state)));
        assert.deepEqual(problems, []);
        assert.deepEqual(clean({ ...DEFAULTS, ...fields }), state);
        // Attributes give strings.
        const strings = Object.fromEntries(
            KEYS.filter(([, field]) => state[field] !== null).map(([key, field, form]) => [
                key,
                form.write(state[field]),
            ]),
        );
        assert.deepEqual(clean({ ...DEFAULTS, ...fieldsOf(strings).fields }), state);
    }
});

test('invalid values are reported and ignored', () => {
    const { fields, problems } = fieldsOf({
        n: 3,
        angle: 'wide',
        palette: ['red'],
        view: {},
        colour: 'level',
        nothing: 1,
        toString: 2,
    });
    assert.deepEqual(fields, { iterations: 3, colourBy: 'level' });
    for (const key of ['angle', 'palette', 'view', 'nothing', 'toString'])
        assert.ok(
            problems.some((words) => words.includes(`“${key}”`)),
            key,
        );
    for (const junk of [null, 7, 'n=3', undefined]) assert.equal(fieldsOf(junk).problems.length, 1);
});

test('every key is an attribute of the element', () => {
    assert.deepEqual(Object.values(ATTRIBUTES).sort(), KEYS.map(([key]) => key).sort());
});
