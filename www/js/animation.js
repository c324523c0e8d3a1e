/** What growth and wind share: a toggle, frames that can pause, and the drawing of the state at the end. */

/**
 * @param {object} options
 * @param {HTMLButtonElement} options.toggle starts and stops
 * @param {() => void} options.start
 * @param {(now: number) => void} options.tick is called for each frame
 * @param {() => void} options.resumed is called before the first frame, and after a pause
 * @param {() => void} options.forgotten is called at the end
 * @param {() => void} options.draw draws the state again
 */
export function createAnimation({ toggle, start, tick, resumed, forgotten, draw }) {
    let running = false;
    /** The request for the next frame; 0 during a pause. */
    let frame = 0;

    /** @param {number} now */
    function next(now) {
        frame = requestAnimationFrame(next);
        tick(now);
    }

    function resume() {
        resumed();
        frame = requestAnimationFrame(next);
    }

    function pause() {
        cancelAnimationFrame(frame);
        frame = 0;
    }

    /** The state has changed, and the engine already draws it. */
    function forget() {
        if (!running) return;
        running = false;
        pause();
        toggle.setAttribute('aria-pressed', 'false');
        forgotten();
    }

    /** Stops, and draws the state again. */
    function stop() {
        if (!running) return;
        forget();
        draw();
    }

    toggle.addEventListener('click', () => (running ? stop() : start()));

    return {
        get running() {
            return running;
        },
        get playing() {
            return frame !== 0;
        },
        /** From now on the toggle stops. */
        begin() {
            running = true;
            toggle.setAttribute('aria-pressed', 'true');
        },
        resume,
        pause,
        forget,
        stop,
    };
}
