/** The merged results of searches that run in parallel. Pure functions. */

/** @typedef {import('../protocol.js').Candidate} Candidate */
/** @typedef {import('../protocol.js').FindReport} FindReport */

/** The most systems that are shown; the engine keeps as many. */
const MOST = 20;

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
    const candidates = [...all.values()]
        .filter((candidate) => candidate.isFound || !isFound)
        .sort(order)
        .slice(0, MOST);
    const slowest = reports.reduce((a, b) => (b.work < a.work ? b : a));
    return { candidates, searched: slowest.searched, work: slowest.work, isMore: reports.some(({ isMore }) => isMore) };
}

/** An agreement in percent, rounded down: what is not the same is never called 100 %. @param {number} agreement */
export const percent = (agreement) => `${(Math.floor(agreement * 1000 + 1e-9) / 10).toFixed(1)} %`;

const WORDS = ['No', 'One', 'Two', 'Three', 'Four', 'Five', 'Six', 'Seven', 'Eight', 'Nine', 'Ten', 'Eleven', 'Twelve'];

/** A number of systems at the beginning of a sentence. @param {number} count */
export const systems = (count) =>
    `${WORDS[count] ?? (count < MOST ? count : `At least ${count}`)} ${count === 1 ? 'system' : 'systems'}`;

/**
 * The result in a sentence.
 * @param {Pick<FindReport, 'candidates'>} report @param {boolean} isString
 */
export function verdict({ candidates }, isString) {
    const same = candidates.filter(isSame).length;
    const best = Math.max(0, ...candidates.map(({ agreement }) => agreement));
    const [one, many] = isString
        ? ['derives the string', 'derive the string']
        : ['draws this picture', 'draw the same picture'];
    if (same > 0) return `${systems(same)} ${same === 1 ? one : many}.`;
    if (candidates.some(({ isFound }) => isFound)) return `Nearly the same: ${percent(best)}`;
    return candidates.length > 0
        ? 'None of the searched systems draws this picture. The nearest:'
        : `None of the searched systems ${isString ? one : 'comes close'}.`;
}
