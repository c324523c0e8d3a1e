/**
 * A student's answers to a package. Several windows may have it open, and their learning system may be late, refuse,
 * forget, cut, or know each window's answers only; this browser keeps them for all windows. All of these are joined by one
 * rule (`weightOf`) before anything is written, so what is solved is never lost.
 */

import { createRows, joined, newestFirst } from '../state/rows.js';
import { OWN, linkOf, readAttempt, weightOf, writeAttempt } from './attempt.js';

/** @typedef {import('./attempt.js').Part} Part */
/** @typedef {import('../state/storage.js').SafeStorage} SafeStorage */
/**
 * What this browser keeps: the parts of each attempt, under `KEY RUN`, the shown step (`at`), and the number of the present
 * attempt (`run`). `sent`: the learning system has had it.
 * @typedef {Part & {run: number, sent?: boolean}} Kept
 */

/** The most rows that are kept. */
const MOST_ROWS = 1000;
/** How often a state is halved for a learning system that refuses it. */
const HALVINGS = 3;
/** A later attempt outweighs all of an earlier one. @param {Kept} row */
const weightIn = (row) => 4 * row.run + weightOf(row);

/** The attempt of answers that were another's than the present one's. */
const NONE = -1;
/** @param {Part} part @param {number} run @returns {Kept} */
const rowOf = ({ id, time, mark, fields }, run) => ({ id: `${id} ${run}`, time, mark, fields, run });
/** @param {Kept} row @returns {Part} */
const partOf = ({ id, time, mark, fields }) => ({ id: id.replace(/ .*/, ''), time, mark, fields });
const runIn = (/** @type {Kept[]} */ list) => list.find((row) => row.id === 'run')?.run ?? 0;
const atIn = (/** @type {Kept[]} */ list) => Number(list.find((row) => row.id === 'at')?.mark ?? 0);

/** @param {any} row */
const isRow = ({ id, run, fields, mark }) =>
    [id, fields].every((words) => typeof words === 'string') &&
    Number.isInteger(run) &&
    (mark === 'solved' || Number.isFinite(mark));

/** Reads what this browser keeps, also from before each attempt had rows, and from before there were any. @param {unknown} stored @returns {Kept[]} */
function readKept(stored) {
    if (Array.isArray(stored))
        return stored
            .filter((row) => row && isRow(row))
            .map((row) => {
                const [, old, key] = /^(old )?([\da-f]{8}|own)$/.exec(row.id) ?? [];
                return key ? { ...row, ...rowOf({ ...row, id: key }, old ? NONE : row.run) } : row;
            });
    const { text, rest, isSent } = /** @type {any} */ (stored ?? {});
    const rowsOf = (/** @type {unknown} */ words, /** @type {number} */ run, more = {}) =>
        (readAttempt(String(words))?.parts ?? []).map((part) => ({ ...rowOf(part, run), ...more }));
    return [...rowsOf(text, 0, isSent === true ? { sent: true } : {}), ...rowsOf(rest, NONE)];
}

/**
 * @param {object} given
 * @param {string} given.id of the package
 * @param {readonly string[]} given.keys of its steps
 * @param {ReturnType<typeof import('./scorm.js').createScorm>} given.scorm
 * @param {SafeStorage} given.storage of this browser
 * @param {SafeStorage} given.tab of this tab
 * @param {() => void} heard another window has changed an answer
 */
export function createAnswers({ id, keys, scorm, storage, tab }, heard) {
    const place = `package ${id}`;
    /** @type {Map<string, Part>} */
    let parts = new Map();
    let [at, run] = [0, 0];
    /** The keys of steps that the student changed in this visit. @type {Set<string>} */
    const touched = new Set();
    /** The student's number and name by the learning system; empty if it is not open. */
    let [student, name] = ['', ''];
    /** Whether the learning system takes answers, and whether it had the exercises as passed. */
    let [isGraded, wasPassed, isKept] = [false, false, true];
    /** Answers of this tab from a time without the learning system. @type {Kept[]} */
    let nobody = [];
    let rows = rowsOf('');

    /** @param {string} of the student */
    function rowsOf(of) {
        /** @type {ReturnType<typeof createRows<Kept>>} */
        const its = createRows(storage, `${place} ${of}`, {
            read: readKept,
            tidy: (list) => list.sort(newestFirst).slice(0, MOST_ROWS),
            weigh: weightIn,
            changed: () => its === rows && absorb() && heard(),
        });
        return its;
    }

    /** @param {readonly Part[]} more @returns {boolean} whether that changes anything */
    function take(more) {
        const former = JSON.stringify([...parts.values()]);
        parts = new Map(joined([...parts.values(), ...more], weightOf).map((part) => [part.id, part]));
        return JSON.stringify([...parts.values()]) !== former;
    }

    const isPart = (/** @type {Kept} */ row) => keys.includes(partOf(row).id);
    const isActive = (/** @type {Kept} */ row) => row.run === run && isPart(row);

    /** Takes over what other windows have written. @returns {boolean} whether that changes anything */
    function absorb() {
        const list = rows.list();
        const isNew = runIn(list) > run;
        run = runIn(list);
        // In a new attempt, the learning system has not told the other window of what this one knows.
        return take(list.filter(isActive).map(partOf)) || isNew;
    }

    /** Keeps all in this browser. @param {boolean} [sent] whether the learning system has it */
    function keep(sent = false) {
        const own = [...parts.values()].filter((part) => keys.includes(part.id));
        isKept = rows.put(own.map((part) => ({ ...rowOf(part, run), ...(sent && { sent }) })));
    }

    return {
        get parts() {
            return [...parts.values()];
        },
        get at() {
            return at;
        },
        /** Answers in this browser that are not shown: of a time without the learning system, or of one that it forgot. */
        get earlier() {
            const old = student === '' ? [] : rows.list().filter((row) => row.run !== run && isPart(row));
            const better = (/** @type {Part} */ part) => weightOf(part) > weightOf(parts.get(part.id) ?? {});
            return joined([...old, ...nobody].map(partOf), weightOf).filter((part) => part.fields && better(part));
        },
        /** Name and number in one text, which decides on variants. */
        get by() {
            return [name, name && student ? `(${student})` : student].filter(Boolean).join(' ');
        },
        get isGraded() {
            return isGraded;
        },
        get isKept() {
            return isKept;
        },
        touched,

        /** Without a learning system: what this browser has of nobody's. */
        begin() {
            absorb();
            at = atIn(rows.list());
        },

        /** What the learning system knows, once it is open, and what only this browser knows. */
        signIn() {
            const { state, ...known } = scorm.read();
            ({ isGraded, isPassed: wasPassed, student, name } = known);
            const there = readAttempt(state);
            // Answers of nobody belong to whoever made them in this tab, and to no other name.
            const nobodys = rows;
            nobody = tab.read(place) === true ? rows.list().filter((row) => row.fields && isPart(row)) : [];
            parts = new Map([...parts].filter(([key]) => touched.has(key)));
            rows = rowsOf(student);
            const list = rows.list();
            run = runIn(list);
            const own = list.filter(isActive);
            const times = new Map(own.map((row) => [partOf(row).id, row.time]));
            // Some of these, or older: the attempt is the same, but a window has sent what it had before it heard of others.
            const isSame = there?.parts.some(({ id, time }) => time <= (times.get(id) ?? -1));
            const has = new Set(there?.parts.map((part) => part.id));
            const lost = own.filter((row) => student === '' || (row.sent && !isSame && !has.has(partOf(row).id)));
            if (isGraded && lost.length > 0) rows.put([{ id: 'run', run: ++run, mark: 0, fields: '' }]);
            take([...own.filter((row) => !lost.includes(row)).map(partOf), ...(there?.parts ?? [])]);
            if (touched.size === 0) at = there?.at ?? atIn(list);
            if (student === '' || !isGraded || !rows.put(nobody.map((row) => rowOf(partOf(row), NONE)))) return;
            if (nobody.length > 0) nobodys.clear();
            tab.write(place, undefined);
        },

        /** Notes an answer. @param {string} key @param {Part['mark']} mark @param {string} fields @returns {boolean} whether it is news */
        answer(key, mark, fields) {
            const former = parts.get(key);
            if (former?.fields === fields && former.mark === mark) return false;
            // Whoever goes on to try keeps the solution.
            if (former?.mark === 'solved' && mark !== 'solved') return false;
            touched.add(key);
            parts.set(key, { id: key, time: Math.max(Date.now(), (former?.time ?? 0) + 1), mark, fields });
            if (student === '') tab.write(place, true);
            keep();
            return true;
        },

        /** Another step is shown. @param {number} next @returns {boolean} whether that is news */
        move(next) {
            if (next === at) return false;
            at = next;
            return parts.size > 0 && rows.put([{ id: 'at', run, mark: at, fields: '' }]);
        },

        /** Takes over the earlier answers. */
        useEarlier() {
            const [time, { earlier }] = [Date.now(), this];
            take(earlier.map((row) => ({ ...row, time })));
            for (const row of earlier) touched.delete(row.id);
            keep();
        },

        /** Sends all to the learning system. `failed` says why it is not saved there; `dropped` are the ids whose texts are not. */
        send() {
            absorb();
            take(readAttempt(scorm.state())?.parts ?? []);
            const [all, asked] = [[...parts.values()], keys.filter((key) => key !== OWN)];
            const marked = all.filter((part) => asked.includes(part.id));
            const solved = marked.filter(({ mark }) => mark === 'solved');
            /** @type {string[]} */
            let dropped = [];
            let isStored = false;
            for (let halving = 0; !isStored && halving <= HALVINGS; halving++) {
                const written = writeAttempt({ at, parts: all }, scorm.longest >> halving);
                if (halving > 0 && written.text.length > scorm.longest >> halving) break;
                ({ dropped } = written);
                isStored = scorm.keeps(written.text);
            }
            const failed = scorm.tell({
                part: marked.length === 0 ? null : solved.length / asked.length,
                isPassed: wasPassed || solved.length === asked.length,
                answers: marked.map((part) => ({
                    id: `e-${part.id}`,
                    link: linkOf(part),
                    isRight: part.mark === 'solved',
                })),
            });
            const isSent = isStored && failed === null;
            // What another window has sent, this one may have replaced by what it had before: that is to be sent again.
            const doubted = isSent ? [] : rows.list().filter((row) => isActive(row) && row.sent);
            for (const row of doubted) take([{ ...partOf(row), ...parts.get(partOf(row).id), time: row.time + 1 }]);
            keep(isSent);
            return { isSent, failed, dropped };
        },
    };
}
