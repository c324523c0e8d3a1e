/** Calls for comparisons and single steps. */

/** @type {import('../tool.js').CallTable} */
export const calls = {
    check: ({ definition, output }) => wasm_bindgen.checkOutput(definition, output),
    growth: ({ definition }) => wasm_bindgen.growth(definition),
    rows: ({ definition, n, start, count }) => wasm_bindgen.stepRows(definition, n, start, count),
    single: ({ definition, steps, rightmost }) => wasm_bindgen.oneByOne(definition, steps, rightmost),
    trace: ({ definition, n, count }) => wasm_bindgen.turtleTrace(definition, n, count),
};
