/** The search for rules: ink, crops, results together, exercises as questions. */

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { answerOf, drawsOf, questionOf } from '../../js/course/others.js';
import { isPicture } from '../../js/find/files.js';
import { promisedSize } from '../../js/find/header.js';
import { LEAST, darkIsLess, greyOf, inkMap, inkShare, inked, isPlain, levelOf, withCorner } from '../../js/find/ink.js';
import { coloured } from '../../js/base/differences.js';
import { merged, percent, systems, verdict } from '../../js/find/merge.js';
import { workersOn } from '../../js/find/search.js';
import { DEFAULTS, definitionOf } from '../../js/state/state.js';

/** A picture of `size` pixels each way with a frame of ink, one pixel wide, at a distance of two. @param {number} size @param {number} ink @param {number} paper */
function framed(size, ink, paper) {
    const grey = new Uint8Array(size * size).fill(paper);
    for (let at = 2; at < size - 2; at++)
        for (const edge of [2, size - 3]) grey[at * size + edge] = grey[edge * size + at] = ink;
    return { grey, width: size, height: size };
}
const whole = { left: 0, top: 0, right: 20, bottom: 20 };

test('ink is told from paper, whichever is darker', () => {
    for (const [ink, paper, isDark] of /** @type {[number, number, boolean][]} */ ([
        [0, 255, true],
        [255, 0, false],
        [90, 130, true],
        [200, 60, false],
    ])) {
        const picture = framed(20, ink, paper);
        const level = levelOf(picture, whole);
        assert.ok(level >= Math.min(ink, paper) && level < Math.max(ink, paper), `${level}`);
        assert.equal(darkIsLess(picture, whole, level), isDark);
        const choice = { crop: whole, level, isDark };
        assert.equal(inkShare(picture, choice), (4 * 15) / 400);
        const taken = inked(picture, choice);
        assert.equal(taken.grey.filter((value) => value === 0).length, 60);
        assert.deepEqual([taken.width, taken.height], [30, 30]);
    }
    assert.equal(levelOf(framed(20, 7, 7), whole), 127);
    assert.ok(isPlain(framed(20, 7, 7)));
});

test('a crop takes only what is inside, and black ink always covers less than the paper', () => {
    const crop = { left: 2, top: 2, right: 18, bottom: 3 };
    const taken = inked(framed(20, 0, 255), { crop, level: 127, isDark: true });
    assert.equal(taken.grey.filter((value) => value === 0).length, 16);
    const full = inked(framed(20, 0, 0), { crop: whole, level: 127, isDark: true });
    assert.ok(full.grey.filter((value) => value === 0).length * 2 < full.grey.length);
});

test('corners stay in the picture and apart from each other', () => {
    const size = { width: 100, height: 50 };
    const crop = { left: 0, top: 0, right: 100, bottom: 50 };
    assert.deepEqual(withCorner(crop, ['top', 'left'], 10.4, 20.6, size), { ...crop, left: 10, top: 21 });
    assert.deepEqual(withCorner(crop, ['bottom', 'right'], 900, -900, size), { ...crop, right: 100, bottom: LEAST });
    assert.deepEqual(withCorner(crop, ['bottom', 'left'], 900, 900, size), { ...crop, left: 100 - LEAST });
    assert.deepEqual(withCorner(crop, ['top', 'right'], -1, -1, size), { ...crop, right: LEAST });
});

test('thin lines stay visible in a small preview', () => {
    const map = inkMap(framed(20, 0, 255), { level: 127, isDark: true }, 5, 5);
    assert.equal(map.filter((share) => share >= 128).length, 16);
    assert.equal(map[2 * 5 + 2], 0);
});

test('colours become levels of grey', () => {
    assert.deepEqual(
        [...greyOf(new Uint8ClampedArray([255, 255, 255, 255, 0, 0, 0, 255, 0, 255, 0, 255]), 3, 1).grey],
        [255, 0, 149],
    );
});

/** @param {string} rules @param {number} agreement @param {number} symbols @returns {import('../../js/protocol.js').Candidate} */
const candidate = (rules, agreement, symbols) => ({
    definition: { ...definitionOf(DEFAULTS), rules },
    name: null,
    key: rules,
    agreement,
    symbols,
    rank: symbols,
    isFound: agreement >= 0.985,
});

test('what several workers found is one list: the shortest that are found, or the closest', () => {
    const slow = { candidates: [candidate('F -> FF', 0.9, 3)], searched: 'little', work: 10, isMore: true };
    const quick = {
        candidates: [candidate('F -> F+F', 0.95, 4), candidate('F -> FF', 0.91, 3)],
        searched: 'much',
        work: 20,
        isMore: false,
    };
    const close = merged([quick, slow]);
    assert.deepEqual(
        close.candidates.map(({ agreement }) => agreement),
        [0.95, 0.91],
    );
    assert.deepEqual([close.searched, close.work, close.isMore], ['little', 10, true]);
    // One rule with several iterations is one answer, and what hardly resembles the picture is none.
    const koch = [5, 4, 7].map((iterations) => ({
        ...candidate('F -> F-F', 1, 4),
        definition: { ...candidate('F -> F-F', 1, 4).definition, iterations },
        key: String(iterations),
    }));
    const [one, ...others] = merged([{ ...slow, candidates: koch }]).candidates;
    assert.deepEqual([one?.definition.iterations, one && 'n' in one && one.n, others], [5, [5, 4, 7], []]);
    assert.equal(verdict(merged([{ ...slow, candidates: koch }]), false), 'One system draws this picture.');
    const far = merged([{ ...slow, candidates: [candidate('F -> FF', 0.49, 3)] }]);
    assert.match(verdict(far, false), /comes close/);
    assert.match(verdict(close, false), /None of the searched systems draws this picture. The nearest/);
    const found = { ...slow, candidates: [candidate('F -> F-F-F', 1, 6), candidate('F -> F-F', 0.99, 4)] };
    assert.deepEqual(
        merged([quick, found]).candidates.map(({ symbols }) => symbols),
        [6, 4],
    );
    assert.equal(verdict(merged([found]), false), 'One system draws this picture.');
    const same = { ...slow, candidates: [candidate('F -> F-F-F', 1, 6), candidate('F -> F-F', 1, 4)] };
    assert.equal(verdict(merged([same]), false), 'Two systems draw the same picture.');
    const near = { ...slow, candidates: [candidate('F -> F-F', 0.98766, 4), candidate('F -> FF', 0.9999, 3)] };
    assert.equal(verdict(merged([near]), false), 'Nearly the same: 99.9 %');
    assert.equal(verdict({ candidates: [candidate('F -> FF', 0.99999, 3)] }, false), 'Nearly the same: 99.9 %');
    // A name is worth more than the same rules without one; the rank decides between systems that are the same.
    const forked = { ...candidate('F -> F+F', 1, 4), name: 'Forked tree', rank: 0 };
    const usual = { ...candidate('F -> +F+F', 1, 3), rank: 1003 };
    const parts = [[candidate('F -> F+F', 1, 4), usual], [forked]].map((candidates) => ({ ...slow, candidates }));
    for (const reports of [parts, [...parts].reverse()]) assert.deepEqual(merged(reports).candidates, [forked, usual]);
    // A search that places the same rules more exactly does not lose the name.
    const loose = { ...forked, agreement: 0.999 };
    const placed = [[candidate('F -> F+F', 1, 4)], [loose]].map((candidates) => ({ ...slow, candidates }));
    for (const reports of [placed, [...placed].reverse()]) assert.deepEqual(merged(reports).candidates, [forked]);
    assert.equal(verdict({ candidates: [candidate('A -> AB', 1, 3)] }, true), 'One system derives the string.');
    assert.match(verdict({ candidates: [] }, false), /None of the searched/);
});

test('percents are rounded down, and numbers begin sentences as words', () => {
    assert.deepEqual([0.98499, 0.985, 1, 0.9999].map(percent), ['98.4 %', '98.5 %', '100.0 %', '99.9 %']);
    assert.deepEqual([1, 6, 19, 20].map(systems), ['One system', 'Six systems', '19 systems', 'At least 20 systems']);
});

test('one core is left to the page, and at most four workers search', () => {
    assert.deepEqual(
        [
            {},
            { hardwareConcurrency: 1 },
            { hardwareConcurrency: 2 },
            { hardwareConcurrency: 4 },
            { hardwareConcurrency: 64 },
        ].map(workersOn),
        [1, 1, 1, 3, 4],
    );
});

test('files that look like pictures are offered', () => {
    const named = (/** @type {string} */ name, type = '') => new File([], name, { type });
    assert.deepEqual(
        [named('a.JPG'), named('a.webp'), named('a', 'image/png'), named('a.json'), named('a.svg.txt')].map(isPicture),
        [true, true, true, false, false],
    );
});

test('an exercise asks for what its students do not know', () => {
    const target = {
        ...definitionOf(DEFAULTS),
        axiom: 'X',
        rules: 'X -> F[+X]-X\nF -> FF',
        angle: 25,
        iterations: 4,
        overrides: 'X: draw\nG: nothing',
    };
    /** @type {any} */
    const exercise = { target, axiom: 'shown', angle: 'hidden', n: 'free', turtle: 'shown' };
    assert.deepEqual(questionOf(exercise), { axiom: 'X', angle: 25, n: null, heading: 90, draws: 'FX' });
    assert.equal(questionOf({ ...exercise, turtle: 'free' }).draws, null);
    assert.equal(drawsOf({ dialect: 'lowercase', overrides: '' }).length, 26);
    const answer = answerOf(
        { ...target, rules: 'X -> F[-X]X\nF -> F', iterations: 3 },
        { fixed: { ...target, rules: 'F -> FF' }, free: ['iterations'] },
    );
    assert.deepEqual([answer.rules, answer.iterations], ['X -> F[-X]X\nF -> FF', 3]);
});

test('files promise their size before they are decoded', () => {
    const bytes = (/** @type {(string | number)[]} */ ...parts) =>
        new Uint8Array(
            parts.flatMap((part) => (typeof part === 'string' ? [...part].map((at) => at.charCodeAt(0)) : [part])),
        ).buffer;
    /** A GIF's block with two parts, and a frame 20,000 wide with a table of colours and data. */
    const noted = ['!', 0xfe, 2, ',,', 1, ',', 0];
    const frame = (/** @type {number} */ left, /** @type {number} */ low) => [
        ...[',', left, 0, 0, 0, 0x20, 0x4e, low, 2, 0x80, 'abcdef', 8],
        ...[3, ',,,', 0],
    ];
    const note = [0xff, 0xe1, 0, 6, 'abcd'];
    for (const [kind, file, size] of /** @type {[string, ArrayBuffer, [number, number] | null][]} */ ([
        ['image/png', bytes('\x89PNG\r\n\x1a\n\0\0\0\rIHDR', 0, 0, 0xea, 0x60, 0, 1, 0, 0), [60_000, 65_536]],
        ['image/gif', bytes('GIF89a', 0, 2, 3, 0, 0, 0, 0), null],
        ['image/gif', bytes('GIF89a', 0, 2, 3, 0, 0, 0, 0, ',', 0, 0, 0, 0, 1, 0, 1, 0, 0), [512, 3]],
        [
            'image/gif',
            bytes('GIF89a', 1, 0, 1, 0, 0x80, 0, 0, 'abcdef', ...noted, ...frame(0, 3), ...frame(7, 2), ';'),
            [0x4e20 + 7, 0x0203],
        ],
        ['image/gif', bytes('GIF89a', 1, 0, 1, 0, 0, 0, 0, ...noted, ...noted), null],
        ['image/jpeg', bytes(0xff, 0xd8, ...note, 0xff, 0xff, 0xc2, 0, 17, 8, 0xea, 0x60, 1, 0, 3), [256, 60_000]],
        ['image/jpeg', bytes(0xff, 0xd8, ...note, 0xff, 0xda, 0, 17, 8, 0xea, 0x60, 1, 0, 3), null],
        ['image/jpeg', bytes(0xff, 0xd8, ...note, 0xff, 0xc4, 0xff, 0xff), null],
        ['image/jpeg', bytes(0xff, 0xd8, 7, 7, 7, 7), null],
        // A marker without a length, in which a small frame hides.
        ['image/jpeg', bytes(0xff, 0xd8, 0xff, 1, 0, 4, 0, 0, 0xff, 0xc0, 0, 17, 8, 0, 1, 0, 1, 3), null],
        ['image/jpeg', bytes(0xff, 0xd8, 0xff, 0, 0, 4, 0, 0, 0xff, 0xc0, 0, 17, 8, 0, 1, 0, 1, 3), null],
        ['image/webp', bytes('RIFF....WEBPVP8X....', 0, 0, 0, 0, 0x5f, 0xea, 0, 2, 0, 1), [60_000, 65_539]],
        ['image/webp', bytes('RIFF....WEBPVP8L....', 0x2f, 0xff, 0xff, 0xff, 0x0f), [16_384, 16_384]],
        ['image/webp', bytes('RIFF....WEBPVP8 ....', '...', 0x9d, 1, 0x2a, 0x10, 0x40, 0x20, 0x80), [16, 32]],
        ['image/png', bytes('\x89PNG'), null],
        ['image/bmp', bytes('BM'), null],
    ]))
        assert.deepEqual(promisedSize(kind, file), size, kind);
});

test('differences have two colours, and agreement a third one', () => {
    for (const theme of /** @type {const} */ (['light', 'dark'])) {
        const pixels = coloured(new Uint8Array([0, 1, 2, 4]), theme);
        const colours = [0, 1, 2, 3].map((at) => [...pixels.subarray(4 * at, 4 * at + 4)].join());
        assert.equal(colours[0], '0,0,0,0');
        assert.equal(new Set(colours).size, 4);
    }
});
