/**
 * The worker as seen from the page: sends the newest state, shows its pictures, and asks questions.
 *
 * A worker that crashes or falls silent is replaced. The task that stopped the worker is given up: the fresh worker
 * continues with everything else, and draws the last good state instead of the one that stopped it.
 */

import { createConnection } from './connection.js';
import { createFallback } from './fallback.js';
import { createNewest } from './newest.js';
import { createOutbox } from './outbox.js';
import { Stopped, asking, createQuestions, isReading } from './questions.js';
import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').Report} Report */
/** @typedef {import('../protocol.js').Notation} Notation */
/** @typedef {import('../protocol.js').FromWorker} FromWorker */
/** @typedef {import('./newest.js').Shown} Shown */
/** A picture and what it shows. @typedef {import('../protocol.js').Picture & import('./newest.js').Look} Drawn */
/**
 * `silent` and `crashed`: the worker stopped while drawing, or while answering a `question` about the drawing, and was
 * replaced; `loading`: the worker's files did not load and are requested again; `unloadable`: the files did not load
 * after several tries; `lost`: fresh workers stopped as well.
 * @typedef {{how: 'silent' | 'crashed' | 'loading' | 'unloadable' | 'lost', question: boolean, message: string}} Trouble
 */
/** @typedef {ReturnType<typeof createEngine>} Engine */

/**
 * @typedef {object} EngineEvents
 * @property {(report: Report, past: boolean) => void} report `past`: the report is about the last good state, because the newest was given up
 * @property {(drawn: Drawn) => void} drawn
 * @property {(busy: boolean) => void} busy whether a newer state than the shown one is being drawn
 * @property {(trouble: Trouble) => void} troubled
 * @property {() => void} recovered the last trouble is over
 * @property {(state: Shown, doubtful: boolean) => void} [doubted] whether a state may stop every worker; if the state
 *   has no `look`, the definition may
 */

/** @param {EngineEvents} events */
export function createEngine(events) {
    let lastId = 0;
    const nextId = () => ++lastId;
    const troubles = createTroubles(events);
    const newest = createNewest();
    const connection = createConnection({
        begun,
        received: (message) => receive(message),
        left,
        stopped,
        loadFailed,
        owes: () => outbox.owes || questions.size > 0,
        doubted: (silent) => fallback.doubt(silent),
        unanswerable: (id, error) => questions.refuseOne(id, error),
    });
    const questions = createQuestions({ post: connection.ask, nextId });
    const outbox = createOutbox(newest, {
        post: connection.post,
        ready: () => connection.ready,
        nextId,
        sent,
        settled: () => events.busy(false),
    });
    const fallback = createFallback(newest, outbox, (state, doubtful) => events.doubted?.(state, doubtful));
    const receive = createReceiver({ events, troubles, connection, questions, newest, outbox, fallback });

    function left() {
        questions.forget();
        newest.unsend();
        outbox.forget();
        fallback.moved();
    }

    /** Sends the state first, because questions are about the newest state. */
    function begun() {
        const recalled = fallback.good.definition !== newest.state.definition && outbox.recall(fallback.good);
        outbox.send();
        if (!recalled) questions.putAll();
    }

    function sent() {
        questions.putAll();
        connection.watch();
        events.busy(true);
    }

    /** The worker has stopped: gives up its current task and starts a fresh worker. @param {'silent' | 'crashed'} how @param {string} message */
    function stopped(how, message) {
        const question = questions.refuseOne(fallback.question);
        if (question && isReading(question)) {
            questions.forbid(question, newest.state.definition);
            troubles.tellOfQuestion(how, message);
        }
        const gone = !question && fallback.giveUp();
        connection.leave();
        if (!connection.replace()) return end('lost', message);
        events.busy(false);
        if (!gone) return;
        questions.refuseAboutDrawing();
        troubles.tell(how, message);
    }

    /** @param {'loading' | 'unloadable'} how @param {string} message */
    function loadFailed(how, message) {
        if (how === 'unloadable') end(how, message);
        else troubles.tell(how, message);
    }

    /** Starts no worker until the next input or question. @param {'unloadable' | 'lost'} how @param {string} message */
    function end(how, message) {
        questions.refuseAll(new Error(message));
        events.busy(false);
        troubles.tell(how, message);
    }

    /** @type {import('./questions.js').Ask} */
    async function ask(type, asked) {
        if (questions.isForbidden(type, newest.state.definition))
            throw new Stopped(say`this question stopped the worker before`);
        connection.revive();
        const answer = questions.ask(type, asked);
        connection.watch();
        return answer;
    }

    connection.start();

    return {
        /** The last state that was drawn completely, if any. @returns {Readonly<Shown>} */
        get good() {
            return fallback.good;
        },

        /** @param {import('./newest.js').Definition} definition */
        define(definition) {
            fallback.defined();
            newest.define(definition);
            connection.revive();
            outbox.send();
        },

        /**
         * @param {import('../protocol.js').Canvas} canvas
         * @param {import('../protocol.js').View} view for drawings in the plane
         * @param {import('../protocol.js').Camera | null} [camera] for drawings in space
         */
        look(canvas, view, camera = null) {
            if (!newest.look({ canvas, view, camera })) return;
            fallback.looked();
            outbox.send();
        },

        /** Shows only the first segments, or all if null. @param {bigint | null} segments */
        play(segments) {
            if (newest.play(segments)) outbox.send();
        },

        /** How many segments are shown; null for all. */
        get upto() {
            return newest.upto;
        },

        /** Sets the mates that help with slow pictures. */
        share: connection.share,

        ...asking(ask),
    };
}

/**
 * Handles the worker's messages.
 * @param {object} engine
 * @param {EngineEvents} engine.events
 * @param {ReturnType<typeof createTroubles>} engine.troubles
 * @param {ReturnType<typeof createConnection>} engine.connection
 * @param {ReturnType<typeof createQuestions>} engine.questions
 * @param {ReturnType<typeof createNewest>} engine.newest
 * @param {ReturnType<typeof createOutbox>} engine.outbox
 * @param {ReturnType<typeof createFallback>} engine.fallback
 */
function createReceiver({ events, troubles, connection, questions, newest, outbox, fallback }) {
    /** @param {number} id @param {Report} report */
    function reported(id, report) {
        if (outbox.isRecalled(id)) return;
        // No picture comes for a definition with errors or above a limit.
        if (outbox.isLastDefinition(id) && isWrong(report)) {
            outbox.settle();
            if (!fallback.gaveUp) troubles.end();
        }
        events.report(report, fallback.gaveUp);
    }

    /** @param {import('../protocol.js').Picture} picture */
    function drawn(picture) {
        connection.proven();
        if (outbox.isRecalled(picture.id)) {
            picture.bitmap.close();
            if (picture.complete) outbox.ended(picture);
            return;
        }
        const look = outbox.lookOf(picture.viewId);
        connection.noteSlow(picture.slow);
        const last = outbox.isLast(picture);
        // A fresh worker begins with a coarse picture of a state whose finest picture is already shown.
        const known = last && !picture.complete && fallback.isKept();
        if (look && !known) events.drawn({ ...picture, ...look });
        if (!fallback.gaveUp) troubles.end();
        if (last && picture.complete && !newest.waits) fallback.keep();
        // Only the finest picture ends the state.
        if (picture.complete) outbox.ended(picture);
        else outbox.reached(picture);
    }

    return (/** @type {FromWorker} */ message) => {
        fallback.trust();
        switch (message.type) {
            case 'hello':
            case 'pong':
            case 'fatal':
                return;
            case 'ready':
                return troubles.endOfLoading();
            case 'at':
                return fallback.moved(message);
            case 'report':
                return reported(message.id, message.report);
            case 'drawn':
                return drawn(message);
            case 'done':
                return outbox.ended(message);
            default:
                if (questions.answer(message)) connection.proven();
        }
    };
}

/** Reports troubles, and once the end of the last one. @param {Pick<EngineEvents, 'troubled' | 'recovered'>} events */
function createTroubles({ troubled, recovered }) {
    /** The reported trouble that is not over yet. @type {Trouble['how'] | null} */
    let reportedTrouble = null;

    function end() {
        if (reportedTrouble === null) return;
        reportedTrouble = null;
        recovered();
    }

    return {
        /** @param {Trouble['how']} how @param {string} message */
        tell(how, message) {
            reportedTrouble = how;
            troubled({ how, question: false, message });
        },

        /** @param {Trouble['how']} how @param {string} message */
        tellOfQuestion: (how, message) => troubled({ how, question: true, message }),

        end,

        endOfLoading() {
            if (reportedTrouble === 'loading' || reportedTrouble === 'unloadable') end();
        },
    };
}

/** Whether errors keep a state from being drawn. @param {Report} report */
export const isWrong = ({ ok, diagnostics }) => !ok || diagnostics.some(({ severity }) => severity === 'error');
