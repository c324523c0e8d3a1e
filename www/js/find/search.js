/**
 * A search for rules with several workers. Each tries its share of the same systems. The work goes on in rounds, each
 * as long as all before it, so that all workers have searched the same at the end of a round.
 */

import { SILENT, createTool } from '../engine/tool.js';
import { say } from '../base/words.js';
import { isSame, merged } from './merge.js';

/** @typedef {import('../protocol.js').FindQuestion} FindQuestion */
/** @typedef {import('../protocol.js').FindSource} FindSource */
/** @typedef {import('../protocol.js').FindReport} FindReport */
/** @typedef {import('../protocol.js').NamedSystem} NamedSystem */
/** @typedef {import('../state/state.js').Definition} Definition */

/** The most workers: more than the cores of a small laptop gain little, and each has a memory of its own. */
const MOST_WORKERS = 4;
/**
 * The work of the first round, and of a search before it asks whether to go on: systems of a picture, symbols of a
 * string. One worker does the latter in 10 to 20 s on a laptop.
 */
const WORK = { picture: { first: 65_536, most: 1 << 21 }, string: { first: 1 << 20, most: 1 << 28 } };
/** The number of systems that a thorough search of a picture tries, whatever it finds. */
const THOROUGH = 1 << 20;
/** The rounds after the one in which the same picture was found, for shorter rules; and after the one in which nearly the same was found. */
const AFTER = { same: 1, near: 3 };
/** The work of "Search longer", as a multiple of the work so far. */
const LONGER = 4;

/** The workers of a search: one core is left to the page. @param {{hardwareConcurrency?: number}} machine */
export const workersOn = ({ hardwareConcurrency = 2 }) => Math.min(MOST_WORKERS, Math.max(1, hardwareConcurrency - 1));

/**
 * The workers and the work.
 * @typedef {object} Search
 * @property {ReturnType<typeof createTool<import('../protocol.js').FindCalls>>[]} tools
 * @property {number} parts
 * @property {number} done The work that is done
 * @property {number} first The work of the first round
 * @property {number} most Where the search stops
 * @property {boolean} isThorough Whether the search goes on after a find, to its end
 */

export function createSearch() {
    /** @type {Search} */
    const self = { tools: [], parts: 1, done: 0, first: 0, most: 0, isThorough: false };

    return {
        /**
         * Begins a search; the former one is given up.
         * @param {FindSource} source
         * @param {FindQuestion} question
         * @param {AbortSignal} signal
         * @param {(report: FindReport) => void} progress
         * @param {{thorough?: boolean, named?: NamedSystem[]}} [how] a thorough search does not stop after a find; systems with names are tried first
         */
        begin: (source, question, signal, progress, { thorough = false, named = [] } = {}) =>
            run(signal, async (signal) => {
                self.isThorough = thorough;
                const isString = 'text' in source;
                self.parts = isString ? 1 : workersOn(navigator);
                have(self, self.parts);
                ({ first: self.first, most: self.most } = isString ? WORK.string : WORK.picture);
                if (thorough) self.most = Math.min(self.most, THOROUGH);
                self.done = 0;
                await Promise.all(
                    self.tools
                        .slice(0, self.parts)
                        .map((tool, part) =>
                            tool.call('begin', { source, question, part, parts: self.parts, named }, { signal }),
                        ),
                );
                return goOn(self, signal, progress);
            }),

        /** Where the searched picture and a system differ, or null (js/base/differences.js). @param {Definition} definition */
        compared: async (definition) => (await self.tools[0]?.call('compare', { definition })) ?? null,

        /** Draws an SVG; throws a sentence if that is not possible. @param {Uint8Array<ArrayBuffer>} bytes */
        drawSvg: (bytes) => drawSvg(self, bytes),

        /** What a photograph shows, straightened; null if the picture is none, or if that takes too long. @param {import('./ink.js').Grey} picture */
        async straightened({ grey, width, height }) {
            have(self, 1);
            return (await self.tools[0]?.call('photograph', { grey, width, height }).catch(() => null)) ?? null;
        },

        /** Goes on where the search stopped. @param {AbortSignal} signal @param {(report: FindReport) => void} progress */
        longer(signal, progress) {
            self.most = Math.max(self.most, self.done * LONGER, self.first * LONGER);
            return run(signal, (signal) => goOn(self, signal, progress));
        },
    };
}

/** @param {Search} self @param {number} count */
function have(self, count) {
    while (self.tools.length < count) self.tools.push(createTool('find'));
}

/**
 * Works until a system is found, and some rounds more for better ones; or until `most`.
 * @param {Search} self
 * @param {AbortSignal} signal
 * @param {(report: FindReport) => void} progress
 * @returns {Promise<FindReport>}
 */
async function goOn(self, signal, progress) {
    /** @type {(FindReport | null)[]} */
    const reports = Array.from({ length: self.parts }, () => null);
    const show = () => {
        const known = reports.filter((report) => report !== null);
        if (known.length === self.parts) progress(merged(known));
    };
    for (let rounds = Infinity; ; ) {
        const until = Math.min(self.most, Math.max(self.first, self.done * 2));
        const answers = await Promise.all(
            self.tools.slice(0, self.parts).map((tool, part) =>
                tool.call(
                    'search',
                    { until },
                    {
                        signal,
                        progress: (report) => {
                            reports[part] = report;
                            show();
                        },
                    },
                ),
            ),
        );
        answers.forEach((report, part) => (reports[part] = report));
        const report = merged(answers);
        self.done = until;
        if (!report.isMore || self.done >= self.most || (rounds === 0 && !self.isThorough)) return report;
        if (report.candidates.some(isSame)) rounds = Math.min(rounds, AFTER.same);
        else if (report.candidates.some((candidate) => candidate.isFound)) rounds = Math.min(rounds, AFTER.near);
        rounds--;
        show();
    }
}

/**
 * Runs a part of the search. If a worker fails or the search is stopped, all workers stop.
 * @template T
 * @param {AbortSignal} signal
 * @param {(signal: AbortSignal) => Promise<T>} work
 */
async function run(signal, work) {
    const all = new AbortController();
    const stop = () => all.abort();
    signal.addEventListener('abort', stop);
    if (signal.aborted) stop();
    try {
        return await work(all.signal);
    } finally {
        signal.removeEventListener('abort', stop);
        stop();
    }
}

/** @param {Search} self @param {Uint8Array<ArrayBuffer>} bytes */
async function drawSvg(self, bytes) {
    have(self, 1);
    const [tool] = self.tools;
    if (!tool) throw new Error(say`There is no worker.`);
    try {
        return await tool.call('svg', { bytes });
    } catch (error) {
        // On a busy machine the worker is ended before its work is counted to the end.
        if (error instanceof Error && error.message === SILENT)
            throw new Error(say`This SVG takes too long to draw. Save it as a PNG first.`);
        throw error;
    }
}
