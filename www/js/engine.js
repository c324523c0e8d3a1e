/**
 * The worker as seen from the page. Nothing is ever queued: it is at one state, one more is there for it to go on with,
 * the newest one waits, those between are forgotten. A state is let finish while it is quick, so that a long drag shows
 * pictures on the way; then newer ones supersede it.
 *
 * A worker that stops, because it crashes or falls silent, is replaced. What it was at is given up: a fresh worker goes on
 * with everything else, and with the last good state in the place of one that stopped it.
 */

import { core, forgetCore, hire } from './core.js';
import { READING, Stopped, asking, createQuestions } from './questions.js';
import { same } from './state.js';
import { SILENCE, STARTUP, createWatchdog } from './watchdog.js';

/** @typedef {import('./protocol.js').Definition} Definition */
/** @typedef {import('./protocol.js').View} View */
/** @typedef {import('./protocol.js').Camera} Camera */
/** @typedef {import('./protocol.js').Diagnostic} Diagnostic */
/** @typedef {import('./protocol.js').Report} Report */
/** @typedef {import('./protocol.js').Canvas} Canvas */
/** @typedef {import('./protocol.js').Link} Link */
/** @typedef {import('./protocol.js').Stroke} Stroke */
/** @typedef {import('./protocol.js').Filled} Filled */
/** @typedef {import('./protocol.js').Look} Look */
/** @typedef {import('./protocol.js').Drawn} Drawn */
/** @typedef {import('./protocol.js').Pose} Pose */
/** @typedef {import('./protocol.js').StringPage} StringPage */
/** @typedef {import('./protocol.js').Part} Part */
/** @typedef {import('./protocol.js').SymbolFacts} SymbolFacts */
/** @typedef {import('./protocol.js').Picked} Picked */
/** @typedef {import('./protocol.js').Notation} Notation */
/** @typedef {import('./protocol.js').Constant} Constant */
/** @typedef {import('./protocol.js').FileRead} FileRead */
/** @typedef {import('./protocol.js').Exported} Exported */
/** @typedef {import('./protocol.js').Shown} Shown */
/** @typedef {import('./protocol.js').Trouble} Trouble */
/** @typedef {ReturnType<typeof createEngine>} Engine */

/**
 * @typedef {object} Events
 * @property {(report: Report, id: number) => void} report
 * @property {(drawn: Drawn) => void} drawn
 * @property {(busy: boolean) => void} busy whether a newer state is under way than the one shown
 * @property {(trouble: Trouble) => void} troubled
 * @property {() => void} recovered it draws again, so that what was told of a trouble holds no longer
 * @property {(state: Shown, doubtful: boolean) => void} [doubted] a state may stop every worker that it is given to, or is
 *   good after all; without its `look` the definition may
 */

/** States that are not drawn after this time are waited for no longer, in milliseconds. */
const PATIENCE = 250;

/** So many states are sent before the first of them is drawn: the worker need not wait while the page shows a picture. */
const AHEAD = 2;

/** What does not load is tried again after these times, in milliseconds. */
const DELAYS = [500, 1500, 4000];

/** After so many workers in a row that have stopped before they drew anything none is started by itself. */
const MOST_FAILURES = 4;

/** A state over which the worker has been silent for this long is doubtful, in milliseconds. */
const DOUBTFUL = 1000;

/** @param {Events} events */
export function createEngine(events) {
    /** @type {Worker | null} */
    let worker = null;
    /** Whether the worker has been handed the wasm, and whether it knows the newest state, so that it can be asked. */
    let ready = false;
    let askable = false;
    /** Whether the worker has said anything, and whether it has begun to work. */
    let met = false;
    let started = false;
    /** What the worker is at, by ids: the newest it has taken up of each kind, and a question or 0. */
    let at = { define: 0, view: 0, question: 0 };
    /** Whether it owes a picture. */
    let owes = false;
    let lastId = 0;
    let failures = 0;
    /** How often the files could not be loaded, and the timer of the next try. */
    let misses = 0;
    let retry = 0;
    /** What was told last of a trouble, if that still holds. @type {Trouble['how'] | null} */
    let told = null;
    /** What was given up, as long as nothing newer is asked for. @type {'definition' | 'look' | null} */
    let given = null;
    /** The state over which the worker is silent. @type {Shown | null} */
    let doubtful = null;
    /** The definition whose questions stopped a worker, and their types. @type {{definition: Definition | null, types: Set<string>}} */
    let refused = { definition: null, types: new Set() };
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
    /** Views sent and not yet drawn. @type {Map<number, Look>} */
    const views = new Map();
    const questions = createQuestions();
    const watchdog = createWatchdog({ patience: patienceNow, ping: () => worker?.postMessage({ type: 'ping' }), doubted, stopped: () => stop('silent', 'the worker did not answer') });

    /** Who helps with pictures that take long. @type {{help: (worker: Worker, wasm: WebAssembly.Module) => void, leave: () => void} | null} */
    let mates = null;
    /** Whether the last picture did. */
    let slow = false;

    /** The state that is shown at its finest. @type {Shown} */
    let shown = { definition: null, look: null };

    start();

    function start() {
        clearTimeout(retry);
        const fresh = hire();
        employ(fresh);
        core().then(
            (wasm) => {
                if (worker !== fresh) return;
                fresh.postMessage({ type: 'init', wasm });
                begin();
            },
            (error) => worker === fresh && miss(error.message),
        );
        watchdog.watch();
    }

    /** Puts a worker in the place of another, for the same state. @param {Worker} fresh */
    function employ(fresh) {
        dismiss();
        worker = fresh;
        defineWaits = definition !== null;
        lookWaits = look !== null;
        fresh.onmessage = ({ data }) => worker === fresh && receive(data);
        fresh.onerror = (event) => {
            event.preventDefault();
            if (worker !== fresh) return;
            if (started) stop('crashed', event.message);
            else miss(event.message || 'the worker did not start');
        };
    }

    /** Lets the worker go, and forgets what it was at. */
    function dismiss() {
        mates?.leave();
        watchdog.leave();
        worker?.terminate();
        worker = null;
        [ready, askable, met, started, owes] = [false, false, false, false, false];
        at = { define: 0, view: 0, question: 0 };
        views.clear();
        awaited([]);
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
        if (worker) questions.putAll(worker);
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
        if (!worker || !ready || !definition || ahead.length >= AHEAD || !(defineWaits || lookWaits)) return;
        if (defineWaits) {
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
        owes = true;
        watchdog.watch();
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
        if (ahead.length > 0) return;
        owes = false;
        events.busy(false);
    }

    /** @param {any} message */
    function receive(message) {
        met = true;
        watchdog.heard();
        if (doubtful) events.doubted?.(doubtful, false);
        doubtful = null;
        switch (message.type) {
            case 'hello':
            case 'pong':
                break;
            case 'at':
                at = message;
                break;
            case 'ready':
                started = true;
                misses = 0;
                if (told === 'loading' || told === 'unloadable') well();
                break;
            case 'report':
                if (message.id === recalled) break;
                // What is wrong is not drawn, nor what passes a limit.
                if (message.id === defineSent && isWrong(message.report)) {
                    settle();
                    if (!given) well();
                }
                events.report(given ? { ...message.report, past: true } : message.report, message.id);
                break;
            case 'drawn':
                receivePicture(message);
                break;
            case 'done':
                settleAt(message);
                break;
            case 'fatal':
                if (started) stop('crashed', message.message);
                else miss(message.message);
                break;
            default:
                if (questions.answer(message)) failures = 0;
        }
    }

    /** @param {any} message */
    function receivePicture(message) {
        failures = 0;
        if (message.id === recalled) {
            message.bitmap.close();
            if (message.complete) settleAt(message);
            return;
        }
        const seen = views.get(message.viewId);
        for (const id of views.keys()) if (id < message.viewId) views.delete(id);
        slow = message.slow;
        if (slow) help();
        const newest = isNewest(message);
        // A worker that takes over begins with a coarse picture of what is shown at its finest already.
        const known = newest && !message.complete && shown.definition === definition && shown.look === look;
        if (seen && !known) events.drawn({ ...message, ...seen });
        if (!given) well();
        if (newest && message.complete && !(defineWaits || lookWaits)) rest();
        // Only the finest is the end of it.
        if (message.complete) settleAt(message);
        else goOn(Math.max(message.id, message.viewId));
    }

    /** Whether a message is about the last that was sent. @param {{id: number, viewId: number}} message */
    const isNewest = ({ id, viewId }) => id >= defineSent && viewId >= lookSent;

    /** There is no more to come for a state. @param {{id: number, viewId: number}} message */
    function settleAt(message) {
        if (message.id === recalled) goOn();
        else if (isNewest(message)) settle();
        else goOn(Math.max(message.id, message.viewId));
    }

    /** The next such picture is made by several workers. */
    async function help() {
        const helped = worker;
        const wasm = await core();
        if (helped && worker === helped) mates?.help(helped, wasm);
    }

    /** How long the worker may be silent now; 0 while it owes nothing. */
    function patienceNow() {
        if (!worker) return 0;
        if (!met) return STARTUP;
        if (started && !owes && questions.size === 0) return 0;
        return SILENCE;
    }

    /** @param {number} silent for so long, in milliseconds */
    function doubted(silent) {
        if (silent < DOUBTFUL || doubtful || !owes || at.question || at.define !== defineSent || defineWaits) return;
        doubtful = { definition, look: definition === shown.definition ? look : null };
        events.doubted?.(doubtful, true);
    }

    /** The worker has stopped: what it was at is given up, and a fresh one goes on. @param {'silent' | 'crashed'} how @param {string} message */
    function stop(how, message) {
        const question = questions.refuseOne(at.question, new Stopped('it stopped answering and was given up'));
        if (question && READING.includes(question)) {
            if (refused.definition !== definition) refused = { definition, types: new Set() };
            refused.types.add(question);
            trouble(how, message, true);
        }
        const gone = !question && owes && giveUp();
        doubtful = null;
        dismiss();
        failures += 1;
        if (failures > MOST_FAILURES) return end('lost', message);
        events.busy(false);
        if (gone) {
            questions.refuseAboutDrawing(new Stopped('the drawing was given up'));
            trouble(how, message);
        }
        start();
    }

    /** Puts the last good state in the place of the one that the worker was at. @returns {boolean} whether that was the newest */
    function giveUp() {
        if (at.define === recalled && recalled !== 0) {
            shown = { definition: null, look: null };
            return false;
        }
        // What nobody has tried yet may be good.
        if (at.define !== defineSent || defineWaits) return false;
        const known = definition === shown.definition;
        if (known && (at.view !== lookSent || lookWaits)) return false;
        given = known && look !== shown.look ? 'look' : 'definition';
        events.doubted?.({ definition, look: given === 'look' ? look : null }, true);
        if (known && given === 'definition') shown = { definition: null, look: null };
        definition = shown.definition;
        look = shown.look ?? look;
        upto = shown.look?.upto ?? null;
        return true;
    }

    /** The worker or its wasm does not load. @param {string} message */
    function miss(message) {
        dismiss();
        forgetCore();
        const delay = DELAYS[misses];
        misses += 1;
        if (delay === undefined) return end('unloadable', message);
        trouble('loading', message);
        retry = window.setTimeout(start, delay);
    }

    /** No worker is started until there is something new to do. @param {'unloadable' | 'lost'} how @param {string} message */
    function end(how, message) {
        questions.refuseAll(new Error(message));
        events.busy(false);
        trouble(how, message);
    }

    /** @param {Trouble['how']} how @param {string} message @param {boolean} [question] */
    function trouble(how, message, question = false) {
        if (!question) told = how;
        events.troubled({ how, question, message });
    }

    /** It works again. */
    function well() {
        if (told === null) return;
        told = null;
        events.recovered();
    }

    /** @param {{type: string} & Record<string, any>} question @returns {Promise<any>} */
    async function ask(question) {
        if (refused.definition === definition && refused.types.has(question.type)) throw new Stopped('this question stopped the worker before');
        revive();
        const request = { ...question, id: ++lastId };
        const answer = questions.add(request);
        if (askable) worker?.postMessage(request);
        watchdog.watch();
        return answer;
    }

    /** The newest state is shown at its finest. */
    function rest() {
        shown = { definition, look };
        events.doubted?.(shown, false);
    }

    /** After a failure for good, new input or a question is worth a fresh start. */
    function revive() {
        if (worker) return;
        if (failures > MOST_FAILURES) failures = 0;
        if (misses > DELAYS.length) misses = 0;
        start();
    }

    return {
        /** The last state that was drawn to its end, if any. @returns {Readonly<Shown>} */
        get good() {
            return shown;
        },

        /** @param {Definition} newest */
        define(newest) {
            given = null;
            definition = newest;
            defineWaits = true;
            revive();
            send();
        },

        /** @param {Canvas} canvas @param {View} view of a drawing in the plane @param {Camera | null} [camera] of one in space */
        look(canvas, view, camera = null) {
            if (look && same(look.canvas, canvas) && same(look.view, view) && same(look.camera, camera)) return;
            look = { canvas, view, camera, upto };
            if (given === 'look') given = null;
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
        },

        /** From now on these help with pictures that take long. @param {NonNullable<typeof mates>} helpers */
        share(helpers) {
            mates = helpers;
            if (slow) help();
        },

        ...asking(ask),
    };
}

/** Whether there is a mistake that keeps a state from being drawn. @param {Report} report */
export const isWrong = ({ ok, diagnostics }) => !ok || diagnostics.some(({ severity }) => severity === 'error');
