import assert from 'node:assert/strict';
import { test } from 'node:test';
import { latest } from '../../js/base/latest.js';
import {
    REACH,
    lastTop,
    marginText,
    paceText,
    portion,
    ratio,
    readPlace,
    revealed,
    rowsOf,
    scrolled,
    within,
} from '../../js/reading/places.js';
import {
    birth,
    birthOf,
    coordinate,
    descent,
    filledText,
    modulesOf,
    ordinal,
    origin,
    partsOf,
    strokeText,
    visible,
} from '../../js/reading/words.js';
import { dice } from './random.mjs';

const LONG = 10n ** 30n;
const page = (/** @type {bigint} */ rows, height = 200) => ({ rows, rowHeight: 20, height });

test('a hidden row is scrolled to the middle, within the string', () => {
    const top = { row: 100n, offset: 5 };
    assert.equal(revealed(top, 104n, page(LONG)), top);
    assert.deepEqual(revealed(top, 100n, page(LONG)), { row: 95n, offset: 0 });
    assert.deepEqual(revealed(top, 500n, page(LONG)), { row: 495n, offset: 0 });
    assert.deepEqual(revealed(top, 2n, page(LONG)), { row: 0n, offset: 0 });
    assert.deepEqual(revealed(top, LONG - 1n, page(LONG)), lastTop(page(LONG)));
});

test('fractions are exact at both ends and stay within the whole', () => {
    for (const whole of [0n, 1n, 7n, LONG, REACH]) {
        assert.equal(portion(whole, 0), 0n);
        assert.equal(portion(whole, 1), whole);
        assert.equal(portion(whole, -3), 0n);
        assert.equal(portion(whole, 3), whole);
    }
    assert.equal(portion(LONG, 0.5), LONG / 2n);
    assert.equal(ratio(LONG / 4n, LONG), 0.25);
    assert.equal(ratio(5n, 0n), 0);
    assert.equal(within(5n, 0n, 3n), 3n);
    assert.equal(within(-5n, 0n, 3n), 0n);
});

test('rows contain every symbol once', () => {
    assert.deepEqual(
        [0n, 1n, 10n, 11n].map((length) => rowsOf(length, 10)),
        [0n, 1n, 1n, 2n],
    );
    assert.equal(rowsOf(LONG, 60), LONG / 60n + 1n);
});

test('scrolling by rows is exact at any depth', () => {
    const rows = rowsOf(LONG, 100);
    let top = { row: rows / 2n, offset: 0 };
    for (let at = 0; at < 1000; at++) top = scrolled(top, 20, page(rows));
    assert.deepEqual(top, { row: rows / 2n + 1000n, offset: 0 });
    for (let at = 0; at < 1000; at++) top = scrolled(top, -20, page(rows));
    assert.deepEqual(top, { row: rows / 2n, offset: 0 });
});

test('random scrolling stays within the string', () => {
    const random = dice(5);
    for (let round = 0; round < 200; round++) {
        const rows = [3n, 10n, 11n, 500n, LONG][Math.floor(random() * 5)] ?? 0n;
        const height = 1 + Math.floor(random() * 300);
        const last = lastTop(page(rows, height));
        let top = { row: 0n, offset: 0 };
        for (let at = 0; at < 20; at++) {
            top = scrolled(top, Math.round((random() - 0.4) * 1e4) / 4, page(rows, height));
            assert.ok(top.row >= 0n && top.offset >= 0 && top.offset < 20);
            assert.ok(top.row < last.row || (top.row === last.row && top.offset <= last.offset));
        }
        // The lowest position shows the whole last row at the lower edge.
        if (last.row > 0n || last.offset > 0) assert.equal(Number(rows - last.row) * 20 - last.offset, height);
    }
});

test('positions are read as people write them, counted from 1', () => {
    for (const [text, place] of /** @type {[string, bigint][]} */ ([
        ['1', 0n],
        ['1,234', 1233n],
        ['1 234 567', 1_234_566n],
        ['10^12', 10n ** 12n - 1n],
        ['10¹²', 10n ** 12n - 1n],
        ['1e12', 10n ** 12n - 1n],
        ['2.5e6', 2_499_999n],
        ['2·10^29', 2n * 10n ** 29n - 1n],
        ['1.5 × 10²', 149n],
        ['50 %', LONG / 2n],
        ['12.5%', LONG / 8n],
        ['0 %', 0n],
        ['100%', LONG - 1n],
        ['end', LONG - 1n],
        ['start', 0n],
        ['0', 0n],
        ['1e9999', LONG - 1n],
        [String(LONG - 5n), LONG - 6n],
    ])) {
        assert.equal(readPlace(text, LONG), place, text);
    }
    for (const text of ['', 'x', '-5', '10^', '1e', '%', '1e99999', '5 symbols', '0x10', '1..2'])
        assert.equal(readPlace(text, LONG), null, text);
    assert.equal(readPlace('7', 0n), 0n);
});

test('places and speeds are shown in short form', () => {
    assert.equal(marginText(0n), '1');
    assert.equal(marginText(1_234_566n), '1,234,567');
    assert.equal(marginText(LONG), '…000,001');
    assert.equal(paceText(1), '1 a second');
    assert.equal(paceText(25.6), '26 a second');
    assert.equal(paceText(2.43e18), '2.4\u2009×\u200910¹⁸ a second');
});

test('the origin of a symbol is described in words', () => {
    /** @type {import('../../js/protocol.js').AncestryLink[]} */
    const chain = [
        { generation: 0, symbol: 'Y', index: '1', production: null, position: 1 },
        { generation: 1, symbol: 'X', index: '4', production: 0, position: 2 },
        { generation: 2, symbol: 'X', index: '9', production: null, position: 0 },
    ];
    assert.equal(origin(chain), 'X at step 1, by rule 1, third symbol');
    assert.deepEqual(descent(chain).map(birth), ['step 1, by rule 1, third symbol', 'second symbol of the axiom']);
    assert.equal(origin(chain.slice(0, 1)), 'Y, second symbol of the axiom');
    assert.equal(origin([]), '');
    assert.deepEqual([0, 11, 12, 20, 21, 110, 111, 1000].map(ordinal), [
        'first',
        'twelfth',
        '13th',
        '21st',
        '22nd',
        '111th',
        '112th',
        '1,001st',
    ]);
    assert.equal(coordinate(-2.5), '−2.5');
    assert.equal(coordinate(1.6934e12), '1.693·10¹²');
    assert.equal(coordinate(-1e-5), '−1.000·10⁻⁵');
});

test('modules are shown with their arguments, numbers to four digits', () => {
    assert.deepEqual(modulesOf('F[X', false), ['F', '[', 'X']);
    assert.deepEqual(modulesOf('A(1,2)\n[\n`(`\n', true), ['A(1,2)', '[', '`(`']);
    assert.deepEqual(modulesOf('', true), []);
    assert.deepEqual(partsOf('B(0.32805000000000006,-7.069999999999999)'), ['B', '(0.3281,-7.07)']);
    for (const [module, shown] of /** @type {[string, string][]} */ ([
        ['F', 'F'],
        ['(', '('],
        [')', ')'],
        ['`', '`'],
        [' ', '␣'],
        ['`(`', '('],
        ['` `(2)', '␣(2)'],
        ['`U+0A`', 'U+0A'],
        ['+(137.5)', '+(137.5)'],
        ['!(1.25e-7,123456.789,12345678)', '!(1.25e-7,123457,12345700)'],
        ['😀(1)', '😀(1)'],
    ])) {
        assert.equal(visible(module), shown, module);
    }
    assert.equal(
        birthOf([{ generation: 0, symbol: 'A(1)', index: '0', production: null, position: 0 }]),
        'first symbol of the axiom',
    );
    assert.equal(birthOf([]), '');
});

test('one question is asked at a time, and only the newest waits', async () => {
    /** @type {((value: number) => void)[]} */
    const open = [];
    /** @type {number[][]} */
    const answers = [];
    const ask = latest(
        (/** @type {number} */ _value) =>
            new Promise((/** @type {(value: number) => void} */ resolve) => open.push(resolve)),
        (answer, value) => answers.push([answer, value]),
    );
    for (let at = 0; at < 100; at++) ask(at);
    assert.equal(open.length, 1);
    open[0]?.(7);
    await new Promise(setImmediate);
    assert.equal(open.length, 2);
    open[1]?.(8);
    await new Promise(setImmediate);
    assert.deepEqual(answers, [
        [7, 0],
        [8, 99],
    ]);
    assert.equal(open.length, 2);
});

test('segments and polygons are described in words', () => {
    const stroke = { from: [0, 0], to: [0, 1], fittedFrom: [], fittedTo: [], heading: 90, level: 2, colour: -1 };
    assert.equal(strokeText(stroke), 'heading 90°, branch level 2, colour −1');
    assert.equal(strokeText({ ...stroke, heading: [0, 0.5, 1], level: 0, colour: 0 }), 'heading 0, 0.5, 1');
    assert.equal(filledText({ outline: [], level: 1, colour: 3 }), 'filled, branch level 1, colour 3');
    assert.equal(filledText({ outline: [], level: 0, colour: 0 }), 'filled');
});
