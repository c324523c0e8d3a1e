/**
 * Which functions of the core a first picture calls: runs the page's worker over the systems of the gallery that lie in
 * the plane. Called by the build with the worker's script, a wasm whose exports named by numbers tell whether a function
 * was called (crates/xtask/src/split.rs), and the gallery. Prints the numbers.
 *
 * The clock goes on by a fixed time with each look at it, so that equal sources have equal parts.
 */

import { readFileSync } from 'node:fs';
import vm from 'node:vm';

/** @typedef {import('../js/protocol.js').ToWorker} ToWorker */
/** @typedef {import('../js/protocol.js').FromWorker} FromWorker */
/** @typedef {import('../js/protocol.js').Definition} Definition */

const [script, wasm, gallery] = process.argv.slice(2).map((name) => readFileSync(name));
if (!script || !wasm || !gallery) throw new Error('needs a script, a wasm and a gallery');
const module = new WebAssembly.Module(wasm);

class Context {
    putImageData() {}
}

class Canvas {
    width = 0;
    height = 0;
    getContext = () => new Context();
    transferToImageBitmap = () => null;
}

/** Starts a worker in a scope of its own, whose clock goes on by `tick` milliseconds with each look. @param {number} tick @returns what tells it a message and returns its answers after all its work */
function hire(tick) {
    let time = 0;
    /** @type {(() => void)[]} */
    const tasks = [];
    /** @type {FromWorker[]} */
    let answers = [];
    class MessageChannel {
        port1 = { onmessage: (/** @type {object} */ _) => {} };
        port2 = { postMessage: () => tasks.push(() => this.port1.onmessage({})) };
    }
    /** @type {Record<string, any>} */
    const scope = {
        WebAssembly,
        OffscreenCanvas: Canvas,
        OffscreenCanvasRenderingContext2D: Context,
        ImageData: class {},
        MessageChannel,
        TextDecoder,
        TextEncoder,
        crypto,
        // The core knows its scope by the class.
        WorkerGlobalScope: { [Symbol.hasInstance]: () => true },
        performance: { now: () => (time += tick) },
        setTimeout: (/** @type {() => void} */ task) => tasks.push(task),
        postMessage: (/** @type {FromWorker} */ answer) => answers.push(answer),
    };
    scope.self = scope;
    vm.runInNewContext(String(script), scope);
    return (/** @type {ToWorker} */ message) => {
        answers = [];
        scope.onmessage({ data: message });
        for (let task = tasks.shift(); task; task = tasks.shift()) task();
        const stopped = answers.find(({ type }) => type === 'fatal');
        if (stopped) throw new Error(JSON.stringify(stopped));
        return answers;
    };
}

/** @type {WebAssembly.Exports[]} */
const started = [];
WebAssembly.Instance = class extends WebAssembly.Instance {
    /** @param {WebAssembly.Module} of @param {WebAssembly.Imports} [imports] */
    constructor(of, imports) {
        super(of, imports);
        started.push(this.exports);
    }
};

let id = 0;
/** @param {Definition & {still?: boolean}} definition @returns {ToWorker} */
const define = (definition) => ({ type: 'define', id: ++id, definition, upto: null });

const reading = hire(0);
reading({ type: 'init', wasm: module });
const plane = /** @type {{definition: Definition}[]} */ (JSON.parse(String(gallery)))
    .map(({ definition }) => definition)
    .filter((definition) => !reading(define(definition)).some((it) => it.type === 'report' && it.report.space));

/** A machine that draws most pictures in one step, and one that needs many steps. */
for (const tick of [0.01, 3]) {
    const drawing = hire(tick);
    drawing({ type: 'init', wasm: module, words: { language: 'de', words: {} } });
    const canvas = { width: 800, height: 600, ratio: 1 };
    /** @param {number} zoom @param {number} [x] @param {number} [y] @returns {ToWorker} */
    const look = (zoom, x = 0, y = 0) => ({
        type: 'view',
        id: ++id,
        view: { x, y, zoom },
        camera: null,
        upto: null,
        ...canvas,
    });
    for (const definition of plane) {
        drawing(look(1));
        // As it is, with the look of systems without one, while it grows, and near by.
        const grown = [0, 1, 2].map((iterations) => ({ ...definition, iterations, growth: 0.4, still: true }));
        for (const variant of [...grown, { ...definition, auto: true }, definition]) drawing(define(variant));
        for (const zoom of [2, 40]) drawing(look(zoom, 0.1, 0.05));
        const { axiom, rules, overrides } = definition;
        drawing({ type: 'notation', id: ++id, texts: { axiom, rules, overrides } });
    }
}
/** @type {Set<string>} */
const called = new Set();
// The first worker has also read the systems in space.
for (const exports of started.slice(1))
    for (const [name, mark] of Object.entries(exports))
        if (/^\d+$/.test(name) && /** @type {WebAssembly.Global} */ (mark).value) called.add(name);
process.stdout.write([...called].join('\n'));
