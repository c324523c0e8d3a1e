import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Stopped, createQuestions } from '../../js/questions.js';
import { SILENCE, silenceAfter } from '../../js/watchdog.js';

test('silence is counted while the page is visible, and anew after sleep', () => {
    let silent = 0;
    let beats = 0;
    while (silent < SILENCE) {
        silent = silenceAfter(silent, 400, true);
        beats += 1;
    }
    assert.equal(beats, 10);
    assert.equal(silenceAfter(3600, 400, false), 0);
    assert.equal(silenceAfter(3600, 3_600_000, true), 0);
    // A page that was busy for a while heard nothing for that long, whoever spoke.
    assert.equal(silenceAfter(0, 3000, true), 500);
});

test('a fresh worker is asked what is open, and not what stopped the one before', async () => {
    const questions = createQuestions();
    const bad = questions.add({ type: 'thumb', id: 1 });
    const good = questions.add({ type: 'thumb', id: 2 });
    const file = questions.add({ type: 'export', id: 3 });
    assert.equal(questions.refuseOne(1, new Stopped('bad')), 'thumb');
    assert.equal(questions.refuseOne(7, new Stopped('no question')), undefined);
    await assert.rejects(bad, Stopped);
    questions.refuseAboutDrawing(new Stopped('the drawing was given up'));
    await assert.rejects(file, Stopped);
    /** @type {number[]} */
    const put = [];
    questions.putAll(/** @type {any} */ ({ postMessage: (/** @type {{id: number}} */ { id }) => put.push(id) }));
    assert.deepEqual(put, [2]);
    assert.ok(questions.answer({ id: 2 }));
    assert.ok(!questions.answer({ id: 2 }));
    assert.deepEqual(await good, { id: 2 });
    assert.equal(questions.size, 0);
});
