/** The page program.html: an exercise whose answer is a program, with its functions, its marks and what it draws. */

import { announce } from '../base/announce.js';
import { copyKeys, copyText } from '../base/copy.js';
import { button, byId, html, input, make, setText } from '../base/dom.js';
import { addressOf } from '../base/files.js';
import { reasonOf, said, say, translatePage } from '../base/words.js';
import { connectHost } from '../embed/messages.js';
import { keyOf } from '../exercise/attempt.js';
import { exerciseIn, studentIn } from '../exercise/open.js';
import { inline, paragraphs } from '../exercise/words.js';
import { DEFAULTS } from '../state/state.js';
import { createStorage } from '../state/storage.js';
import { createStore } from '../state/store.js';
import { createEditor } from './editor.js';
import { createBoard } from './board.js';
import { faultWords } from './faults.js';
import { givenIn } from './given.js';
import { callsOf, judged } from './judge.js';
import { createPlants } from './plants.js';
import { createRunner } from './runner.js';
import { markClass } from './marking.js';
import { packed, programIn, readExercise, readTask } from './tasks.js';

/** @typedef {import('./runner.js').Language} Language */

/** Programs run again after a pause in typing of this length, in milliseconds. */
const PAUSE = 800;
/** The address follows after this time: browsers refuse many changes of it. */
const KEEP = 300;
/** Links that are longer are cut by some platforms, in characters. */
const LONG = 2000;
/** @type {Readonly<Record<Language, string>>} */
const NAMES = { python: 'Python', javascript: 'JavaScript' };

translatePage();
const has = (/** @type {string} */ what) => new RegExp(`(^|[#&])${what}(&|$)`).test(location.hash);
const x = exerciseIn(location.hash) ?? '';
const storage = createStorage(() => localStorage);
const store = createStore(DEFAULTS);
const host = connectHost(store, {
    host: null,
    offer: () => {},
    theme: (theme) => showTheme(theme),
    play: () => {},
    facts: () => ({ description: '', symbols: null, segments: null }),
});

/** @param {'light' | 'dark' | null} theme */
function showTheme(theme) {
    if (theme) document.documentElement.dataset['theme'] = theme;
    else delete document.documentElement.dataset['theme'];
}
showTheme(has('theme=dark') ? 'dark' : has('theme=light') ? 'light' : null);

const exercise = await readExercise(x).catch((error) => refuse(reasonOf(error)));
if (exercise) open(exercise);

/** @param {string} reason @returns {null} */
function refuse(reason) {
    setText(html('exercise-title'), say`Exercise`);
    setText(html('exercise-task'), say`The exercise cannot be opened: ${reason}.`);
    html('work').hidden = true;
    return null;
}

/** @param {import('./tasks.js').Exercise} about */
async function open(about) {
    const task = readTask(about.program);
    if (task.functions.length === 0) return void refuse(task.problems[0] ?? say`it names no functions`);
    if (has('class=1')) return markClass(task);
    const draft = `program ${keyOf(x)}`;
    const linked = await programIn(location.hash);
    const kept = /** @type {any} */ (storage.read(draft) ?? {});
    /** @type {Record<Language, string>} */
    const codes = { python: '', javascript: '' };
    for (const language of task.languages) if (typeof kept[language] === 'string') codes[language] = kept[language];
    if (linked) codes[linked.language] = linked.code;
    const wanted = linked?.language ?? kept.language;
    /** @type {Language} */
    let language = task.languages.includes(wanted) ? wanted : (task.languages[0] ?? 'python');
    let [hasRun, isTouched, timer, keeping, hints, shown] = [false, false, 0, 0, 0, ''];
    /** @type {AbortController | null} */
    let running = null;

    const runner = createRunner((told, part) => {
        html('loading').hidden = told === '';
        setText(html('loading-words'), told);
        const bar = byId('loading-bar', HTMLProgressElement);
        if (part === null) bar.removeAttribute('value');
        else bar.value = part;
    });
    const editor = createEditor(html('editor'), (text) => {
        codes[language] = text;
        isTouched = true;
        storage.write(draft, { ...codes, language });
        clearTimeout(keeping);
        keeping = window.setTimeout(keep, KEEP);
        clearTimeout(timer);
        running?.abort();
        setText(html('result'), '');
        if (hasRun) timer = window.setTimeout(run, PAUSE);
    });
    const board = createBoard(html('functions'), task, {
        begin: (text) => editor.append(text(language)),
    });
    const plants = task.drawing ? createPlants(task, task.drawing, { again: () => hasRun && void run(), time }) : null;
    html('garden').hidden = plants === null;

    /** Keeps the program in this browser, and in the address of a window of its own. */
    async function keep() {
        storage.write(draft, { ...codes, language });
        const link = await linkOf();
        if (parent === window) history.replaceState(null, '', link);
        return link;
    }

    async function linkOf() {
        const by = input('student-name').value.trim();
        const code = await packed(language, codes[language]);
        return [`#v=1&x=${x}`, `code=${code}`, ...(by === '' ? [] : [`by=${encodeURIComponent(by)}`])].join('&');
    }

    /** What a run is asked for: the tests, and then what the plant's picture and times need. @param {import('./worker.js').Call[]} calls */
    const asked = (calls) => ({
        code: codes[language],
        given: givenIn(language),
        names: [...new Set(calls.map(({ name }) => name))],
        calls,
    });

    async function run() {
        clearTimeout(timer);
        running?.abort();
        const own = (running = new AbortController());
        hasRun = true;
        const tests = callsOf(task.functions);
        button('run').setAttribute('aria-busy', 'true');
        try {
            const calls = [...tests, ...(plants?.calls(tests.length) ?? [])];
            const ran = await runner.run(language, asked(calls), own.signal);
            if (own.signal.aborted) return;
            show(ran, tests.length);
        } catch (error) {
            html('loading').hidden = true;
            setText(html('result'), say`The program could not be run (${reasonOf(error)}).`);
        }
        if (own === running) button('run').removeAttribute('aria-busy');
    }

    /** @param {import('./runner.js').Ran} ran @param {number} count of the tests */
    async function show(ran, count) {
        const all = judged(task.functions, ran);
        const right = all.filter((one) => one.isRight).length;
        const isSolved = right === all.length;
        board.show(all);
        const fault = ran.fault ?? all.find((one) => one.wrong?.given.fault)?.wrong?.given.fault ?? null;
        editor.mark(fault?.line ?? null);
        const words = ran.fault
            ? faultWords(ran.fault)
            : isSolved
              ? say`Solved. All functions are right.`
              : say`${right} of ${all.length} functions are right.`;
        setText(html('result'), words);
        html('result').classList.toggle('wrong', ran.fault !== null);
        html('result').classList.toggle('solved', isSolved);
        if (words !== shown) announce(words);
        shown = words;
        setText(html('printed'), ran.printed.slice(0, 2000));
        html('printed').hidden = ran.printed === '';
        plants?.show(ran, count);
        const [agreement, link] = [right / all.length, await keep()];
        host.marked(/** @type {any} */ ({ isSolved, agreement, words }), link, isTouched);
    }

    /** Runs calls beside the tests. @param {import('./worker.js').Call[]} calls */
    async function time(calls) {
        hasRun = true;
        return (await runner.run(language, asked(calls))).results;
    }

    function showHints() {
        html('hints').replaceChildren(
            ...about.hints.slice(0, hints).map((hint) => make('li', {}, ...inline(said(hint)))),
        );
        html('hints').hidden = hints === 0;
        button('ask-hint').hidden = hints >= about.hints.length;
    }

    document.title = say`${said(about.title) || say`Exercise`} – L-system`;
    setText(html('exercise-title'), said(about.title) || say`Exercise`);
    html('exercise-task').replaceChildren(
        ...paragraphs(said(about.task) || say`Write the functions, and see what they draw.`),
    );
    setText(html('exercise-problems'), task.problems.join(' '));
    input('student-name').value = studentIn(location.hash);
    html('handing').hidden = has('hand=0');
    document.body.classList.toggle('framed', parent !== window);
    const languages = byId('language', HTMLSelectElement);
    languages.append(...task.languages.map((one) => make('option', { value: one }, NAMES[one])));
    languages.value = language;
    languages.disabled = task.languages.length < 2;
    languages.addEventListener('change', () => {
        language = task.languages.find((one) => one === languages.value) ?? language;
        editor.open(codes[language], language);
        setText(html('result'), '');
        void keep();
    });
    editor.open(codes[language], language);
    showHints();
    button('ask-hint').addEventListener('click', () => {
        hints += 1;
        showHints();
    });
    button('run').addEventListener('click', run);
    html('editor').addEventListener('keydown', (event) => {
        if (event.key === 'Enter' && (event.ctrlKey || event.metaKey)) void run();
    });
    button('hand-in').addEventListener('click', async () => {
        const address = addressOf(await keep());
        const isLong =
            address.length > LONG
                ? ` ${say`It is long (${address.length} characters): some platforms cut it. Hand in the program as a file beside it.`}`
                : '';
        const isCopied = await copyText(address);
        setText(
            html('handed'),
            `${isCopied ? say`Your answer is copied as a link. Paste it where you hand it in.` : say`Press ${copyKeys()} to copy the link.`}${isLong}`,
        );
        if (isCopied) return;
        const field = input('answer-link');
        [field.hidden, field.value] = [false, address];
        field.select();
    });
    button('print').addEventListener('click', () => print());
    addEventListener('hashchange', () => location.reload());
    if (parent !== window) new ResizeObserver(() => host.needs(html('app').offsetHeight)).observe(html('app'));
    void host.ready();
}
