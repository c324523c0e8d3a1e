/** Calls for exercises. */

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

/** @type {import('../tool.js').CallTable} */
export const calls = {
    variantOf: ({ text, student }) => wasm_bindgen.variantOf(text, student),
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
