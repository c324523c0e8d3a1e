import assert from 'node:assert/strict';
import test from 'node:test';
import { createHold } from '../../js/stage/hold.js';

/** A stage whose places are pixels from the middle, and its hold. @param {(number[] | null)[]} found in order */
function stage(found) {
    /** @type {{at: string | undefined, asked: number}} */
    const state = { at: undefined, asked: 0 };
    const hold = createHold({
        grip: async () => {
            state.asked++;
            return found.shift() ?? null;
        },
        origin: () => state.at,
        seen: ([x = 0, y = 0]) => [x, y],
    });
    return { state, hold };
}

test('a held place is held until the pointer leaves it', async () => {
    const { state, hold } = stage([[3, 4], null]);
    assert.equal(hold.at([0, 0]), null);
    await null;
    await null;
    assert.deepEqual(hold.at([0, 0]), [3, 4]);
    assert.deepEqual(hold.at([30, 4]), [3, 4]);
    assert.equal(state.asked, 1);
    assert.equal(hold.at([90, 4]), null);
    assert.equal(state.asked, 2);
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
