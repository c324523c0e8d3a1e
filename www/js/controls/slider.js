/** A slider over a list of values. */

/** `held`: more changes of the same drag may follow. @typedef {{stops: readonly number[], text: (value: number) => string, change: (value: number, held: boolean) => void, settle: () => void}} Scale */
/** @typedef {{show: (value: number) => void, limit: (highest: number | null) => void, scale: (stops: readonly number[]) => void}} Slider */

/**
 * @param {HTMLInputElement} element
 * @param {Scale} scale `stops` ascend
 * @returns {Slider}
 */
export function slider(element, { stops, text, change, settle }) {
    let last = stops.length - 1;
    element.min = '0';
    element.step = '1';
    element.max = String(last);

    const paint = () => element.style.setProperty('--at', String(last === 0 ? 0 : Number(element.value) / last));
    const stopAt = () => /** @type {number} */ (stops[Number(element.value)]);

    element.addEventListener('input', () => {
        element.setAttribute('aria-valuetext', text(stopAt()));
        paint();
        change(stopAt(), true);
    });
    element.addEventListener('change', settle);

    return {
        show(value) {
            element.value = String(nearest(stops, value));
            element.setAttribute('aria-valuetext', text(value));
            paint();
        },
        limit(highest) {
            const next =
                highest === null
                    ? stops.length - 1
                    : Math.max(
                          1,
                          stops.findLastIndex((stop) => stop <= highest),
                      );
            if (next === last) return;
            const value = stopAt();
            last = next;
            element.max = String(last);
            element.value = String(nearest(stops, value));
            paint();
        },
        scale(next) {
            stops = next;
            last = stops.length - 1;
            element.max = String(last);
        },
    };
}

/**
 * The index of the stop nearest to a value.
 * @param {readonly number[]} stops ascending
 * @param {number} value
 */
export function nearest(stops, value) {
    let best = 0;
    for (let at = 1; at < stops.length; at++) {
        if (Math.abs(/** @type {number} */ (stops[at]) - value) < Math.abs(/** @type {number} */ (stops[best]) - value))
            best = at;
    }
    return best;
}

/**
 * Values from `low` to `high` in even steps.
 * @param {number} low
 * @param {number} high
 * @param {number} step
 */
export function even(low, high, step) {
    return Array.from({ length: Math.round((high - low) / step) + 1 }, (_, at) => Number((low + at * step).toFixed(6)));
}
