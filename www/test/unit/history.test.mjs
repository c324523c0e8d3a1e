import assert from 'node:assert/strict';
import { test } from 'node:test';
import { EMPTY, MERGE_MS, record, redo, settle, undo } from '../../js/state/history.js';
import { FIELDS, clean, same } from '../../js/state/state.js';
import { createStore } from '../../js/state/store.js';
import { dice, randomState } from './random.mjs';

test('quick changes by one control are one undo step, others are not', () => {
    const state = clean({ angle: 1 });
    let history = record(EMPTY, state, { angle: 2 }, 'angle', 0);
    history = record(history, clean({ angle: 2 }), { angle: 3 }, 'angle', 100);
    assert.equal(history.past.length, 1);
    assert.deepEqual(undo(history)?.patch, { angle: 1 });
    history = record(history, clean({ angle: 3 }), { angle: 4 }, 'angle', 200 + MERGE_MS);
    history = record(history, clean({ angle: 4 }), { iterations: 5 }, 'iterations', 210 + MERGE_MS);
    assert.equal(history.past.length, 3);
});

test('a drag is one undo step until it is released, even with pauses', () => {
    let history = record(EMPTY, clean({ angle: 1 }), { angle: 2 }, 'drag angle', 0);
    history = record(history, clean({ angle: 2 }), { angle: 3 }, 'drag angle', 10 * MERGE_MS);
    assert.equal(history.past.length, 1);
    history = record(settle(history), clean({ angle: 3 }), { angle: 4 }, 'drag angle', 10 * MERGE_MS + 1);
    assert.equal(history.past.length, 2);
    assert.deepEqual(undo(history)?.patch, { angle: 3 });
});

test('a control moved and moved back leaves nothing to undo', () => {
    let history = record(EMPTY, clean({ angle: 1 }), { angle: 2 }, 'angle', 0);
    history = record(history, clean({ angle: 2 }), { angle: 1 }, 'angle', 1);
    assert.equal(undo(history), null);
});

test('changes of long texts are dropped before they fill the memory, the oldest first', () => {
    let history = EMPTY;
    for (let step = 0; step < 100; step++) {
        const axiom = 'F'.repeat(1e6 + step);
        history = record(history, clean({ axiom: 'F' }), { axiom }, '', step);
    }
    assert.equal(history.past.length, 49);
    assert.equal(history.past.at(-1)?.after.axiom?.length, 1e6 + 99);
    const one = record(EMPTY, clean({}), { axiom: 'F'.repeat(6e7) }, '', 0);
    assert.equal(one.past.length, 1);
});

test('undo keeps the view unless the change moved it', () => {
    const store = createStore(clean({ axiom: 'F' }));
    store.change({ angle: 30 }, 'angle');
    store.setView({ x: 1, y: 2, zoom: 3 });
    store.undo();
    assert.equal(store.state.angle, 0);
    assert.deepEqual(store.state.view, { x: 1, y: 2, zoom: 3 });
    store.open({ axiom: 'G' });
    assert.equal(store.state.view, null);
    store.undo();
    assert.deepEqual(store.state.view, { x: 1, y: 2, zoom: 3 });
    assert.equal(store.state.axiom, 'F');
});

test('undo and redo of opening a system change what Reset returns to', () => {
    const store = createStore(clean({ axiom: 'F' }));
    const first = store.origin;
    store.change({ angle: 30 }, '');
    store.open({ axiom: 'G' });
    store.change({ angle: 60 }, '');
    store.undo();
    assert.equal(store.origin.axiom, 'G');
    store.undo();
    assert.deepEqual(store.origin, first);
    store.undo();
    store.redo();
    assert.deepEqual(store.origin, first);
    store.redo();
    assert.deepEqual(store.origin, clean({ axiom: 'G' }));
});

test('undo to the start and redo to the end pass the same states', () => {
    const roll = dice(7);
    for (let round = 0; round < 50; round++) {
        const store = createStore(randomState(roll));
        const states = [store.state];
        for (let step = 0; step < 20; step++) {
            const target = randomState(roll);
            const field = FIELDS[Math.floor(roll() * FIELDS.length)] ?? 'axiom';
            if (roll() < 0.1) store.open(target);
            else store.change({ [field]: target[field] }, roll() < 0.5 ? '' : `${field}${step}`);
            if (!same(store.state, states.at(-1))) states.push(store.state);
        }
        for (const state of states.slice(0, -1).reverse()) {
            assert.ok(store.undo());
            assert.deepEqual(store.state, state);
        }
        assert.ok(!store.canUndo && !store.undo());
        for (const state of states.slice(1)) {
            assert.ok(store.redo());
            assert.deepEqual(store.state, state);
        }
        assert.ok(!store.canRedo && !store.redo());
    }
});

test('a new change clears the redo list', () => {
    const store = createStore(clean({}));
    store.change({ axiom: 'A' }, '');
    store.undo();
    store.change({ axiom: 'B' }, '');
    assert.ok(!store.canRedo);
    store.undo();
    assert.equal(store.state.axiom, '');
    assert.ok(redo({ past: [], future: [] }) === null);
});
