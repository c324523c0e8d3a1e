/** How large the stage is, and how fine its pixels are. */

const MOST_RATIO = 3;

/** @param {HTMLElement} frame @param {() => void} changed */
export function watchSize(frame, changed) {
    /** In CSS pixels; `ratio` is device pixels per CSS pixel. */
    const size = { width: 0, height: 0, ratio: 1 };

    function measure() {
        Object.assign(size, { width: frame.clientWidth, height: frame.clientHeight, ratio: Math.min(MOST_RATIO, devicePixelRatio || 1) });
        if (size.width > 0 && size.height > 0) changed();
    }

    function watchRatio() {
        matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener(
            'change',
            () => {
                measure();
                watchRatio();
            },
            { once: true },
        );
    }

    new ResizeObserver(measure).observe(frame);
    watchRatio();
    return { size, measure };
}
