/**
 * A package of exercises in a learning system: keeps the answers there and in this browser, and tells the student
 * where they are. No answer is lost with a learning system that is late, refuses, forgets or is not there.
 */

import { copyField, copyKeys } from '../copy.js';
import { make, setText } from '../dom.js';
import { say } from '../words.js';
import { OWN, fieldsIn, keyOf, linkOf, merged, readAttempt, writeAttempt } from './attempt.js';
import { createScorm } from './scorm.js';

/** @typedef {import('./attempt.js').Attempt} Attempt */
/** @typedef {import('./attempt.js').Part} Part */

/** Answers wait for a pause in typing of this length before they are sent, in milliseconds. */
const PAUSE = 1500;
/** The first and the longest wait before another try, in milliseconds. */
const [FIRST_WAIT, LONGEST_WAIT] = [2000, 30_000];
/** How often a state is halved for a learning system that refuses it. */
const HALVINGS = 3;

const ABSENT = say`No learning system answers here.`;
const PREVIEW = say`This is a preview: the learning system saves nothing.`;
const EARLIER = say`This browser has earlier answers that the learning system does not have.`;
const SAVED = say`Saved in the learning system.`;

/**
 * @param {{id: string, standard: import('./scorm.js').Standard, tasks: HTMLElement[], above: Element, restored: (at: number, done: number[]) => void}} page
 *     `tasks` are the elements of the steps, in their order; the words for the student stand before `above`
 */
export function createPackage({ id, standard, tasks, above, restored }) {
    const scorm = createScorm(standard);
    const texts = tasks.map((task) => /[#&]x=([\w-]+)/.exec(task.getAttribute('link') ?? '')?.[1] ?? null);
    const keys = texts.map((text) => (text === null ? OWN : keyOf(text)));
    const links = tasks.map((task) => `${task.getAttribute('link') ?? '#v=1'}&away=0`);
    /** @type {Attempt} */
    let attempt = { at: 0, parts: [] };
    /** The keys of steps that the student changed in this visit. */
    const changed = new Set();
    /** The student by the learning system; empty if it is not open. */
    let student = '';
    /** Whether the learning system takes answers, and whether it had the exercises as passed. */
    let [isGraded, wasPassed] = [false, false];
    let isSent = true;
    let isKept = true;
    /** Answers in this browser that are not shown: of a time without the learning system, or of one that it forgot. @type {Part[]} */
    let earlier = [];
    /** @type {string[]} */
    let dropped = [];
    let wait = FIRST_WAIT;
    let timer = 0;

    const words = make('p', { role: 'status' });
    const field = make('textarea', {
        readonly: true,
        rows: '3',
        'aria-label': say`The links of my answers`,
        hidden: true,
    });
    const copy = make('button', { type: 'button', hidden: true }, say`Copy my answers`);
    const again = make('button', { type: 'button', hidden: true }, say`Use my earlier answers`);
    const notice = make('section', { id: 'learning', hidden: true }, words, make('p', {}, copy, again), field);
    above.before(notice);

    /** @param {string} text @param {{isTrouble?: boolean, offers?: boolean}} [how] */
    function tell(text, { isTrouble = false, offers = !again.hidden } = {}) {
        setText(words, text);
        notice.hidden = text === '';
        notice.classList.toggle('trouble', isTrouble);
        copy.hidden = !isTrouble || attempt.parts.length === 0;
        again.hidden = !offers;
    }

    /** Where answers are that the learning system does not have. */
    const here = () =>
        isKept ? say`Your answers are kept in this browser.` : say`Your answers are on this page only: leave it open.`;

    /** @param {string} of the student */
    const place = (of) => `l-system-package ${id} ${of}`;

    /** What this browser has. @param {string} of the student */
    function kept(of) {
        try {
            const { text = '', rest = '', isSent = false } = JSON.parse(localStorage.getItem(place(of)) ?? '{}');
            const [attempt, others] = [text, rest].map((one) => readAttempt(String(one)) ?? { at: 0, parts: [] });
            return { attempt: attempt ?? { at: 0, parts: [] }, others: others?.parts ?? [], isSent: isSent === true };
        } catch {
            return { attempt: { at: 0, parts: [] }, others: [], isSent: true };
        }
    }

    function keep() {
        try {
            const [text, rest] = [attempt, { at: 0, parts: earlier }].map((one) => writeAttempt(one, Infinity).text);
            localStorage.setItem(place(student), JSON.stringify({ text, rest, isSent }));
            isKept = true;
        } catch {
            isKept = false;
        }
    }

    /** Shows answers that the student has not changed since. @param {Attempt} known */
    function restore(known) {
        const mine = { at: attempt.at, parts: attempt.parts.filter(({ key }) => changed.has(key)) };
        const before = attempt;
        attempt = merged(changed.size > 0 ? mine : { ...known, parts: mine.parts }, known);
        for (const [index, key] of keys.entries()) {
            const fields = attempt.parts.find((part) => part.key === key)?.fields ?? '';
            if (changed.has(key) || fields === (before.parts.find((part) => part.key === key)?.fields ?? '')) continue;
            if (key === OWN) /** @type {any} */ (tasks[index]).open(`#v=1&${fields}`);
            else tasks[index]?.setAttribute('link', `${links[index]}&${fields}`);
        }
        show();
    }

    const isDone = (/** @type {string} */ key) =>
        attempt.parts.some((part) => part.key === key && (part.mark === 'solved' || key === OWN));
    const show = () =>
        restored(
            attempt.at,
            keys.flatMap((key, at) => (isDone(key) ? [at] : [])),
        );

    function connect() {
        const why = scorm.open();
        if (why === null) return opened();
        const told = why === '' ? ABSENT : say`The learning system does not start this page (${why}).`;
        const where = isKept ? say`Your answers are kept in this browser only.` : here();
        tell(`${told} ${where} ${say`Trying again.`}`, { isTrouble: true });
        later(connect);
    }

    /** @param {() => void} what */
    function later(what) {
        clearTimeout(timer);
        timer = window.setTimeout(what, wait);
        wait = Math.min(LONGEST_WAIT, 2 * wait);
    }

    /** What the learning system knows, and what only this browser knows. */
    function opened() {
        const known = scorm.read();
        ({ isGraded, isPassed: wasPassed, student } = known);
        wait = FIRST_WAIT;
        const there = readAttempt(known.state) ?? { at: 0, parts: [] };
        const own = kept(student);
        if (!own.isSent && student !== '') restore(merged(own.attempt, there));
        else {
            // Of what it has, this browser may have the whole.
            const cut = there.parts.filter(({ fields }) => fields === '').map(({ key }) => key);
            restore(merged(there, { at: 0, parts: own.attempt.parts.filter(({ key }) => cut.includes(key)) }));
        }
        if (!isGraded) return tell(PREVIEW);
        const all = [...own.attempt.parts, ...own.others, ...kept('').attempt.parts];
        earlier = all.filter(
            (part, at) =>
                part.fields !== '' &&
                all.findIndex(({ key }) => key === part.key) === at &&
                !attempt.parts.some(({ key }) => key === part.key),
        );
        tell(earlier.length > 0 ? EARLIER : '', { offers: earlier.length > 0 });
        send();
    }

    function send() {
        clearTimeout(timer);
        const parts = attempt.parts.filter(({ key }) => key !== OWN);
        const [solved, all] = [parts.filter(({ mark }) => mark === 'solved'), keys.filter((key) => key !== OWN)];
        let isStored = false;
        for (let halving = 0; !isStored && halving <= HALVINGS; halving++) {
            const written = writeAttempt(attempt, scorm.longest >> halving);
            if (halving > 0 && written.text.length > scorm.longest >> halving) break;
            dropped = written.dropped;
            isStored = scorm.keeps(written.text);
        }
        const failed = scorm.tell({
            part: parts.length === 0 ? null : solved.length / all.length,
            isPassed: wasPassed || solved.length === all.length,
            answers: parts.map((part) => ({
                id: `e-${part.key}`,
                link: linkOf(part),
                isRight: part.mark === 'solved',
            })),
        });
        isSent = isStored && failed === null;
        keep();
        if (!isSent) {
            const why = failed ?? say`it does not keep the answers`;
            const told =
                attempt.parts.length === 0
                    ? say`The learning system does not save (${why}).`
                    : `${say`The learning system has not saved your last answers (${why}).`} ${here()}`;
            tell(`${told} ${say`Trying again.`}`, { isTrouble: true });
            return later(send);
        }
        wait = FIRST_WAIT;
        const steps = keys.flatMap((key, at) => (dropped.includes(key) ? [at + 1] : []));
        if (steps.length > 0)
            tell(
                `${SAVED} ${say`It has no room for the text of step ${steps.join(', ')}: its mark is saved, and the text is kept in this browser only.`}`,
                { isTrouble: true },
            );
        else if (attempt.parts.length > 0) tell(SAVED);
    }

    function follow() {
        isSent = false;
        keep();
        show();
        if (!isGraded) return;
        clearTimeout(timer);
        timer = window.setTimeout(send, PAUSE);
    }

    /** @param {string} key @param {Part['mark']} mark @param {string} fields */
    function answered(key, mark, fields) {
        const former = attempt.parts.find((part) => part.key === key);
        if (former?.fields === fields && former.mark === mark) return;
        // Whoever goes on to try keeps the solution.
        if (former?.mark === 'solved' && mark !== 'solved') return;
        changed.add(key);
        const part = { key, mark, fields };
        attempt.parts = former ? attempt.parts.map((one) => (one === former ? part : one)) : [...attempt.parts, part];
        follow();
    }

    for (const [at, task] of tasks.entries()) {
        const key = keys[at] ?? OWN;
        task.setAttribute('link', links[at] ?? '');
        task.addEventListener('change', (event) => {
            const { by, link } = /** @type {CustomEvent} */ (event).detail;
            if (key === OWN && by === 'visitor') answered(key, 0, fieldsIn(link));
        });
        task.addEventListener('mark', (event) => {
            const { solved, agreement, link, touched } = /** @type {CustomEvent} */ (event).detail;
            // The page shows a solved step as done, so that is kept in any case.
            if (touched || solved) answered(key, solved ? 'solved' : Math.floor(100 * agreement), fieldsIn(link));
        });
    }
    again.addEventListener('click', () => {
        restore(merged(attempt, { at: attempt.at, parts: earlier }));
        earlier = [];
        tell('', { offers: false });
        follow();
    });
    copy.addEventListener('click', async () => {
        const full = (/** @type {Part} */ part) =>
            linkOf(part).replace(`k=${part.key}`, `x=${texts[keys.indexOf(part.key)]}`);
        field.value = attempt.parts
            .filter(({ key }) => key !== OWN)
            .map(full)
            .join('\n');
        field.hidden = false;
        const isCopied = await copyField(field);
        copy.textContent = isCopied ? say`Copied: send it to your teacher` : say`Press ${copyKeys()} to copy`;
    });
    addEventListener('visibilitychange', () => document.hidden && isGraded && !isSent && send());
    addEventListener('pagehide', () => {
        if (isGraded) send();
        clearTimeout(timer);
        scorm.close();
    });
    // A page that comes back from the browser's memory has ended its visit.
    addEventListener('pageshow', ({ persisted }) => persisted && location.reload());

    if (scorm.open() === null) opened();
    else {
        restore(kept('').attempt);
        connect();
    }

    return {
        /** Another step is shown. @param {number} at */
        moved(at) {
            if (at === attempt.at) return;
            attempt.at = at;
            if (attempt.parts.length > 0) follow();
        },
    };
}
