/**
 * The page's worker: keeps one Playground between edits and draws. It stands behind the generated glue, which defines
 * `wasm_bindgen`, and behind sharing.js in one classic script, because a classic worker also starts from a blob.
 *
 * It keeps only the newest `define` and `view` it has seen, works in steps of at most 8 ms, and returns to its event
 * loop between steps, so that newer input supersedes older. What it is at may finish first while it is quick, so that
 * there are pictures on the way of a long drag.
 */

/** @typedef {wasm_bindgen.Playground} Playground */
/** @typedef {import('./js/protocol.js').Sight} Sight */
/** @typedef {import('./js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('./js/protocol.js').Question<T>} Question */
/** @template {Asked} [T=Asked] @typedef {import('./js/protocol.js').Answer<T>} Answer */
/** @typedef {import('./js/protocol.js').Questions} Questions */
/** @typedef {import('./js/protocol.js').Reading} Reading */
/** What has come from the page and was not yet acted on: the newest state and view, and questions, answered in turn. @typedef {{define: import('./js/protocol.js').Define | null, view: Sight | null, questions: Exclude<Question, Question<'thumb'>>[]}} Inbox */
/** What a step of a playground gives. @typedef {{report: import('./js/protocol.js').Report | null, drawn: {complete: boolean, scale: number, moving: boolean, rough: boolean, slow: boolean} | null, idle: boolean}} Step */

const STEP_MS = 8;

/** The page. @type {import('./js/protocol.js').Channel<import('./js/protocol.js').FromWorker, import('./js/protocol.js').ToWorker>} */
const page = self;

/** Receives the page's messages, and works between them. */
(() => {
    const canvas = new OffscreenCanvas(1, 1);
    const channel = new MessageChannel();
    /** @type {Inbox} */
    const inbox = { define: null, view: null, questions: [] };
    /** @type {Question<'thumb'>[]} */
    const thumbs = [];
    /** Does the next of what there is to do; null until the wasm is there. @type {(() => void) | null} */
    let work = null;
    /** Has these mates from now on. @type {(ports: MessagePort[]) => void} */
    let meet = () => {};
    let awake = false;
    let dead = false;

    page.onmessage = ({ data }) => {
        // That this is answered shows that the worker comes back to its event loop.
        if (data.type === 'ping') return page.postMessage({ type: 'pong' });
        if (data.type === 'init') return guard(() => start(data));
        if (data.type === 'mates') return guard(() => meet(data.ports));
        if (data.type === 'define') inbox.define = data;
        else if (data.type === 'view') inbox.view = data;
        else if (data.type === 'thumb') thumbs.push(data);
        else inbox.questions.push(data);
        wake();
    };
    channel.port1.onmessage = () => {
        awake = false;
        guard(() => work?.());
    };

    /** @param {import('./js/protocol.js').Init} init */
    function start({ wasm, master }) {
        const instance = wasm_bindgen.initSync({ module: wasm });
        const memory = () => instance.memory.buffer.byteLength;
        const playground = new wasm_bindgen.Playground(canvas);
        if (master) {
            work = createMate({ master, playground, wake, lookAt: (sight) => lookAt(playground, sight), memory, stepMs: STEP_MS });
        } else {
            const drawing = createDrawing({ playground, canvas, inbox });
            const sharing = createSharing({ canvas, playground, guard, wake, shown: drawing.shown, memory });
            const files = createFiles({ playground, guard, wake, tellAt: drawing.tellAt });
            work = createWork({ playground, inbox, drawing, sharing, files, thumbs: createThumbs({ playground, waiting: thumbs, tellAt: drawing.tellAt }), wake });
            meet = sharing.meet;
        }
        page.postMessage({ type: 'ready' });
        wake();
    }

    /** Goes to work after the messages that are already waiting. */
    function wake() {
        if (awake || dead || work === null) return;
        awake = true;
        channel.port2.postMessage(null);
    }

    /**
     * After a trap the instance is in a doubtful state: say so and do nothing more. The page starts a fresh worker.
     * @param {() => void} action
     */
    function guard(action) {
        if (dead) return;
        try {
            action();
        } catch (error) {
            dead = true;
            page.postMessage({ type: 'fatal', message: String(error instanceof Error ? error.message : error) });
        }
    }

    // Before the wasm is there: the script is.
    page.postMessage({ type: 'hello' });
})();

/**
 * What there is to do, in its order: the drawing, then a question about it, then a small picture.
 * @param {object} worker
 * @param {Playground} worker.playground
 * @param {Inbox} worker.inbox
 * @param {ReturnType<typeof createDrawing>} worker.drawing
 * @param {ReturnType<typeof createSharing>} worker.sharing
 * @param {ReturnType<typeof createFiles>} worker.files
 * @param {ReturnType<typeof createThumbs>} worker.thumbs
 * @param {() => void} worker.wake
 */
function createWork({ playground, inbox, drawing, sharing, files, thumbs, wake }) {
    /** So long after a picture of what moves the next is waited for before a finer one is begun. */
    const PAUSE_MS = 12;
    /** Mates are looked after again after so long without an answer. */
    const WAIT_MS = 40;
    const { questions } = inbox;
    const reading = createReading(playground, () => drawing.iterations);
    const hasNews = () => inbox.define !== null || inbox.view !== null;

    /** Works towards what a question needs, for one step. @param {Question} question @returns {boolean} whether it can be answered */
    function canAnswer(question) {
        if (!reading.is(question)) return true;
        drawing.tellAt(question.id);
        return playground.remember(question.type === 'string' ? question.generation : drawing.iterations, STEP_MS);
    }

    /** @param {Inbox['questions'][number]} question */
    function answer(question) {
        const { id } = question;
        drawing.tellAt(id);
        if (reading.is(question)) return page.postMessage(reading.answer(question));
        switch (question.type) {
            case 'notation':
                return page.postMessage({ type: 'notation', id, .../** @type {import('./js/protocol.js').Notation} */ (wasm_bindgen.notation(question.texts)) });
            case 'qr':
                return page.postMessage({ type: 'qr', id, modules: wasm_bindgen.qr_code(question.text) ?? null });
            case 'seed':
                return page.postMessage({ type: 'seed', id, seed: wasm_bindgen.fresh_seed() });
            default:
                return files.answer(question);
        }
    }

    return function work() {
        // A small picture shares its memory with drawings and files in the making: it begins again later.
        if (hasNews() || questions.length > 0 || !files.rest) thumbs.putOff();
        const report = drawing.takeUp();
        sharing.deal();
        const idle = drawing.step(report);
        sharing.deal();
        // Questions are about the newest definition, whose drawing may still be in the making.
        const isNewest = () => !hasNews() && playground.built;
        const [question] = isNewest() ? questions : [];
        if (question && canAnswer(question)) {
            questions.shift();
            answer(question);
        }
        if (idle && questions.length === 0 && files.rest) thumbs.step();
        if (hasNews() || (questions.length > 0 && isNewest()) || thumbs.making || (thumbs.waiting && files.rest)) wake();
        else if (!idle) {
            const pause = drawing.moving ? PAUSE_MS : playground.waits ? WAIT_MS : 0;
            if (pause > 0) setTimeout(wake, pause);
            else wake();
        }
    };
}

/**
 * The newest state and view: takes them up, makes pictures of them, and tells the page of both.
 * @param {object} worker
 * @param {Playground} worker.playground
 * @param {OffscreenCanvas} worker.canvas
 * @param {Inbox} worker.inbox
 */
function createDrawing({ playground, canvas, inbox }) {
    /** What is not shown after this time is superseded by what is newer. */
    const PATIENCE_MS = 250;
    /** What is taken up. @type {{define: Inbox['define'], view: Inbox['view']}} */
    const at = { define: null, view: null };
    /** The last good state, which pictures are of. @type {import('./js/protocol.js').Definition | null} */
    let definition = null;
    /** How many segments are shown; null for all. @type {bigint | null} */
    let upto = null;
    /** Counts what is taken up. */
    let number = 0;
    /** Whether the newest definition can be drawn; what is still in the making otherwise belongs to the one before. */
    let ok = true;
    /** When what is not shown yet was begun; null once it is. @type {number | null} */
    let begun = null;
    /** Whether the picture just shown is one of many while things move. */
    let moving = false;
    /** Whether the last step left nothing to draw. */
    let rested = true;
    const tellAt = onChange((/** @type {number} */ define, /** @type {number} */ view, /** @type {number} */ question) => page.postMessage({ type: 'at', define, view, question }));
    const tellDone = onChange((/** @type {number} */ id, /** @type {number} */ viewId) => page.postMessage({ type: 'done', id, viewId }));
    const ids = () => /** @type {const} */ ([at.define?.id ?? 0, at.view?.id ?? 0]);

    /** @param {NonNullable<Inbox['define' | 'view']>} newest @param {() => void} act */
    function take(newest, act) {
        upto = newest.upto;
        tellAt(...ids(), 0);
        rested = false;
        act();
        playground.play(upto ?? undefined);
        number += 1;
    }

    return {
        /** The generation that is defined. */
        get iterations() {
            return definition?.iterations ?? 0;
        },
        get moving() {
            return moving;
        },

        shown: () => ({ number, state: definition && at.view && { definition, view: at.view, upto } }),

        /**
         * Takes up the newest state and view, unless what is in the making may finish first.
         * @returns {import('./js/protocol.js').Report | null} what is known so far of a new definition
         */
        takeUp() {
            /** @type {import('./js/protocol.js').Report | null} */
            let report = null;
            const { define, view } = inbox;
            if (begun === null || performance.now() - begun > PATIENCE_MS) {
                begun = define || view ? performance.now() : null;
                Object.assign(inbox, { define: null, view: null });
                if (define) {
                    at.define = define;
                    take(define, () => {
                        report = /** @type {import('./js/protocol.js').Report} */ (playground.define(define.definition));
                        ok = report.ok;
                        if (ok) definition = define.definition;
                    });
                }
                if (view) {
                    at.view = view;
                    take(view, () => lookAt(playground, view));
                }
            }
            if (!rested) tellAt(...ids(), 0);
            return report;
        },

        /**
         * @param {import('./js/protocol.js').Report | null} first what is known so far of a new definition; most drawings are built in this step, and
         *   then the page is told once
         * @returns {boolean} whether there is nothing more to do
         */
        step(first) {
            /** @type {Step} */
            const { report, drawn, idle } = at.view ? playground.step(STEP_MS) : { report: null, drawn: null, idle: true };
            const [id, viewId] = ids();
            const news = (ok && report) || first;
            if (news) page.postMessage({ type: 'report', id, report: news });
            moving = drawn?.moving ?? false;
            if (drawn || idle) begun = null;
            if (drawn) {
                const bitmap = canvas.transferToImageBitmap();
                const { complete, scale, rough, slow } = drawn;
                page.postMessage({ type: 'drawn', id, viewId, complete, scale, rough, slow, bitmap, pose: poseAt(playground, upto) }, [bitmap]);
            }
            // The page need not wait for a picture, be it that there can be none.
            if (idle && at.view) tellDone(id, viewId);
            rested = idle;
            return idle;
        },

        /** Tells the page what comes next, so that it knows what to give up if this worker stops over it. @param {number} question its id, or 0 for the drawing */
        tellAt: (question) => tellAt(...ids(), question),
    };
}

/** The turtle's pose behind the segments that are shown, or before the first. @param {Playground} playground @param {bigint | null} upto @returns {import('./js/protocol.js').Pose | null} */
function poseAt(playground, upto) {
    if (upto === null) return null;
    const began = upto > 0n;
    /** @type {import('./js/protocol.js').Stroke | null} */
    const stroke = playground.segment(began ? upto - 1n : 0n);
    if (!stroke) return null;
    const { from, to, fittedFrom, fittedTo, heading, level } = stroke;
    return { at: began ? to : from, fitted: began ? fittedTo : fittedFrom, heading, level };
}

/** Calls only with other numbers than the last time. @template {number[]} Numbers @param {(...numbers: Numbers) => void} act @returns {(...numbers: Numbers) => void} */
function onChange(act) {
    let last = '';
    return (...numbers) => {
        const now = numbers.join();
        if (now === last) return;
        last = now;
        act(...numbers);
    };
}

/** @param {Playground} playground @param {Sight} sight */
function lookAt(playground, { width, height, ratio, view, camera }) {
    playground.view(width, height, ratio, view.x, view.y, view.zoom, view.fx ?? 0, view.fy ?? 0);
    if (camera) playground.camera(camera.azimuth, camera.elevation, camera.zoom, camera.x, camera.y, camera.z, camera.perspective, camera.fade);
}

/**
 * Questions about what the newest definition derives and draws.
 * @param {Playground} playground
 * @param {() => number} iterations the generation that is drawn
 */
function createReading(playground, iterations) {
    /** @type {{[T in Reading]: (question: Question<T>) => Questions[T]['answer']}} */
    const readers = {
        string: ({ generation, start, count }) => {
            const text = playground.slice(generation, start, count) ?? null;
            return { text, length: (text !== null && playground.stringLength(generation)) || null, apart: playground.apart };
        },
        symbol: ({ generation, index }) => {
            /** @type {import('./js/protocol.js').Part | null} */
            const part = playground.part(generation, index, iterations());
            const stroke = part && playground.segment(BigInt(part.segments[0]));
            return { ancestry: playground.ancestry(generation, index), part, stroke };
        },
        descendant: ({ generation, index, later }) => ({ start: playground.part(generation, index, later)?.symbols[0] ?? null }),
        pick: ({ x, y, tolerance }) => {
            /** @type {Pick<import('./js/protocol.js').Picked, 'segment' | 'polygon' | 'symbol'> | null} */
            const found = playground.pick(x, y, tolerance);
            if (!found) return { segment: null, polygon: null, symbol: null, ancestry: [], stroke: null, filled: null };
            const { segment, polygon, symbol } = found;
            return {
                ...found,
                ancestry: symbol === null ? [] : playground.ancestry(iterations(), BigInt(symbol)),
                stroke: segment === null ? null : playground.segment(BigInt(segment)),
                filled: polygon === null ? null : playground.polygon(BigInt(polygon)),
            };
        },
    };

    return {
        /** @param {Question} question @returns {question is Question<Reading>} */
        is: (question) => Object.hasOwn(readers, question.type),

        /** @template {Reading} T @param {Question<T>} question @returns {Answer<T>} */
        answer: (question) => ({ type: question.type, id: question.id, ...readers[question.type](question) }),
    };
}

/**
 * Files, which are read and written. They are made one after another: each may take all the memory that there is for one.
 * @param {object} worker
 * @param {Playground} worker.playground
 * @param {(action: () => void) => void} worker.guard
 * @param {() => void} worker.wake
 * @param {(question: number) => void} worker.tellAt
 */
function createFiles({ playground, guard, wake, tellAt }) {
    /** The file being made, and those asked for after it; and how many those are. */
    let saving = Promise.resolve();
    let unsaved = 0;

    /** Makes a file after those before it. @param {number} id @param {() => Promise<void>} answered */
    function save(id, answered) {
        unsaved += 1;
        saving = saving.then(async () => {
            tellAt(id);
            await answered();
            unsaved -= 1;
            wake();
        });
    }

    /**
     * Answers a question whose answer takes others' time as well.
     * @template {Answer} A
     * @param {Promise<A>} work @param {(reason: string | null) => A} failed the answer where it fails
     */
    async function later(work, failed) {
        try {
            page.postMessage(await work);
        } catch (error) {
            if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) guard(() => { throw error; });
            else page.postMessage(failed(typeof error === 'string' ? error : null));
        }
    }

    /** @param {Question<'read'>} question @returns {Promise<Answer<'read'>>} */
    async function read({ type, id, file }) {
        const bytes = new Uint8Array(await file.arrayBuffer());
        tellAt(id);
        /** @type {Omit<import('./js/protocol.js').FileRead, 'text'>} */
        const found = wasm_bindgen.read_file(bytes);
        return { type, id, ...found, text: found.diagnostics.length > 0 ? textOf(bytes) : null };
    }

    /** Goes through the steps of a file. @param {number} id @param {() => boolean} step whether it was the last */
    async function inSteps(id, step) {
        while (!step()) {
            await new Promise((resolve) => setTimeout(resolve));
            tellAt(id);
        }
    }

    /** A file, whose pieces leave the memory of the wasm as they are written. @param {Question<'export'>} question @returns {Promise<Answer<'export'>>} */
    async function written({ type, id, format }) {
        const file = playground.export(format);
        /** @type {Blob[]} */
        const pieces = [];
        try {
            await inSteps(id, () => {
                const done = file.step(STEP_MS);
                pieces.push(new Blob([/** @type {Uint8Array<ArrayBuffer>} */ (file.take())]));
                return done;
            });
            /** @type {{complete: boolean, diagnostics: import('./js/protocol.js').Diagnostic[]}} */
            const { complete, diagnostics } = file.report();
            return { type, id, blob: complete ? new Blob(pieces) : null, diagnostics };
        } finally {
            // No drawing is made as long as it is there.
            file.free();
        }
    }

    /** A PNG file that carries its system, so that it can be opened again. @param {Question<'png'>} question @returns {Promise<Answer<'png'>>} */
    async function tagged({ type, id, width, height, definition }) {
        const sheet = new OffscreenCanvas(1, 1);
        const picture = playground.snapshot(sheet, width, height);
        try {
            await inSteps(id, () => picture.step(STEP_MS));
        } finally {
            // Its pixels are on the sheet, and no drawing is made as long as it is there.
            picture.free();
        }
        const plain = await sheet.convertToBlob({ type: 'image/png' });
        const bytes = new Uint8Array(await plain.arrayBuffer());
        tellAt(id);
        const file = /** @type {Uint8Array<ArrayBuffer>} */ (wasm_bindgen.tag_png(bytes, definition));
        return { type, id, blob: new Blob([file], { type: 'image/png' }), reason: null };
    }

    return {
        /** Whether none is being made. */
        get rest() {
            return unsaved === 0;
        },

        /** @param {Question<'read' | 'export' | 'png'>} question */
        answer(question) {
            const { id } = question;
            if (question.type === 'read') later(read(question), () => ({ type: 'read', id, definition: null, diagnostics: [], text: null }));
            else if (question.type === 'export') save(id, () => later(written(question), () => ({ type: 'export', id, blob: null, diagnostics: [] })));
            else save(id, () => later(tagged(question), (reason) => ({ type: 'png', id, blob: null, reason })));
        },
    };
}

/** A file as text, where people can read it: in UTF-8, or in UTF-16, as programs of Windows write it. @param {Uint8Array} bytes */
function textOf(bytes) {
    /** Longer files are not shown to their reader, in bytes. */
    const LONGEST_TEXT = 1 << 20;
    if (bytes.length > LONGEST_TEXT) return null;
    const [first, second] = bytes;
    const mark = first === 0xff && second === 0xfe ? 'utf-16le' : first === 0xfe && second === 0xff ? 'utf-16be' : 'utf-8';
    const text = new TextDecoder(mark).decode(bytes);
    // What a picture carries is not to be read by people.
    return text.trim() !== '' && !/^\s*<|^.PNG/.test(text) ? text : null;
}

/**
 * Small pictures of other systems, made while there is nothing else to do, each by a playground that is there for it alone.
 * @param {object} worker
 * @param {Playground} worker.playground
 * @param {Question<'thumb'>[]} worker.waiting
 * @param {(question: number) => void} worker.tellAt
 */
function createThumbs({ playground, waiting, tellAt }) {
    /** A picture that takes more steps is shown as far as it came. */
    const MOST_STEPS = 40;
    /** The picture being made. @type {{request: Question<'thumb'>, easel: Playground, sheet: OffscreenCanvas, bitmap: ImageBitmap | null, steps: number} | null} */
    let making = null;

    /** @param {Question<'thumb'>} request @returns {NonNullable<typeof making>} */
    function begin(request) {
        const { definition, width, height } = request;
        playground.forget();
        const sheet = new OffscreenCanvas(1, 1);
        const easel = wasm_bindgen.Playground.small(sheet);
        /** @type {import('./js/protocol.js').Report} */
        const { ok } = easel.define(definition);
        easel.view(width, height, 1, 0, 0, 1, 0, 0);
        return { request, easel, sheet, bitmap: null, steps: ok ? MOST_STEPS : 0 };
    }

    return {
        get making() {
            return making !== null;
        },
        get waiting() {
            return waiting.length > 0;
        },

        /** Begins the picture again later. */
        putOff() {
            if (!making) return;
            waiting.unshift(making.request);
            making.easel.free();
            making.bitmap?.close();
            making = null;
        },

        /** One step of the picture that is made, or of the next. */
        step() {
            const request = making?.request ?? waiting.shift();
            if (!request) return;
            tellAt(request.id);
            const thumb = (making ??= begin(request));
            /** @type {Step} */
            const { drawn, idle } = thumb.steps > 0 ? thumb.easel.step(STEP_MS) : { report: null, drawn: null, idle: true };
            thumb.steps -= 1;
            if (drawn) {
                thumb.bitmap?.close();
                thumb.bitmap = thumb.sheet.transferToImageBitmap();
            }
            if (!idle && !drawn?.complete && thumb.steps > 0) return;
            making = null;
            thumb.easel.free();
            page.postMessage({ type: 'thumb', id: request.id, bitmap: thumb.bitmap }, thumb.bitmap ? [thumb.bitmap] : []);
        },
    };
}
