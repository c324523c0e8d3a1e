/**
 * Measures drawings in space at 1600x1000, in the worker: the time of the first picture while the camera turns, and the
 * time to the finest picture, beside drawing each segment as a line of a canvas, if that ends. Prints a table.
 */

import { close, withModules, withPage } from '../e2e/browser.mjs';

const TURNS = 24;
/** The most segments that are drawn as lines of a canvas. */
const MOST = 2e6;

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
const BUSH = {
    axiom: 'A',
    rules: "A -> [&FL!A]/////'[&FL!A]///////'[&FL!A]\nF -> S/////F\nS -> FL\nL -> ['''^^-f+f+f-|-f+f+f]",
    angle: 22.5,
    width: 0.1,
};
const CHANCE = { axiom: 'A', rules: 'A -> [&FA]/////[&FA]/////[&FA] : 1\nA -> FA : 0.0001', angle: 24 };

/** @type {[string, object, number[]][]} */
const WORKS = [
    ['Practical 1, tree3d0', TREE, [8, 12, 20, 30]],
    ['ABOP 1.25', BUSH, [8, 12, 20, 30]],
    ['materialised', CHANCE, [11]],
];

/**
 * Runs in the page.
 * @param {{definition: object, turns: number, most: number}} work
 */
async function measure({ definition, turns, most }) {
    const worker = new Worker('worker.js');
    const [wasm, joining] = await Promise.all(
        ['lsystem.wasm', 'lsystem-rest.wasm'].map((name) => WebAssembly.compileStreaming(fetch(name))),
    );
    /** @type {(message: any) => void} */
    let heard = () => {};
    worker.onmessage = ({ data }) => heard(data);
    /** @param {(message: any) => boolean} wanted @returns {Promise<any>} */
    const next = (wanted) =>
        new Promise((resolve, reject) => {
            heard = (message) => {
                const wrong = message.report?.diagnostics.find(
                    (/** @type {any} */ { severity }) => severity === 'error',
                );
                if (wrong) reject(new Error(wrong.message));
                if (wanted(message)) resolve(message);
            };
        });
    const ready = next(({ type }) => type === 'ready');
    worker.postMessage({ type: 'init', wasm });
    worker.postMessage({ type: 'rest', wasm: joining });
    await ready;
    let id = 0;
    const camera = { azimuth: 0, elevation: 12, zoom: 1, x: 0, y: 0, z: 0, perspective: true, fade: 0 };
    /** @param {number} azimuth */
    const look = (azimuth) =>
        worker.postMessage({
            type: 'view',
            id: ++id,
            width: 1600,
            height: 1000,
            ratio: 1,
            view: { x: 0, y: 0, zoom: 1 },
            camera: { ...camera, azimuth },
            upto: null,
        });
    const began = performance.now();
    const drawn = next(({ type }) => type === 'drawn');
    worker.postMessage({ type: 'define', id: ++id, definition, upto: null });
    look(0);
    await drawn;
    const first = performance.now() - began;
    /** @type {number[]} */
    const moving = [];
    for (let turn = 1; turn <= turns; turn++) {
        const start = performance.now();
        const picture = next(({ type, viewId }) => type === 'drawn' && viewId === id);
        look(turn * 3);
        (await picture).bitmap.close();
        moving.push(performance.now() - start);
    }
    const start = performance.now();
    const finest = next(({ type, viewId, complete }) => type === 'drawn' && viewId === id && complete);
    look(200);
    await finest;
    const rest = performance.now() - start;
    worker.terminate();
    const { createExports } = await import(new URL('js/save/exports.js', document.baseURI).href);
    const { blob } = await createExports().make({ definition, format: 'csv', options: {}, camera: null });
    const text = await blob?.text();
    let lines = NaN;
    const rows = text?.trimEnd().split('\n').slice(1) ?? [];
    if (rows.length > 0 && rows.length <= most) {
        const ends = Float64Array.from(
            rows.flatMap((/** @type {string} */ row) => row.split(',').slice(0, 6).map(Number)),
        );
        const context = /** @type {OffscreenCanvasRenderingContext2D} */ (
            new OffscreenCanvas(1600, 1000).getContext('2d')
        );
        const start = performance.now();
        for (let at = 0; at < ends.length; ) {
            context.beginPath();
            for (const last = Math.min(ends.length, at + 6000); at < last; at += 6) {
                const seen = (/** @type {number} */ from) => {
                    const [x, y, z] = [Number(ends[from]), Number(ends[from + 1]), Number(ends[from + 2])];
                    return /** @type {[number, number]} */ ([
                        800 + 10 * (0.9 * x - 0.4 * z),
                        900 - 10 * (0.98 * y - 0.2 * (0.4 * x + 0.9 * z)),
                    ]);
                };
                context.moveTo(...seen(at));
                context.lineTo(...seen(at + 3));
            }
            context.stroke();
        }
        context.getImageData(0, 0, 1, 1);
        lines = performance.now() - start;
    }
    return { first, moving, rest, lines, segments: rows.length };
}

const number = (/** @type {number} */ value) =>
    (Number.isNaN(value) ? '-' : value.toFixed(value < 100 ? 1 : 0)).padStart(9);

console.log('milliseconds at 1600x1000             first  moving: median     worst  at rest    lines of a canvas');
await withPage({ before: withModules, options: { viewport: { width: 1280, height: 800 } } }, async (page) => {
    for (const [name, system, iterations] of WORKS) {
        for (const n of iterations) {
            const { first, moving, rest, lines } = await page.evaluate(measure, {
                definition: { ...system, iterations: n },
                turns: TURNS,
                most: MOST,
            });
            // Moving pictures adapt their quality first.
            const settled = moving.slice(moving.length / 3).sort((a, b) => a - b);
            const median = Number(settled[Math.floor(settled.length / 2)]);
            console.log(
                `${`${name}, n = ${n}`.padEnd(32)}${number(first)}${number(median).padStart(16)}${number(Number(settled.at(-1)))}${number(rest)}${number(lines).padStart(21)}`,
            );
        }
    }
});
await close();
