/** Calls for files. */

/** The time between two signs of life, in milliseconds. */
const SIGN = 300;

/** @type {import('../tool.js').CallTable} */
export const calls = {
    /** Makes a file in one call, so that the worker cannot hear meanwhile: the page ends the worker to cancel. */
    file(asked, tell) {
        let last = performance.now();
        return wasm_bindgen.make_file(asked, (/** @type {Uint8Array<ArrayBuffer> | undefined} */ piece) => {
            const now = performance.now();
            if (!piece && now - last < SIGN) return;
            last = now;
            tell(piece);
        });
    },

    /** Makes a package for learning systems. */
    package: ({ exercises, title, standard, steps, exercise, language, catalogue }) =>
        wasm_bindgen.makePackage(exercises, title, standard, steps, exercise, language, catalogue),
};
