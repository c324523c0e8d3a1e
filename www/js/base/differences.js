/** Two compared pictures of lines: where both have ink, and where one of them only. */

/** The side of compared pictures, in pixels. */
export const SIDE = 512;

/** Ink of both, of the first picture only, of the second one only: told apart by the colour-blind. @type {Record<'light' | 'dark', [number, number, number][]>} */
export const COLOURS = {
    light: [
        [176, 176, 170],
        [0, 98, 178],
        [209, 84, 0],
    ],
    dark: [
        [104, 110, 104],
        [86, 180, 255],
        [255, 152, 56],
    ],
};

/**
 * Pixels of compared pictures, transparent where nothing has ink.
 * @param {Uint8Array} codes of each pixel: 1 for ink of both, 2 for ink of the first one only, 4 for ink of the second one only
 * @param {'light' | 'dark'} theme
 */
export function coloured(codes, theme) {
    const pixels = new Uint8ClampedArray(4 * codes.length);
    for (const [at, code] of codes.entries()) {
        const colour = code === 0 ? null : COLOURS[theme][code >> 1];
        if (colour) pixels.set([...colour, 255], 4 * at);
    }
    return pixels;
}
