/** Calls for writing the notations of other programs. */

/** @type {import('../tool.js').CallTable} */
export const calls = {
    writeAs: ({ definition, notation }) => wasm_bindgen.writeSystem(definition, notation),
};
