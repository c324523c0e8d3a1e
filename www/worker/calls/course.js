/** Calls for exercises and comparisons. */

/** The open exercise and its text. @type {{text: string, exercise: InstanceType<typeof wasm_bindgen.OpenExercise>} | null} */
let open = null;

/** Opens an exercise, unless it is open. @param {string} text */
function opened(text) {
    if (open?.text === text) return open.exercise;
    open?.exercise.free();
    open = null;
    const exercise = new wasm_bindgen.OpenExercise(text);
    open = { text, exercise };
    return exercise;
}

/** The answers that are being marked. @type {InstanceType<typeof wasm_bindgen.ClassMarking> | null} */
let marking = null;

/** @type {import('../tool.js').CallTable} */
export const calls = {
    check: ({ definition, output }) => wasm_bindgen.checkOutput(definition, output),
    growth: ({ definition }) => wasm_bindgen.growth(definition),
    rows: ({ definition, n, start, count }) => wasm_bindgen.stepRows(definition, n, start, count),
    single: ({ definition, steps, rightmost }) => wasm_bindgen.oneByOne(definition, steps, rightmost),
    trace: ({ definition, n, count }) => wasm_bindgen.turtleTrace(definition, n, count),
    variantOf: ({ text, student }) => wasm_bindgen.variantOf(text, student),
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
    open: ({ text }) => opened(text).about(),
    picture: ({ text, width, height, ratio }) => opened(text).picture(width, height, ratio),
    hint: ({ text, student }) => opened(text).hint(student) ?? null,
    answer: ({ text }) => opened(text).answer(),
    *mark({ text, student }) {
        const exercise = opened(text);
        exercise.begin(student);
        for (;;) {
            const mark = exercise.step();
            if (mark !== null) return { mark, pixels: exercise.overlay() };
            yield;
        }
    },
};
