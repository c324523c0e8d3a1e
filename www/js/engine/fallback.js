/**
 * Goes back when a state stops the worker: the last state that was drawn completely replaces the newest, which is given
 * up until newer input comes. The engine is told of doubtful states.
 */

/** @typedef {import('../protocol.js').At} At */
/** @typedef {import('./newest.js').Shown} Shown */

/** A state is doubtful once the worker has been silent over it for this many milliseconds. */
const DOUBTFUL = 1000;

/** @type {Readonly<Shown>} */
const NOTHING = { definition: null, look: null };
/** @type {At} */
const NOWHERE = { type: 'at', define: 0, view: 0, question: 0 };

/**
 * @param {ReturnType<typeof import('./newest.js').createNewest>} newest
 * @param {ReturnType<typeof import('./outbox.js').createOutbox>} outbox
 * @param {(state: Shown, doubtful: boolean) => void} doubted whether a state may stop every worker; if the state has no
 *   `look`, the definition may
 */
export function createFallback(newest, outbox, doubted) {
    /** The last state that was drawn completely. */
    let good = NOTHING;
    /** The part of the newest state that was given up, until newer input comes. @type {'definition' | 'look' | null} */
    let givenUp = null;
    /** The state over which the worker is silent. @type {Shown | null} */
    let doubtful = null;
    /** The worker's last `at` message: its current task. */
    let at = NOWHERE;

    return {
        get good() {
            return good;
        },
        /** Whether an older state is shown instead of the newest. */
        get gaveUp() {
            return givenUp !== null;
        },
        /** The id of the question that the worker is answering, or 0. */
        get question() {
            return at.question;
        },

        /** The worker has another task, or none because it was replaced. @param {At} [next] */
        moved(next = NOWHERE) {
            at = next;
        },

        /** The newest state was drawn completely. */
        keep() {
            // A moment of growth or wind is no state to go back to.
            if (!newest.state.definition?.still) good = newest.state;
            doubted(newest.state, false);
        },

        /** Whether the newest state was drawn completely. */
        isKept: () => good.definition === newest.state.definition && good.look === newest.state.look,

        defined() {
            givenUp = null;
        },
        looked() {
            if (givenUp === 'look') givenUp = null;
        },

        /** The worker is silent. @param {number} silent in milliseconds */
        doubt(silent) {
            if (silent < DOUBTFUL || doubtful || !outbox.owes || at.question || !outbox.taken(at).definition) return;
            const { definition, look } = newest.state;
            doubtful = { definition, look: definition === good.definition ? look : null };
            doubted(doubtful, true);
        },

        /** The worker has sent a message. */
        trust() {
            if (doubtful) doubted(doubtful, false);
            doubtful = null;
        },

        /** The worker has stopped: replaces the state that it was drawing by the last good state. @returns {boolean} whether the newest state was given up */
        giveUp() {
            doubtful = null;
            if (!outbox.owes) return false;
            if (outbox.isRecalled(at.define)) {
                good = NOTHING;
                return false;
            }
            const { definition, look } = newest.state;
            const taken = outbox.taken(at);
            const known = definition === good.definition;
            // The worker has not begun the newest state, which may be good.
            if (!taken.definition || (known && !taken.look)) return false;
            givenUp = known && look !== good.look ? 'look' : 'definition';
            doubted({ definition, look: givenUp === 'look' ? look : null }, true);
            if (known && givenUp === 'definition') good = NOTHING;
            newest.replace(good);
            return true;
        },
    };
}
