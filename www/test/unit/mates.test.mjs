import assert from 'node:assert/strict';
import { mock, test } from 'node:test';
import { createMates, matesOn } from '../../js/engine/mates.js';

/** The smallest wasm module. */
const WASM = new WebAssembly.Module(new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0]));

test('the number of mates depends on cores and memory', () => {
    assert.equal(matesOn({}), 0);
    assert.equal(matesOn({ hardwareConcurrency: 1 }), 0);
    assert.equal(matesOn({ hardwareConcurrency: 2 }), 1);
    assert.equal(matesOn({ hardwareConcurrency: 64, deviceMemory: 8 }), 3);
    assert.equal(matesOn({ hardwareConcurrency: 8, deviceMemory: 2 }), 0);
    assert.equal(matesOn({ hardwareConcurrency: 0, deviceMemory: 4 }), 0);
});

/** A page with fake workers. @param {() => void} use @param {boolean} [refuses] */
function inPage(use, refuses = false) {
    const page = /** @type {any} */ (globalThis);
    const live = new Set();
    page.window = globalThis;
    page.document = { querySelector: () => null };
    page.Worker = class {
        constructor() {
            if (refuses) throw new Error('no workers here');
            live.add(this);
        }
        postMessage() {}
        terminate() {
            live.delete(this);
        }
    };
    mock.timers.enable({ apis: ['setTimeout'] });
    try {
        page.live = live;
        use();
    } finally {
        mock.timers.reset();
        for (const name of ['window', 'document', 'Worker', 'live']) delete page[name];
    }
}

/** @returns {Set<any>} */
const live = () => /** @type {any} */ (globalThis).live;

/** A fake worker that records its numbers of mates. */
function master() {
    /** @type {number[]} */
    const told = [];
    const worker = /** @type {any} */ ({
        postMessage: (/** @type {any} */ { ports }, /** @type {any} */ moved) =>
            told.push(ports.length) && moved?.forEach((/** @type {MessagePort} */ port) => port.close()),
    });
    return { worker, told };
}

test('mates stay while pictures are slow and end with their worker', () =>
    inPage(() => {
        const mates = createMates(3);
        const [first, second] = [master(), master()];
        mates.help(first.worker, WASM, WASM);
        mates.help(first.worker, WASM, WASM);
        assert.equal(live().size, 3);
        assert.deepEqual(first.told, [3]);
        mates.help(second.worker, WASM, WASM);
        assert.equal(live().size, 3);
        assert.deepEqual([first.told, second.told], [[3, 0], [3]]);
        mock.timers.tick(29_000);
        mates.help(second.worker, WASM, WASM);
        mock.timers.tick(29_000);
        assert.equal(live().size, 3);
        mock.timers.tick(2000);
        assert.equal(live().size, 0);
        assert.deepEqual(second.told, [3, 0]);
        mates.help(second.worker, WASM, WASM);
        assert.equal(live().size, 3);
        mates.leave();
        assert.equal(live().size, 0);
    }));

test('a failed mate is removed, and a page that may not start workers works without mates', () => {
    inPage(() => {
        const mates = createMates(2);
        mates.help(master().worker, WASM, WASM);
        const [broken, trapped] = [...live()];
        broken.onerror({ preventDefault() {} });
        assert.equal(live().size, 1);
        trapped.onmessage({ data: { type: 'ready' } });
        assert.equal(live().size, 1);
        trapped.onmessage({ data: { type: 'fatal' } });
        assert.equal(live().size, 0);
        mates.leave();
    });
    inPage(() => {
        const { worker, told } = master();
        const mates = createMates(2);
        mates.help(worker, WASM, WASM);
        mates.help(worker, WASM, WASM);
        assert.deepEqual(told, [0]);
        mates.leave();
    }, true);
});
