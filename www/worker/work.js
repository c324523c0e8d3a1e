/** The order of the worker's tasks. */

import { page } from './page.js';
import { createReading } from './reading.js';

/** @typedef {wasm_bindgen.Playground} Playground */
/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** @typedef {import('../js/protocol.js').Questions} Questions */
/** @typedef {import('./page.js').Inbox} Inbox */

/**
 * Does the next task: first the drawing, then a question, then a small picture.
 * @param {object} worker
 * @param {Playground} worker.playground
 * @param {Inbox} worker.inbox
 * @param {ReturnType<typeof import('./drawing.js').createDrawing>} worker.drawing
 * @param {ReturnType<typeof import('./sharing.js').createSharing>} worker.sharing
 * @param {ReturnType<typeof import('./files.js').createReadFile>} worker.readFile
 * @param {ReturnType<typeof import('./thumbs.js').createThumbs>} worker.thumbs
 * @param {() => void} worker.wake
 */
export function createWork({ playground, inbox, drawing, sharing, readFile, thumbs, wake }) {
    /** After a picture of a moving drawing, wait this long for the next view before refining the picture. */
    const PAUSE_MS = 12;
    /** Mates are checked again after this time without an answer. */
    const WAIT_MS = 40;
    const { questions } = inbox;
    const reading = createReading(playground);
    const hasNews = () => inbox.define !== null || inbox.view !== null;

    /** Prepares a question's answer for one step. @param {Question} question @returns {boolean} whether the question can be answered */
    function canAnswer(question) {
        if (!reading.is(question)) return true;
        drawing.tellAt(question.id);
        return playground.remember(question.type === 'string' ? question.generation : undefined);
    }

    /** @param {Inbox['questions'][number]} question */
    function answer(question) {
        const { id } = question;
        drawing.tellAt(id);
        if (reading.is(question)) return page.postMessage(reading.answer(question));
        switch (question.type) {
            case 'notation':
                return page.postMessage({ type: 'notation', id, ...wasm_bindgen.notation(question.texts) });
            case 'site':
                return page.postMessage({
                    type: 'site',
                    id,
                    site: wasm_bindgen.siteOf(question.texts, question.field, question.offset),
                });
            case 'qr':
                return page.postMessage({ type: 'qr', id, modules: wasm_bindgen.qr_code(question.text) ?? null });
            case 'seed':
                return page.postMessage({ type: 'seed', id, seed: wasm_bindgen.fresh_seed() });
            default:
                return readFile(question);
        }
    }

    return function work() {
        // A small picture shares its memory with unfinished drawings, so postpone it.
        if (hasNews() || questions.length > 0) thumbs.postpone();
        const report = drawing.takeUp();
        sharing.deal();
        const idle = drawing.step(report);
        sharing.deal();
        // Questions are about the newest definition, whose drawing may be unfinished.
        const isNewest = () => !hasNews() && playground.built;
        const [question] = isNewest() ? questions : [];
        if (question && canAnswer(question)) {
            questions.shift();
            answer(question);
        }
        if (idle && questions.length === 0) thumbs.step();
        if (hasNews() || (questions.length > 0 && isNewest()) || thumbs.making || thumbs.waiting) wake();
        else if (!idle) {
            const pause = drawing.moving ? PAUSE_MS : playground.waits ? WAIT_MS : 0;
            if (pause > 0) setTimeout(wake, pause);
            else wake();
        }
    };
}
