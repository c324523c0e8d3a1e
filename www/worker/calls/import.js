/** Calls for reading the notations of other programs. */

/** @type {import('../tool.js').CallTable} */
export const calls = {
    import: ({ text }) => wasm_bindgen.importSystems(text),
};
