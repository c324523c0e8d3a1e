/** The drawing on the page. */

import { STEP_MS, page } from './page.js';

/** @typedef {wasm_bindgen.Playground} Playground */
/** @typedef {import('../js/protocol.js').ViewMessage} ViewMessage */
/** @typedef {import('./page.js').Inbox} Inbox */
/** @typedef {import('./page.js').Step} Step */

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
        /** The number of iterations of the drawn definition. */
        get iterations() {
            return definition?.iterations ?? 0;
        },
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
                        report = /** @type {import('../js/protocol.js').Report} */ (
                            playground.define(define.definition)
                        );
                        ok = report.ok;
                        if (ok) definition = define.definition;
                    });
                }
                if (view) {
                    at.view = view;
                    take(view, () => lookAt(playground, view));
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
            /** @type {Step} */
            const { report, drawn, idle } = at.view
                ? playground.step(STEP_MS)
                : { report: null, drawn: null, idle: true };
            const [id, viewId] = ids();
            const news = (ok && report) || first;
            if (news) page.postMessage({ type: 'report', id, report: news });
            moving = drawn?.moving ?? false;
            if (drawn || idle) begun = null;
            if (drawn) {
                const bitmap = canvas.transferToImageBitmap();
                const { complete, scale, rough, slow, only } = drawn;
                page.postMessage(
                    {
                        type: 'drawn',
                        id,
                        viewId,
                        complete,
                        scale,
                        rough,
                        slow,
                        only,
                        bitmap,
                        pose: poseAt(playground, upto),
                    },
                    [bitmap],
                );
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

/** The turtle's pose after the last shown segment, or before the first one. @param {Playground} playground @param {bigint | null} upto @returns {import('../js/protocol.js').Pose | null} */
function poseAt(playground, upto) {
    if (upto === null) return null;
    const began = upto > 0n;
    /** @type {import('../js/protocol.js').SegmentFacts | null} */
    const stroke = playground.segment(began ? upto - 1n : 0n);
    if (!stroke) return null;
    const { from, to, fittedFrom, fittedTo, heading, level } = stroke;
    return { at: began ? to : from, fitted: began ? fittedTo : fittedFrom, heading, level };
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

/** @param {Playground} playground @param {Pick<ViewMessage, 'width' | 'height' | 'ratio' | 'view' | 'camera'>} message */
export function lookAt(playground, { width, height, ratio, view, camera }) {
    playground.view(width, height, ratio, view.x, view.y, view.zoom, view.fx ?? 0, view.fy ?? 0);
    if (camera)
        playground.camera(
            camera.azimuth,
            camera.elevation,
            camera.zoom,
            camera.x,
            camera.y,
            camera.z,
            camera.perspective,
            camera.fade,
        );
}
