/** Pictures as levels of grey, and which of their pixels are ink. Pure functions. */

/** Levels of grey, row by row from above; 0 is black. @typedef {{grey: Uint8Array<ArrayBuffer>, width: number, height: number}} Grey */
/** A rectangle in pixels: from the upper left corner to before the lower right one. @typedef {{left: number, top: number, right: number, bottom: number}} Box */
/** What of a picture is ink: what is darker, or lighter, than a level of grey, inside a rectangle. @typedef {{crop: Box, level: number, isDark: boolean}} Choice */

/** A crop has at least this many pixels in each direction. */
export const LEAST = 8;

/** The levels of grey of opaque pixels. @param {Uint8ClampedArray} rgba @param {number} width @param {number} height @returns {Grey} */
export function greyOf(rgba, width, height) {
    const grey = new Uint8Array(width * height);
    for (let at = 0; at < grey.length; at++) {
        const [red, green, blue] = [rgba[4 * at] ?? 0, rgba[4 * at + 1] ?? 0, rgba[4 * at + 2] ?? 0];
        grey[at] = (299 * red + 587 * green + 114 * blue) / 1000;
    }
    return { grey, width, height };
}

/** Whether all pixels have one level of grey. @param {Grey} picture */
export const isPlain = ({ grey }) => grey.every((level) => level === grey[0]);

/**
 * The level of grey that tells dark from light best (Otsu, "A threshold selection method from gray-level histograms",
 * 1979): the darker pixels have at most this. Between two shades every level is as good, and the middle one is taken.
 * @param {Grey} picture
 * @param {Box} box
 */
export function levelOf({ grey, width }, { left, top, right, bottom }) {
    const counts = new Float64Array(256);
    for (let y = top; y < bottom; y++)
        for (let x = left; x < right; x++)
            counts[grey[y * width + x] ?? 0] = (counts[grey[y * width + x] ?? 0] ?? 0) + 1;
    const all = (right - left) * (bottom - top);
    const sum = counts.reduce((total, count, level) => total + count * level, 0);
    let [dark, darkSum, most] = [0, 0, 0];
    /** @type {number[]} */
    let best = [127];
    for (let level = 0; level < 255; level++) {
        dark += counts[level] ?? 0;
        darkSum += (counts[level] ?? 0) * level;
        const light = all - dark;
        if (dark === 0 || light === 0) continue;
        const apart = darkSum / dark - (sum - darkSum) / light;
        const value = dark * light * apart * apart;
        if (value > most * (1 + 1e-9)) {
            most = value;
            best = [level];
        } else if (value >= most * (1 - 1e-9)) best.push(level);
    }
    return best[best.length >> 1] ?? 127;
}

/** Whether less of a picture is dark than light: lines cover less than what is between them. @param {Grey} picture @param {Box} box @param {number} level */
export const darkIsLess = (picture, box, level) => 2 * inkShare(picture, { crop: box, level, isDark: true }) <= 1;

/** The part of the crop that is ink, from 0 to 1. @param {Grey} picture @param {Choice} choice */
export function inkShare({ grey, width }, { crop: { left, top, right, bottom }, level, isDark }) {
    let ink = 0;
    for (let y = top; y < bottom; y++)
        for (let x = left; x < right; x++) if ((grey[y * width + x] ?? 0) <= level === isDark) ink++;
    return ink / ((right - left) * (bottom - top));
}

/**
 * The crop with black ink on white. A white margin keeps the paper larger than the ink.
 * @param {Grey} picture @param {Choice} choice @returns {Grey}
 */
export function inked({ grey, width }, { crop: { left, top, right, bottom }, level, isDark }) {
    const margin = Math.ceil(Math.max(right - left, bottom - top) / 4);
    const [wide, high] = [right - left + 2 * margin, bottom - top + 2 * margin];
    const ink = new Uint8Array(wide * high).fill(255);
    for (let y = top; y < bottom; y++) {
        for (let x = left; x < right; x++)
            if ((grey[y * width + x] ?? 0) <= level === isDark) ink[(y - top + margin) * wide + x - left + margin] = 0;
    }
    return { grey: ink, width: wide, height: high };
}

/**
 * How much of each pixel of a smaller picture of `wide` times `high` pixels is ink, from 0 to 255. Thin lines stay
 * visible, because one pixel of ink makes at least three quarters of a pixel.
 * @param {Grey} picture @param {Pick<Choice, 'level' | 'isDark'>} choice @param {number} wide @param {number} high
 */
export function inkMap({ grey, width, height }, { level, isDark }, wide, high) {
    const map = new Uint8Array(wide * high);
    for (let y = 0; y < height; y++) {
        const row = Math.floor((y * high) / height) * wide;
        for (let x = 0; x < width; x++) {
            if ((grey[y * width + x] ?? 0) <= level !== isDark) continue;
            const at = row + Math.floor((x * wide) / width);
            map[at] = Math.min(255, Math.max(192, (map[at] ?? 0) + 32));
        }
    }
    return map;
}

/** @typedef {'left' | 'right'} Side @typedef {'top' | 'bottom'} End */

/**
 * The crop with one corner moved to a place, or as near to it as the other corner and the picture allow.
 * @param {Box} crop @param {[End, Side]} corner @param {number} x @param {number} y @param {Pick<Grey, 'width' | 'height'>} picture
 * @returns {Box}
 */
export function withCorner(crop, [end, side], x, y, { width, height }) {
    const within = (/** @type {number} */ value, /** @type {number} */ low, /** @type {number} */ high) =>
        Math.round(Math.min(high, Math.max(low, value)));
    return {
        ...crop,
        [side]: side === 'left' ? within(x, 0, crop.right - LEAST) : within(x, crop.left + LEAST, width),
        [end]: end === 'top' ? within(y, 0, crop.bottom - LEAST) : within(y, crop.top + LEAST, height),
    };
}
