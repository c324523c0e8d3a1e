/**
 * The states on their way to the worker. No queue grows: the worker draws one state, has one more ready, and only the
 * newest of the rest waits. A state may finish for a while before a newer one supersedes it, so that a long drag shows
 * pictures on the way.
 */

/** @typedef {import('./newest.js').Look} Look */
/** @typedef {import('./newest.js').Shown} Shown */
/** The state and the view that a message is about. @typedef {{id: number, viewId: number}} Ids */

/** After this time without a picture, the newest state is sent without waiting, in milliseconds. */
const PATIENCE = 250;

/** How many states are sent before the first of them is drawn, so that the worker need not wait for the page. */
const AHEAD = 2;

/**
 * @param {ReturnType<typeof import('./newest.js').createNewest>} newest
 * @param {object} worker
 * @param {(message: import('../protocol.js').Define | import('../protocol.js').ViewMessage) => void} worker.post
 * @param {() => boolean} worker.ready whether the worker accepts messages
 * @param {() => number} worker.nextId
 * @param {() => void} worker.sent a newer state than the shown one is on its way
 * @param {() => void} worker.settled the newest state is shown or cannot be drawn
 */
export function createOutbox(newest, { post, ready, nextId, sent, settled }) {
    /** The ids of the last definition and look that were sent. */
    const last = { define: 0, view: 0 };
    /** The id under which the shown state was sent to a fresh worker, or 0. */
    let recalled = 0;
    const ahead = createAhead(() => goOn());
    /** Whether the worker owes a picture. */
    let owes = false;
    /** Looks that are sent and not yet drawn. @type {Map<number, Look>} */
    const looks = new Map();

    /** @param {NonNullable<Shown['definition']>} definition @param {bigint | null} upto */
    function postDefinition(definition, upto) {
        const id = nextId();
        post({ type: 'define', id, definition, upto });
        return id;
    }

    /** @param {Look} look */
    function postLook(look) {
        const { canvas, view, camera, upto } = look;
        last.view = nextId();
        looks.set(last.view, look);
        post({ type: 'view', id: last.view, ...canvas, view, camera, upto });
        return last.view;
    }

    function send() {
        const { state, unsent, upto } = newest;
        if (!ready() || !state.definition || ahead.full || !newest.waits) return;
        let id = 0;
        if (unsent.definition) id = last.define = postDefinition(state.definition, upto);
        if (unsent.look && state.look) id = postLook(state.look);
        newest.send();
        ahead.add(id);
        owes = true;
        sent();
    }

    /** The states up to an id are drawn or no longer waited for: sends the newest. */
    function goOn(id = Infinity) {
        ahead.reach(id);
        send();
    }

    /** A picture of a state has come. @param {Ids} ids */
    const reached = ({ id, viewId }) => goOn(Math.max(id, viewId));
    /** Whether a message is about the last sent state. @param {Ids} ids */
    const isLast = ({ id, viewId }) => id >= last.define && viewId >= last.view;
    /** Whether a message is about the recalled state. @param {number} id */
    const isRecalled = (id) => recalled !== 0 && id === recalled;

    /** The newest state is shown or cannot be drawn. */
    function settle() {
        goOn();
        if (!ahead.empty) return;
        owes = false;
        settled();
    }

    return {
        get owes() {
            return owes;
        },
        send,
        settle,
        reached,
        isLast,
        isRecalled,

        /** Whether a report is about the last sent definition. @param {number} id */
        isLastDefinition: (id) => id === last.define,

        /** Which parts of the newest state the worker has begun. @param {import('../protocol.js').At} at */
        taken: (at) => ({
            definition: at.define === last.define && !newest.unsent.definition,
            look: at.view === last.view && !newest.unsent.look,
        }),

        /** The worker was replaced; the fresh one owes nothing. */
        forget() {
            owes = false;
            recalled = 0;
            looks.clear();
            ahead.reach(Infinity);
        },

        /**
         * Sends the shown state to a fresh worker first; that picture stays if the newer state cannot be drawn.
         * @param {Readonly<Shown>} shown
         * @returns {boolean} whether a state is shown
         */
        recall({ definition, look }) {
            if (!definition || !look) return false;
            recalled = postDefinition(definition, look.upto);
            // No other state may be sent before this one is drawn.
            ahead.fill(postLook(look));
            return true;
        },

        /** The look that a picture shows. @param {number} viewId */
        lookOf(viewId) {
            const look = looks.get(viewId);
            for (const id of looks.keys()) if (id < viewId) looks.delete(id);
            return look;
        },

        /** No more pictures follow for a state. @param {Ids} ids */
        ended(ids) {
            if (isRecalled(ids.id)) goOn();
            else if (isLast(ids)) settle();
            else reached(ids);
        },
    };
}

/** The states that are sent and not drawn yet, by their last ids. @param {() => void} impatient called when none of them has been drawn for PATIENCE */
function createAhead(impatient) {
    /** @type {number[]} */
    let ids = [];
    let timer = 0;

    /** @param {number[]} next */
    function expect(next) {
        clearTimeout(timer);
        ids = next;
        timer = ids.length > 0 ? window.setTimeout(impatient, PATIENCE) : 0;
    }

    return {
        get full() {
            return ids.length >= AHEAD;
        },
        get empty() {
            return ids.length === 0;
        },

        /** @param {number} id */
        add: (id) => expect([...ids, id]),

        /** Leaves no room for other states, however long this one takes. @param {number} id */
        fill(id) {
            clearTimeout(timer);
            ids = Array(AHEAD).fill(id);
        },

        /** The states up to an id are drawn or no longer waited for. @param {number} id */
        reach: (id) => expect(ids.filter((each) => each > id)),
    };
}
