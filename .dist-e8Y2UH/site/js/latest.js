/** One question at a time: while one is under way only the newest that follows is kept. */

/**
 * @template {any[]} Args
 * @template Answer
 * @param {(...args: Args) => Promise<Answer>} ask
 * @param {(answer: Answer, ...args: Args) => void} answered for every question that was asked, in their order
 * @returns {(...args: Args) => void}
 */
export function latest(ask, answered) {
    /** @type {Args | null} */
    let waiting = null;
    let asking = false;

    async function go() {
        asking = true;
        while (waiting) {
            const args = waiting;
            waiting = null;
            try {
                answered(await ask(...args), ...args);
            } catch {
                // The worker was replaced meanwhile; the fresh one is asked when there is something new to ask.
            }
        }
        asking = false;
    }

    return (...args) => {
        waiting = args;
        if (!asking) go();
    };
}
