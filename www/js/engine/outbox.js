/**
 * The states on their way to the worker. None is ever queued: the worker is at one state, one more is there for it to go on
 * with, the newest waits, those between are forgotten. A state is let finish while it is quick, so that a long drag shows
 * pictures on the way; then newer ones supersede it.
 */

/** @typedef {import('./newest.js').Look} Look */
/** @typedef {import('./newest.js').Shown} Shown */
/** The state and the view that a message is about. @typedef {{id: number, viewId: number}} Ids */

/** States that are not drawn after this time are waited for no longer, in milliseconds. */
const PATIENCE = 250;

/** So many states are sent before the first of them is drawn: the worker need not wait while the page shows a picture. */
const AHEAD = 2;

/**
 * @param {ReturnType<typeof import('./newest.js').createNewest>} newest
 * @param {object} worker
 * @param {(message: import('../protocol.js').Define | import('../protocol.js').Sight) => void} worker.post
 * @param {() => boolean} worker.ready whether it takes messages
 * @param {() => number} worker.nextId
 * @param {() => void} worker.sent a newer state than the one shown is under way
 * @param {() => void} worker.settled the newest state is shown, or cannot be
 */
export function createOutbox(newest, { post, ready, nextId, sent, settled }) {
    /** The ids of the last definition and look that were sent. */
    const last = { define: 0, view: 0 };
    /** The id under which a fresh worker was told what is shown already, or 0. */
    let recalled = 0;
    const ahead = createAhead(() => goOn());
    /** Whether the worker owes a picture. */
    let owes = false;
    /** Looks sent and not yet drawn. @type {Map<number, Look>} */
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

    /** The states up to an id are drawn, or waited for no longer: the newest may follow. */
    function goOn(id = Infinity) {
        ahead.reach(id);
        send();
    }

    /** A picture of a state has come. @param {Ids} ids */
    const reached = ({ id, viewId }) => goOn(Math.max(id, viewId));
    /** Whether a message is about the last that was sent. @param {Ids} ids */
    const isLast = ({ id, viewId }) => id >= last.define && viewId >= last.view;
    /** Whether it is about what a fresh worker was told first. @param {number} id */
    const isRecalled = (id) => recalled !== 0 && id === recalled;

    /** The newest state is shown, or cannot be. */
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

        /** Whether a report is on the last definition that was sent. @param {number} id */
        isLastDefinition: (id) => id === last.define,

        /** Which parts of the newest state the worker has taken up. @param {import('../protocol.js').At} at */
        taken: (at) => ({ definition: at.define === last.define && !newest.unsent.definition, look: at.view === last.view && !newest.unsent.look }),

        /** There is another worker, which owes nothing. */
        forget() {
            owes = false;
            recalled = 0;
            looks.clear();
            ahead.reach(Infinity);
        },

        /**
         * Tells a fresh worker first what is shown, which stays where what is newer cannot be drawn.
         * @param {Readonly<Shown>} shown
         * @returns {boolean} whether anything is
         */
        recall({ definition, look }) {
            if (!definition || !look) return false;
            recalled = postDefinition(definition, look.upto);
            // Nothing else may come before it is drawn.
            ahead.fill(postLook(look));
            return true;
        },

        /** The look that a picture shows. @param {number} viewId */
        lookOf(viewId) {
            const look = looks.get(viewId);
            for (const id of looks.keys()) if (id < viewId) looks.delete(id);
            return look;
        },

        /** There is no more to come for a state. @param {Ids} ids */
        ended(ids) {
            if (isRecalled(ids.id)) goOn();
            else if (isLast(ids)) settle();
            else reached(ids);
        },
    };
}

/** The states that were sent and are not drawn yet, by their last ids. @param {() => void} impatient called when none of them has been drawn for a while */
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

        /** Leaves no room beside a state. @param {number} id */
        fill: (id) => expect(Array(AHEAD).fill(id)),

        /** The states up to an id are drawn, or waited for no longer. @param {number} id */
        reach: (id) => expect(ids.filter((each) => each > id)),
    };
}
