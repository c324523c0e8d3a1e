/** Gestures on the drawing with fingers, mouse, wheel and track pad. */

/**
 * Turns pointer, wheel and pinch events into drags and zooms, in client coordinates.
 * @param {HTMLElement} element
 * @param {{takes: (event: Event) => boolean, drag: (dx: number, dy: number, aside: boolean) => void, zoom: (factor: number, x: number, y: number) => void, fit: () => void}} act
 */
export function listenToGestures(element, { takes, drag, zoom, fit }) {
    /** @type {Map<number, {x: number, y: number}>} */
    const pointers = new Map();

    element.addEventListener('pointerdown', (event) => {
        if (event.button !== 0 || !takes(event)) return;
        element.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        element.classList.add('held');
    });
    element.addEventListener('pointermove', (event) => {
        const was = pointers.get(event.pointerId);
        if (!was) return;
        const now = { x: event.clientX, y: event.clientY };
        pointers.set(event.pointerId, now);
        const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
        if (!other) return drag(now.x - was.x, now.y - was.y, event.shiftKey);
        const apart = (/** @type {{x: number, y: number}} */ a) => Math.hypot(a.x - other.x, a.y - other.y);
        const middle = (/** @type {{x: number, y: number}} */ a) => ({
            x: (a.x + other.x) / 2,
            y: (a.y + other.y) / 2,
        });
        drag(middle(now).x - middle(was).x, middle(now).y - middle(was).y, true);
        if (apart(was) > 1 && apart(now) > 1) zoom(apart(now) / apart(was), middle(now).x, middle(now).y);
    });
    /** @param {PointerEvent} event */
    const release = (event) => {
        pointers.delete(event.pointerId);
        element.classList.toggle('held', pointers.size > 0);
    };
    element.addEventListener('pointerup', release);
    element.addEventListener('pointercancel', release);
    element.addEventListener('dblclick', fit);
    element.addEventListener(
        'wheel',
        (event) => {
            if (!takes(event)) return;
            event.preventDefault();
            const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1);
            // A pinch on a track pad arrives as a wheel with Ctrl held, in much smaller steps.
            const speed = event.ctrlKey ? 0.01 : 0.0018;
            zoom(Math.exp(-Math.max(-400, Math.min(400, pixels)) * speed), event.clientX, event.clientY);
        },
        { passive: false },
    );
    // Safari sends separate events for a pinch on a track pad; pointer events already cover a pinch on the screen.
    let pinched = 1;
    /** @param {Event} event */
    const pinch = (event) => {
        if (pointers.size > 0 || !takes(event)) return;
        event.preventDefault();
        const { scale, clientX, clientY } = /** @type {MouseEvent & {scale: number}} */ (event);
        if (event.type === 'gesturechange') zoom(scale / pinched, clientX, clientY);
        pinched = scale;
    };
    element.addEventListener('gesturestart', pinch);
    element.addEventListener('gesturechange', pinch);
}
