/**
 * A package of exercises in a learning system: keeps the answers there and in this browser, and tells the student
 * where they are. No answer is lost with a learning system that is late, refuses, forgets or is not there.
 */

import { copyField, copyKeys } from '../base/copy.js';
import { make, setText } from '../base/dom.js';
import { say } from '../base/words.js';
import { createStorage } from '../state/storage.js';
import { createAnswers } from './answers.js';
import { OWN, fieldsIn, keyOf, linkOf } from './attempt.js';
import { createScorm } from './scorm.js';

/** @typedef {import('./attempt.js').Part} Part */

/** Answers wait for a pause in typing of this length before they are sent, in milliseconds. */
const PAUSE = 1500;
/** The first and the longest wait before another try, in milliseconds. */
const [FIRST_WAIT, LONGEST_WAIT] = [2000, 30_000];

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
    const storage = createStorage(() => localStorage, 'l-system-');
    const tab = createStorage(() => sessionStorage, 'l-system-');
    const answers = createAnswers({ id, keys, scorm, storage, tab }, follow);
    /** What the steps show of former visits and other windows, by step. @type {string[]} */
    const shown = [];
    let isSent = true;
    let wait = FIRST_WAIT;
    let timer = 0;

    const words = make('p', { role: 'status' });
    const field = make('textarea', {
        readonly: true,
        rows: '3',
        'aria-label': say`The links of my answers`,
        hidden: true,
    });
    const copy = make('button', { hidden: true }, say`Copy my answers`);
    const again = make('button', { hidden: true }, say`Use my earlier answers`);
    const notice = make('section', { id: 'learning', hidden: true }, words, make('p', {}, copy, again), field);
    above.before(notice);

    /** @param {string} text @param {{isTrouble?: boolean, offers?: boolean}} [how] */
    function tell(text, { isTrouble = false, offers = !again.hidden } = {}) {
        setText(words, text);
        notice.hidden = text === '';
        notice.classList.toggle('trouble', isTrouble);
        copy.hidden = !isTrouble || answers.parts.length === 0;
        again.hidden = !offers || answers.earlier.length === 0;
    }

    /** Where answers are that the learning system does not have. */
    const here = () =>
        answers.isKept
            ? say`Your answers are kept in this browser.`
            : say`Your answers are on this page only: leave it open.`;

    /** Shows answers that the student has not changed since, and what is done. */
    function show() {
        const parts = new Map(answers.parts.map((part) => [part.id, part]));
        for (const [index, key] of keys.entries()) {
            const fields = parts.get(key)?.fields ?? '';
            if (answers.touched.has(key) || fields === (shown[index] ?? '')) continue;
            shown[index] = fields;
            if (key === OWN) /** @type {any} */ (tasks[index]).open(`#v=1&${fields}`);
            else tasks[index]?.setAttribute('link', `${links[index]}&${fields}`);
        }
        const isDone = (/** @type {string} */ key) =>
            parts.has(key) && (key === OWN || parts.get(key)?.mark === 'solved');
        restored(
            answers.at,
            keys.flatMap((key, at) => (isDone(key) ? [at] : [])),
        );
    }

    function connect() {
        const why = scorm.open();
        if (why === null) return opened();
        const told = why === '' ? ABSENT : say`The learning system does not start this page (${why}).`;
        const where = answers.isKept ? say`Your answers are kept in this browser only.` : here();
        tell(`${told} ${where} ${say`Trying again.`}`, { isTrouble: true });
        later(connect);
    }

    /** @param {() => void} what */
    function later(what) {
        clearTimeout(timer);
        timer = window.setTimeout(what, wait);
        wait = Math.min(LONGEST_WAIT, 2 * wait);
    }

    function opened() {
        wait = FIRST_WAIT;
        answers.signIn();
        const by = encodeURIComponent(answers.by);
        for (const [index, task] of tasks.entries()) {
            if (task.dataset['varied'] === undefined || by === '' || answers.touched.has(keys[index] ?? '')) continue;
            links[index] += `&by=${by}`;
            task.setAttribute('link', links[index] ?? '');
        }
        show();
        if (!answers.isGraded) return tell(PREVIEW);
        tell(answers.earlier.length > 0 ? EARLIER : '', { offers: true });
        send();
    }

    function send() {
        clearTimeout(timer);
        const { failed, dropped, ...sent } = answers.send();
        ({ isSent } = sent);
        show();
        const hasParts = answers.parts.length > 0;
        if (!isSent) {
            const why = failed ?? say`it does not keep the answers`;
            const told = hasParts
                ? `${say`The learning system has not saved your last answers (${why}).`} ${here()}`
                : say`The learning system does not save (${why}).`;
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
        else if (hasParts) tell(SAVED);
    }

    /** Something has changed, here or in another window. */
    function follow() {
        isSent = false;
        show();
        if (!answers.isGraded) return;
        clearTimeout(timer);
        timer = window.setTimeout(send, PAUSE);
    }

    /** @param {string} key @param {Part['mark']} mark @param {string} link */
    const answered = (key, mark, link) => answers.answer(key, mark, fieldsIn(link)) && follow();

    for (const [at, task] of tasks.entries()) {
        const key = keys[at] ?? OWN;
        task.setAttribute('link', links[at] ?? '');
        task.addEventListener('change', (event) => {
            const { by, link } = /** @type {CustomEvent} */ (event).detail;
            if (key === OWN && by === 'visitor') answered(key, 0, link);
        });
        task.addEventListener('mark', (event) => {
            const { solved, agreement, link, touched } = /** @type {CustomEvent} */ (event).detail;
            // The page shows a solved step as done, so that is kept in any case.
            if (touched || solved) answered(key, solved ? 'solved' : Math.floor(100 * agreement), link);
        });
    }
    again.addEventListener('click', () => {
        answers.useEarlier();
        tell('', { offers: false });
        follow();
    });
    copy.addEventListener('click', async () => {
        const full = (/** @type {Part} */ part) =>
            linkOf(part).replace(`k=${part.id}`, `x=${texts[keys.indexOf(part.id)]}`);
        field.value = answers.parts
            .filter((part) => part.id !== OWN)
            .map(full)
            .join('\n');
        field.hidden = false;
        const isCopied = await copyField(field);
        copy.textContent = isCopied ? say`Copied: send it to your teacher` : say`Press ${copyKeys()} to copy`;
    });
    addEventListener('visibilitychange', () => document.hidden && answers.isGraded && !isSent && send());
    addEventListener('pagehide', () => {
        if (answers.isGraded) send();
        clearTimeout(timer);
        scorm.close();
    });
    // A page that comes back from the browser's memory has ended its visit.
    addEventListener('pageshow', ({ persisted }) => persisted && location.reload());

    if (scorm.open() === null) opened();
    else {
        answers.begin();
        show();
        connect();
    }

    return {
        /** Another step is shown. @param {number} at */
        moved(at) {
            if (answers.move(at)) follow();
        },
    };
}
