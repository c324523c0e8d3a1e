/** Wheel, touch and clicks on the rows of a string: scrolling, flicks, and selecting a symbol. */

/** A press that moved no farther is a tap on a symbol, in CSS pixels. */
const TAP_DISTANCE = 6;
/** A flick loses this fraction of its speed per millisecond. */
const FRICTION = 0.004;
/** A finger that rested longer before it was lifted does not flick, in milliseconds. */
const REST = 60;
/** A flick stops below this speed, in CSS pixels per millisecond. */
const SLOWEST = 0.02;

/**
 * @param {HTMLElement} area
 * @param {{ruler: {readonly rowHeight: number, readonly height: number}, symbolAt: (clientX: number, clientY: number) => bigint | null}} rows
 * @param {{scroll: (pixels: number) => unknown, click: (index: bigint) => unknown}} act
 */
export function listenToGestures(area, rows, { scroll, click }) {
    /** @type {{id: number, y: number, travelled: number, speed: number, time: number} | null} */
    let finger = null;
    let flick = 0;

    area.addEventListener(
        'wheel',
        (event) => {
            if (event.ctrlKey) return;
            event.preventDefault();
            scroll(
                event.deltaY *
                    (event.deltaMode === 1 ? rows.ruler.rowHeight : event.deltaMode === 2 ? rows.ruler.height : 1),
            );
        },
        { passive: false },
    );
    area.addEventListener('pointerdown', (event) => {
        cancelAnimationFrame(flick);
        if (event.button !== 0) return;
        finger = { id: event.pointerId, y: event.clientY, travelled: 0, speed: 0, time: event.timeStamp };
        if (event.pointerType !== 'mouse') area.setPointerCapture(event.pointerId);
    });
    area.addEventListener('pointermove', (event) => {
        if (finger?.id !== event.pointerId) return;
        const by = finger.y - event.clientY;
        const time = Math.max(1, event.timeStamp - finger.time);
        Object.assign(finger, {
            y: event.clientY,
            travelled: finger.travelled + Math.abs(by),
            speed: by / time,
            time: event.timeStamp,
        });
        if (event.pointerType !== 'mouse' && finger.travelled > TAP_DISTANCE) scroll(by);
    });
    area.addEventListener('pointerup', (event) => {
        if (finger?.id !== event.pointerId) return;
        const { travelled, speed, time } = finger;
        finger = null;
        if (travelled <= TAP_DISTANCE) {
            const index = rows.symbolAt(event.clientX, event.clientY);
            if (index !== null) click(index);
        } else if (event.pointerType !== 'mouse' && event.timeStamp - time < REST) {
            startFlick(speed);
        }
    });
    area.addEventListener('pointercancel', () => (finger = null));

    /** @param {number} speed in CSS pixels per millisecond */
    function startFlick(speed) {
        let last = performance.now();
        const tick = (/** @type {number} */ now) => {
            const time = Math.max(0, now - last);
            last = now;
            speed *= Math.exp(-FRICTION * time);
            if (Math.abs(speed) < SLOWEST) return;
            scroll(speed * time);
            flick = requestAnimationFrame(tick);
        };
        flick = requestAnimationFrame(tick);
    }
}
