import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
    admits,
    choicesFrom,
    defaultOf,
    groupsOf,
    optionOf,
    pixelSize,
    posterValues,
    rowOf,
    savedName,
    sizeOf,
    sizeWords,
    valuesFor,
} from '../../js/save/choices.js';
import { createMaking } from '../../js/save/making.js';
import { firstLines, sheetOf } from '../../js/save/preview.js';
import { FILE_OPTIONS, FORMATS } from '../../js/late-tables.js';
import { Cancelled } from '../../js/engine/tool.js';

/** @typedef {import('../../js/save/making.js').Made} Made */

test('every format stands in the groups of its purposes, and dialogs of their own stand among them', () => {
    const groups = groupsOf();
    const placed = groups.flatMap(({ purpose, rows }) => rows.map(({ name }) => `${name} ${purpose}`));
    assert.deepEqual(
        placed.sort(),
        Object.entries(FORMATS)
            .flatMap(([name, { purposes }]) => purposes.map((purpose) => `${name} ${purpose}`))
            .sort(),
    );
    assert.ok(groups.every(({ rows }) => rows.length > 0));
    for (const purpose of ['screen', 'print'])
        assert.equal(
            groupsOf()
                .find((group) => group.purpose === purpose)
                ?.rows.some(({ name }) => name === 'png'),
            true,
        );
});

const POSTER = { sheet: 'a3', landscape: false, dpi: 300 };

test('posters have the pixels of their sheets', () => {
    assert.deepEqual(posterValues(POSTER), { size: '3508x4961', dpi: 300 });
    assert.deepEqual(posterValues({ sheet: 'a1', landscape: true, dpi: 150 }), { size: '4967x3508', dpi: 150 });
    assert.deepEqual(posterValues({ sheet: 'tabloid', landscape: false, dpi: 300 }), { size: '3300x5100', dpi: 300 });
});

test('remembered choices are kept as far as they are possible', () => {
    const groups = groupsOf();
    const none = choicesFrom(undefined, groups);
    assert.deepEqual(none, { purpose: 'screen', formats: {}, values: {}, poster: POSTER });
    assert.equal(rowOf(none, groups).name, 'svg');
    const some = choicesFrom(
        {
            purpose: 'data',
            formats: { data: 'csv', screen: 'gone' },
            values: { margin: 500, landscape: true, sheet: 'a99', size: '2048', flavour: 1 },
            poster: { sheet: 'a1', landscape: 'yes', dpi: 301 },
        },
        groups,
    );
    assert.deepEqual(some, {
        purpose: 'data',
        formats: { data: 'csv' },
        values: { landscape: true, size: '2048' },
        poster: { ...POSTER, sheet: 'a1' },
    });
    assert.equal(rowOf(some, groups).name, 'csv');
    for (const junk of [null, 7, 'x', [], { purpose: {}, formats: 3, values: null }])
        assert.equal(choicesFrom(junk, groups).purpose, 'screen');
});

test('every option admits its default, and only differing values of a format are sent', () => {
    for (const option of Object.values(FILE_OPTIONS)) assert.ok(admits(option, defaultOf(option)), option.label);
    /** @type {import('../../js/save/choices.js').Choices} */
    const choices = {
        purpose: 'screen',
        formats: {},
        values: { transparent: true, bare: false, margin: 3 },
        poster: POSTER,
    };
    assert.deepEqual(valuesFor('svg', choices), { transparent: true });
    assert.deepEqual(valuesFor('json', choices), {});
});

test('sizes are within the limits, in the proportions of the drawing unless both sides are given', () => {
    const limits = { most: 4096 };
    assert.deepEqual(sizeOf('1600x1200', limits), [1600, 1200]);
    for (const wrong of ['', '0x5', '4097x1', '5', '-3x3', '1e3x4', '3x4x5'])
        assert.equal(sizeOf(wrong, limits), null, wrong);
    assert.equal(pixelSize('', { width: 900, height: 600 }), '900x600');
    assert.equal(pixelSize('2048', { width: 600, height: 900 }), '1365x2048');
    assert.equal(pixelSize('30x20', { width: 600, height: 900 }), '30x20');
    assert.ok(['a4', '300x400', '10x10000'].every((sheet) => admits(optionOf('sheet'), sheet)));
    assert.ok(!['a99', '9x400', '300x', 'x', '1e2x300', ''].some((sheet) => admits(optionOf('sheet'), sheet)));
    assert.ok(admits(optionOf('size'), '2048') && !admits(optionOf('size'), '2048px'));
});

test('names and sizes in words', () => {
    assert.equal(savedName('koch_n4', 'svg-compact'), 'koch_n4_compact.svg');
    assert.equal(savedName('koch_n4', 'glb'), 'koch_n4.glb');
    assert.deepEqual([1, 999, 1000, 9960, 123_456, 2_500_000, 3e9].map(sizeWords), [
        '1 byte',
        '999 bytes',
        '1.0 kB',
        '10 kB',
        '123 kB',
        '2.5 MB',
        '3.0 GB',
    ]);
});

test('previews show the first lines of texts, and sheets as they lie', async () => {
    assert.equal(await firstLines(new Blob(['a\nb\n'])), 'a\nb\n');
    assert.equal((await firstLines(new Blob(['x\n'.repeat(100)])))?.split('\n').length, 24);
    assert.equal((await firstLines(new Blob(['F'.repeat(1000)])))?.length, 121);
    // Half of a character at the end belongs to what follows.
    assert.equal(await firstLines(new Blob([new Uint8Array([70, 0xc3])])), 'F');
    assert.equal(await firstLines(new Blob([new Uint8Array([0x67, 0x6c, 0, 2])])), null);
    assert.equal(await firstLines(new Blob([new Uint8Array([0xff, 0xfe, 65])])), null);
    assert.deepEqual(sheetOf({}), { width: 210, height: 297, margin: 10 });
    assert.deepEqual(sheetOf({ sheet: 'a5', landscape: true, margin: 2 }), { width: 210, height: 148, margin: 2 });
    assert.deepEqual(sheetOf({ sheet: '300.5x200', landscape: true }), { width: 300.5, height: 200, margin: 10 });
});

/** A making whose files grow by the pieces that the test sends. */
function making() {
    /** @type {Made[]} */
    const told = [];
    /** @type {{progress: (size: number, piece: Blob) => void, end: (made: any) => void, fail: (error: Error) => void, signal: AbortSignal}[]} */
    const files = [];
    const make = (/** @type {any} */ _wanted, /** @type {any} */ { signal, progress }) =>
        new Promise((end, fail) => {
            signal.addEventListener('abort', () => fail(new Cancelled()));
            files.push({ progress, end, fail, signal });
        });
    return { told, files, ...createMaking(/** @type {any} */ (make), (made) => told.push(made)) };
}

const CSV = { format: /** @type {const} */ ('csv'), values: {} };

test('the file in the background is the file that is saved', async () => {
    const { told, files, show, whole } = making();
    show(CSV);
    files[0]?.progress(3, new Blob(['abc']));
    assert.deepEqual([told.at(-1)?.state, told.at(-1)?.size, await told.at(-1)?.head?.text()], ['making', 3, 'abc']);
    const saved = whole(CSV);
    files[0]?.end({ blob: new Blob(['abcdef']), diagnostics: [] });
    assert.equal(await (await saved).blob?.text(), 'abcdef');
    assert.equal(files.length, 1);
    assert.equal((await whole(CSV)).size, 6);
    assert.equal(files.length, 1);
});

test('a large file is made when it is asked for, and not before', async () => {
    const { told, files, show, whole } = making();
    show(CSV);
    files[0]?.progress(33 << 20, new Blob(['abc']));
    await Promise.resolve();
    assert.ok(files[0]?.signal.aborted);
    assert.equal(told.at(-1)?.state, 'large');
    const saved = whole(CSV);
    files[1]?.progress(33 << 20, new Blob(['abc']));
    files[1]?.end({ blob: new Blob(['abc']), diagnostics: [] });
    assert.equal((await saved).state, 'made');
});

test('a cancelled file is not saved, and tells nothing more', async () => {
    const { told, files, show, whole, cancel } = making();
    show(CSV);
    const saved = whole(CSV);
    const count = told.length;
    cancel();
    assert.equal((await saved).state, 'cancelled');
    assert.equal(told.length, count);
    assert.equal(files.length, 1);
});

test('a file that failed is tried again', async () => {
    const { told, files, show, whole } = making();
    show(CSV);
    files[0]?.fail(new Error('it did not answer'));
    await new Promise((resolve) => setTimeout(resolve));
    assert.deepEqual([told.at(-1)?.state, told.at(-1)?.reason], ['failed', 'it did not answer']);
    const saved = whole(CSV);
    files[1]?.end({ blob: null, diagnostics: [{ message: 'too large' }] });
    assert.equal((await saved).state, 'failed');
});
