/** The size of the stage and its pixel ratio. */

/** The highest pixel ratio used: finer pixels cost time and are hardly visible. */
const MAX_RATIO = 3;

/** @param {HTMLElement} frame @param {() => void} changed */
export function watchSize(frame, changed) {
    /** In CSS pixels; `ratio` is device pixels per CSS pixel. */
    const size = { width: 0, height: 0, ratio: 1 };

    function measure() {
        Object.assign(size, {
            width: frame.clientWidth,
            height: frame.clientHeight,
            ratio: Math.min(MAX_RATIO, devicePixelRatio || 1),
        });
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
