/** Questions to the worker that have no answer yet. They outlive it: a fresh worker is asked what is still open. */

/** The worker stopped over this question, and would again. */
export class Stopped extends Error {}

/** What is asked about the drawing, rather than about texts, files and other systems. */
export const READING = ['string', 'symbol', 'descendant', 'pick'];
const ABOUT_DRAWING = [...READING, 'export', 'png'];

/** @typedef {{type: string, id: number} & Record<string, any>} Request */

export function createQuestions() {
    /** @type {Map<number, {request: Request, resolve: (answer: any) => void, reject: (reason: Error) => void}>} */
    const asked = new Map();

    /** @param {(request: Request) => boolean} which @param {Error} error */
    function refuse(which, error) {
        for (const [id, { request, reject }] of asked) {
            if (!which(request)) continue;
            asked.delete(id);
            reject(error);
        }
    }

    return {
        get size() {
            return asked.size;
        },

        /** @param {number} id @returns {string | undefined} */
        type: (id) => asked.get(id)?.request.type,

        /** @param {Request} request @returns {Promise<any>} */
        add: (request) => new Promise((resolve, reject) => asked.set(request.id, { request, resolve, reject })),

        /** Asks a worker everything. @param {Worker} worker */
        putAll(worker) {
            for (const { request } of asked.values()) worker.postMessage(request);
        },

        /** @param {{id: number}} message @returns {boolean} whether it answers one of them */
        answer(message) {
            const question = asked.get(message.id);
            asked.delete(message.id);
            question?.resolve(message);
            return question !== undefined;
        },

        /** @param {number} id @param {Error} error @returns {string | undefined} the type of the question, if it is one */
        refuseOne(id, error) {
            const type = asked.get(id)?.request.type;
            refuse((request) => request.id === id, error);
            return type;
        },

        /** Refuses what is about a drawing that was given up. @param {Error} error */
        refuseAboutDrawing: (error) => refuse(({ type }) => ABOUT_DRAWING.includes(type), error),

        /** @param {Error} error */
        refuseAll: (error) => refuse(() => true, error),
    };
}
