/** Answers questions about the string and the segments. */

/** @typedef {wasm_bindgen.Playground} Playground */
/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Answer<T>} Answer */
/** @typedef {import('../js/protocol.js').Questions} Questions */
/** @typedef {import('../js/protocol.js').Reading} Reading */

/** Answers questions about the newest definition's string and drawing. @param {Playground} playground */
export function createReading(playground) {
    /** @type {{[T in Reading]: (question: Question<T>) => Questions[T]['answer']}} */
    const readers = {
        string: ({ generation, start, count }) => playground.string(generation, start, count),
        symbol: ({ generation, index }) => playground.symbol(generation, index),
        descendant: ({ generation, index, later }) => ({
            start: playground.descendant(generation, index, later) ?? null,
        }),
        anchor: ({ x, y, reach }) => ({ anchor: playground.anchor(x, y, reach) }),
        pick: ({ x, y, tolerance }) => playground.pick(x, y, tolerance),
    };

    return {
        /** @param {Question} question @returns {question is Question<Reading>} */
        is: (question) => Object.hasOwn(readers, question.type),

        /** @template {Reading} T @param {Question<T>} question @returns {Answer<T>} */
        answer: (question) => ({ type: question.type, id: question.id, ...readers[question.type](question) }),
    };
}
