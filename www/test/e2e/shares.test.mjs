import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { close, nextPicture, picture, quiet, stillPicture, until, withPage } from './browser.mjs';

after(close);

const TREE =
    '#v=1&axiom=T&rules=T%20-%3E%20TF%0AF%20-%3E%20F%5B+F%5D%5B-FF%5D%5B%3CF%5D%5B%3EFF%5D%5B%26F%5D&n=8&angle=40&turtle=practical';
const CHANCE =
    '#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5D%5B%26F%5DF%20:%201%0AF%20-%3E%20F%5B-F%5D%5B%5EF%5DF%20:%201&n=9&angle=25';
const BUSH = '#v=1&axiom=F&rules=F%20-%3E%20FF-%5B-F+F+F%5D+%5B+F-F-F%5D&n=12&angle=22.5';
const LEAF = '#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5DF&n=4&angle=25';

/**
 * Runs in the page: a worker makes pictures alone, and then with a mate whose messages pass through here. Returns how
 * much the pictures differ, and how many panes the mate has drawn. A mate that is `lost` answers nothing; with `drags`
 * there are other views before the last.
 * @param {{definition: object, lost?: boolean, drags?: number}} work
 */
async function compare({ definition, lost = false, drags = 0 }) {
    const [wasm, rest] = await Promise.all(
        ['lsystem.wasm', 'lsystem-rest.wasm'].map((name) => WebAssembly.compileStreaming(fetch(name))),
    );
    const [worker, mate] = [new Worker('worker.js'), new Worker('worker.js')];
    const [near, far] = [new MessageChannel(), new MessageChannel()];
    let [made, stopped] = [0, 0];
    let asked = () => {};
    near.port1.onmessage = ({ data }) => {
        if (data.round === 0) stopped += 1;
        else asked();
        if (!lost) far.port1.postMessage(data);
    };
    far.port1.onmessage = ({ data }) => {
        if (data.made) made += 1;
        near.port1.postMessage(data);
    };
    mate.postMessage({ type: 'init', wasm, master: far.port2 }, [far.port2]);
    worker.postMessage({ type: 'init', wasm });
    for (const each of [worker, mate]) each.postMessage({ type: 'rest', wasm: rest });
    let id = 0;
    worker.postMessage({ type: 'define', id: ++id, definition, upto: null });
    /** @param {number} zoom */
    const look = (zoom) =>
        worker.postMessage({
            type: 'view',
            id: ++id,
            width: 640,
            height: 480,
            ratio: 2,
            view: { x: 0, y: 0, zoom: 1 },
            camera: { azimuth: 20, elevation: 12, zoom, x: 0, y: 0, z: 0, perspective: true, fade: 0 },
            upto: null,
        });
    /** The finished picture of the last view. @returns {Promise<Uint8ClampedArray>} */
    const finished = () =>
        new Promise((resolve, reject) => {
            worker.onmessage = ({ data }) => {
                if (data.type === 'fatal') return reject(new Error(data.message));
                if (data.type !== 'drawn' || data.viewId !== id || !data.complete) return data.bitmap?.close();
                const sheet = new OffscreenCanvas(640, 480).getContext('2d');
                sheet?.drawImage(data.bitmap, 0, 0);
                if (sheet) resolve(sheet.getImageData(0, 0, 640, 480).data);
            };
        });
    look(1.01);
    await finished();
    look(1);
    const alone = await finished();
    worker.postMessage({ type: 'mates', ports: [near.port2] }, [near.port2]);
    for (let drag = 0; drag < drags; drag++) {
        // The next view comes while the mate draws panes.
        const begun = /** @type {Promise<void>} */ (new Promise((resolve) => (asked = resolve)));
        look(1.5 + 0.01 * drag);
        await begun;
    }
    look(1.01);
    await finished();
    look(1);
    const shared = await finished();
    worker.terminate();
    mate.terminate();
    let [sum, ink] = [0, 0];
    for (let at = 0; at < alone.length; at++) {
        sum += Math.abs(Number(alone[at]) - Number(shared[at]));
        if (alone[at] !== alone[at % 4]) ink += 1;
    }
    return { mean: sum / alone.length, ink: ink / alone.length, made, stopped };
}

const WOOD = {
    axiom: 'T',
    rules: 'T -> TF\nF -> F[+F][-FF][<F][>FF][&F]',
    dialect: 'practical',
    angle: 40,
    iterations: 8,
    colourBy: 'level',
};
const LEAVES = {
    axiom: 'A',
    rules: "A -> [&FL!A]/////'[&FL!A]///////'[&FL!A]\nF -> S/////F\nS -> FL\nL -> ['''^^-f+f+f-|-f+f+f]",
    angle: 22.5,
    width: 0.1,
    iterations: 8,
};

test('pictures drawn with a mate equal pictures drawn alone', () =>
    withPage({}, async (page) => {
        for (const definition of some([LEAVES, WOOD])) {
            const { mean, ink, made } = await page.evaluate(compare, { definition });
            assert.equal(mean, 0);
            assert.ok(ink > 0.003 && made > 0, JSON.stringify({ ink, made }));
        }
    }));

test('newer views supersede shared pictures, also for mates', () =>
    withPage({}, async (page) => {
        const { mean, made, stopped } = await page.evaluate(compare, { definition: WOOD, drags: 8 });
        assert.equal(mean, 0);
        assert.ok(made > 0 && stopped > 0);
    }));

test('the picture is complete without the answers of a mate', () =>
    withPage({}, async (page) => {
        for (const definition of some([LEAVES, WOOD])) {
            const { mean, ink, made } = await page.evaluate(compare, { definition, lost: true });
            assert.equal(mean, 0);
            assert.ok(ink > 0.003);
            assert.equal(made, 0);
        }
    }));

/** Simulates a machine with this many cores, and lists the workers of the page for the test. @param {number} cores */
const machine = (cores) => (/** @type {import('playwright-core').Page} */ page) =>
    page.addInitScript((count) => {
        Object.defineProperty(navigator, 'hardwareConcurrency', { get: () => count });
        Object.defineProperty(navigator, 'deviceMemory', { get: () => 8, configurable: true });
        const page = /** @type {any} */ (globalThis);
        page.workers = [];
        const Own = Worker;
        page.Worker = class extends Own {
            /** @param {[string]} how */
            constructor(...how) {
                super(...how);
                page.workers.push(this);
            }
        };
    }, cores);

/** @param {import('playwright-core').Page} page */
const patient = (page) => until(() => stillPicture(page), 'a picture');

test('the page hires mates for a slow picture, and the picture is the same without mates', async () => {
    /** @type {string[][]} */
    const seen = [];
    for (const cores of [1, 4]) {
        await withPage({ hash: TREE, before: machine(cores) }, async (page) => {
            const first = await patient(page);
            // The main worker and its mates.
            await until(() => page.workers().length === cores, `${cores} workers`);
            await page.focus('#drawing');
            await page.keyboard.press('Shift+ArrowLeft');
            const moved = await nextPicture(page, first);
            seen.push([first.digest, moved.digest]);
            if (cores === 1) return;
            await page.evaluate(() =>
                /** @type {any} */ (globalThis).workers
                    .slice(-3)
                    .forEach((/** @type {Worker} */ mate) => mate.terminate()),
            );
            await page.keyboard.press('Shift+ArrowRight');
            await until(async () => (await picture(page)).digest === first.digest, 'the first picture again');
            await page.evaluate((next) => (location.hash = next), LEAF);
            await nextPicture(page, first);
        });
    }
    assert.deepEqual(seen[0], seen[1]);
});

test('drawings that are not memoised and drawings in the plane are not shared', async () => {
    // In space a worker with the whole core follows the first one.
    for (const [hash, workers] of /** @type {const} */ ([
        [CHANCE, 2],
        [BUSH, 1],
    ])) {
        await withPage({ hash, before: machine(4) }, async (page) => {
            await patient(page);
            const hired = () => page.evaluate(() => /** @type {any} */ (globalThis).workers.length);
            await quiet(300, 'mates would be hired');
            assert.equal(await hired(), workers);
            assert.equal(page.workers().length, 1);
        });
    }
});
