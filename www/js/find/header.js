/** The sizes of pictures as their files begin, before anything is decoded. Pure functions. */

/** @param {DataView} view @param {number} at */
const short = (view, at) => view.getUint16(at);
/** Three bytes, the lowest first. @param {DataView} view @param {number} at */
const triple = (view, at) => view.getUint16(at, true) | (view.getUint8(at + 2) << 16);

/** The bytes of a GIF's table of colours, by its flags. @param {DataView} view @param {number} at */
const coloursIn = (view, at) => (view.getUint8(at) & 0x80 ? 6 << (view.getUint8(at) & 7) : 0);

/** By the type of the file. @type {Readonly<Record<string, (view: DataView) => [number, number] | null>>} */
const SIZES = {
    'image/png': (view) => [view.getUint32(16), view.getUint32(20)],
    'image/gif': (view) => {
        // Frames may be larger than the screen, and decoders make room for them.
        let [width, height, isFound] = [view.getUint16(6, true), view.getUint16(8, true), false];
        for (let at = 13 + coloursIn(view, 10); at + 10 <= view.byteLength; at++) {
            const block = view.getUint8(at);
            if (block !== 0x21 && block !== 0x2c) break;
            if (block === 0x2c) {
                isFound = true;
                width = Math.max(width, view.getUint16(at + 1, true) + view.getUint16(at + 5, true));
                height = Math.max(height, view.getUint16(at + 3, true) + view.getUint16(at + 7, true));
                at += 9 + coloursIn(view, at + 9);
            }
            // The data come in parts, of which the last is empty.
            at += 2;
            while (at < view.byteLength && view.getUint8(at) > 0) at += 1 + view.getUint8(at);
        }
        return isFound ? [width, height] : null;
    },
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
            // The picture itself begins without a frame, or a marker has no length: decoders would read on elsewhere.
            if (marker < 0xc0 || (marker >= 0xd0 && marker <= 0xda)) return null;
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
