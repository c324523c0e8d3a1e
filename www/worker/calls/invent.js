/** Calls for new systems. */

/** @type {import('../tool.js').CallTable} */
export const calls = {
    surprise: ({ seed }) => wasm_bindgen.surprise(seed),
};
