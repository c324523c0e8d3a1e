/** Open questions to the worker. Questions outlive the worker: a fresh worker is asked the open ones again. */

import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').Asked} Asked */
/** @typedef {import('../protocol.js').Questions} Questions */
/** @template {Asked} [T=Asked] @typedef {import('../protocol.js').Question<T>} Question */
/** @template {Asked} [T=Asked] @typedef {import('../protocol.js').Answer<T>} Answer */
/** @typedef {import('../protocol.js').Definition} Definition */

/** The worker stopped while answering a question, and would stop again. */
export class Stopped extends Error {}

/** Fresh seeds are below this number, so that they can be read out and remembered. Typed and linked ones may be longer. */
export const SEEDS = 10_000;

/** @type {readonly Asked[]} */
const READING = /** @satisfies {import('../protocol.js').Reading[]} */ ([
    'string',
    'symbol',
    'descendant',
    'anchor',
    'pick',
]);
/** Whether a question is about the newest definition's string or drawing. @param {Asked} type */
export const isReading = (type) => READING.includes(type);

/**
 * @param {object} worker
 * @param {(question: Question) => void} worker.post
 * @param {() => number} worker.nextId
 */
export function createQuestions({ post, nextId }) {
    /** @type {Map<number, {question: Question, resolve: (answer: any) => void, reject: (reason: Error) => void}>} */
    const open = new Map();
    /** Whether the worker knows the newest state and can be asked. */
    let askable = false;
    /** A definition, and the types of questions about it that stopped a worker. @type {{definition: Definition | null, types: Set<Asked>}} */
    let forbidden = { definition: null, types: new Set() };

    /** @param {(question: Question) => boolean} which @param {Error} error */
    function refuse(which, error) {
        for (const [id, { question, reject }] of open) {
            if (!which(question)) continue;
            open.delete(id);
            reject(error);
        }
    }

    return {
        get size() {
            return open.size;
        },

        /** Whether questions of a type about a definition have stopped a worker. @param {Asked} type @param {Definition | null} definition */
        isForbidden: (type, definition) => forbidden.definition === definition && forbidden.types.has(type),

        /** @template {Asked} T @param {T} type @param {Questions[T]['asked']} asked @returns {Promise<Answer<T>>} */
        ask(type, asked) {
            const question = /** @type {Question} */ (/** @type {unknown} */ ({ type, id: nextId(), ...asked }));
            const answer = new Promise((resolve, reject) => open.set(question.id, { question, resolve, reject }));
            if (askable) post(question);
            return answer;
        },

        /** The worker can be asked from now on. */
        putAll() {
            if (askable) return;
            askable = true;
            for (const { question } of open.values()) post(question);
        },

        /** The worker was replaced; the fresh one cannot be asked yet. */
        forget() {
            askable = false;
        },

        /** @param {Answer} answer @returns {boolean} whether the question was open */
        answer(answer) {
            const asked = open.get(answer.id);
            open.delete(answer.id);
            asked?.resolve(answer);
            return asked !== undefined;
        },

        /** The worker stopped while answering a question, or the question needs what is missing. @param {number} id @param {Error} [error] @returns {Asked | undefined} the type of the question, if the id is open */
        refuseOne(id, error = new Stopped(say`it stopped answering and was given up`)) {
            const type = open.get(id)?.question.type;
            refuse((question) => question.id === id, error);
            return type;
        },

        /** Questions of this type about a definition are not asked again. @param {Asked} type @param {Definition | null} definition */
        forbid(type, definition) {
            if (forbidden.definition !== definition) forbidden = { definition, types: new Set() };
            forbidden.types.add(type);
        },

        /** Refuses the questions about a drawing that was given up. */
        refuseAboutDrawing: () => refuse(({ type }) => isReading(type), new Stopped(say`the drawing was given up`)),

        /** @param {Error} error */
        refuseAll: (error) => refuse(() => true, error),
    };
}

/** Why the worker has no small picture; the core says other reasons in words. @type {Partial<Record<string, string>>} */
const REASONS = { mistakes: say`The rules have mistakes.`, size: say`Too large for a small picture.` };

/** @param {Answer<'thumb'>} answer */
const withReason = ({ missing, ...answer }) => ({
    ...answer,
    missing: missing === null ? null : (REASONS[missing] ?? missing),
});

/** @typedef {<T extends Asked>(type: T, asked: Questions[T]['asked']) => Promise<Answer<T>>} Ask */

/** The questions of protocol.js as functions. @param {Ask} ask */
export function asking(ask) {
    return {
        /** @param {number} generation @param {bigint} start @param {number} count */
        string: (generation, start, count) => ask('string', { generation, start, count }),

        /** @param {number} generation @param {bigint} index */
        symbol: (generation, index) => ask('symbol', { generation, index }),

        /** @param {number} generation @param {bigint} index @param {number} later */
        descendant: async (generation, index, later) => (await ask('descendant', { generation, index, later })).start,

        /** @param {number} x @param {number} y @param {number} tolerance */
        pick: (x, y, tolerance) => ask('pick', { x, y, tolerance }),

        /** A place on a segment near a place, in device pixels, and where it is from the view's origin. @param {number} x @param {number} y @param {number} reach */
        anchor: async (x, y, reach) => (await ask('anchor', { x, y, reach })).anchor,

        /** @param {import('../protocol.js').Texts} texts */
        notation: (texts) => ask('notation', { texts }),

        /** @param {import('../protocol.js').Texts} texts @param {'axiom' | 'rules'} field @param {number} offset in UTF-16 units */
        site: async (texts, field, offset) => (await ask('site', { texts, field, offset })).site,

        /** @param {Blob} file */
        read: (file) => ask('read', { file }),

        /** @param {string} text */
        qr: async (text) => (await ask('qr', { text })).modules,

        seed: async () => (await ask('seed', {})).seed % SEEDS,

        /** @param {Definition} definition @param {number} width @param {number} height @param {import('../protocol.js').Camera | null} [camera] @param {import('../protocol.js').Definition | null} [frame] */
        thumb: (definition, width, height, camera = null, frame = null) =>
            ask('thumb', { definition, width, height, camera, frame }).then(withReason),
    };
}
