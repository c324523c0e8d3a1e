/**
 * How the page's worker shares a picture that takes long with mates, workers of the same script. They hear from it alone,
 * through a port, and every pane that it hands out is answered, be it with nothing; what is not answered it makes itself.
 * It stands before worker.js in one script.
 *
 * @param {object} worker the one that shares, or helps
 * @param {OffscreenCanvas} worker.canvas
 * @param {() => any} worker.playground
 * @param {(action: () => void) => void} worker.guard
 * @param {() => void} worker.wake
 * @param {() => {number: number, definition: any, view: any, upto: bigint | null}} worker.state that panes are of
 * @param {(look: any) => void} worker.lookAt
 * @param {() => number} worker.memory of its wasm, in bytes
 * @param {number} worker.stepMs
 */
function createSharing({ canvas, playground, guard, wake, state, lookAt, memory, stepMs }) {
    /** All workers together may have so much memory, in bytes. A mate needs about as much for a drawing as the worker it helps. */
    const MOST_MEMORY = 512 << 20;

    /** So many panes are handed to a mate before the first of them is answered: it need not wait while this worker is at a step. */
    const AHEAD = 2;

    /** Those who help: how many answers they owe, which state they know, and their memory in bytes. @type {{port: MessagePort, owed: number, knows: number, memory: number}[]} */
    let mates = [];
    /** The panes that are handed out belong to this round; 0 without any. */
    let round = 0;
    /** As a mate: where to answer, what to do, and a state that was not yet acted on. @type {MessagePort | null} */
    let master = null;
    /** @type {any[]} */
    const tasks = [];
    /** @type {any} */
    let newState = null;

    /** Hands out panes of the picture that is being made, if any; mates drop what is not wanted any more. */
    function deal() {
        if (mates.length === 0) return;
        const now = playground().round;
        if (now === 0 && round !== 0) for (const { port } of mates) port.postMessage({ round: 0 });
        round = now;
        if (round === 0) return;
        const { number, ...own } = state();
        for (let most = 1; most <= AHEAD; most++) {
            for (const mate of mates) {
                if (mate.owed >= most || !hasRoom(mate, number)) continue;
                // What is left at the end is for who is free first.
                const task = playground().handOut(most > 1 ? 2 * mates.length : 0);
                if (!task) return;
                mate.port.postMessage({ round, task, state: mate.knows === number ? null : own });
                mate.knows = number;
                mate.memory = Math.max(mate.memory, memory());
                mate.owed += 1;
            }
        }
    }

    /** Whether a mate may build the newest drawing, if it has not yet. @param {typeof mates[number]} mate @param {number} number of the state */
    function hasRoom(mate, number) {
        if (mate.knows === number) return true;
        const own = memory();
        return mates.reduce((sum, each) => sum + (each === mate ? Math.max(each.memory, own) : each.memory), own) <= MOST_MEMORY;
    }

    /** A mate's answer. @param {typeof mates[number]} mate @param {any} answer */
    function receive(mate, { round, task, outcome, pixels, memory: bytes = mate.memory }) {
        mate.memory = bytes;
        const [number, x, y, width, height] = task;
        const [work, poor, rough] = outcome;
        mate.owed -= 1;
        if (pixels && playground().takeIn(round, number, work, poor, rough)) {
            const image = new ImageData(new Uint8ClampedArray(pixels.buffer), width, height);
            canvas.getContext('2d')?.putImageData(image, x, y);
        }
        deal();
        wake();
    }

    /** @param {any} request @param {ArrayLike<number>} outcome empty where the pane was not made */
    function deliver({ round, task }, outcome) {
        const pixels = outcome.length > 0 ? playground().panePixels() : null;
        master?.postMessage({ round, task, outcome, pixels, memory: memory() }, pixels ? [pixels.buffer] : []);
    }

    return {
        deal,

        /** Has these mates from now on. @param {MessagePort[]} ports */
        meet(ports) {
            for (const { port } of mates) port.close();
            mates = ports.map((port) => ({ port, owed: 0, knows: -1, memory: 0 }));
            for (const mate of mates) mate.port.onmessage = ({ data }) => guard(() => receive(mate, data));
            playground().mates = mates.length;
            round = 0;
        },

        /** Makes panes for another worker from now on. @param {MessagePort} port */
        serve(port) {
            master = port;
            port.onmessage = ({ data }) => {
                while (tasks.length > 0 && tasks[0].round !== data.round) deliver(tasks.shift(), []);
                if (data.state) newState = data.state;
                if (data.round !== 0) tasks.push(data);
                wake();
            };
        },

        /** Whether this worker is a mate. */
        get serves() {
            return master !== null;
        },

        /** As a mate: one step of the pane that is asked for. */
        assist() {
            if (tasks.length === 0) return;
            if (newState) {
                playground().define(newState.definition);
                lookAt(newState.view);
                playground().play(newState.upto ?? undefined);
                newState = null;
            }
            if (!tasks[0].begun) {
                const [, x, y, width, height, budget] = tasks[0].task;
                playground().beginPane(x, y, width, height, budget);
                tasks[0].begun = true;
            }
            const outcome = playground().stepPane(stepMs);
            if (outcome) deliver(tasks.shift(), outcome);
            if (tasks.length > 0) wake();
        },
    };
}
