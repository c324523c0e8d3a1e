/**
 * The worker as seen from the page: takes states, shows pictures of the newest, and asks questions.
 *
 * A worker that stops, because it crashes or falls silent, is replaced. What it was at is given up: a fresh worker goes on
 * with everything else, and with the last good state in the place of one that stopped it.
 */

import { createConnection } from './engine/connection.js';
import { createFallback } from './engine/fallback.js';
import { createNewest } from './engine/newest.js';
import { createOutbox } from './engine/outbox.js';
import { Stopped, asking, createQuestions, isReading } from './engine/questions.js';

/** @typedef {import('./protocol.js').Report} Report */
/** @typedef {import('./protocol.js').Notation} Notation */
/** @typedef {import('./protocol.js').FromWorker} FromWorker */
/** @typedef {import('./engine/newest.js').Shown} Shown */
/** A picture and what it shows. @typedef {import('./protocol.js').Picture & import('./engine/newest.js').Look} Drawn */
/**
 * What went wrong. `silent` and `crashed`: the worker stopped over the drawing, or over a `question` about it, and was
 * replaced; `loading`: its files could not be loaded, and are tried again; `unloadable`: they are not; `lost`: fresh workers
 * stopped as well.
 * @typedef {{how: 'silent' | 'crashed' | 'loading' | 'unloadable' | 'lost', question: boolean, message: string}} Trouble
 */
/** @typedef {ReturnType<typeof createEngine>} Engine */

/**
 * @typedef {object} Events
 * @property {(report: Report, past: boolean) => void} report `past`: of the last good state, because the newest was given up
 * @property {(drawn: Drawn) => void} drawn
 * @property {(busy: boolean) => void} busy whether a newer state is under way than the one shown
 * @property {(trouble: Trouble) => void} troubled
 * @property {() => void} recovered it draws again, so that what was told of a trouble holds no longer
 * @property {(state: Shown, doubtful: boolean) => void} [doubted] a state may stop every worker that it is given to, or is
 *   good after all; without its `look` the definition may
 */

/** @param {Events} events */
export function createEngine(events) {
    let lastId = 0;
    const nextId = () => ++lastId;
    const troubles = createTroubles(events);
    const newest = createNewest();
    const connection = createConnection({ begun, received: (message) => receive(message), left, stopped, missed, owes: () => outbox.owes || questions.size > 0, doubted: (silent) => fallback.doubt(silent) });
    const questions = createQuestions({ post: connection.post, nextId });
    const outbox = createOutbox(newest, { post: connection.post, ready: () => connection.ready, nextId, sent, settled: () => events.busy(false) });
    const fallback = createFallback(newest, outbox, (state, doubtful) => events.doubted?.(state, doubtful));
    const receive = createReceiver({ events, troubles, connection, questions, newest, outbox, fallback });

    function left() {
        questions.forget();
        newest.unsend();
        outbox.forget();
        fallback.forget();
    }

    /** Questions are about the newest state, which the worker has to know. */
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

    /** The worker has stopped: what it was at is given up, and a fresh one goes on. @param {'silent' | 'crashed'} how @param {string} message */
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
    function missed(how, message) {
        if (how === 'unloadable') end(how, message);
        else troubles.tell(how, message);
    }

    /** No worker is started until there is something new to do. @param {'unloadable' | 'lost'} how @param {string} message */
    function end(how, message) {
        questions.refuseAll(new Error(message));
        events.busy(false);
        troubles.tell(how, message);
    }

    /** @type {import('./engine/questions.js').Ask} */
    async function ask(type, asked) {
        if (questions.isForbidden(type, newest.state.definition)) throw new Stopped('this question stopped the worker before');
        connection.revive();
        const answer = questions.ask(type, asked);
        connection.watch();
        return answer;
    }

    connection.start();

    return {
        /** The last state that was drawn to its end, if any. @returns {Readonly<Shown>} */
        get good() {
            return fallback.good;
        },

        /** @param {import('./protocol.js').Definition} definition */
        define(definition) {
            fallback.defined();
            newest.define(definition);
            connection.revive();
            outbox.send();
        },

        /**
         * @param {import('./protocol.js').Canvas} canvas
         * @param {import('./protocol.js').View} view of a drawing in the plane
         * @param {import('./protocol.js').Camera | null} [camera] of one in space
         */
        look(canvas, view, camera = null) {
            if (!newest.look({ canvas, view, camera })) return;
            fallback.looked();
            outbox.send();
        },

        /** Shows only the first segments; all of them with null. @param {bigint | null} segments */
        play(segments) {
            if (newest.play(segments)) outbox.send();
        },

        /** From now on these help with pictures that take long. */
        share: connection.share,

        ...asking(ask),
    };
}

/**
 * What is done with the worker's messages.
 * @param {object} engine
 * @param {Events} engine.events
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
        // What is wrong is not drawn, nor what passes a limit.
        if (outbox.isLastDefinition(id) && isWrong(report)) {
            outbox.settle();
            if (!fallback.gaveUp) troubles.end();
        }
        events.report(report, fallback.gaveUp);
    }

    /** @param {import('./protocol.js').Picture} picture */
    function drawn(picture) {
        connection.proven();
        if (outbox.isRecalled(picture.id)) {
            picture.bitmap.close();
            if (picture.complete) outbox.ended(picture);
            return;
        }
        const look = outbox.lookOf(picture.viewId);
        connection.took(picture.slow);
        const last = outbox.isLast(picture);
        // A worker that takes over begins with a coarse picture of what is shown at its finest already.
        const known = last && !picture.complete && fallback.isKept();
        if (look && !known) events.drawn({ ...picture, ...look });
        if (!fallback.gaveUp) troubles.end();
        if (last && picture.complete && !newest.waits) fallback.keep();
        // Only the finest is the end of it.
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

/** Tells of troubles, and once of the end of the last. @param {Pick<Events, 'troubled' | 'recovered'>} events */
function createTroubles({ troubled, recovered }) {
    /** What was told last, if that still holds. @type {Trouble['how'] | null} */
    let told = null;

    function end() {
        if (told === null) return;
        told = null;
        recovered();
    }

    return {
        /** @param {Trouble['how']} how @param {string} message */
        tell(how, message) {
            told = how;
            troubled({ how, question: false, message });
        },

        /** @param {Trouble['how']} how @param {string} message */
        tellOfQuestion: (how, message) => troubled({ how, question: true, message }),

        end,

        endOfLoading() {
            if (told === 'loading' || told === 'unloadable') end();
        },
    };
}

/** Whether there is a mistake that keeps a state from being drawn. @param {Report} report */
export const isWrong = ({ ok, diagnostics }) => !ok || diagnostics.some(({ severity }) => severity === 'error');
