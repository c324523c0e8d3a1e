/** Exercises whose answer is a program: what their texts mean, and what is said of wrong results. */

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { faultWords } from '../../js/programs/faults.js';
import { truth } from '../../js/programs/given.js';
import { isSame, judged, whyWrong } from '../../js/programs/judge.js';
import { LOCK, FILES } from '../../js/programs/python.js';
import { KNOWN, SETS, definitionOf, PLANTS } from '../../js/programs/sets.js';
import { packed, programIn, readExercise, readTask } from '../../js/programs/tasks.js';

const own = truth();
const seed = { F: 'FF', X: 'F[+X][-X]FX' };
const package_ = (/** @type {string} */ name) => new URL(`../../node_modules/pyodide/${name}`, import.meta.url);

test('the given functions give what the documents of the courses say', () => {
    assert.equal(own.derivation('X', seed), 'F[+X][-X]FX');
    assert.equal(own.generation('X', seed, 2), 'FF[+F[+X][-X]FX][-F[+X][-X]FX]FFF[+X][-X]FX');
    assert.equal(own.expand('A', { A: 'ALRI' }, 3), 'ALRILRILRI');
    assert.ok(isSame(own.move2d([0, 5], 30, 3), [2.598076211353316, 6.5]));
    assert.deepEqual(
        own.multmat(
            [
                [1, 2, 3],
                [-1, 0, 2],
            ],
            [
                [-1, 1],
                [0, 1],
            ],
        ),
        [
            [-2, -2, -1],
            [-1, 0, 2],
        ],
    );
    assert.equal(own.draw(own.expand('X', seed, 7), 25.7).length, 6305);
    assert.equal(own.axiomtoline2d(own.generation('X', seed, 5), [0, 0], 90, 25.7, 25.7, 1).length, 422);
    const { axiom, rules, angles } = PLANTS['tree3d0'] ?? assert.fail();
    assert.equal(own.axiomtoline3d(own.generation(axiom, rules, 4), [0, 0, 0], 90, angles, 1).length, 585);
});

test('ready-made sets know their functions and plants', () => {
    for (const [name, { functions, plants, drawing }] of Object.entries(SETS)) {
        const task = readTask(`set: ${name}`);
        assert.deepEqual(task.problems, []);
        assert.deepEqual(
            task.functions.map((one) => one.name),
            functions,
        );
        for (const one of functions) assert.ok(KNOWN[one], one);
        for (const plant of plants) assert.ok(definitionOf(PLANTS[plant] ?? assert.fail(plant), drawing, 2).rules);
    }
});

test('own functions have examples, known ones need no results', () => {
    const { functions, languages, problems } = readTask(
        'languages: JavaScript\ndouble(word): The word twice.\ndouble("F") = "FF"\ndouble("") = ""\nderivation\ngeneration of koch, tree0 for n = 0..2',
    );
    assert.deepEqual([languages, problems], [['javascript'], []]);
    assert.deepEqual(
        functions.map(({ name, tests }) => [name, tests.length]),
        [
            ['double', 2],
            ['derivation', KNOWN['derivation']?.calls.length],
            ['generation', 6 + (KNOWN['generation']?.calls.length ?? 0)],
        ],
    );
    assert.deepEqual(functions[0]?.tests[0], { args: ['F'], expected: 'FF' });
    assert.deepEqual(readTask('double(word): Twice.\ndouble(F) = 1\nwhat is this?').problems, [
        'Line 2 is no call with its result.',
        'Line 3 is not understood.',
        'Each function needs an example of what it gives.',
    ]);
});

test('programs travel in links, and damaged ones are none', async () => {
    const code = 'def f(n):\n    return "ä" * n\n';
    const hash = `#v=1&x=abc&code=${await packed('python', code)}&by=Ada`;
    assert.deepEqual(await programIn(hash), { language: 'python', code });
    for (const wrong of ['#v=1&x=abc', '#v=1&code=AAAA', `${hash.slice(0, 60)}`])
        assert.equal(await programIn(wrong), null);
    await assert.rejects(readExercise('AAAA'));
});

test('the interpreter is the one whose versions and sizes are written down', () => {
    assert.deepEqual(JSON.parse(readFileSync(package_('pyodide-lock.json'), 'utf8')).info, LOCK);
    for (const [, name, bytes] of FILES) assert.equal(readFileSync(package_(name)).length, bytes, name);
});

/** Wrong results: the function, what it was called with, what it gave, and what is said. @type {[string, unknown[], unknown, RegExp][]} */
const WRONG = [
    ['generation', ['X', seed, 1], own.generation('X', seed, 2), /one step more/],
    ['generation', ['X', seed, 2], own.generation('X', seed, 1), /one step less/],
    ['derivation', ['AB', { A: 'B', B: 'A' }], 'AA', /one after another/],
    ['derivation', ['F[+X]', seed], 'FFF[+X][-X]FX', /without a rule are lost/],
    ['derivation', ['F[+X]', seed], 'FF[+F[+X][-X]F]', /Symbol 15 .* instead of/],
    ['derivation', ['F', {}], ['F'], /a list, and a text/],
    ['expandOnce', ['AB', { A: 'B', B: 'A' }], 'AA', /one after another/],
    ['expand', ['X', seed, 1], own.expand('X', seed, 2), /one step more/],
    ['expandSymbol', ['F', { F: 'FF' }], 'F', /Symbol 2/],
    ['degreetorad', [180], own.degreetorad(180) + 1, /is expected/],
    ['degreetorad', [180], (180 * 180) / Math.PI, /degrees of radians/],
    [
        'multmat',
        KNOWN['multmat']?.calls[3] ?? [],
        own.multmat(
            [
                [5, 6],
                [7, 8],
            ],
            [
                [1, 2],
                [3, 4],
            ],
        ),
        /other order/,
    ],
    [
        'multmatvector',
        [
            [
                [1, 2],
                [3, 4],
            ],
            [5, 6],
        ],
        [17, 39],
        /Rows and columns/,
    ],
    [
        'multmatvector',
        [
            [
                [1, 2],
                [3, 4],
            ],
            [5, 6],
        ],
        [23],
        /1 value/,
    ],
    [
        'multmatvector',
        [
            [
                [1, 2],
                [3, 4],
            ],
            [5, 6],
        ],
        [23, 35],
        /Value 2/,
    ],
    ['r2d', [30], own.r2d(-30), /clockwise/],
    ['r2d', [30], own.r2d((30 * 180) / Math.PI), /radians/],
    ['move2d', [[0, 0], 30, 2], own.move2d([0, 0], (30 * 180) / Math.PI, 2), /radians/],
    ['move2d', [[0, 0], 30, 2], own.move2d([0, 0], 60, 2), /Sine and cosine/],
    ['move2d', [[0, 0], 30, 2], ['nan', 1], /Value 1/],
    ['draw', ['F+F', 30], own.draw('F-F', 30), /Left and right/],
    ['draw', ['F[+F]F', 30], own.draw('F+FF', 30), /do nothing/],
    ['draw', ['FF', 30], own.draw('F', 30), /1 line/],
    [
        'draw',
        ['F[+F]F', 30],
        [
            ...own.draw('F[+F]', 30),
            [
                [0, 2],
                [0, 3],
            ],
        ],
        /After \]/,
    ],
    ['axiomtoline2d', ['F-F', [0, 0], 90, 30, 45, 2], own.axiomtoline2d('FF', [0, 0], 90, 30, 45, 2), /Line 2/],
    [
        'axiomtoline3d',
        ['F+F', [0, 0, 0], 90, { l: 90, r: 45 }, 2],
        own.axiomtoline3d('FF', [0, 0, 0], 90, { l: 90 }, 2),
        /Line 2/,
    ],
];

test('wrong results are explained', () => {
    for (const [name, args, got, words] of WRONG) {
        const given = { at: 0, ms: 0, changed: false, printed: '' };
        const told = whyWrong(name, { call: '', args, expected: own[name](...args), got, given, isRight: false });
        assert.match(told, words, `${name} ${JSON.stringify(args)}`);
    }
    const tried = { call: '', args: ['F', {}], expected: 'F', got: null, isRight: false };
    const given = { at: 0, value: 'null', nothing: true, ms: 0, changed: false, printed: '' };
    assert.match(whyWrong('derivation', { ...tried, given }), /gives nothing back/);
    assert.match(whyWrong('derivation', { ...tried, given: { ...given, printed: 'F\n' } }), /prints its result/);
    assert.match(whyWrong('derivation', { ...tried, given: { ...given, changed: true } }), /changes what it is given/);
});

test('errors are told in words, with their line', () => {
    for (const [type, message, words] of /** @type {[string, string, RegExp][]} */ ([
        ['NameError', "name 'x' is not defined", /The name x/],
        ['ReferenceError', 'x is not defined', /The name x/],
        ['RangeError', 'Maximum call stack size exceeded', /calls itself/],
        ['RangeError', 'printed too much', /prints too much/],
        ['TypeError', "f() missing 1 required positional argument: 'n'", /too few or too many/],
        ['TypeError', "Cannot read properties of undefined (reading 'x')", /value is missing/],
        ['TabError', '', /Tabs and blanks/],
        ['Other', 'words', /An error: words/],
    ])) {
        const told = faultWords({ type, message, line: 3 });
        assert.match(told, /^Line 3: /);
        assert.match(told, words);
    }
    assert.match(faultWords({ type: 'Endless', message: '', line: null }), /^The program was ended after 5 seconds/);
});

test('a function that is not written has no calls, and one that was ended is not right', () => {
    const { functions } = readTask('set: assignment-8');
    const ran = { fault: null, printed: '', own: ['expandSymbol'], results: [] };
    const [first, second] = judged(functions, ran);
    assert.deepEqual([first?.isOwn, first?.isRight, second?.isOwn, second?.tried], [true, false, false, []]);
});
