/** The drawing as sound: notes in step with playback, and notes at their own times. */

import assert from 'node:assert/strict';
import test from 'node:test';
import { createFollower, strideOf } from '../../js/motion/follower.js';
import { frequencyOf } from '../../js/motion/instrument.js';
import { createTogether, timeText } from '../../js/motion/together.js';

/** @typedef {import('../../js/protocol.js').Note} Note */

/** @param {Partial<Note>} values @returns {Note} */
const note = (values) => ({ start: 0, length: 1, key: 60, velocity: 90, voice: 0, side: 0, fitted: [], ...values });

test('keys are those of the MIDI standard', () => {
    assert.equal(frequencyOf(69), 440);
    assert.ok(Math.abs(frequencyOf(60) - 261.6256) < 1e-3);
    assert.ok(Math.abs(frequencyOf(72) / frequencyOf(60) - 2) < 1e-12);
});

/** A follower of a walk whose line number `n` has the voice `n`, and what it played. */
function following() {
    const played = /** @type {[number, number][]} */ ([]);
    const asked = /** @type {[bigint, bigint, number][]} */ ([]);
    const follower = createFollower({
        async ask(from, stride, count) {
            asked.push([from, stride, count]);
            return Array.from({ length: count }, (_, at) => note({ voice: Number(from + stride * BigInt(at)) }));
        },
        play: ({ voice }, seconds) => void played.push([voice, seconds]),
    });
    return { played, asked, follower };
}

/** Lets answers come. */
const settled = () => new Promise((resolve) => setTimeout(resolve));

test('slow playback sounds every line, and fast playback lines at even distances', async () => {
    for (const [perSecond, stride] of /** @type {const} */ ([
        [4, 1],
        [60, 5],
    ])) {
        assert.equal(strideOf(perSecond), BigInt(stride));
        const { played, asked, follower } = following();
        await follower.follow({ upto: 1n, perSecond });
        await settled();
        for (let upto = 2n; upto <= 400n; upto++) {
            await follower.follow({ upto, perSecond });
            await settled();
        }
        const lines = played.map(([line]) => line);
        // The first note may come too late; no other is left out, and none sounds twice.
        const first = lines[0] ?? -1;
        assert.ok(first <= stride);
        assert.deepEqual(
            lines,
            lines.map((_, at) => first + at * stride),
        );
        assert.ok((lines.at(-1) ?? 0) + stride >= 400);
        assert.ok(played.every(([, seconds]) => Math.abs(seconds - stride / perSecond) < 1e-9));
        assert.equal(asked.length, stride === 1 ? 4 : 2);
    }
});

test('a line that is shown by hand sounds alone, and the last of many wins', async () => {
    const { played, asked, follower } = following();
    void follower.follow({ upto: 10n ** 18n, perSecond: 0 });
    void follower.follow({ upto: 7n, perSecond: 0 });
    await settled();
    assert.deepEqual(played, [[6, 0.4]]);
    assert.deepEqual(asked[0], [10n ** 18n - 1n, 1n, 1]);
    await follower.follow({ upto: null, perSecond: 0 });
    await follower.follow({ upto: 0n, perSecond: 5 });
    await settled();
    assert.equal(played.length, 1);
});

test('walks of any length have notes at a rate that ears can follow', async () => {
    const { played, follower } = following();
    const perSecond = 1e30;
    for (let upto = 10n ** 29n; upto < 10n ** 30n; upto += 10n ** 28n) {
        await follower.follow({ upto, perSecond });
        await settled();
    }
    assert.ok(played.length > 5 && played.length <= 12, String(played.length));
});

test('branches sound together, at their own times', (context) => {
    context.mock.timers.enable({ apis: ['setInterval'] });
    Object.assign(globalThis, { window: globalThis });
    let now = 100;
    const played = /** @type {[number, number, number][]} */ ([]);
    const marked = /** @type {number[][][]} */ ([]);
    let hushed = 0;
    let shown = /** @type {import('../../js/motion/playback.js').Show | null} */ (null);
    const together = createTogether({
        now: () => now,
        play: ({ voice }, at, seconds) => void played.push([voice, at, seconds]),
        hush: () => void hushed++,
        present: (show) => {
            shown = show;
        },
        mark: (places) => void marked.push(places),
    });
    const pass = (/** @type {number} */ seconds) => {
        for (let tick = 0; tick < seconds * 100; tick++) {
            now += 0.01;
            context.mock.timers.tick(10);
        }
    };
    const notes = [
        note({ voice: 0, start: 0, fitted: [0] }),
        note({ voice: 0, start: 1, length: 3, fitted: [1] }),
        note({ voice: 1, start: 1, length: 2, fitted: [2] }),
        note({ voice: 2, start: 2, fitted: [3] }),
    ];
    together.begin({ notes: [...notes].reverse(), length: 4, step: 0.5, words: '' });
    pass(1.2);
    assert.deepEqual(marked.at(-1)?.flat().sort(), [1, 2, 3], 'three places sound after 1.2 s');
    assert.equal(shown?.words, '0:01 of 0:02 min');
    pass(1);
    const starts = played.map(([voice, at, seconds]) => [voice, Math.round((at - 100.03) * 100) / 100, seconds]);
    assert.deepEqual(starts.sort(), [
        [0, 0, 0.5],
        [0, 0.5, 1.5],
        [1, 0.5, 1],
        [2, 1, 0.5],
    ]);
    assert.deepEqual([shown?.playing, shown?.part, hushed], [false, 1, 0], 'the tune ends by itself');
    // By hand: from the middle on.
    shown?.seek(0.5);
    assert.equal(shown?.part, 0.5);
    shown?.toggle();
    pass(0.1);
    assert.deepEqual(
        played.slice(4).map(([voice]) => voice),
        [2],
    );
    shown?.toggle();
    assert.ok(!shown?.playing && hushed > 0);
    together.leave();
    assert.equal(shown, null);
    assert.deepEqual(marked.at(-1), []);
    assert.equal(timeText(75.9), '1:15');
});
