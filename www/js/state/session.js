/** The current visit: saved after each change, and restored after a reload or on return. */

import { writePlain } from './link.js';
import { createRows } from './rows.js';
import { nameOf, openSession, readSessions, readSuspects, sessionOf, tidySessions, tidySuspects } from './sessions.js';
import { sameSystem } from './state.js';

/** @typedef {import('./sessions.js').Session} Session */
/** @typedef {import('./state.js').State} State */
/** @typedef {import('./store.js').Store} Store */
/** @typedef {import('./storage.js').SafeStorage} SafeStorage */

/** The delay after the last change, in milliseconds. */
const PAUSE = 400;

const freshId = () => Math.random().toString(36).slice(2);

/**
 * @param {SafeStorage} storage permanent storage
 * @param {SafeStorage} tab storage of this tab
 */
export function createSession(storage, tab) {
    /** The id of this visit, and what this window has stored of it. */
    let [own, written] = [freshId(), ''];
    /** The state before the reader changed anything, which is not saved. @type {Readonly<State> | null} */
    let base = null;
    /** @type {Store | null} */
    let followed = null;
    let timer = 0;

    /** @type {ReturnType<typeof createRows<Session>>} */
    const { list, put } = createRows(storage, 'sessions', { read: readSessions, tidy: tidySessions });

    function save() {
        clearTimeout(timer);
        timer = 0;
        if (!followed || (base && sameSystem(base, followed.state))) return;
        base = null;
        // Another window, such as a copy of this one, goes on with the same visit: this is another one now.
        if (list().some(({ id, link }) => id === own && link !== written)) own = freshId();
        const session = sessionOf(own, followed.state, followed.origin);
        if (put([session])) written = session.link;
        tab.write('tab', { id: own, hash: location.hash });
    }

    /** Saves unsaved changes. */
    const flush = () => timer && save();

    return {
        /** The last few visits, newest first, without this one. @returns {Session[]} */
        others: () => list().filter((one) => one.id !== own),

        /**
         * The visit to restore for an address: this tab's visit after a reload; else a visit that ended at the linked
         * state, or, without a link, the last visit; null if there is none.
         * @param {string} hash
         * @param {State | null} linked the state in the hash
         */
        start(hash, linked) {
            const here = /** @type {{id?: unknown, hash?: unknown} | undefined} */ (tab.read('tab'));
            const mine = here?.hash === hash ? list().find((one) => one.id === here.id) : undefined;
            if (mine) [own, written] = [mine.id, mine.link];
            const link = linked && writePlain(linked);
            const session = mine ?? list().find((one) => link === null || one.link === link);
            return opened(session, mine !== undefined || linked !== null);
        },

        /** @param {Store} store */
        follow(store) {
            followed = store;
            base = store.state;
            store.subscribe(() => {
                clearTimeout(timer);
                timer = window.setTimeout(save, PAUSE);
            });
            addEventListener('pagehide', flush);
        },

        ...createSuspects(storage),

        /** Opens another state, which becomes a new visit once it is changed. @param {State} state */
        visit(state) {
            flush();
            // The address already belongs to the new state.
            tab.write('tab', null);
            own = freshId();
            base = state;
            followed?.open(state);
        },

        /** Continues an earlier visit. @param {Session} session */
        resume(session) {
            const opened = openSession(session);
            if (!opened || !followed) return;
            flush();
            [own, written] = [session.id, session.link];
            base = opened.state;
            followed.open(opened.state, opened.origin);
        },
    };
}

/** The states of a visit, if there is one; `again` if the reader expects them from the address. @param {Session | undefined} session @param {boolean} again */
function opened(session, again) {
    const states = session && openSession(session);
    return states ? { ...states, again } : null;
}

/** States that stopped the drawing. @param {SafeStorage} storage */
function createSuspects(storage) {
    /** @type {ReturnType<typeof createRows<import('./rows.js').Row>>} */
    const { list, put } = createRows(storage, 'suspects', { read: readSuspects, tidy: tidySuspects });
    /** Whether there are suspects, to avoid reading the storage after each picture. */
    let suspected = list().length > 0;

    return {
        /** Whether a state, in this or any view, stopped the drawing when it was last drawn. @param {Readonly<State>} state */
        isSuspect: (state) =>
            suspected && [true, false].some((withView) => list().some(({ id }) => id === nameOf(state, withView))),

        /**
         * Remembers whether a state stops the drawing; if so, the next visit does not draw it at once.
         * @param {Readonly<State>} state
         * @param {boolean} doubtful
         * @param {boolean} withView whether this holds for this view only
         */
        suspect(state, doubtful, withView) {
            if (!doubtful && !suspected) return;
            const names = doubtful ? [nameOf(state, withView)] : [nameOf(state, true), nameOf(state, false)];
            const former = list().map(({ id }) => id);
            const news = names.filter((id) => former.includes(id) !== doubtful);
            if (news.length > 0) put(news.map((id) => (doubtful ? { id } : { id, gone: true })));
            suspected = list().length > 0;
        },
    };
}
