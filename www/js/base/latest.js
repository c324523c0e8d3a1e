/** Asks one question at a time. While an answer is awaited, only the newest further question waits. */

/**
 * @template {any[]} Args
 * @template Answer
 * @param {(...args: Args) => Promise<Answer>} ask
 * @param {(answer: Answer, ...args: Args) => void} answered called for each asked question, in order
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
                // The worker was replaced; the next question goes to the fresh one.
            }
        }
        asking = false;
    }

    return (...args) => {
        waiting = args;
        if (!asking) go();
    };
}
