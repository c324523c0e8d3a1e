/** This visit: kept as it goes on, and found again after a reload or on return. */

import { writeLink } from './link.js';
import { keepSession, nameOf, openSession, readSessions, readSuspects, withSuspect } from './sessions.js';
import { sameSystem } from './state.js';

/** @typedef {import('./sessions.js').Session} Session */
/** @typedef {import('./state.js').State} State */
/** @typedef {import('./store.js').Store} Store */
/** @typedef {import('./storage.js').SafeStorage} SafeStorage */

/** After the last change, in milliseconds. */
const PAUSE = 400;

const freshId = () => Math.random().toString(36).slice(2);

/**
 * @param {SafeStorage} storage for good
 * @param {SafeStorage} tab as long as the tab is open
 */
export function createSession(storage, tab) {
    let own = freshId();
    /** What was there before the reader changed anything, which is not worth keeping. @type {Readonly<State> | null} */
    let base = null;
    /** @type {Store | null} */
    let followed = null;
    let timer = 0;

    const list = () => readSessions(storage.read('sessions'));
    const suspects = () => readSuspects(storage.read('suspects'));
    /** Whether there are any, so that nobody looks for them after each picture. */
    let suspected = suspects().length > 0;

    function keep() {
        clearTimeout(timer);
        timer = 0;
        if (!followed || (base && sameSystem(base, followed.state))) return;
        base = null;
        storage.write('sessions', keepSession(list(), own, followed.state, followed.origin, Date.now()));
        tab.write('tab', { id: own, hash: location.hash });
    }

    /** Keeps what has not been kept yet. */
    const flush = () => timer && keep();

    return {
        /** The last few visits, newest first, without this one. @returns {Session[]} */
        others: () => list().filter((one) => one.id !== own),

        /**
         * What to show first where the address is `hash`: this tab's own visit after a reload, one that ended with just
         * what is linked, or, without a link, the last one; null where there is none.
         * @param {string} hash
         * @param {State | null} linked what the hash holds
         * @returns {{state: State, origin: State, again: boolean} | null} `again` where the reader sees what the address says
         */
        start(hash, linked) {
            const here = /** @type {{id?: unknown, hash?: unknown} | undefined} */ (tab.read('tab'));
            const mine = here?.hash === hash ? list().find((one) => one.id === here.id) : undefined;
            if (mine) own = mine.id;
            const link = linked && writeLink(linked);
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
                timer = window.setTimeout(keep, PAUSE);
            });
            addEventListener('pagehide', flush);
        },

        /** Whether a state, in this view or in any, stopped the drawing when it was last drawn. @param {Readonly<State>} state */
        isSuspect: (state) => suspected && [true, false].some((withView) => suspects().includes(nameOf(state, withView))),

        /**
         * Remembers that a state stops the drawing, so that it is not started by itself again, or that it does not.
         * @param {Readonly<State>} state
         * @param {boolean} doubtful
         * @param {boolean} withView whether it does so in this view only
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

        /** Opens what was made elsewhere: a visit of its own once it is changed. @param {State} state */
        visit(state) {
            flush();
            // The address is that of what comes already.
            tab.write('tab', null);
            own = freshId();
            base = state;
            followed?.open(state);
        },

        /** Goes on where an earlier visit ended. @param {Session} session */
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
