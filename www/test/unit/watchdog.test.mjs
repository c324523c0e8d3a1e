import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Stopped, createQuestions } from '../../js/engine/questions.js';
import { SILENCE, silenceAfter } from '../../js/engine/watchdog.js';
import { DEFAULTS, definitionOf } from '../../js/state/state.js';

test('silence counts only while the page is visible and the machine awake', () => {
    let silent = 0;
    let beats = 0;
    while (silent < SILENCE) {
        silent = silenceAfter(silent, 400, true);
        beats += 1;
    }
    assert.equal(beats, 10);
    assert.equal(silenceAfter(3600, 400, false), 0);
    assert.equal(silenceAfter(3600, 3_600_000, true), 0);
    // A busy page hears nothing meanwhile, so a late beat counts as at most two.
    assert.equal(silenceAfter(0, 3000, true), 500);
});

test('a fresh worker gets the open questions, except the one that stopped the former worker', async () => {
    let lastId = 0;
    /** @type {number[]} */
    let put = [];
    const questions = createQuestions({ post: ({ id }) => put.push(id), nextId: () => ++lastId });
    const thumb = { definition: definitionOf(DEFAULTS), width: 1, height: 1, camera: null, frame: null };
    const bad = questions.ask('thumb', thumb);
    const good = questions.ask('thumb', thumb);
    const pick = questions.ask('pick', { x: 0, y: 0, tolerance: 1 });
    assert.deepEqual(put, []);
    assert.equal(questions.refuseOne(1), 'thumb');
    assert.equal(questions.refuseOne(7), undefined);
    await assert.rejects(bad, Stopped);
    questions.refuseAboutDrawing();
    await assert.rejects(pick, Stopped);
    questions.putAll();
    assert.deepEqual(put, [2]);
    questions.forget();
    put = [];
    questions.putAll();
    assert.deepEqual(put, [2]);
    assert.ok(questions.answer({ type: 'thumb', id: 2, bitmap: null, missing: null }));
    assert.ok(!questions.answer({ type: 'thumb', id: 2, bitmap: null, missing: null }));
    assert.deepEqual(await good, { type: 'thumb', id: 2, bitmap: null, missing: null });
    assert.equal(questions.size, 0);
});

test('questions that stopped a worker are forbidden only for that definition', () => {
    const questions = createQuestions({ post: () => {}, nextId: () => 1 });
    const [one, other] = [definitionOf(DEFAULTS), definitionOf(DEFAULTS)];
    questions.forbid('pick', one);
    assert.ok(questions.isForbidden('pick', one));
    assert.ok(!questions.isForbidden('string', one));
    questions.forbid('string', other);
    assert.ok(!questions.isForbidden('pick', one));
});
