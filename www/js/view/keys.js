/** Keys on the drawing: arrows change angle and iterations, or move with Shift; other keys zoom. */

/** The zoom factor of one press of a key or button. */
export const ZOOM_STEP = 1.5;
/** The movement of one press of an arrow, as a fraction of the drawing's shorter side. */
const PAN_STEP = 0.1;
/** The turn of one press of an arrow in space, in CSS pixels of dragging. */
const ORBIT_STEP = 25;

/** The arrows' directions: right and up. @type {Record<string, [number, number]>} */
export const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/**
 * @param {HTMLElement} canvas
 * @param {import('../state/store.js').Store} store
 * @param {Pick<ReturnType<typeof import('./moves.js').createMoves>, 'drag' | 'fit'> & {zoom: (factor: number) => unknown}} moves
 * @param {{space: () => boolean, side: () => number, changes: () => readonly ('angle' | 'iterations')[]}} stage `side` is the
 *   length of the shorter side, in CSS pixels; `changes` tells which fields the arrows change
 */
export function listenToKeys(canvas, store, moves, { space, side, changes }) {
    canvas.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.metaKey) return;
        const act = actionOf(event);
        if (!act) return;
        event.preventDefault();
        act();
    });

    /** @param {KeyboardEvent} event @returns {(() => void) | undefined} */
    function actionOf({ key, shiftKey, altKey }) {
        const arrow = ARROWS[key];
        if (arrow) return arrowAction(arrow, shiftKey, altKey);
        switch (key) {
            case '+':
            case '=':
                return () => moves.zoom(ZOOM_STEP);
            case '-':
                return () => moves.zoom(1 / ZOOM_STEP);
            case '0':
                return moves.fit;
            default:
                return undefined;
        }
    }

    /** @param {[number, number]} arrow @param {boolean} moving @param {boolean} fine */
    function arrowAction([x, y], moving, fine) {
        const by = space() ? ORBIT_STEP : PAN_STEP * side();
        if (moving) return () => moves.drag(-x * by, y * by, false);
        if (!changes().includes(x ? 'angle' : 'iterations')) return undefined;
        const { angle, iterations } = store.state;
        if (y) return () => store.change({ iterations: iterations + y }, 'iterations');
        return () => store.change({ angle: Number((angle + x * (fine ? 0.1 : 1)).toFixed(6)) }, 'angle');
    }
}
