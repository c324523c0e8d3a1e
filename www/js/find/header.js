/** The sizes of pictures as their files begin, before anything is decoded. Pure functions. */

/** @param {DataView} view @param {number} at */
const short = (view, at) => view.getUint16(at);
/** Three bytes, the lowest first. @param {DataView} view @param {number} at */
const triple = (view, at) => view.getUint16(at, true) | (view.getUint8(at + 2) << 16);

/** By the type of the file. @type {Readonly<Record<string, (view: DataView) => [number, number] | null>>} */
const SIZES = {
    'image/png': (view) => [view.getUint32(16), view.getUint32(20)],
    'image/gif': (view) => [view.getUint16(6, true), view.getUint16(8, true)],
    'image/webp': (view) => {
        const form = view.getUint8(15);
        // VP8X, VP8L and VP8.
        if (form === 0x58) return [triple(view, 24) + 1, triple(view, 27) + 1];
        if (form === 0x4c) {
            const bits = view.getUint32(21, true);
            return [(bits & 0x3fff) + 1, ((bits >> 14) & 0x3fff) + 1];
        }
        return [view.getUint16(26, true) & 0x3fff, view.getUint16(28, true) & 0x3fff];
    },
    'image/jpeg': (view) => {
        for (let at = 2; ; ) {
            if (view.getUint8(at) !== 0xff) return null;
            const marker = view.getUint8(at + 1);
            // Markers may be filled up.
            if (marker === 0xff) {
                at++;
                continue;
            }
            const isFrame = marker >= 0xc0 && marker <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(marker);
            if (isFrame) return [short(view, at + 7), short(view, at + 5)];
            // The picture itself begins without a frame.
            if (marker === 0xda || marker === 0xd9) return null;
            at += 2 + short(view, at + 2);
        }
    },
};

/**
 * The width and height in pixels that a file promises, or null if it promises none.
 * @param {string} kind the type of the file
 * @param {ArrayBuffer} start its first bytes
 * @returns {[number, number] | null}
 */
export function promisedSize(kind, start) {
    try {
        return SIZES[kind]?.(new DataView(start)) ?? null;
    } catch {
        // The file ends before.
        return null;
    }
}
