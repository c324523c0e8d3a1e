/**
 * The page's worker: keeps one Playground between edits and draws. It stands behind the generated glue, which defines
 * `wasm_bindgen`, in one classic script, because a classic worker also starts from a blob.
 *
 * It keeps only the newest `define` and `view` it has seen, works in steps of at most 8 ms, and returns to its event
 * loop between steps, so that newer input supersedes older. What it is at may finish first while it is quick, so that
 * there are pictures on the way of a long drag.
 */
(() => {
    const STEP_MS = 8;
    /** So long after a picture of what moves the next is waited for before a finer one is begun. */
    const PAUSE_MS = 12;
    /** What is not shown after this time is superseded by what is newer. */
    const PATIENCE_MS = 250;
    /** Mates are looked after again after so long without an answer. */
    const WAIT_MS = 40;
    /** A small picture gets at most this many steps. */
    const THUMB_STEPS = 40;
    /** Longer files are not shown to their reader, in bytes. */
    const LONGEST_TEXT = 1 << 20;

    const wasm = wasm_bindgen;
    const canvas = new OffscreenCanvas(1, 1);
    const channel = new MessageChannel();

    /** @type {any} */
    let playground = null;
    /** Of the wasm. @type {WebAssembly.Memory | null} */
    let memory = null;
    /** @type {any} the newest message of each kind that was not yet acted on */
    let newDefine = null;
    /** @type {any} */
    let newView = null;
    /** @type {any[]} questions, answered in turn */
    const questions = [];
    /** The file being made, and those asked for after it. */
    let saving = Promise.resolve();
    /** How many those are. */
    let unsaved = 0;
    /** @type {any[]} small pictures to make while nothing else is to do */
    const thumbs = [];
    /** The small picture being made, and the playground that is there for it alone. @type {any} */
    let thumb = null;
    /** Whether the picture just shown is one of many while things move. */
    let moving = false;
    /** When what is not shown yet was begun; null once it is. @type {number | null} */
    let begun = null;
    let defineId = 0;
    /** The generation that is defined. */
    let iterations = 0;
    let viewId = 0;
    /** How many segments are shown; null for all. @type {bigint | null} */
    let upto = null;
    /** Whether a view is set; nothing is drawn before. */
    let seen = false;
    /** The state that pictures are of: changes are counted. @type {{definition: any, view: any}} */
    const state = { definition: null, view: null };
    let stateNumber = 0;
    let awake = false;
    let dead = false;
    /** Whether the last step left nothing to draw. */
    let rested = true;
    /** What the page was told last that this worker is at. */
    let told = '';
    /** The state for which it was told that there is nothing left to draw. */
    let done = '';
    /** Whether the newest definition can be drawn; what is still in the making otherwise belongs to the one before. */
    let sound = true;

    const sharing = createSharing({ canvas, playground: () => playground, guard, wake, lookAt, memory: () => memory?.buffer.byteLength ?? 0, state: () => ({ ...state, upto, number: stateNumber }), stepMs: STEP_MS });

    /** Questions about what the newest definition derives and draws. @type {Record<string, (question: any) => object>} */
    const READERS = {
        string: ({ generation, start, count }) => {
            const text = playground.slice(generation, start, count) ?? null;
            return { text, length: (text !== null && playground.stringLength(generation)) || null, apart: playground.apart };
        },
        symbol: ({ generation, index }) => {
            const part = playground.part(generation, index, iterations);
            const stroke = part && playground.segment(BigInt(part.segments[0]));
            return { ancestry: playground.ancestry(generation, index), part, stroke };
        },
        descendant: ({ generation, index, later }) => ({ start: playground.part(generation, index, later)?.symbols[0] ?? null }),
        pick: ({ x, y, tolerance }) => {
            const found = playground.pick(x, y, tolerance);
            if (!found) return { segment: null, polygon: null, symbol: null, ancestry: [], stroke: null, filled: null };
            const { segment, polygon, symbol } = found;
            return {
                ...found,
                ancestry: symbol === null ? [] : playground.ancestry(iterations, BigInt(symbol)),
                stroke: segment === null ? null : playground.segment(BigInt(segment)),
                filled: polygon === null ? null : playground.polygon(BigInt(polygon)),
            };
        },
    };

    self.onmessage = ({ data }) => {
        // That this is answered shows that the worker comes back to its event loop.
        if (data.type === 'ping') return self.postMessage({ type: 'pong' });
        if (data.type === 'init') return start(data.wasm, data.master);
        if (data.type === 'mates') return guard(() => sharing.meet(data.ports));
        if (data.type === 'define') newDefine = data;
        else if (data.type === 'view') newView = data;
        else if (data.type === 'thumb') thumbs.push(data);
        else questions.push(data);
        wake();
    };
    channel.port1.onmessage = () => {
        awake = false;
        guard(sharing.serves ? sharing.assist : work);
    };

    /** @param {WebAssembly.Module} module @param {MessagePort} [port] of the worker whose mate this one is */
    function start(module, port) {
        guard(() => {
            if (port) sharing.serve(port);
            ({ memory } = wasm.initSync({ module }));
            playground = new wasm.Playground(canvas);
            self.postMessage({ type: 'ready' });
            wake();
        });
    }

    /** Goes to work after the messages that are already waiting. */
    function wake() {
        if (awake || dead || playground === null) return;
        awake = true;
        channel.port2.postMessage(null);
    }

    function work() {
        let report = null;
        // A small picture shares its memory with drawings and files in the making: it begins again later.
        if (thumb && (newDefine || newView || questions.length > 0 || unsaved > 0)) putOff();
        const free = begun === null || performance.now() - begun > PATIENCE_MS;
        if (free) begun = newDefine || newView ? performance.now() : null;
        if (free && newDefine) {
            const { id, definition } = newDefine;
            upto = newDefine.upto;
            newDefine = null;
            defineId = id;
            tellAt(0);
            rested = false;
            report = playground.define(definition);
            sound = report.ok;
            if (sound) {
                iterations = definition.iterations;
                state.definition = definition;
            }
            playground.play(upto ?? undefined);
            stateNumber += 1;
        }
        if (free && newView) {
            upto = newView.upto;
            viewId = newView.id;
            state.view = newView;
            newView = null;
            tellAt(0);
            rested = false;
            lookAt(state.view);
            playground.play(upto ?? undefined);
            stateNumber += 1;
            seen = true;
        }
        if (!rested) tellAt(0);
        sharing.deal();
        const idle = step(report);
        sharing.deal();
        rested = idle;
        // Questions are about the newest definition, whose drawing may still be in the making.
        const newest = !newDefine && !newView && playground.built;
        if (newest && questions.length > 0 && canRead(questions[0])) answer(questions.shift());
        if (idle && questions.length === 0 && unsaved === 0) {
            const request = thumb?.request ?? thumbs.shift();
            if (request) {
                tellAt(request.id);
                thumb ??= beginThumb(request);
                paintThumb();
            }
        }
        if (newDefine || newView || (questions.length > 0 && newest) || thumb || (thumbs.length > 0 && unsaved === 0)) wake();
        else if (!idle) {
            const pause = moving ? PAUSE_MS : playground.waits ? WAIT_MS : 0;
            pause > 0 ? setTimeout(wake, pause) : wake();
        }
    }

    /**
     * Tells the page what comes next, so that it knows what to give up if this worker stops over it.
     * @param {number} question its id, or 0 for the drawing
     */
    function tellAt(question) {
        const now = [defineId, viewId, question].join();
        if (now === told) return;
        told = now;
        self.postMessage({ type: 'at', define: defineId, view: viewId, question });
    }

    /** @param {any} look a message of the page's */
    function lookAt({ width, height, ratio, view, camera }) {
        playground.view(width, height, ratio, view.x, view.y, view.zoom, view.fx ?? 0, view.fy ?? 0);
        // Only the full wasm has one.
        if (camera) playground.camera?.(camera.azimuth, camera.elevation, camera.zoom, camera.x, camera.y, camera.z, camera.perspective, camera.fade);
    }

    /** Works towards what a question needs, for one step; whether it can be answered. @param {any} question */
    function canRead({ type, id, generation }) {
        if (READERS[type]) tellAt(id);
        return !READERS[type] || playground.remember(type === 'string' ? generation : iterations, STEP_MS);
    }

    /**
     * @param {any} first what is known so far of a new definition; most drawings are built in this step, and then the
     *   page is told once
     * @returns {boolean} whether there is nothing more to do
     */
    function step(first) {
        const { report, drawn, idle } = seen ? playground.step(STEP_MS) : { report: null, drawn: null, idle: true };
        const news = (sound && report) || first;
        if (news) self.postMessage({ type: 'report', id: defineId, report: news });
        moving = drawn?.moving ?? false;
        if (drawn || idle) begun = null;
        if (drawn) {
            const bitmap = canvas.transferToImageBitmap();
            self.postMessage({ type: 'drawn', id: defineId, viewId, complete: drawn.complete, scale: drawn.scale, rough: drawn.rough, slow: drawn.slow, bitmap, pose: pose() }, { transfer: [bitmap] });
        }
        if (idle && seen) tellDone();
        return idle;
    }

    /** Tells the page that no picture is to come, be it that none can: it need not wait for one. */
    function tellDone() {
        const now = [defineId, viewId].join();
        if (now === done) return;
        done = now;
        self.postMessage({ type: 'done', id: defineId, viewId });
    }

    /** The turtle's pose behind the segments that are shown, or before the first. */
    function pose() {
        if (upto === null) return null;
        const began = upto > 0n;
        // Only the full wasm tells.
        const stroke = playground.segment?.(began ? upto - 1n : 0n);
        if (!stroke) return null;
        const { from, to, fittedFrom, fittedTo, heading, level } = stroke;
        return { at: began ? to : from, fitted: began ? fittedTo : fittedFrom, heading, level };
    }

    /** @param {any} question */
    function answer(question) {
        const { type, id } = question;
        tellAt(id);
        const reader = READERS[type];
        if (reader) {
            self.postMessage({ type, id, ...reader(question) });
        } else if (type === 'read') {
            later(question, read, { type: 'file', definition: null, diagnostics: [], text: null });
        } else if (type === 'notation') {
            self.postMessage({ type, id, ...wasm.notation(question.texts) });
        } else if (type === 'export') {
            save(question, written, { type: 'exported', blob: null, diagnostics: [] });
        } else if (type === 'qr') {
            self.postMessage({ type: 'qr', id, modules: wasm.qr_code(question.text) ?? null });
        } else if (type === 'seed') {
            self.postMessage({ type: 'seed', id, seed: wasm.fresh_seed() });
        } else if (type === 'png') {
            save(question, tagged, { type: 'png', blob: null });
        }
    }

    /**
     * Makes files one after another: each may take all the memory that there is for one.
     * @param {any} question @param {(question: any) => Promise<object>} work @param {object} without the answer where it fails
     */
    function save(question, work, without) {
        unsaved += 1;
        saving = saving.then(async () => {
            tellAt(question.id);
            await later(question, work, without);
            unsaved -= 1;
            wake();
        });
    }

    /**
     * Answers a question whose answer takes others' time as well.
     * @param {any} question @param {(question: any) => Promise<object>} work @param {object} without the answer where it fails
     */
    async function later(question, work, without) {
        try {
            self.postMessage({ id: question.id, ...(await work(question)) });
        } catch (error) {
            if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) guard(() => { throw error; });
            else self.postMessage({ id: question.id, ...without, reason: typeof error === 'string' ? error : null });
        }
    }

    /** @param {any} question */
    async function read({ id, file }) {
        const bytes = new Uint8Array(await file.arrayBuffer());
        tellAt(id);
        const found = wasm.read_file(bytes);
        return { type: 'file', ...found, text: found.diagnostics.length > 0 ? textOf(bytes) : null };
    }

    /** A file as text, where people can read it: in UTF-8, or in UTF-16, as programs of Windows write it. @param {Uint8Array} bytes */
    function textOf(bytes) {
        if (bytes.length > LONGEST_TEXT) return null;
        const [first, second] = bytes;
        const mark = first === 0xff && second === 0xfe ? 'utf-16le' : first === 0xfe && second === 0xff ? 'utf-16be' : 'utf-8';
        const text = new TextDecoder(mark).decode(bytes);
        // What a picture carries is not to be read by people.
        return text.trim() !== '' && !/^\s*<|^.PNG/.test(text) ? text : null;
    }

    /** A file, whose pieces leave the memory of the wasm as they are written. @param {any} question */
    async function written({ id, format }) {
        const file = playground.export(format);
        const pieces = [];
        try {
            for (;;) {
                const done = file.step(STEP_MS);
                pieces.push(new Blob([file.take()]));
                if (done) break;
                await new Promise((resolve) => setTimeout(resolve));
                tellAt(id);
            }
            const { complete, diagnostics } = file.report();
            return { type: 'exported', blob: complete ? new Blob(pieces) : null, diagnostics };
        } finally {
            // No drawing is made as long as it is there.
            file.free();
        }
    }

    /** A PNG file that carries its system, so that it can be opened again. @param {any} question */
    async function tagged({ id, width, height, definition }) {
        const sheet = new OffscreenCanvas(1, 1);
        const picture = playground.snapshot(sheet, width, height);
        try {
            while (!picture.step(STEP_MS)) {
                await new Promise((resolve) => setTimeout(resolve));
                tellAt(id);
            }
        } finally {
            // Its pixels are on the sheet, and no drawing is made as long as it is there.
            picture.free();
        }
        const plain = await sheet.convertToBlob({ type: 'image/png' });
        const bytes = new Uint8Array(await plain.arrayBuffer());
        tellAt(id);
        const tagged = wasm.tag_png(bytes, definition);
        const blob = new Blob([/** @type {Uint8Array<ArrayBuffer>} */ (tagged)], { type: 'image/png' });
        return { type: 'png', blob };
    }

    /** @param {any} request */
    function beginThumb(request) {
        const { definition, width, height } = request;
        playground.forget();
        const sheet = new OffscreenCanvas(1, 1);
        const easel = wasm.Playground.small(sheet);
        const { ok } = easel.define(definition);
        easel.view(width, height, 1, 0, 0, 1, 0, 0);
        return { request, easel, sheet, bitmap: null, steps: ok ? THUMB_STEPS : 0 };
    }

    /** Begins the small picture again later. */
    function putOff() {
        thumbs.unshift(thumb.request);
        endThumb()?.close();
    }

    /** What there is of the small picture. @returns {ImageBitmap | null} */
    function endThumb() {
        const { easel, bitmap } = thumb;
        easel.free();
        thumb = null;
        return bitmap;
    }

    /** One step of a small picture; a system that takes too many is shown as far as it came. */
    function paintThumb() {
        const { drawn, idle } = thumb.steps > 0 ? thumb.easel.step(STEP_MS) : { drawn: null, idle: true };
        thumb.steps -= 1;
        if (drawn) {
            thumb.bitmap?.close();
            thumb.bitmap = thumb.sheet.transferToImageBitmap();
        }
        if (!idle && !drawn?.complete && thumb.steps > 0) return;
        const { request } = thumb;
        const bitmap = endThumb();
        self.postMessage({ type: 'thumb', id: request.id, bitmap }, { transfer: bitmap ? [bitmap] : [] });
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
            self.postMessage({ type: 'fatal', message: String(error instanceof Error ? error.message : error) });
        }
    }

    // Before the wasm is there: the script is.
    self.postMessage({ type: 'hello' });
})();
