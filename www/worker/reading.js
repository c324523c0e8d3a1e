/** Answers questions about the string and the segments. */

/** @typedef {wasm_bindgen.Playground} Playground */
/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Answer<T>} Answer */
/** @typedef {import('../js/protocol.js').Questions} Questions */
/** @typedef {import('../js/protocol.js').Reading} Reading */

/**
 * Answers questions about the newest definition's string and drawing.
 * @param {Playground} playground
 * @param {() => number} iterations the drawn generation
 */
export function createReading(playground, iterations) {
    /** @type {{[T in Reading]: (question: Question<T>) => Questions[T]['answer']}} */
    const readers = {
        string: ({ generation, start, count }) => {
            const text = playground.slice(generation, start, count) ?? null;
            return {
                text,
                length: (text !== null && playground.stringLength(generation)) || null,
                apart: playground.apart,
            };
        },
        symbol: ({ generation, index }) => {
            /** @type {import('../js/protocol.js').Descendants | null} */
            const part = playground.part(generation, index, iterations());
            const stroke = part && playground.segment(BigInt(part.segments[0]));
            return { ancestry: playground.ancestry(generation, index), part, stroke };
        },
        descendant: ({ generation, index, later }) => ({
            start: playground.part(generation, index, later)?.symbols[0] ?? null,
        }),
        pick: ({ x, y, tolerance }) => {
            /** @type {Pick<import('../js/protocol.js').Picked, 'segment' | 'polygon' | 'symbol'> | null} */
            const found = playground.pick(x, y, tolerance);
            if (!found) return { segment: null, polygon: null, symbol: null, ancestry: [], stroke: null, filled: null };
            const { segment, polygon, symbol } = found;
            return {
                ...found,
                ancestry: symbol === null ? [] : playground.ancestry(iterations(), BigInt(symbol)),
                stroke: segment === null ? null : playground.segment(BigInt(segment)),
                filled: polygon === null ? null : playground.polygon(BigInt(polygon)),
            };
        },
    };

    return {
        /** @param {Question} question @returns {question is Question<Reading>} */
        is: (question) => Object.hasOwn(readers, question.type),

        /** @template {Reading} T @param {Question<T>} question @returns {Answer<T>} */
        answer: (question) => ({ type: question.type, id: question.id, ...readers[question.type](question) }),
    };
}
