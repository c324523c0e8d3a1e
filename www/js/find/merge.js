/** The merged results of searches that run in parallel. Pure functions. */

import { decimal } from '../base/numerals.js';
import { counted, say } from '../base/words.js';

/** @typedef {import('../protocol.js').Candidate} Candidate */
/** @typedef {import('../protocol.js').FindReport} FindReport */

/** The most systems that are shown; the engine keeps as many. */
const MOST = 20;

/** Systems that are no answer are shown from this agreement on. */
const LEAST = 0.5;

/** Whether a candidate draws the same picture: the skeletons agree, and nothing is left over. @param {Candidate} candidate */
export const isSame = ({ agreement }) => agreement >= 1;

/** The order of candidates: those that draw the picture and then those nearly so by their rank, others by their agreement. @param {Candidate} a @param {Candidate} b */
function order(a, b) {
    if (a.isFound !== b.isFound) return a.isFound ? -1 : 1;
    if (isSame(a) !== isSame(b)) return isSame(a) ? -1 : 1;
    const [byRank, byAgreement] = [a.rank - b.rank, b.agreement - a.agreement];
    return a.isFound ? byRank || byAgreement : byAgreement || byRank;
}

/**
 * The systems that draw the picture, or the closest ones if none does, best first. Each search tried its share of the
 * same systems in the same order, so all of them searched what the slowest one did.
 * @param {FindReport[]} reports
 * @returns {FindReport}
 */
export function merged(reports) {
    /** @type {Map<string, Candidate>} */
    const all = new Map();
    for (const candidate of reports.flatMap(({ candidates }) => candidates)) {
        const other = all.get(candidate.key) ?? candidate;
        // One search may place the same rules more exactly than another. The name stays with them.
        const better = candidate.agreement > other.agreement ? candidate : other;
        const rank = Math.min(candidate.rank, other.rank);
        all.set(candidate.key, { ...better, name: other.name ?? candidate.name, rank });
    }
    const isFound = [...all.values()].some((candidate) => candidate.isFound);
    const kept = [...all.values()].filter((one) => one.isFound || (!isFound && one.agreement >= LEAST));
    const candidates = answers(kept.sort(order)).slice(0, MOST);
    const slowest = reports.reduce((a, b) => (b.work < a.work ? b : a));
    return { candidates, searched: slowest.searched, work: slowest.work, isMore: reports.some(({ isMore }) => isMore) };
}

/** One answer for each rule: the best of its candidates, with all iterations that are as good. @param {Candidate[]} candidates */
function answers(candidates) {
    /** @type {Map<string, Candidate & {n?: number[]}>} */
    const groups = new Map();
    for (const candidate of candidates) {
        const { axiom, rules, overrides, angle, iterations } = candidate.definition;
        const key = JSON.stringify([axiom, rules, overrides, candidate.isFound && angle]);
        const best = groups.get(key);
        if (!best) groups.set(key, { ...candidate });
        else if (isSame(best) && isSame(candidate)) best.n = [...(best.n ?? [best.definition.iterations]), iterations];
    }
    return [...groups.values()];
}

/** An agreement in percent, rounded down: what is not the same is never called 100 %. @param {number} agreement */
export const percent = (agreement) => `${decimal(Math.floor(agreement * 1000 + 1e-9) / 10, 1)} %`;

const WORDS = [
    say`No systems`,
    say`One system`,
    say`Two systems`,
    say`Three systems`,
    say`Four systems`,
    say`Five systems`,
    say`Six systems`,
    say`Seven systems`,
    say`Eight systems`,
    say`Nine systems`,
    say`Ten systems`,
    say`Eleven systems`,
    say`Twelve systems`,
];

/** A number of systems at the beginning of a sentence. @param {number} count */
export const systems = (count) =>
    WORDS[count] ??
    (count < MOST
        ? counted(count, '{} system', '{} systems')
        : counted(count, 'At least {} system', 'At least {} systems'));

/**
 * The result in a sentence.
 * @param {Pick<FindReport, 'candidates'>} report @param {boolean} isString
 */
export function verdict({ candidates }, isString) {
    const same = candidates.filter(isSame).length;
    const best = Math.max(0, ...candidates.map(({ agreement }) => agreement));
    if (same === 1) return isString ? say`One system derives the string.` : say`One system draws this picture.`;
    if (same > 0)
        return isString ? say`${systems(same)} derive the string.` : say`${systems(same)} draw the same picture.`;
    if (candidates.some(({ isFound }) => isFound)) return say`Nearly the same: ${percent(best)}`;
    if (candidates.length > 0) return say`None of the searched systems draws this picture. The nearest:`;
    return isString
        ? say`None of the searched systems derives the string.`
        : say`None of the searched systems comes close.`;
}
