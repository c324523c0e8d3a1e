/** The current visit: saved after each change, and restored after a reload or on return. */

import { writePlain } from './link.js';
import { keepSession, nameOf, openSession, readSessions, readSuspects, withSuspect } from './sessions.js';
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
    let own = freshId();
    /** The state before the reader changed anything, which is not saved. @type {Readonly<State> | null} */
    let base = null;
    /** @type {Store | null} */
    let followed = null;
    let timer = 0;

    const list = () => readSessions(storage.read('sessions'));
    const suspects = () => readSuspects(storage.read('suspects'));
    /** Whether there are suspects, to avoid reading the storage after each picture. */
    let suspected = suspects().length > 0;

    function save() {
        clearTimeout(timer);
        timer = 0;
        if (!followed || (base && sameSystem(base, followed.state))) return;
        base = null;
        storage.write('sessions', keepSession(list(), own, followed.state, followed.origin, Date.now()));
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
         * @returns {{state: State, origin: State, again: boolean} | null} `again` if the reader expects this state from the address
         */
        start(hash, linked) {
            const here = /** @type {{id?: unknown, hash?: unknown} | undefined} */ (tab.read('tab'));
            const mine = here?.hash === hash ? list().find((one) => one.id === here.id) : undefined;
            if (mine) own = mine.id;
            const link = linked && writePlain(linked);
            const session = mine ?? list().find((one) => link === null || one.link === link);
            const opened = session ? openSession(session) : null;
            return opened && { ...opened, again: mine !== undefined || linked !== null };
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

        /** Whether a state, in this or any view, stopped the drawing when it was last drawn. @param {Readonly<State>} state */
        isSuspect: (state) =>
            suspected && [true, false].some((withView) => suspects().includes(nameOf(state, withView))),

        /**
         * Remembers whether a state stops the drawing; if so, the next visit does not draw it at once.
         * @param {Readonly<State>} state
         * @param {boolean} doubtful
         * @param {boolean} withView whether this holds for this view only
         */
        suspect(state, doubtful, withView) {
            if (!doubtful && !suspected) return;
            const names = doubtful ? [nameOf(state, withView)] : [nameOf(state, true), nameOf(state, false)];
            const former = suspects();
            const next = names.reduce((kept, name) => withSuspect(kept, name, doubtful), former);
            suspected = next.length > 0;
            if (next.join() === former.join()) return;
            storage.write('suspects', next);
        },

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
            own = session.id;
            base = opened.state;
            followed.open(opened.state, opened.origin);
        },
    };
}
