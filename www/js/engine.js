/**
 * The worker as seen from the page. Nothing is ever queued: it is at one state, one more is there for it to go on with,
 * the newest one waits, those between are forgotten. A state is let finish while it is quick, so that a long drag shows
 * pictures on the way; then newer ones supersede it. A worker that fails is replaced by a fresh one with the same state,
 * and so is the small kit of the first picture, by the full one.
 */

import { bytesOf, scriptAddress } from './files.js';
import { same } from './state.js';

/** @typedef {import('./state.js').Definition} Definition */
/** @typedef {import('./state.js').View} View */
/** @typedef {import('./state.js').Camera} Camera */
/** @typedef {'axiom' | 'rules' | 'overrides' | 'file' | 'numbers'} Field */

/**
 * @typedef {object} Diagnostic
 * @property {Field} field
 * @property {'warning' | 'error'} severity
 * @property {string} message
 * @property {string | null} hint
 * @property {number} start UTF-16 offset into the field
 * @property {number} end
 */

/**
 * What a definition means, or what is wrong with it.
 * @typedef {object} Report
 * @property {boolean} ok when false, the last good drawing stays
 * @property {Diagnostic[]} diagnostics
 * @property {string} kind `deterministic`, or those of `stochastic`, `context-sensitive`, `parametric` that hold, separated by commas
 * @property {boolean} beyond whether only the full kit can draw it, or say what is wrong with it
 * @property {boolean} stochastic
 * @property {boolean} solid whether the drawing leaves the plane
 * @property {boolean | null} memoised whether the drawing shares its blocks; null while unknown
 * @property {string | null} symbols exact decimal digits
 * @property {string | null} segments exact decimal digits
 * @property {number | null} blocks of the drawing; null while unknown
 * @property {number | null} largest the most iterations within the limits, where one was passed
 * @property {{symbol: string, actions: string, rewritten: boolean}[]} legend
 * @property {string | null} empty why nothing draws
 * @property {string} description the text alternative of the picture
 */

/** @typedef {{width: number, height: number, ratio: number}} Canvas width and height in device pixels */
/** @typedef {import('./reading/words.js').Link} Link */
/** @typedef {import('./reading/words.js').Stroke} Stroke */
/** @typedef {import('./reading/words.js').Filled} Filled */
/** How the picture is to be shown; only the first `upto` segments unless it is null. @typedef {{canvas: Canvas, view: View, camera: Camera | null, upto: bigint | null}} Look */
/**
 * A picture; `scale` is in device pixels per fitted extent at zoom 1, and `rough` tells that not every line is in its
 * place, for good. `pose` is the turtle's where only the first segments are shown: `at` in model units, `fitted` as places of
 * marks, `heading` in degrees, in space a vector.
 * @typedef {{id: number, viewId: number, complete: boolean, scale: number, rough: boolean, bitmap: ImageBitmap, pose: Pose | null} & Look} Drawn
 */
/** @typedef {{at: number[], fitted: number[], heading: number | number[], level: number}} Pose */
/** Symbols of a generation from `start` on, and how many it has, null where it is too long to be derived; `apart` tells that each ends with a line end. @typedef {{length: string | null, text: string | null, apart: boolean}} StringPage */
/** What a symbol has become: half-open ranges in decimal digits, the outline as places of marks. @typedef {{symbols: [string, string], segments: [string, string], outline: number[][]}} Part */
/** `ancestry` is empty and `part` null where neither is known; `stroke` is where its drawing begins. @typedef {{ancestry: Link[], part: Part | null, stroke: Stroke | null}} SymbolFacts */
/** One of `segment` and `polygon`, with `stroke` or `filled`, or nothing. @typedef {{segment: string | null, polygon: string | null, symbol: string | null, ancestry: Link[], stroke: Stroke | null, filled: Filled | null}} Picked */
/**
 * How texts read, be they right or wrong: the letter of its class for each UTF-16 unit, and the named constants of the rules.
 * @typedef {{axiom: string, rules: string, overrides: string, constants: Constant[]}} Notation
 */
/** `value` is null where it is wrong; it stands from `start` to `end` in the rules, and another number may take its place if it is one `number`. @typedef {{name: string, value: number | null, start: number, end: number, number: boolean}} Constant */
/** @typedef {{definition: Definition | null, diagnostics: Diagnostic[]}} FileRead */
/** @typedef {{text: string | null, bytes?: Uint8Array<ArrayBuffer>, diagnostics: Diagnostic[]}} Exported */
/** @typedef {ReturnType<typeof createEngine>} Engine */

/**
 * @typedef {object} Events
 * @property {(report: Report, id: number) => void} report
 * @property {(drawn: Drawn) => void} drawn
 * @property {(busy: boolean) => void} busy whether a newer state is under way than the one shown
 * @property {(message: string, again: boolean) => void} failed `again` tells whether a fresh worker has taken over
 */

/** States that are not drawn after this time are waited for no longer, in milliseconds. */
const PATIENCE = 250;

/** So many states are sent before the first of them is drawn: the worker need not wait while the page shows a picture. */
const AHEAD = 2;

/** The full kit is fetched so long after the first picture, in milliseconds. */
const IDLE = 500;

/** A worker that fails this often in a row with the same state is not started again. */
const MOST_FAILURES = 2;

/**
 * A worker and its wasm, by name.
 * @typedef {{worker: string, wasm: string}} Kit
 */

/**
 * @param {Kit[]} kits the one to start with, and the one that can do everything
 * @param {Events} events
 */
export function createEngine(kits, events) {
    let kit = kits[0];
    const full = kits[kits.length - 1];
    /** The wasm of the kit in use. @type {Promise<ArrayBuffer> | null} */
    let wasm = null;
    /** The full kit on its way. @type {Promise<void> | null} */
    let growing = null;
    /** @type {Worker | null} */
    let worker = null;
    /** Whether the worker has been handed the wasm, and whether it knows the newest state, so that it can be asked. */
    let ready = false;
    let askable = false;
    let lastId = 0;
    let failures = 0;
    /** @type {Definition | null} */
    let definition = null;
    /** @type {Look | null} */
    let look = null;
    /** @type {bigint | null} */
    let upto = null;
    /** What is newer than what was sent. */
    let defineWaits = false;
    let lookWaits = false;
    /** The last of each that was sent, by id. */
    let defineSent = 0;
    let lookSent = 0;
    /** The states that were sent and are not drawn yet, by their last ids, and the timer that ends the patience with them. @type {number[]} */
    let ahead = [];
    let patience = 0;
    /** The id under which a fresh worker was told what is shown already. */
    let recalled = 0;
    /** The timer that waits for a quiet moment to grow in. */
    let idle = 0;
    /** Views sent and not yet drawn. @type {Map<number, Look>} */
    const views = new Map();
    /** Questions without an answer yet. @type {Map<number, {request: object, resolve: (answer: any) => void, reject: (reason: Error) => void}>} */
    const asked = new Map();

    /** Who helps with pictures that take long. @type {{help: (worker: Worker, script: string, wasm: ArrayBuffer) => void, leave: () => void} | null} */
    let mates = null;
    /** Whether the last picture did. */
    let slow = false;

    /** The state that is shown at its finest. @type {{definition: Definition | null, look: Look | null}} */
    let shown = { definition: null, look: null };

    start();

    function start() {
        const fresh = new Worker(scriptAddress(kit.worker));
        employ(fresh);
        wasm ??= bytesOf(kit.wasm);
        wasm.then(
            (bytes) => {
                if (worker !== fresh) return;
                fresh.postMessage({ type: 'init', wasm: bytes });
                begin();
            },
            (error) => {
                wasm = null;
                if (worker === fresh) fail(error.message, true);
            },
        );
    }

    /** Puts a worker in the place of another, for the same state. @param {Worker} fresh */
    function employ(fresh) {
        mates?.leave();
        worker?.terminate();
        worker = fresh;
        ready = false;
        askable = false;
        views.clear();
        awaited([]);
        defineWaits = definition !== null;
        lookWaits = look !== null;
        fresh.onmessage = ({ data }) => worker === fresh && receive(data);
        fresh.onerror = (event) => {
            event.preventDefault();
            if (worker === fresh) fail(event.message || 'the worker did not start');
        };
    }

    /** The worker has its wasm: it is told the state, and asked what there is to ask. */
    function begin() {
        ready = true;
        recall();
        send();
        if (!recalled) putQuestions();
    }

    /** Questions are about the newest state, which the worker has to know. */
    function putQuestions() {
        if (askable) return;
        askable = true;
        for (const { request } of asked.values()) worker?.postMessage(request);
    }

    /** Tells a fresh worker first what is shown, which stays where what is newer cannot be drawn. */
    function recall() {
        recalled = 0;
        if (!worker || !shown.definition || !shown.look || shown.definition === definition) return;
        recalled = ++lastId;
        worker.postMessage({ type: 'define', id: recalled, definition: shown.definition, upto: shown.look.upto });
        tellLook(worker, shown.look);
        // Nothing else may come before it is drawn.
        awaited(Array(AHEAD).fill(lastId));
    }

    /** @param {Worker} to @param {Look} what */
    function tellLook(to, what) {
        lookSent = ++lastId;
        views.set(lookSent, what);
        to.postMessage({ type: 'view', id: lookSent, ...what.canvas, view: what.view, camera: what.camera, upto: what.upto });
    }

    function send() {
        if (!worker || !ready || ahead.length >= AHEAD || !(defineWaits || lookWaits)) return;
        if (definition && defineWaits) {
            defineWaits = false;
            defineSent = ++lastId;
            worker.postMessage({ type: 'define', id: defineSent, definition, upto });
        }
        if (look && lookWaits) {
            lookWaits = false;
            tellLook(worker, look);
        }
        awaited([...ahead, lastId]);
        putQuestions();
        events.busy(true);
    }

    /** Sets what is waited for. @param {number[]} ids of states */
    function awaited(ids) {
        clearTimeout(patience);
        ahead = ids;
        patience = ids.length > 0 ? window.setTimeout(() => goOn(), PATIENCE) : 0;
    }

    /** The states up to an id are drawn, or waited for no longer: the newest may follow. */
    function goOn(id = lastId) {
        awaited(ahead.filter((each) => each > id));
        send();
    }

    /** The newest state is shown, or cannot be. */
    function settle() {
        goOn();
        if (ahead.length === 0) events.busy(false);
    }

    /** @param {any} message */
    function receive(message) {
        const question = asked.get(message.id);
        switch (message.type) {
            case 'report':
                if (message.id === recalled) break;
                if (message.report.beyond) {
                    grow().catch(({ message: why }) => fail(why, true));
                    break;
                }
                // What is wrong is not drawn, nor what passes a limit.
                if (message.id === defineSent && isWrong(message.report)) settle();
                events.report(message.report, message.id);
                break;
            case 'drawn': {
                if (message.id === recalled) {
                    message.bitmap.close();
                    if (message.complete) goOn();
                    break;
                }
                failures = 0;
                const seen = views.get(message.viewId);
                for (const id of views.keys()) if (id < message.viewId) views.delete(id);
                slow = message.slow && kit === full;
                if (slow) help();
                const newest = message.id >= defineSent && message.viewId >= lookSent;
                // A worker that takes over begins with a coarse picture of what is shown at its finest already.
                const known = newest && !message.complete && shown.definition === definition && shown.look === look;
                if (seen && !known) events.drawn({ ...message, ...seen });
                if (newest && message.complete && !(defineWaits || lookWaits)) rest();
                // Only the finest is the end of it.
                if (newest && message.complete) settle();
                else goOn(Math.max(message.id, message.viewId));
                break;
            }
            case 'fatal':
                fail(message.message);
                break;
            default:
                asked.delete(message.id);
                question?.resolve(message);
        }
    }

    /** The next such picture is made by several workers. */
    async function help() {
        const helped = worker;
        const bytes = await wasm;
        if (helped && bytes && worker === helped) mates?.help(helped, full.worker, bytes);
    }

    /** @param {string} message @param {boolean} [hopeless] */
    function fail(message, hopeless = false) {
        mates?.leave();
        worker?.terminate();
        worker = null;
        failures += 1;
        for (const { reject } of asked.values()) reject(new Error(message));
        asked.clear();
        const again = !hopeless && failures < MOST_FAILURES;
        if (again) start();
        events.failed(message, again);
    }

    /** @param {object} question @returns {Promise<any>} */
    async function ask(question) {
        revive();
        await wasm;
        return new Promise((resolve, reject) => {
            if (!worker) return reject(new Error('the drawing engine has stopped'));
            const id = ++lastId;
            const request = { ...question, id };
            asked.set(id, { request, resolve, reject });
            if (askable) worker.postMessage(request);
        });
    }

    /** The picture is there: time for what it did not need. */
    function rest() {
        shown = { definition, look };
        // What fails here is tried again when it is needed.
        if (kit !== full && !growing && !idle) idle = window.setTimeout(() => grow().catch(() => {}), IDLE);
    }

    /** Goes over to the full kit, with the same state and the questions under way. The picture stays meanwhile. */
    function grow() {
        if (kit === full) return Promise.resolve();
        growing ??= fullWorker().catch((error) => {
            growing = null;
            throw error;
        });
        return growing;
    }

    /** The worker in use goes on until the full one is ready. */
    async function fullWorker() {
        const bytes = await bytesOf(full.wasm);
        const fresh = new Worker(scriptAddress(full.worker));
        await new Promise((resolve, reject) => {
            const refuse = (/** @type {string} */ why) => {
                fresh.terminate();
                reject(new Error(why));
            };
            fresh.onmessage = ({ data }) => (data.type === 'ready' ? resolve(null) : refuse(data.message));
            fresh.onerror = (event) => {
                event.preventDefault();
                refuse(event.message || 'the worker did not start');
            };
            fresh.postMessage({ type: 'init', wasm: bytes });
        });
        kit = full;
        wasm = Promise.resolve(bytes);
        employ(fresh);
        begin();
    }

    /** Asks what only the full kit can answer. @param {object} question @returns {Promise<any>} */
    async function askFull(question) {
        await grow();
        return ask(question);
    }

    /** After a failure for good, new input or a question is worth a fresh start. */
    function revive() {
        if (worker) return;
        failures = 0;
        start();
    }

    return {
        /** @param {Definition} newest */
        define(newest) {
            definition = newest;
            defineWaits = true;
            revive();
            send();
        },

        /** @param {Canvas} canvas @param {View} view of a drawing in the plane @param {Camera | null} [camera] of one in space */
        look(canvas, view, camera = null) {
            if (look && same(look.canvas, canvas) && same(look.view, view) && same(look.camera, camera)) return;
            look = { canvas, view, camera, upto };
            lookWaits = true;
            send();
        },

        /** Shows only the first segments; all of them with null. @param {bigint | null} segments */
        play(segments) {
            if (segments === upto) return;
            upto = segments;
            if (!look) return;
            look = { ...look, upto };
            lookWaits = true;
            send();
            // The turtle's pose is known to the full kit only.
            if (upto !== null) grow().catch(() => {});
        },

        /** From now on these help with pictures that take long. @param {NonNullable<typeof mates>} helpers */
        share(helpers) {
            mates = helpers;
            if (slow) help();
        },

        /** @param {number} generation @param {bigint} start @param {number} count @returns {Promise<StringPage>} */
        string: (generation, start, count) => askFull({ type: 'string', generation, start, count }),

        /** A symbol of a generation, and what it has become in the one that is drawn. @param {number} generation @param {bigint} index @returns {Promise<SymbolFacts>} */
        symbol: (generation, index) => askFull({ type: 'symbol', generation, index }),

        /** Where the symbols derived from another begin, in decimal digits. @param {number} generation @param {bigint} index @param {number} later @returns {Promise<string | null>} */
        descendant: async (generation, index, later) => (await askFull({ type: 'descendant', generation, index, later })).start,

        /** What is drawn near a place, in device pixels. @param {number} x @param {number} y @param {number} tolerance @returns {Promise<Picked>} */
        pick: (x, y, tolerance) => askFull({ type: 'pick', x, y, tolerance }),

        /** @param {{axiom: string, rules: string, overrides: string}} texts @returns {Promise<Notation>} */
        notation: (texts) => ask({ type: 'notation', texts }),

        /** @param {ArrayBuffer} bytes of a JSON file, or of a picture saved here @returns {Promise<FileRead>} */
        read: (bytes) => askFull({ type: 'read', bytes }),

        /** @param {'svg' | 'svg-compact' | 'csv' | 'txt' | 'json' | 'obj' | 'glb'} format @returns {Promise<Exported>} */
        export: (format) => askFull({ type: 'export', format }),

        /** @param {number} width @param {number} height @param {Definition} carried in the file, to open it again @returns {Promise<Blob | null>} */
        png: async (width, height, carried) => (await askFull({ type: 'png', width, height, definition: carried })).blob,

        /** The modules of a text's QR code, row by row, 1 for dark; null where it is too long. @param {string} text @returns {Promise<Uint8Array | null>} */
        qr: async (text) => (await askFull({ type: 'qr', text })).modules,

        /** @returns {Promise<number>} */
        seed: async () => (await ask({ type: 'seed' })).seed,

        /** @param {Definition} small @param {number} width @param {number} height @returns {Promise<ImageBitmap | null>} */
        thumb: async (small, width, height) => {
            const request = { type: 'thumb', definition: small, width, height };
            const { bitmap, beyond } = await ask(request);
            return beyond ? (await askFull(request)).bitmap : bitmap;
        },
    };
}

/** Whether there is a mistake that keeps a state from being drawn. @param {Report} report */
const isWrong = ({ ok, diagnostics }) => !ok || diagnostics.some(({ severity }) => severity === 'error');
