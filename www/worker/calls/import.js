/** Calls for the notations of other programs. */

/** @type {import('../tool.js').CallTable} */
export const calls = {
    import: ({ text }) => wasm_bindgen.importSystems(text),
    writeAs: ({ definition, notation }) => wasm_bindgen.writeSystem(definition, notation),
};
