import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';
import {
    LABELS,
    NAMES,
    SHELVES,
    choose,
    count,
    filtersOf,
    matches,
    searchText,
    shelved,
    shortSource,
} from '../../js/dialogs/shelves.js';

const DATA = new URL('../../../data_in/', import.meta.url);
const files = readdirSync(DATA, { recursive: true, encoding: 'utf8' })
    .map((path) => path.replaceAll('\\', '/'))
    .filter((path) => path.endsWith('.json'))
    .sort();

/** Angles this near look nearly equal, in degrees. */
const NEAR = 6;

/** The productions of a file, one text each. @param {unknown} rules @returns {string[]} */
function productions(rules) {
    if (Array.isArray(rules)) return rules.map(String);
    return Object.entries(/** @type {Record<string, string | {p: number, e: string}[]>} */ (rules)).flatMap(
        ([from, to]) =>
            typeof to === 'string' ? [`${from} -> ${to}`] : to.map(({ p, e }) => `${from} -> ${e} : ${p}`),
    );
}

/** The rules and the axiom of a system with its letters renamed in the order of their use. @param {string} path */
function shape(path) {
    const { initial, rules, angle_deg: angle } = JSON.parse(readFileSync(new URL(path, DATA), 'utf8'));
    /** @type {Map<string, string>} */
    const names = new Map();
    const rename = (/** @type {string} */ text) =>
        text.replace(
            /\p{L}/gu,
            (letter) => names.get(letter) ?? String(names.set(letter, `<${names.size}>`).get(letter)),
        );
    return { rules: productions(rules).sort().map(rename).join('\n'), axiom: rename(initial), angle: Number(angle) };
}

test('every system of data_in is on exactly one shelf', () => {
    const listed = Object.values(SHELVES).flatMap((systems) => Object.keys(systems));
    assert.deepEqual(listed.map((path) => `${path}.json`).sort(), files);
    const gallery = shelved(files.map((path) => ({ path })));
    assert.deepEqual(
        gallery.map(([name]) => name),
        NAMES,
    );
    assert.deepEqual(
        gallery.flatMap(([, inside]) => inside.map(({ path }) => path.replace(/\.json$/, ''))),
        listed,
    );
    for (const other of Object.values(SHELVES).flatMap((systems) => Object.values(systems)))
        assert.ok(other === '' || NAMES.includes(other), other);
});

test('the first shelf is small, and the last one takes systems without a shelf', () => {
    assert.equal(NAMES[0], 'Start here');
    assert.deepEqual(Object.keys(LABELS), NAMES);
    const first = Object.keys(SHELVES['Start here'] ?? {}).length;
    assert.ok(first >= 6 && first <= 8);
    assert.deepEqual(shelved([{ path: 'new/one.json' }]), [['Books and courses', [{ path: 'new/one.json' }]]]);
});

test('no near-duplicates are neighbours, and all but one are on the last shelf', () => {
    const gallery = shelved(files.map((path) => ({ path, ...shape(path) })));
    const near = (/** @type {{rules: string, angle: number}} */ a, /** @type {{rules: string, angle: number}} */ b) =>
        a.rules === b.rules && Math.abs(a.angle - b.angle) <= NEAR;
    const row = gallery.flatMap(([, inside]) => inside);
    row.slice(1).forEach((entry, at) =>
        assert.ok(!near(entry, /** @type {typeof entry} */ (row[at])), `${entry.path} is beside ${row[at]?.path}`),
    );
    const seen = gallery.slice(0, -1).flatMap(([, inside]) => inside);
    for (const [at, entry] of seen.entries()) {
        for (const other of seen.slice(at + 1))
            assert.ok(!(near(entry, other) && entry.axiom === other.axiom), `${entry.path} and ${other.path}`);
    }
});

test('filters are what one sees', () => {
    assert.deepEqual(filtersOf({ path: 'abop/2.6a.json', kinds: ['deterministic', 'parametric'], solid: true }), [
        'Trees',
        'In space',
    ]);
    assert.deepEqual(filtersOf({ path: 'garden/meadow.json', kinds: ['stochastic'], solid: false }), [
        'Flowers and leaves',
        'By chance',
    ]);
    assert.deepEqual(filtersOf({ path: 'a/new.json', kinds: ['context-sensitive'], solid: true }), [
        'In space',
        'Signals',
        'Books and courses',
    ]);
});

test('filters are combined, or replaced if they have nothing in common', () => {
    const found = [['Trees', 'In space'], ['Trees'], ['Curves']];
    const trees = choose(new Set(), 'Trees', found);
    assert.deepEqual([...choose(trees, 'In space', found)], ['Trees', 'In space']);
    assert.deepEqual([...choose(trees, 'Curves', found)], ['Curves']);
    assert.deepEqual([...choose(trees, 'Trees', found)], []);
    assert.equal(count(found, trees), 2);
    assert.equal(count(found, new Set()), 3);
});

test('a search reads name, title, notes and rules', () => {
    const text = searchText({ title: 'Weed', name: '1.24a', notes: 'A feather', rules: 'F -> F[+F]F[-F]F\nX -> F' });
    for (const search of ['f[+f]', 'F -> F[+F]', 'WEED', '1.24a feather', '', '  '])
        assert.ok(matches(text, search), search);
    for (const search of ['F[+X]', 'weed dragon', 'beauty']) assert.ok(!matches(text, search), search);
});

test('a source is shortened to its author or book and its year', () => {
    for (const [source, short] of [
        [
            'Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants (1990), figure 1.24a, page 25',
            'Prusinkiewicz and Lindenmayer, 1990',
        ],
        ['McWorter and Tazelaar, Creating Fractals (Byte, August 1987)', 'McWorter and Tazelaar, 1987'],
        ['Of Trees and Turtles (Autotelic Computing, 2012)', 'Of Trees and Turtles, 2012'],
        [
            'After figure 1.24f of The Algorithmic Beauty of Plants (1990), with widths',
            'After The Algorithmic Beauty of Plants, 1990',
        ],
        ['Practical 1: Lindenmayer systems and fractal plants', 'Practical 1'],
        ['Lecture Computer Graphics, Assignment 8: Lindenmayer Systems (2019)', 'Lecture Computer Graphics, 2019'],
        ["Four of P. Lévy's curves (1938) around a square", "Four of P. Lévy's curves, 1938"],
        ['', ''],
    ])
        assert.equal(shortSource(String(source)), short);
});
