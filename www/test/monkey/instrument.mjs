/** Runs in each frame before its scripts: makes workers stoppable from outside and lists long tasks. */

/** @typedef {{start: number, duration: number}} Task in milliseconds; `start` since 1970 */
/** `reads` are the times when the monkey itself blocked the page, from and to. @typedef {{workers: Worker[], tasks: Task[], reads: [number, number][]}} Kept */
/** @typedef {Window & {monkey: Kept}} Watched a window with what stands here */

/** Ways to stop a worker: silently, with an error, with a trap, or by an endless loop. */
export const ENDS = /** @type {const} */ (['silent', 'throw', 'fatal', 'loop']);

/** Runs in the page. */
export function instrument() {
    if (Object.hasOwn(window, 'monkey')) return;
    /** @type {Worker[]} */
    const workers = [];
    /** @type {Task[]} */
    const tasks = [];
    /** @type {[number, number][]} */
    const reads = [];
    Object.assign(window, { monkey: { workers, tasks, reads } });
    try {
        new PerformanceObserver((list) => {
            for (const { startTime, duration } of list.getEntries())
                tasks.push({ start: performance.timeOrigin + startTime, duration });
        }).observe({ type: 'longtask', buffered: true });
    } catch {
        // A frame that is not loaded yet cannot be observed.
    }

    // The listener is added before the worker's script, so that the script never gets these messages.
    const head = `self.addEventListener('message', (event) => {
        const order = event.data && event.data.monkey;
        if (!order) return;
        event.stopImmediatePropagation();
        if (order === 'loop') for (;;);
        if (order === 'fatal') self.postMessage({ type: 'fatal', message: 'the monkey' });
        else throw new Error('the monkey');
    });`;
    // A single-file page starts its worker from a blob, whose policy forbids importing other scripts.
    /** @type {Map<string, Blob>} */
    const blobs = new Map();
    const addressOf = URL.createObjectURL;
    URL.createObjectURL = (source) => {
        const address = addressOf.call(URL, source);
        if (source instanceof Blob && source.type === 'text/javascript') blobs.set(address, source);
        return address;
    };
    const Real = window.Worker;
    window.Worker = class extends Real {
        /** @param {string | URL} address @param {WorkerOptions} [options] */
        constructor(address, options) {
            const script =
                blobs.get(String(address)) ??
                `importScripts(${JSON.stringify(new URL(address, document.baseURI).href)});`;
            super(addressOf.call(URL, new Blob([`${head}\n`, script], { type: 'text/javascript' })), options);
            workers.push(this);
        }

        terminate() {
            const at = workers.indexOf(this);
            if (at >= 0) workers.splice(at, 1);
            super.terminate();
        }
    };
}

/** Runs in the page: the long tasks since the last call, without tasks of the monkey. @returns {Task[]} */
export function longTasks() {
    const { tasks, reads } = /** @type {Watched} */ (/** @type {unknown} */ (window)).monkey;
    const found = tasks
        .splice(0)
        .filter(({ start, duration }) => !reads.some(([from, to]) => from < start + duration && start < to));
    reads.splice(0, reads.length - 20);
    return found;
}

/**
 * Runs in the page: stops one of its workers.
 * @param {readonly [number, typeof ENDS[number]]} how which of them, counted round, and how
 * @returns {string} what came of it
 */
export function stopWorker([which, how]) {
    const { workers } = /** @type {Watched} */ (/** @type {unknown} */ (window)).monkey;
    const worker = workers[which % Math.max(1, workers.length)];
    if (!worker) return 'there is none';
    if (how !== 'silent') worker.postMessage({ monkey: how });
    else {
        // The page still references the worker, which sends no more messages.
        Object.getPrototypeOf(Object.getPrototypeOf(worker)).terminate.call(worker);
        workers.splice(workers.indexOf(worker), 1);
    }
    return `worker ${which % Math.max(1, workers.length)} of ${workers.length}`;
}
