/**
 * How the page's worker shares a picture in space that takes long with mates, workers of the same script. They hear from it
 * alone, through a port, and every pane that it hands out is answered, be it with nothing; what is not answered it makes itself.
 * Both sides of that stand here.
 */

/** @typedef {import('../js/protocol.js').Pane} Pane */
/** @typedef {import('../js/protocol.js').Outcome} Outcome */
/** @typedef {import('../js/protocol.js').SharedState} SharedState */
/** @typedef {import('../js/protocol.js').Channel<import('../js/protocol.js').ToMate, import('../js/protocol.js').FromMate> & {close: () => void}} PortToMate */
/** @typedef {import('../js/protocol.js').Channel<import('../js/protocol.js').FromMate, import('../js/protocol.js').ToMate>} PortToMaster */
/** One who helps: how many answers are owed, which state is known there, and the memory in bytes. @typedef {{port: PortToMate, owed: number, knows: number, memory: number}} Mate */

/**
 * The worker that hands out panes of its picture.
 * @param {object} worker
 * @param {OffscreenCanvas} worker.canvas
 * @param {wasm_bindgen.Playground} worker.playground
 * @param {(action: () => void) => void} worker.guard
 * @param {() => void} worker.wake
 * @param {() => {number: number, state: SharedState | null}} worker.shown what panes are of; its changes are counted
 * @param {() => number} worker.memory of its wasm, in bytes
 */
export function createSharing({ canvas, playground, guard, wake, shown, memory }) {
    /** All workers together may have so much memory, in bytes. A mate needs about as much for a drawing as the worker it helps. */
    const MOST_MEMORY = 512 << 20;

    /** So many panes are handed to a mate before the first of them is answered: it need not wait while this worker is at a step. */
    const AHEAD = 2;

    /** @type {Mate[]} */
    let mates = [];
    /** The panes that are handed out belong to this round; 0 without any. */
    let round = 0;

    /** Hands out panes of the picture that is being made, if any; mates drop what is not wanted any more. */
    function deal() {
        if (mates.length === 0) return;
        const now = playground.round;
        if (now === 0 && round !== 0) for (const { port } of mates) port.postMessage({ round: 0, pane: null, state: null });
        round = now;
        if (round === 0) return;
        const { number, state } = shown();
        for (let most = 1; most <= AHEAD; most++) {
            for (const mate of mates) {
                if (mate.owed >= most || !hasRoom(mate, number)) continue;
                // What is left at the end is for who is free first.
                const task = playground.handOut(most > 1 ? 2 * mates.length : 0);
                if (!task) return;
                mate.port.postMessage({ round, pane: paneOf(task), state: mate.knows === number ? null : state });
                mate.knows = number;
                mate.memory = Math.max(mate.memory, memory());
                mate.owed += 1;
            }
        }
    }

    /** @param {Float64Array} task as the wasm hands it out @returns {Pane} */
    function paneOf([number = 0, x = 0, y = 0, width = 0, height = 0, budget = 0]) {
        return { number, x, y, width, height, budget };
    }

    /** Whether a mate may build the newest drawing, if it has not yet. @param {Mate} mate @param {number} number of the state */
    function hasRoom(mate, number) {
        if (mate.knows === number) return true;
        const own = memory();
        return mates.reduce((sum, each) => sum + (each === mate ? Math.max(each.memory, own) : each.memory), own) <= MOST_MEMORY;
    }

    /** @param {Mate} mate @param {import('../js/protocol.js').FromMate} answer */
    function receive(mate, { round: dealt, pane, made, memory: bytes }) {
        mate.memory = bytes;
        mate.owed -= 1;
        if (made && playground.takeIn(dealt, pane.number, made.outcome.work, made.outcome.poor)) {
            const image = new ImageData(new Uint8ClampedArray(made.pixels.buffer), pane.width, pane.height);
            canvas.getContext('2d')?.putImageData(image, pane.x, pane.y);
        }
        deal();
        wake();
    }

    return {
        deal,

        /** Has these mates from now on. @param {PortToMate[]} ports */
        meet(ports) {
            for (const { port } of mates) port.close();
            mates = ports.map((port) => ({ port, owed: 0, knows: -1, memory: 0 }));
            for (const mate of mates) mate.port.onmessage = ({ data }) => guard(() => receive(mate, data));
            playground.mates = mates.length;
            round = 0;
        },
    };
}

/**
 * A mate, which makes panes for another worker and does nothing else.
 * @param {object} worker
 * @param {PortToMaster} worker.master where to answer
 * @param {wasm_bindgen.Playground} worker.playground
 * @param {() => void} worker.wake
 * @param {(sight: import('../js/protocol.js').Sight) => void} worker.lookAt
 * @param {() => number} worker.memory of its wasm, in bytes
 * @param {number} worker.stepMs
 */
export function createMate({ master, playground, wake, lookAt, memory, stepMs }) {
    /** What to make, in turn. @type {{round: number, pane: Pane}[]} */
    const tasks = [];
    /** Whether the first of them is begun. */
    let begun = false;
    /** A state that was not yet acted on. @type {SharedState | null} */
    let newState = null;

    master.onmessage = ({ data }) => {
        while (tasks[0] && tasks[0].round !== data.round) deliver(null);
        if (data.state) newState = data.state;
        if (data.pane) tasks.push({ round: data.round, pane: data.pane });
        wake();
    };

    /** Answers the first of the tasks. @param {Outcome | null} outcome null where it was not made */
    function deliver(outcome) {
        const task = tasks.shift();
        begun = false;
        if (!task) return;
        const made = outcome && { outcome, pixels: /** @type {Uint8Array<ArrayBuffer>} */ (playground.panePixels()) };
        master.postMessage({ ...task, made, memory: memory() }, made ? [made.pixels.buffer] : []);
    }

    /** One step of the pane that is asked for. */
    return function assist() {
        const [task] = tasks;
        if (!task) return;
        if (newState) {
            playground.define(newState.definition);
            lookAt(newState.view);
            playground.play(newState.upto ?? undefined);
            newState = null;
        }
        if (!begun) {
            const { x, y, width, height, budget } = task.pane;
            playground.beginPane(x, y, width, height, budget);
            begun = true;
        }
        const spent = playground.stepPane(stepMs);
        if (spent) {
            const [work, poor] = spent;
            deliver(work === undefined ? null : { work, poor: poor !== 0 });
        }
        if (tasks.length > 0) wake();
    };
}
