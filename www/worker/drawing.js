/** The drawing on the page. */

import { page } from './page.js';

/** @typedef {wasm_bindgen.Playground} Playground */
/** @typedef {import('../js/protocol.js').ViewMessage} ViewMessage */
/** @typedef {import('./page.js').Inbox} Inbox */

/**
 * Draws the newest definition and view, and reports both to the page.
 * @param {object} worker
 * @param {Playground} worker.playground
 * @param {OffscreenCanvas} worker.canvas
 * @param {Inbox} worker.inbox
 */
export function createDrawing({ playground, canvas, inbox }) {
    /** A state that is not shown after this time is superseded by a newer one. */
    const PATIENCE_MS = 250;
    /** The messages being drawn. @type {{define: Inbox['define'], view: Inbox['view']}} */
    const at = { define: null, view: null };
    /** The last valid definition, which pictures show. @type {import('../js/protocol.js').Definition | null} */
    let definition = null;
    /** How many segments are shown; null for all. @type {bigint | null} */
    let upto = null;
    /** Counts the states taken up. */
    let revision = 0;
    /** Whether the newest definition can be drawn; otherwise the playground still draws the one before. */
    let ok = true;
    /** When the current state was begun; null once its picture is shown. @type {number | null} */
    let begun = null;
    /** Whether the last picture was made while the drawing moves. */
    let moving = false;
    /** Whether the last step left nothing to draw. */
    let wasIdle = true;
    const tellAt = onChange(
        (/** @type {number} */ define, /** @type {number} */ view, /** @type {number} */ question) =>
            page.postMessage({ type: 'at', define, view, question }),
    );
    const tellDone = onChange((/** @type {number} */ id, /** @type {number} */ viewId) =>
        page.postMessage({ type: 'done', id, viewId }),
    );
    const ids = () => /** @type {const} */ ([at.define?.id ?? 0, at.view?.id ?? 0]);

    /** @param {NonNullable<Inbox['define' | 'view']>} newest @param {() => void} act */
    function take(newest, act) {
        upto = newest.upto;
        tellAt(...ids(), 0);
        wasIdle = false;
        act();
        playground.play(upto ?? undefined);
        revision += 1;
    }

    return {
        get moving() {
            return moving;
        },

        shown: () => ({ revision, state: definition && at.view && { definition, view: at.view, upto } }),

        /**
         * Takes up the newest definition and view, unless the current picture may finish first.
         * @returns {import('../js/protocol.js').Report | null} the first report on a new definition
         */
        takeUp() {
            /** @type {import('../js/protocol.js').Report | null} */
            let report = null;
            const { define, view } = inbox;
            if (begun === null || performance.now() - begun > PATIENCE_MS) {
                begun = define || view ? performance.now() : null;
                Object.assign(inbox, { define: null, view: null });
                if (define) {
                    at.define = define;
                    take(define, () => {
                        playground.hold(Boolean(define.definition.still));
                        report = playground.define(define.definition);
                        ok = report.ok;
                        if (ok) definition = define.definition;
                    });
                }
                if (view) {
                    at.view = view;
                    take(view, () => playground.look(view));
                }
            }
            if (!wasIdle) tellAt(...ids(), 0);
            return report;
        },

        /**
         * @param {import('../js/protocol.js').Report | null} first the first report on a new definition; most drawings are built in this step, and
         *   then the page gets one report
         * @returns {boolean} whether nothing is left to do
         */
        step(first) {
            const { report, drawn, idle } = at.view ? playground.step() : { report: null, drawn: null, idle: true };
            const [id, viewId] = ids();
            const news = (ok && report) || first;
            if (news) page.postMessage({ type: 'report', id, report: news });
            moving = drawn?.moving ?? false;
            if (drawn || idle) begun = null;
            if (drawn) {
                const bitmap = canvas.transferToImageBitmap();
                page.postMessage({ type: 'drawn', id, viewId, bitmap, ...drawn }, [bitmap]);
            }
            // Tell the page not to wait for more pictures, even if there was none.
            if (idle && at.view) tellDone(id, viewId);
            wasIdle = idle;
            return idle;
        },

        /** Tells the page the next task, so that the page can give that task up if this worker stops. @param {number} question the question's id, or 0 for the drawing */
        tellAt: (question) => tellAt(...ids(), question),
    };
}

/** Calls `act` only if the numbers have changed. @template {number[]} Numbers @param {(...numbers: Numbers) => void} act @returns {(...numbers: Numbers) => void} */
function onChange(act) {
    let last = '';
    return (...numbers) => {
        const now = numbers.join();
        if (now === last) return;
        last = now;
        act(...numbers);
    };
}
