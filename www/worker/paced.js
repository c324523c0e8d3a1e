/** Telling the page of a file that is made in one call: meanwhile the worker cannot hear, and the page ends it to cancel. */

/** The time between two signs of life, in milliseconds. */
const SIGN = 300;

/** Tells each piece of the file, and a sign of life now and then. @param {(piece: Uint8Array<ArrayBuffer> | undefined) => void} tell */
export function paced(tell) {
    let last = performance.now();
    return (/** @type {Uint8Array<ArrayBuffer> | undefined} */ piece) => {
        const now = performance.now();
        if (!piece && now - last < SIGN) return;
        last = now;
        tell(piece);
    };
}
