/** Random messages from a host to an embedded drawing. */

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CONTROLS } from '../../js/embed/options.js';
import { readLink, writeLink } from '../../js/state/link.js';
import { clean } from '../../js/state/state.js';
import { createStore } from '../../js/state/store.js';
import { damaged, junk, junkLink, junkObject, pick, whole } from './junk.mjs';
import { dice, randomState } from './random.mjs';

const ROUNDS = Number(process.env.LSYSTEM_CASES ?? 200);

/** A random message of a host. @param {() => number} roll @param {number} id */
function message(roll, id) {
    return pick(roll, [
        () => junk(roll),
        () => ({ lsystem: junk(roll, 1), ...junkObject(roll, 2) }),
        () => ({
            lsystem: 'set',
            values: pick(roll, [junk(roll), junkObject(roll), { angle: roll() * 90, n: whole(roll, 9) }]),
        }),
        () => ({
            lsystem: 'open',
            link: pick(roll, [junkLink(roll), junk(roll, 1), damaged(roll, writeLink(randomState(roll)))]),
        }),
        () => ({ lsystem: pick(roll, ['reset', 'play', 'pause', 'hello']), id: junk(roll, 1) }),
        () => ({ lsystem: 'controls', controls: junk(roll, 2) }),
        () => ({ lsystem: 'theme', theme: pick(roll, ['light', 'dark', '', junk(roll, 1)]) }),
        () => ({ lsystem: 'get', id }),
    ])();
}

test('after any messages the drawing is valid and answers', async (context) => {
    /** @type {any[]} */
    const said = [];
    /** @type {(event: any) => void} */
    let hear = () => {};
    const holder = { postMessage: (/** @type {any} */ words) => void said.push(structuredClone(words)) };
    Object.assign(globalThis, {
        window: globalThis,
        parent: holder,
        addEventListener: (/** @type {string} */ _, /** @type {typeof hear} */ listener) => (hear = listener),
    });
    const { connectHost } = await import('../../js/embed/messages.js');
    const store = createStore(clean({ axiom: 'F', rules: 'F -> F+F', iterations: 3 }));
    connectHost(store, {
        host: null,
        offer: (controls) => assert.ok(controls.every((one) => CONTROLS.includes(one))),
        theme: (theme) => assert.ok(theme === null || theme === 'light' || theme === 'dark'),
        play: (on) => assert.equal(typeof on, 'boolean'),
        facts: () => ({ description: '', symbols: null, segments: null }),
    });
    // An object without a text form used to throw.
    for (const name of [{ toString: 7 }, [{ toString: 7 }]]) {
        hear({ source: holder, origin: 'null', data: { lsystem: name } });
        hear({ source: holder, origin: 'null', data: { lsystem: 'controls', controls: name } });
    }
    for (let round = 0; round < ROUNDS; round++) {
        const roll = dice(round * 7919);
        try {
            hear({ source: holder, origin: pick(roll, ['https://example.org', 'null']), data: message(roll, round) });
            if (round % 20 !== 19) continue;
            said.length = 0;
            hear({ source: holder, origin: 'null', data: { lsystem: 'get', id: `${round}` } });
            await until(() => said.some((words) => words.lsystem === 'state' && words.id === `${round}`));
            assert.deepEqual(clean(store.state), store.state);
            assert.deepEqual(readLink(writeLink(store.state))?.state, store.state);
        } catch (error) {
            throw new Error(`message ${round}`, { cause: error });
        }
    }
    // Messages of other windows than the host are ignored.
    said.length = 0;
    hear({ source: {}, origin: 'https://example.org', data: { lsystem: 'get', id: 'another' } });
    await new Promise((resolve) => setTimeout(resolve, 100));
    assert.ok(said.every(({ id }) => id !== 'another'));
    context.diagnostic(`${ROUNDS} messages`);
});

/** Waits until this is so. A test that waits for ever is ended by its runner. @param {() => boolean} check */
async function until(check) {
    while (!check()) await new Promise((resolve) => setTimeout(resolve, 1));
}
