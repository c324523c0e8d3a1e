/** The drawing that the page shows. */

import { STEP_MS, page } from './page.js';

/** @typedef {wasm_bindgen.Playground} Playground */
/** @typedef {import('../js/protocol.js').Sight} Sight */
/** @typedef {import('./page.js').Inbox} Inbox */
/** @typedef {import('./page.js').Step} Step */

/**
 * The newest state and view: takes them up, makes pictures of them, and tells the page of both.
 * @param {object} worker
 * @param {Playground} worker.playground
 * @param {OffscreenCanvas} worker.canvas
 * @param {Inbox} worker.inbox
 */
export function createDrawing({ playground, canvas, inbox }) {
    /** What is not shown after this time is superseded by what is newer. */
    const PATIENCE_MS = 250;
    /** What is taken up. @type {{define: Inbox['define'], view: Inbox['view']}} */
    const at = { define: null, view: null };
    /** The last good state, which pictures are of. @type {import('../js/protocol.js').Definition | null} */
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
         * @returns {import('../js/protocol.js').Report | null} what is known so far of a new definition
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
                        report = /** @type {import('../js/protocol.js').Report} */ (playground.define(define.definition));
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
         * @param {import('../js/protocol.js').Report | null} first what is known so far of a new definition; most drawings are built in this step, and
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

/** The turtle's pose behind the segments that are shown, or before the first. @param {Playground} playground @param {bigint | null} upto @returns {import('../js/protocol.js').Pose | null} */
function poseAt(playground, upto) {
    if (upto === null) return null;
    const began = upto > 0n;
    /** @type {import('../js/protocol.js').Stroke | null} */
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
export function lookAt(playground, { width, height, ratio, view, camera }) {
    playground.view(width, height, ratio, view.x, view.y, view.zoom, view.fx ?? 0, view.fy ?? 0);
    if (camera) playground.camera(camera.azimuth, camera.elevation, camera.zoom, camera.x, camera.y, camera.z, camera.perspective, camera.fade);
}
