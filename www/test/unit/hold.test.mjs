import assert from 'node:assert/strict';
import test from 'node:test';
import { createHold } from '../../js/view/hold.js';

/** A stage whose places are pixels from the middle at a zoom of 1, and its hold. @param {(number[] | null)[]} found in order */
function stage(found) {
    /** @type {{at: string | undefined, asked: number, zoom: number, shift: [number, number]}} */
    const state = { at: undefined, asked: 0, zoom: 1, shift: [0, 0] };
    const hold = createHold({
        grip: async () => {
            state.asked++;
            return found.shift() ?? null;
        },
        origin: () => state.at,
        seen: ([x = 0, y = 0]) => [x * state.zoom + state.shift[0], y * state.zoom + state.shift[1]],
        zoom: () => state.zoom,
        shift: (dx, dy) => {
            state.shift = [state.shift[0] + dx, state.shift[1] + dy];
        },
    });
    return { state, hold };
}

test('a held place is held until the pointer leaves it', async () => {
    const { state, hold } = stage([[3, 4], null]);
    assert.equal(hold.at([0, 0]), null);
    await new Promise(setImmediate);
    assert.deepEqual(hold.at([0, 0]), [3, 4]);
    assert.deepEqual(hold.at([30, 4]), [3, 4]);
    assert.equal(state.asked, 1);
    assert.equal(hold.at([90, 4]), null);
    assert.equal(state.asked, 2);
});

test('a line that was driven away while it was looked for is brought back', async () => {
    const { state, hold } = stage([[3, 4]]);
    for (const zoom of [1, 20, 400]) {
        state.zoom = zoom;
        assert.equal(hold.at([0, 0]), null);
    }
    await new Promise(setImmediate);
    assert.deepEqual(hold.at([0, 0]), [3, 4]);
    assert.deepEqual(state.shift, [3 - 1200, 4 - 1600]);
    assert.equal(state.asked, 1);
});

test('a line that was not near is left where it is', async () => {
    const { state, hold } = stage([[30, 40]]);
    hold.at([0, 0]);
    state.zoom = 2;
    await new Promise(setImmediate);
    assert.deepEqual(state.shift, [0, 0]);
});

test('a place means nothing from another origin', async () => {
    const { state, hold } = stage([
        [3, 4],
        [5, 6],
    ]);
    assert.deepEqual(await hold.inMiddle(40), [3, 4]);
    state.at = '17.25';
    assert.deepEqual(await hold.inMiddle(40), [5, 6]);
});

test('a held place is found again, and none is found without one', async () => {
    const { state, hold } = stage([
        [3, 4],
        [0, 0],
    ]);
    assert.equal(await hold.again(), false);
    assert.equal(state.asked, 0);
    await hold.inMiddle(40);
    assert.equal(await hold.again(), true);
    assert.deepEqual(hold.at([0, 0]), [0, 0]);
});
