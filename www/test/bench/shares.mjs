/**
 * Measures slow pictures in space at 1600x1000, in the page's worker, alone and with mates: milliseconds from the view
 * to the finished picture, each time at another zoom, and the speedup by mates. Prints a table.
 */

import { close, withPage } from '../e2e/browser.mjs';

const TURNS = 9;

const TREE = {
    axiom: 'T',
    rules: 'T -> TF\nF -> F[+F][-FF][<F][>FF][&F]',
    dialect: 'practical',
    angle: 45,
    pitchUp: 50,
    pitchDown: 40,
    rollLeft: 30,
    rollRight: 30,
    width: 0.1,
    colourBy: 'level',
};
const LEAVES = {
    axiom: 'A',
    rules: "A -> [&FL!A]/////'[&FL!A]///////'[&FL!A]\nF -> S/////F\nS -> FL\nL -> ['''^^-f+f+f-|-f+f+f]",
    angle: 22.5,
    width: 0.1,
};

/** @type {[string, object, number, number][]} name, system, iterations, zoom */
const WORKS = [
    ['Practical 1, tree3d0', TREE, 8, 1],
    ['Practical 1, tree3d0', TREE, 20, 1],
    ['ABOP 1.25', LEAVES, 8, 1],
    ['ABOP 1.25', LEAVES, 20, 2],
];

/**
 * Runs in the page: the median time alone, and with a number of mates.
 * @param {{definition: object, zoom: number, turns: number, count: number}} work
 */
async function measure({ definition, zoom, turns, count }) {
    const [wasm, rest] = await Promise.all(
        ['lsystem.wasm', 'lsystem-rest.wasm'].map((name) => WebAssembly.compileStreaming(fetch(name))),
    );
    const workers = Array.from({ length: 1 + count }, () => new Worker('worker.js'));
    const [worker, ...mates] = /** @type {[Worker, ...Worker[]]} */ (workers);
    const ports = mates.map((mate) => {
        const { port1, port2 } = new MessageChannel();
        mate.postMessage({ type: 'init', wasm, master: port2 }, [port2]);
        mate.postMessage({ type: 'rest', wasm: rest });
        return port1;
    });
    worker.postMessage({ type: 'init', wasm });
    worker.postMessage({ type: 'rest', wasm: rest });
    let id = 0;
    worker.postMessage({ type: 'define', id: ++id, definition, upto: null });
    /** Draws at a slightly larger zoom, and waits for the finished picture. */
    const show = () =>
        new Promise((resolve) => {
            const began = performance.now();
            const viewId = ++id;
            worker.onmessage = ({ data }) => {
                if (data.type === 'fatal') throw new Error(data.message);
                data.bitmap?.close();
                if (data.type === 'drawn' && data.viewId === viewId && data.complete)
                    resolve(performance.now() - began);
            };
            const size = zoom * 1.0001 ** viewId;
            worker.postMessage({
                type: 'view',
                id: viewId,
                width: 1600,
                height: 1000,
                ratio: 1,
                view: { x: 0, y: 0, zoom: 1 },
                camera: { azimuth: 20, elevation: 12, zoom: size, x: 0, y: 0, z: 0, perspective: true, fade: 0 },
                upto: null,
            });
        });
    const median = async () => {
        await show();
        const times = [];
        for (let turn = 0; turn < turns; turn++) times.push(Number(await show()));
        return times.sort((a, b) => a - b)[Math.floor(turns / 2)] ?? NaN;
    };
    const alone = await median();
    worker.postMessage({ type: 'mates', ports }, ports);
    const shared = await median();
    for (const each of workers) each.terminate();
    return { alone, shared };
}

await withPage({ options: { viewport: { width: 1280, height: 800 } } }, async (page) => {
    const cores = await page.evaluate(() => navigator.hardwareConcurrency);
    const count = Number(process.env.MATES ?? Math.max(1, Math.min(cores - 1, 3)));
    console.log(
        `milliseconds at 1600x1000, ${cores} cores              alone   ${count === 1 ? '1 mate' : `${count} mates`}   ratio`,
    );
    for (const [name, system, iterations, zoom] of WORKS) {
        const { alone, shared } = await page.evaluate(measure, {
            definition: { ...system, iterations },
            zoom,
            turns: TURNS,
            count,
        });
        console.log(
            `${`${name}, n = ${iterations}, zoom ${zoom}`.padEnd(42)}${alone.toFixed(1).padStart(11)}${shared.toFixed(1).padStart(9)}${(alone / shared).toFixed(2).padStart(8)}`,
        );
    }
});
await close();
