/**
 * The learning system around a package, by SCORM 1.2 or SCORM 2004: one small interface for both. A call of a learning
 * system may throw, refuse, or answer with anything, so every answer is checked, and what went wrong is a sentence.
 */

import { say } from '../base/words.js';

/** Windows are searched up to this depth; a page may hold itself. */
const DEEPEST = 50;

/** The most that is taken of the names and reasons of a learning system, in characters. */
const LONGEST_WORDS = 200;

/** Both standards keep the state of a visit here. */
const STATE = 'cmi.suspend_data';

/**
 * How a standard names what both have. `longest` are characters.
 * @typedef {object} Names
 * @property {string} api
 * @property {[start: string, end: string, get: string, set: string, commit: string, error: string, words: string]} calls
 * @property {string} core
 * @property {number} longest of a state
 * @property {string} student
 * @property {string} name of the student
 * @property {string} mode
 * @property {string} status
 * @property {string} success what `status` is once the exercises are passed
 * @property {{name: string, type: string, longest: number, wrong: string}} answer
 * @property {(seconds: number) => string} time
 */

/** @type {Names} */
const SCORM12 = {
    api: 'API',
    calls: [
        'LMSInitialize',
        'LMSFinish',
        'LMSGetValue',
        'LMSSetValue',
        'LMSCommit',
        'LMSGetLastError',
        'LMSGetErrorString',
    ],
    core: 'cmi.core.',
    longest: 4096,
    student: 'student_id',
    name: 'student_name',
    mode: 'lesson_mode',
    status: 'lesson_status',
    success: 'passed',
    answer: { name: 'student_response', type: 'fill-in', longest: 255, wrong: 'wrong' },
    time: clockTime,
};

/** @type {Names} */
const SCORM2004 = {
    api: 'API_1484_11',
    calls: ['Initialize', 'Terminate', 'GetValue', 'SetValue', 'Commit', 'GetLastError', 'GetErrorString'],
    core: 'cmi.',
    longest: 64_000,
    student: 'learner_id',
    name: 'learner_name',
    mode: 'mode',
    status: 'completion_status',
    success: 'completed',
    answer: { name: 'learner_response', type: 'long-fill-in', longest: 4000, wrong: 'incorrect' },
    time: (seconds) => `PT${Math.round(seconds * 100) / 100}S`,
};

/** @typedef {'1.2' | '2004'} Standard */
/** An answer: `link` is its link, `isRight` whether it solves the exercise. @typedef {{id: string, link: string, isRight: boolean}} Answer */
/**
 * What the learning system is told. `part` is the part of the exercises that is solved, from 0 to 1; null if nothing
 * was touched.
 * @typedef {{part: number | null, isPassed: boolean, answers: Answer[]}} Told
 */

/** A time as SCORM 1.2 writes it: HHHH:MM:SS.SS. @param {number} seconds */
export function clockTime(seconds) {
    const hundredths = Math.round(seconds * 100);
    const two = (/** @type {number} */ number) => String(number).padStart(2, '0');
    const [minutes, rest] = [Math.floor(hundredths / 6000), hundredths % 6000];
    const hours = String(Math.min(9999, Math.floor(minutes / 60))).padStart(4, '0');
    return `${hours}:${two(minutes % 60)}:${two(Math.floor(rest / 100))}.${two(rest % 100)}`;
}

/** The API in a window or in those around it; or else around their openers. @param {string} name @param {any} from */
function found(name, from) {
    for (const first of [() => from, () => from.opener, () => from.top.opener]) {
        try {
            let [place, depth] = [first(), 0];
            while (place) {
                if (place[name]) return place[name];
                if (place.parent === place || ++depth > DEEPEST) break;
                place = place.parent;
            }
        } catch {
            // A window of another origin: no learning system can be reached there.
        }
    }
    return null;
}

const agrees = (/** @type {string | null} */ answered) => answered?.toLowerCase() === 'true';

/** Calls of a learning system, none of which throws. @param {Names['calls']} calls @param {() => any} api */
function createCalls([, , get, set, , error, words], api) {
    /** The answer of a call as a text; null if it throws. @param {string} what @param {string[]} given */
    function call(what, ...given) {
        try {
            return String(api()[what](...given) ?? '');
        } catch {
            return null;
        }
    }
    return {
        call,
        /** Why the last call failed. */
        reason() {
            const code = call(error) ?? '';
            const isKnown = code !== '' && code !== '0';
            const told = isKnown ? call(words, code)?.slice(0, LONGEST_WORDS) : '';
            return told || (isKnown ? say`error ${code.slice(0, LONGEST_WORDS)}` : say`it gives no reason`);
        },
        read: (/** @type {string} */ element) => call(get, element) ?? '',
        write: (/** @type {string} */ element, /** @type {string} */ value) => agrees(call(set, element, value)),
    };
}

/**
 * @param {Standard} standard
 * @param {{from?: any, now?: () => number}} [surroundings] the window of the page, and milliseconds
 */
export function createScorm(standard, { from = window, now = () => performance.now() } = {}) {
    const is2004 = standard === '2004';
    const { api: name, calls, core, longest, answer, ...names } = is2004 ? SCORM2004 : SCORM12;
    const [start, end, , , commit, error] = calls;
    const begun = now();
    /** @type {any} */
    let api = null;
    let isOpen = false;
    const { call, reason, read, write } = createCalls(calls, () => api);
    /** The state. More than the standard allows is not looked at. */
    const state = () => read(STATE).slice(0, longest);

    return {
        /** The most characters of a state. */
        longest,

        /** Finds and opens the learning system. Null if it is open, else why not; empty if there is none. */
        open() {
            if (isOpen) return null;
            api = found(name, from);
            if (!api) return '';
            // After a reload of the page alone, the learning system is open already and refuses.
            isOpen = agrees(call(start, '')) || (read(core + names.mode) !== '' && call(error) === '0');
            return isOpen ? null : reason();
        },

        state,

        /** What is known from earlier visits. */
        read: () => ({
            state: state(),
            student: read(core + names.student).slice(0, LONGEST_WORDS),
            name: read(core + names.name).slice(0, LONGEST_WORDS),
            isGraded: !['browse', 'review'].includes(read(core + names.mode)),
            isPassed: read(core + names.status) === names.success,
        }),

        /** Keeps a state, and reads it back: some learning systems cut it, and say nothing. @param {string} text */
        keeps: (text) => write(STATE, text) && read(STATE) === text,

        /** Tells marks and the time, and asks to keep all. Null if that is done, else why not. @param {Told} told */
        tell({ part, isPassed, answers }) {
            /** @type {[string, string][]} */
            const needed = [[core + names.status, isPassed ? names.success : 'incomplete']];
            if (is2004 && isPassed) needed.push(['cmi.success_status', 'passed']);
            if (part !== null) needed.push([`${core}score.raw`, String(Math.round(part * 100))]);
            let failed = null;
            for (const [element, value] of needed) if (!write(element, value)) failed ??= reason();
            // A learning system need not keep the rest.
            if (part !== null) {
                write(`${core}score.min`, '0');
                write(`${core}score.max`, '100');
                if (is2004) write('cmi.score.scaled', String(Math.round(part * 1e4) / 1e4));
            }
            for (const [at, { id, link, isRight }] of answers.entries()) {
                const place = `cmi.interactions.${at}.`;
                write(`${place}id`, id);
                write(`${place}type`, answer.type);
                if (link.length <= answer.longest) write(place + answer.name, link);
                write(`${place}result`, isRight ? 'correct' : answer.wrong);
            }
            write(`${core}session_time`, names.time((now() - begun) / 1000));
            write(`${core}exit`, 'suspend');
            return agrees(call(commit, '')) ? failed : (failed ?? reason());
        },

        /** Ends the visit. */
        close() {
            if (isOpen) call(end, '');
            isOpen = false;
        },
    };
}
