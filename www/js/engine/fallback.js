/**
 * What to go back to when a state stops the worker: the last state that was drawn to its end takes the place of the newest,
 * which is given up until something newer is asked for. The engine uses it, and tells of states that are in doubt.
 */

/** @typedef {import('../protocol.js').At} At */
/** @typedef {import('./newest.js').Shown} Shown */

/** A state over which the worker has been silent for this long is doubtful, in milliseconds. */
const DOUBTFUL = 1000;

/** @type {Readonly<Shown>} */
const NOTHING = { definition: null, look: null };
/** @type {At} */
const NOWHERE = { type: 'at', define: 0, view: 0, question: 0 };

/**
 * @param {ReturnType<typeof import('./newest.js').createNewest>} newest
 * @param {ReturnType<typeof import('./outbox.js').createOutbox>} outbox
 * @param {(state: Shown, doubtful: boolean) => void} doubted a state may stop every worker that it is given to, or is good
 *   after all; without its `look` the definition may
 */
export function createFallback(newest, outbox, doubted) {
    /** The state that is shown at its finest. */
    let good = NOTHING;
    /** What was given up, as long as nothing newer is asked for. @type {'definition' | 'look' | null} */
    let given = null;
    /** The state over which the worker is silent. @type {Shown | null} */
    let doubtful = null;
    /** What the worker is at, as its last `at` says. */
    let at = NOWHERE;

    return {
        get good() {
            return good;
        },
        /** Whether what is shown is not what was asked for. */
        get gaveUp() {
            return given !== null;
        },
        /** The id of the question that the worker is at, or 0. */
        get question() {
            return at.question;
        },

        /** @param {At} next */
        moved(next) {
            at = next;
        },

        /** There is another worker. */
        forget() {
            at = NOWHERE;
        },

        /** The newest state is shown at its finest. */
        keep() {
            good = newest.state;
            doubted(good, false);
        },

        /** Whether the newest state is shown at its finest. */
        isKept: () => good.definition === newest.state.definition && good.look === newest.state.look,

        defined() {
            given = null;
        },
        looked() {
            if (given === 'look') given = null;
        },

        /** The worker is silent. @param {number} silent for so long, in milliseconds */
        doubt(silent) {
            if (silent < DOUBTFUL || doubtful || !outbox.owes || at.question || !outbox.taken(at).definition) return;
            const { definition, look } = newest.state;
            doubtful = { definition, look: definition === good.definition ? look : null };
            doubted(doubtful, true);
        },

        /** The worker has said something. */
        trust() {
            if (doubtful) doubted(doubtful, false);
            doubtful = null;
        },

        /** The worker has stopped: puts the last good state in the place of the one that it was at. @returns {boolean} whether that was the newest */
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
            // What nobody has tried yet may be good.
            if (!taken.definition || (known && !taken.look)) return false;
            given = known && look !== good.look ? 'look' : 'definition';
            doubted({ definition, look: given === 'look' ? look : null }, true);
            if (known && given === 'definition') good = NOTHING;
            newest.replace(good);
            return true;
        },
    };
}
