/** Calls for the walk of the turtle as notes. */

/** The work of a step, well below the time after which the page gives a silent tool up. */
const WORK = 2_000_000;

/** The system that is heard. @type {wasm_bindgen.Listener | null} */
let listener = null;

function current() {
    if (!listener) throw new Error('No system is heard.');
    return listener;
}

/** @type {import('../tool.js').CallTable} */
export const calls = {
    listen({ definition }) {
        listener?.free();
        listener = null;
        listener = new wasm_bindgen.Listener(definition);
        return null;
    },
    *part({ from, stride, count, options }) {
        while (current().step(WORK)) yield;
        return current().part(String(from), String(stride), count, options);
    },
    tune: ({ options }) => current().tune(options),
};
