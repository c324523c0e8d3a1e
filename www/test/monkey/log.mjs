/** The log of the monkey's actions and their results. */

/** @typedef {import('./instrument.mjs').Task} Task */
/** @typedef {{kind: string, time: number, words: string}} Entry */

/** Longer tasks on the main thread are noticeable, in milliseconds. */
const FELT = 100;
/** How many of the longest tasks are printed. */
const TOLD = 12;

export class Log {
    /** @type {string[]} */
    faults = [];
    /** How often each kind of action was done, and how often its element was missing. @type {Map<string, {done: number, idle: number}>} */
    counts = new Map();
    checks = 0;
    /** Results of comparing pictures with a fresh page, in words. @type {Map<string, number>} */
    pictures = new Map();
    /** @type {{duration: number, cause: string}[]} */
    tasks = [];
    /** The actions of the round. @type {Entry[]} */
    #entries = [];
    #round = '';
    /** @param {boolean} verbose whether to print everything at once */
    constructor(verbose) {
        this.verbose = verbose;
    }

    /** @param {string} words */
    round(words) {
        this.#entries = [];
        this.#round = words;
        if (this.verbose) console.log(`== ${words}`);
    }

    /** An action begins. @param {string} kind */
    begins(kind) {
        this.#entries.push({ kind, time: Date.now(), words: '' });
    }

    /** An action ends. @param {string} words @param {boolean} idle whether its element was missing */
    ends(words, idle) {
        const entry = this.#entries.at(-1);
        if (!entry) return;
        entry.words = words;
        const count = this.counts.get(entry.kind) ?? { done: 0, idle: 0 };
        count[idle ? 'idle' : 'done'] += 1;
        this.counts.set(entry.kind, count);
        if (this.verbose) console.log(`${String(this.#entries.length).padStart(4)} ${entry.kind}: ${words}`);
    }

    /** @param {string} words */
    picture(words) {
        this.checks += 1;
        const kind = words.replace(/^[\d.]+ levels.*/, 'a little off');
        this.pictures.set(kind, (this.pictures.get(kind) ?? 0) + 1);
        if (this.verbose) console.log(`     picture: ${words}`);
    }

    /** Assigns long tasks to the action before them. @param {Task[]} tasks */
    long(tasks) {
        for (const { start, duration } of tasks) {
            const cause = this.#entries.findLast(({ time }) => time <= start + 1);
            this.tasks.push({ duration, cause: cause ? `${cause.kind}: ${cause.words}` : 'opening the page' });
        }
    }

    /** @param {string} message */
    fault(message) {
        const replay = `${this.#round} --actions ${this.#entries.length}`;
        this.faults.push(`${message}\n    again: ${replay}`);
        console.log(`FAULT ${message}\n    again: ${replay}\n    the actions before it:`);
        for (const [at, { kind, words }] of this.#entries.entries()) console.log(`    ${at + 1} ${kind}: ${words}`);
    }

    report() {
        const counts = [...this.counts].sort(([, a], [, b]) => b.done - a.done);
        const actions = counts.reduce((sum, [, { done }]) => sum + done, 0);
        console.log(
            `\n${actions} actions, ${this.checks} pictures beside those of a fresh page (${[...this.pictures].map(([kind, count]) => `${kind} ${count}`).join(', ')}), ${this.faults.length} faults`,
        );
        console.log(
            counts.map(([kind, { done, idle }]) => `${kind} ${done}${idle ? ` (and ${idle} in vain)` : ''}`).join(', '),
        );
        const longest = this.tasks.toSorted((a, b) => b.duration - a.duration);
        console.log(
            `\ntasks on the main thread longer than ${FELT} ms: ${longest.filter(({ duration }) => duration > FELT).length}; the longest:`,
        );
        for (const { duration, cause } of longest.slice(0, TOLD))
            console.log(`${duration.toFixed(0).padStart(6)} ms  ${cause}`);
        for (const fault of this.faults) console.log(`\nFAULT ${fault}`);
    }
}
