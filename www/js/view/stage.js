/**
 * The drawing: shows the worker's pictures, and moves the last picture when the reader pans or zooms, until the worker
 * sends a new one.
 */

import { FRONT } from './camera.js';
import { button, byId, html, setText } from '../base/dom.js';
import { zoomText } from '../base/numerals.js';
import { listenToGestures } from './gestures.js';
import { createHold, nearest } from './hold.js';
import { ZOOM_STEP, listenToKeys } from './keys.js';
import { viewBeside } from './beside-tools.js';
import { createMoves } from './moves.js';
import { createNothingHere } from './nothing-here.js';
import { createPicture } from './picture.js';
import { watchSize } from './size.js';
import { FITTED, isDeep, isFarOff, viewFrom } from './view.js';

/** Zooming in with buttons and keys holds a line within this part of the stage's smaller side from the middle. */
const HELD = 0.45;
/** The digits of 2^128, almost. */
const MOST_DIGITS = 38;
/** The busy sign appears after this time, in milliseconds. */
const SLOW_MS = 300;

/**
 * The places of the tools for drawings in the plane. Tools that come and go with the state have their place always, so
 * that equal states have equal views.
 * @param {HTMLElement} frame
 */
function toolsOn(frame) {
    const { left, top } = frame.getBoundingClientRect();
    // On a projector the tools go away, and the caption is large.
    const shown = frame.closest('.projecting') ? '.caption > p' : '.tools:not([hidden], .tools-space)';
    return [...frame.querySelectorAll(shown)].map((bar) => {
        const box = bar.getBoundingClientRect();
        return { left: box.left - left, top: box.top - top, right: box.right - left, bottom: box.bottom - top };
    });
}

/**
 * @param {import('../state/store.js').Store} store
 * @param {import('../engine/engine.js').Engine} engine
 * @param {{look: (viewpoint: import('./marks.js').Viewpoint | null) => void, from?: (place: number[]) => void}} marks the marks on the picture, which move with it
 * @param {{takes?: (event: Event) => boolean, keys?: () => readonly ('angle' | 'iterations')[], isBesideTools?: boolean}} [page]
 *   `isBesideTools` lets a fitted drawing leave the tools free; `takes` tells which gestures are for the drawing rather than the page around it; `keys` tells which fields the arrow
 *   keys change
 */
export function createStage(
    store,
    engine,
    marks,
    { takes = () => true, keys = () => ['angle', 'iterations'], isBesideTools = false } = {},
) {
    const frame = html('stage');
    const canvas = byId('drawing', HTMLCanvasElement);
    /** Whether the drawing is in space. */
    let space = false;
    /** Whether the drawing has branches. */
    let branches = false;
    let slow = 0;
    /** The camera where the reader has named none: chosen for the system as opened, so that edits do not turn the drawing. */
    let front = FRONT;
    /** The system for which that camera was chosen. @type {unknown} */
    let opened = null;

    const picture = createPicture(canvas, marks.look);
    /** The drawing's width over its height, if it is known. @type {number | null | undefined} */
    let aspect = null;
    /** The view that shows the whole drawing in the plane. */
    let fitted = FITTED;
    const moves = createMoves(
        store,
        picture,
        () => space,
        () => fitted,
        () => front,
    );
    const { size, measure } = watchSize(frame, () => {
        fit();
        look();
    });

    /** Finds the fitted view. Returns whether it has changed. */
    function fit() {
        const before = fitted;
        fitted = isBesideTools && !space ? viewBeside(size, aspect, toolsOn(frame)) : FITTED;
        return ['x', 'y', 'zoom'].some(
            (name) => before[/** @type {'x'} */ (name)] !== fitted[/** @type {'x'} */ (name)],
        );
    }

    /** @returns {import('../protocol.js').Canvas} */
    const resolution = () => ({
        width: Math.max(1, Math.round(size.width * size.ratio)),
        height: Math.max(1, Math.round(size.height * size.ratio)),
        ratio: size.ratio,
    });
    const place = () => picture.place(moves.view(), space ? moves.camera() : null, size);

    function look() {
        place();
        engine.look(resolution(), moves.view(), moves.camera());
        aim();
    }

    /** A place and a reach in device pixels, from CSS pixels from the middle. @param {[number, number]} at @param {number} reach @returns {[number, number, number]} */
    const device = ([x, y], reach) => [
        (x + size.width / 2) * size.ratio,
        (y + size.height / 2) * size.ratio,
        reach * size.ratio,
    ];
    /** Finds what is near a place. @param {[number, number]} at CSS pixels from the middle @param {number} reach in CSS pixels */
    const pick = (at, reach) => engine.pick(...device(at, reach));
    /** Whether the drawing has more than 2^128 segments. */
    let enormous = false;
    /** Whether a segment is being looked for. */
    let aiming = false;

    /**
     * Makes a place on a line the view's origin, from which all places in the picture are exact. Returns the place from
     * there: in deep views, no other numbers stay on a line.
     * @param {[number, number]} near CSS pixels from the middle
     * @param {number} reach in CSS pixels
     */
    async function anchor(near, reach) {
        const { at } = moves.view();
        const found = await engine.anchor(...device(near, reach));
        if (!found || moves.view().at !== at) return null;
        picture.from(found.place, found.at, at);
        marks.from?.(found.place);
        store.setView(viewFrom(moves.view(), found.place, found.at));
        return [0, 0, 0, 0];
    }

    /** Finds a place on a line, from the view's origin. @param {[number, number]} at CSS pixels from the middle @param {number} reach in CSS pixels */
    async function grip(at, reach) {
        if (!space && isDeep(moves.view(), enormous)) return anchor(at, reach);
        const { stroke } = await pick(at, reach);
        return stroke && nearest(stroke, at, moves);
    }

    /** Gives a deep view an origin in the picture: on the held line, or else near the middle. */
    async function aim() {
        if (aiming || space || !isFarOff(moves.view(), enormous)) return;
        aiming = true;
        try {
            if (!(await hold.again())) await anchor([0, 0], Math.max(size.width, size.height) / 2);
        } catch {
            // The worker was replaced. The next move asks again.
        }
        aiming = false;
    }

    const hold = createHold({
        grip,
        origin: () => moves.view().at,
        seen: moves.seen,
        zoom: () => (space ? moves.camera() : moves.view()).zoom,
        shift: (dx, dy) => moves.drag(dx, dy, true),
    });
    const nothingHere = createNothingHere({
        pick,
        goTo: ({ stroke, filled }) =>
            moves.goTo(stroke ? [stroke.fittedFrom, stroke.fittedTo] : (filled?.outline ?? []), size),
        fit: moves.fit,
    });

    button('fit').addEventListener('click', moves.fit);
    /** Zooms in the middle, and keeps a line in view. @param {number} factor */
    const zoom = async (factor) =>
        moves.zoom(factor, factor > 1 ? await hold.inMiddle(HELD * Math.min(size.width, size.height)) : null);
    button('zoom-in').addEventListener('click', () => zoom(ZOOM_STEP));
    button('zoom-out').addEventListener('click', () => zoom(1 / ZOOM_STEP));
    listenToKeys(
        canvas,
        store,
        { ...moves, zoom },
        { space: () => space, side: () => Math.min(size.width, size.height), changes: keys },
    );
    /** From the middle, in CSS pixels. @param {number} x @param {number} y @returns {[number, number]} */
    const fromMiddle = (x, y) => {
        const { left, top } = frame.getBoundingClientRect();
        return [x - left - size.width / 2, y - top - size.height / 2];
    };
    // The buttons then zoom about the line that was clicked: all of the drawing can be reached without dragging.
    canvas.addEventListener('click', ({ clientX, clientY }) => hold.click(fromMiddle(clientX, clientY)));
    listenToGestures(canvas, {
        takes,
        drag: moves.drag,
        zoom(factor, x, y) {
            const at = fromMiddle(x, y);
            const held = hold.at(at);
            if (held) moves.zoomOn(factor, held);
            else moves.zoomAt(factor, ...at);
        },
        fit: moves.fit,
    });
    measure();

    /** @param {boolean} under whether a drawing or its finest picture is being made */
    function setBusy(under) {
        clearTimeout(slow);
        if (under) slow = window.setTimeout(() => (html('busy').hidden = false), SLOW_MS);
        else html('busy').hidden = true;
    }

    /** @param {import('../state/state.js').State} state @param {import('../state/state.js').State | null} before */
    function show(state, before) {
        setText(html('zoom'), zoomText(space ? moves.camera().zoom : moves.view().zoom / fitted.zoom));
        button('fit').setAttribute('aria-pressed', String(moves.isFitted()));
        if (!before || before.view !== state.view || before.camera !== state.camera) look();
    }

    return {
        resolution,
        show,
        setBusy,

        /** Turns a drawing in space smoothly. */
        glideTo: moves.glideToCamera,

        camera: moves.camera,

        /** Whether the drawing is in space. */
        get space() {
            return space;
        },

        /** Whether the drawing has branches. */
        get branches() {
            return branches;
        },

        /** Notes whether the drawing is in space. @param {import('../protocol.js').Report} report */
        report(report) {
            hold.forget();
            if (!report.ok) return;
            ({ branches } = report);
            enormous = (report.segments?.length ?? 0) > MOST_DIGITS;
            if (report.memoised !== null) {
                aspect = report.aspect;
                const { azimuth } = report;
                const turns = azimuth !== null && opened !== store.origin;
                if (turns) {
                    opened = store.origin;
                    front = { ...FRONT, azimuth };
                }
                if ((fit() && moves.isFitted()) || turns) look();
            }
            if (space === report.space) return;
            space = report.space;
            frame.classList.toggle('space', space);
            fit();
            show(store.state, null);
        },

        /** @param {import('../engine/engine.js').Drawn} drawn */
        drawn(drawn) {
            // A picture from before the camera was chosen would turn at once.
            if (space && drawn.camera?.azimuth !== moves.camera().azimuth && !store.state.camera) return;
            picture.paint(drawn);
            frame.classList.add('inked');
            setBusy(!drawn.complete);
            place();
            if (drawn.complete) nothingHere.show(drawn.upto === null && !moves.isFitted() ? drawn.only : null);
        },
    };
}
