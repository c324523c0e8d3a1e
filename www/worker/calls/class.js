/** Calls for teachers: the answers of a class, and exercises to give. */

/** The answers that are being marked. @type {InstanceType<typeof wasm_bindgen.ClassMarking> | null} */
let marking = null;

/** @type {import('../tool.js').CallTable} */
export const calls = {
    variantsOf: ({ exercise, varied }) => wasm_bindgen.variantsOf(exercise, varied),
    *markClass({ exercise, text }) {
        marking?.free();
        marking = null;
        marking = new wasm_bindgen.ClassMarking(exercise, text);
        yield { about: marking.about() };
        for (;;) {
            const row = marking.step();
            if (row === null) break;
            yield { row, picture: row.percent === '' ? null : marking.picture() };
        }
        return { mistakes: marking.mistakes(), csv: marking.csv() };
    },
    write: ({ exercise }) => wasm_bindgen.writeExercise(exercise),
};
