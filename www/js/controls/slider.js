/** A slider over a list of values. */

/** The least that a slider with an open end reaches. */
const LEAST_REACH = 8;

/**
 * `held`: more changes of the same drag may follow. `open`: the slider reaches about twice its value, and further once
 * it is let go at its end.
 * @typedef {{stops: readonly number[], open?: boolean, text: (value: number) => string, change: (value: number, held: boolean) => void, settle: () => void}} Scale
 */
/** @typedef {{show: (value: number) => void, limit: (highest: number | null) => void, scale: (stops: readonly number[]) => void}} Slider */

/**
 * @param {HTMLInputElement} element
 * @param {Scale} scale `stops` ascend
 * @returns {Slider}
 */
export function slider(element, { stops, open = false, text, change, settle }) {
    let last = stops.length - 1;
    let highest = Infinity;
    let reach = open ? 0 : Infinity;
    let held = false;
    element.min = '0';
    element.step = '1';
    element.max = String(last);

    const paint = () => element.style.setProperty('--at', String(last === 0 ? 0 : Number(element.value) / last));
    const stopAt = () => /** @type {number} */ (stops[Number(element.value)]);

    /** Sets the end of the slider, with the thumb at a value. @param {number} value */
    function place(value) {
        const end = Math.min(highest, reach);
        last = Math.max(
            1,
            stops.findLastIndex((stop) => stop <= end),
        );
        element.max = String(last);
        element.value = String(nearest(stops, value));
        paint();
    }

    /** @param {number} value */
    function reachFor(value) {
        if (open) reach = Math.max(LEAST_REACH, 2 * value);
        place(value);
    }

    element.addEventListener('input', () => {
        held = true;
        element.setAttribute('aria-valuetext', text(stopAt()));
        paint();
        change(stopAt(), true);
    });
    element.addEventListener('change', () => {
        held = false;
        if (Number(element.value) === last) reachFor(stopAt());
        settle();
    });

    return {
        show(value) {
            // The slider's own value never shortens it, or the thumb would leave the finger.
            if (!held && (value >= reach || (value !== stopAt() && value < reach / 3))) reachFor(value);
            else place(value);
            element.setAttribute('aria-valuetext', text(value));
        },
        limit(most) {
            const next = most ?? Infinity;
            if (next === highest) return;
            const value = stopAt();
            highest = next;
            place(value);
        },
        scale(next) {
            stops = next;
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
