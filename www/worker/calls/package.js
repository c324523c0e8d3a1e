/** Calls for packages for learning systems. */

/** @type {import('../tool.js').CallTable} */
export const calls = {
    package: ({ exercises, title, standard, steps, exercise, program, language, catalogue }) =>
        wasm_bindgen.makePackage(exercises, title, standard, steps, exercise, program, language, catalogue),
};
