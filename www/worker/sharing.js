/**
 * How the main worker shares a slow picture in space with mates, workers of the same script. Mates talk only to the
 * main worker, through a port, and answer every pane, even one that was not drawn. The main worker draws unanswered
 * panes itself. Both sides stand here.
 */

/** @typedef {import('../js/protocol.js').Pane} Pane */
/** @typedef {import('../js/protocol.js').Outcome} Outcome */
/** @typedef {import('../js/protocol.js').SharedState} SharedState */
/** @typedef {import('../js/protocol.js').Channel<import('../js/protocol.js').ToMate, import('../js/protocol.js').FromMate> & {close: () => void}} PortToMate */
/** @typedef {import('../js/protocol.js').Channel<import('../js/protocol.js').FromMate, import('../js/protocol.js').ToMate>} PortToMaster */
/** A mate: how many answers it owes, the revision of the state that it has, and its memory in bytes. @typedef {{port: PortToMate, owed: number, knows: number, memory: number}} Mate */

/**
 * The main worker, which hands out panes of its picture.
 * @param {object} worker
 * @param {OffscreenCanvas} worker.canvas
 * @param {wasm_bindgen.Playground} worker.playground
 * @param {(action: () => void) => void} worker.guard
 * @param {() => void} worker.wake
 * @param {() => {revision: number, state: SharedState | null}} worker.shown the state that panes show, and its revision
 * @param {() => number} worker.memory of its wasm, in bytes
 */
export function createSharing({ canvas, playground, guard, wake, shown, memory }) {
    /** The most wasm memory of all workers together, in bytes. A mate needs about as much for a drawing as the main worker. */
    const MOST_MEMORY = 512 << 20;

    /** How many panes a mate may have at once, so that it need not wait while this worker runs a step. */
    const AHEAD = 2;

    /** @type {Mate[]} */
    let mates = [];
    /** The round of the panes that are handed out; 0 for none. */
    let round = 0;

    /** Hands out panes of the current picture, if any; mates drop panes of older rounds. */
    function deal() {
        if (mates.length === 0) return;
        const now = playground.round;
        if (now === 0 && round !== 0)
            for (const { port } of mates) port.postMessage({ round: 0, pane: null, state: null });
        round = now;
        if (round === 0) return;
        const { revision, state } = shown();
        for (let most = 1; most <= AHEAD; most++) {
            for (const mate of mates) {
                if (mate.owed >= most || !hasRoom(mate, revision)) continue;
                // Keep the last panes for workers that become free first.
                const pane = playground.handOut(most > 1 ? 2 * mates.length : 0);
                if (!pane) return;
                mate.port.postMessage({ round, pane, state: mate.knows === revision ? null : state });
                mate.knows = revision;
                mate.memory = Math.max(mate.memory, memory());
                mate.owed += 1;
            }
        }
    }

    /** Whether the memory allows a mate to build the newest drawing. @param {Mate} mate @param {number} revision */
    function hasRoom(mate, revision) {
        if (mate.knows === revision) return true;
        const own = memory();
        return (
            mates.reduce((sum, each) => sum + (each === mate ? Math.max(each.memory, own) : each.memory), own) <=
            MOST_MEMORY
        );
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

        /** Sets the mates. @param {PortToMate[]} ports */
        setMates(ports) {
            for (const { port } of mates) port.close();
            mates = ports.map((port) => ({ port, owed: 0, knows: -1, memory: 0 }));
            for (const mate of mates) mate.port.onmessage = ({ data }) => guard(() => receive(mate, data));
            playground.mates = mates.length;
            round = 0;
        },
    };
}

/**
 * A mate, which only draws panes for the main worker.
 * @param {object} worker
 * @param {PortToMaster} worker.master the port to the main worker
 * @param {wasm_bindgen.Playground} worker.playground
 * @param {() => void} worker.wake
 * @param {() => number} worker.memory of its wasm, in bytes
 */
export function createMate({ master, playground, wake, memory }) {
    /** The panes to draw, in turn. @type {{round: number, pane: Pane}[]} */
    const tasks = [];
    /** Whether the first task is begun. */
    let begun = false;
    /** A received state that the playground does not have yet. @type {SharedState | null} */
    let newState = null;

    master.onmessage = ({ data }) => {
        while (tasks[0] && tasks[0].round !== data.round) deliver(null);
        if (data.state) newState = data.state;
        if (data.pane) tasks.push({ round: data.round, pane: data.pane });
        wake();
    };

    /** Answers the first task. @param {Outcome | null} outcome null if the pane was not drawn */
    function deliver(outcome) {
        const task = tasks.shift();
        begun = false;
        if (!task) return;
        const made = outcome && { outcome, pixels: /** @type {Uint8Array<ArrayBuffer>} */ (playground.panePixels()) };
        master.postMessage({ ...task, made, memory: memory() }, made ? [made.pixels.buffer] : []);
    }

    /** Draws one step of the first pane. */
    return function assist() {
        const [task] = tasks;
        if (!task) return;
        if (newState) {
            playground.define(newState.definition);
            playground.look(newState.view);
            playground.play(newState.upto ?? undefined);
            newState = null;
        }
        if (!begun) {
            const { x, y, width, height, budget } = task.pane;
            playground.beginPane(x, y, width, height, budget);
            begun = true;
        }
        const outcome = playground.stepPane();
        if (outcome !== undefined) deliver(outcome);
        if (tasks.length > 0) wake();
    };
}
