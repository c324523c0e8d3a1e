/** Questions to the worker that have no answer yet. They outlive it: a fresh worker is asked what is still open. */

/** The worker stopped over this question, and would again. */
export class Stopped extends Error {}

/** What is asked about the drawing, rather than about texts, files and other systems. */
export const READING = ['string', 'symbol', 'descendant', 'pick'];
const ABOUT_DRAWING = [...READING, 'export', 'png'];

/** @typedef {{type: string, id: number} & Record<string, any>} Request */
/** @typedef {import('./protocol.js').StringPage} StringPage */
/** @typedef {import('./protocol.js').SymbolFacts} SymbolFacts */
/** @typedef {import('./protocol.js').Picked} Picked */
/** @typedef {import('./protocol.js').Notation} Notation */
/** @typedef {import('./protocol.js').FileRead} FileRead */
/** @typedef {import('./protocol.js').Exported} Exported */
/** @typedef {import('./protocol.js').Definition} Definition */

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

/**
 * What can be asked of the worker.
 * @param {(question: {type: string} & Record<string, any>) => Promise<any>} ask
 */
export function asking(ask) {
    return {
        /** @param {number} generation @param {bigint} start @param {number} count @returns {Promise<StringPage>} */
        string: (generation, start, count) => ask({ type: 'string', generation, start, count }),

        /** A symbol of a generation, and what it has become in the one that is drawn. @param {number} generation @param {bigint} index @returns {Promise<SymbolFacts>} */
        symbol: (generation, index) => ask({ type: 'symbol', generation, index }),

        /** Where the symbols derived from another begin, in decimal digits. @param {number} generation @param {bigint} index @param {number} later @returns {Promise<string | null>} */
        descendant: async (generation, index, later) => (await ask({ type: 'descendant', generation, index, later })).start,

        /** What is drawn near a place, in device pixels. @param {number} x @param {number} y @param {number} tolerance @returns {Promise<Picked>} */
        pick: (x, y, tolerance) => ask({ type: 'pick', x, y, tolerance }),

        /** @param {{axiom: string, rules: string, overrides: string}} texts @returns {Promise<Notation>} */
        notation: (texts) => ask({ type: 'notation', texts }),

        /** @param {Blob} file in JSON, or a picture saved here @returns {Promise<FileRead>} */
        read: (file) => ask({ type: 'read', file }),

        /** @param {'svg' | 'svg-compact' | 'csv' | 'txt' | 'json' | 'obj' | 'glb'} format @returns {Promise<Exported>} */
        export: (format) => ask({ type: 'export', format }),

        /** @param {number} width @param {number} height @param {Definition} carried in the file, to open it again @returns {Promise<Blob>} */
        png: async (width, height, carried) => {
            const { blob, reason } = await ask({ type: 'png', width, height, definition: carried });
            if (!blob) throw new Error(reason ?? 'the browser could not make the picture');
            return blob;
        },

        /** The modules of a text's QR code, row by row, 1 for dark; null where it is too long. @param {string} text @returns {Promise<Uint8Array | null>} */
        qr: async (text) => (await ask({ type: 'qr', text })).modules,

        /** @returns {Promise<number>} */
        seed: async () => (await ask({ type: 'seed' })).seed,

        /** @param {Definition} small @param {number} width @param {number} height @returns {Promise<ImageBitmap | null>} */
        thumb: async (small, width, height) => {
            const { bitmap } = await ask({ type: 'thumb', definition: small, width, height });
            return bitmap;
        },
    };
}
