/** The dialog that finds the rules of a picture or a string. */

import gallery from '../../css/gallery.css';
import legend from '../../css/differences.css';
import styles from '../../css/find.css';
import { toast } from '../announce.js';
import { button, byId, closes, html, input, setText } from '../dom.js';
import { addElements } from '../late.js';
import { Cancelled, SILENT } from '../tool.js';
import { say } from '../words.js';
import { fillExamples, pictureOf } from './examples.js';
import { pictureIn } from './files.js';
import markup from './finding.html';
import { inkShare, inked } from './ink.js';
import { namedSystems } from './named.js';
import { readPicture } from './picture.js';
import { createPreview } from './preview.js';
import { readQuestion, showQuestion } from './question.js';
import { createResults, workWords } from './results.js';
import { createSearch } from './search.js';

/** @typedef {import('../state.js').Definition} Definition */
/** @typedef {import('../protocol.js').FindReport} FindReport */

/** A text of several formats that begins as SVG does. @param {string} text */
const isSvg = (text) => /^\s*</.test(text) && text.includes('<svg');

/** @param {unknown} error */
const sentence = (error) => {
    const words = String(error instanceof Error ? error.message : error);
    if (words === SILENT) return say`The search has stopped, because it did not answer. Try again.`;
    return `${words.charAt(0).toUpperCase()}${words.slice(1)}${/[.!?]$/.test(words) ? '' : '.'}`;
};

/** @param {import('../dialogs.js').Page} page */
export function createFinding({ store, engine, restyle }) {
    addElements(markup, [gallery, styles, legend]);
    const dialog = byId('find', HTMLDialogElement);
    const text = byId('find-string', HTMLTextAreaElement);
    const file = input('find-file');
    const search = createSearch();
    const preview = createPreview({ changed: invalidate });
    const results = createResults({
        engine,
        restyle,
        compared: search.compared,
        open({ definition }) {
            stop();
            dialog.close();
            store.open(restyle({ ...definition, title: title && `Rules of ${title}` }));
            toast(say`Opened. Undo to go back; “Rules from a picture” has the other systems.`);
        },
    });
    /** Stops the running search. @type {AbortController | null} */
    let running = null;
    /** What was found so far. @type {FindReport | null} */
    let report = null;
    /** The picture that was taken, and what it shows if it is a photograph. @type {{picture: import('./ink.js').Grey | null, straight: import('./ink.js').Grey | null}} */
    let taken = { picture: null, straight: null };
    /** The title of what is opened. */
    let title = '';
    /** The newest picture that is being read. */
    let turn = 0;
    let hasExamples = false;

    const isString = () => input('find-of-string').checked;

    function showSource() {
        const has = preview.shown !== null;
        html('find-text').hidden = !isString();
        html('find-empty').hidden = isString() || has;
        html('find-picture').hidden = isString() || !has;
        button('find-start').disabled = !isString() && !has;
        if (isString() || has || hasExamples) return;
        hasExamples = true;
        fillExamples(html('find-examples'), engine, { restyle, choose: tryExample }).catch(() => (hasExamples = false));
    }

    /** What was found is no longer about what is shown. */
    function invalidate() {
        stop();
        report = null;
        results.clear();
        problem('');
        html('find-results').hidden = true;
        showActs();
    }

    function showActs() {
        button('find-start').hidden = running !== null;
        button('find-stop').hidden = running === null;
        button('find-longer').hidden = running !== null || !report?.isMore;
        html('find-busy').hidden = running === null;
    }

    /** @param {string} words */
    const problem = (words) => setText(html('find-problem'), words);

    /** @param {FindReport} next */
    function progress(next) {
        report = next;
        const section = html('find-results');
        const isNew = section.hidden;
        section.hidden = false;
        results.show(next, { isString: isString(), isRunning: running !== null });
        setText(html('find-work'), workWords(next, isString()));
        // On a phone the results stand below the fields.
        if (isNew) {
            const copy = byId('find-searched-picture', HTMLCanvasElement);
            copy.hidden = isString();
            preview.copyTo(copy);
            section.scrollIntoView({ block: 'start' });
        }
    }

    /** Runs a search, or goes on with one. @param {(signal: AbortSignal) => Promise<FindReport>} work */
    async function run(work) {
        stop();
        problem('');
        const own = (running = new AbortController());
        showActs();
        button('find-stop').focus();
        try {
            const last = await work(own.signal);
            if (running !== own) return;
            running = null;
            progress(last);
        } catch (error) {
            if (running !== own) return;
            running = null;
            // What was found stays; the search cannot go on.
            if (report) progress((report = { ...report, isMore: false }));
            if (!(error instanceof Cancelled) && !report?.candidates.some(({ isFound }) => isFound))
                problem(sentence(error));
        }
        showActs();
        if (document.activeElement === document.body) button(report?.isMore ? 'find-longer' : 'find-start').focus();
    }

    function stop() {
        if (!running) return;
        running.abort();
        running = null;
        if (report) progress(report);
        showActs();
    }

    function start() {
        invalidate();
        const { shown } = preview;
        try {
            const question = readQuestion();
            if (isString()) {
                if (text.value.trim() === '') throw new Error(say`Type or paste a string.`);
                title = '';
                return void run((signal) => search.begin({ text: text.value }, question, signal, progress));
            }
            if (!shown) throw new Error(say`Open a picture first.`);
            if (inkShare(shown.picture, shown.choice) === 0)
                throw new Error(say`Nothing is ink here. Move the threshold.`);
            const isStraight = shown.picture === taken.straight;
            const source = { ...inked(shown.picture, shown.choice), isStraight };
            void run(async (signal) =>
                search.begin(source, question, signal, progress, { named: await namedSystems() }),
            );
        } catch (error) {
            problem(sentence(error));
        }
    }

    /**
     * @param {import('./ink.js').Grey | null} picture
     * @param {string} name
     * @param {import('./ink.js').Grey | null} [straight] what it shows, if it is a photograph
     */
    function setPicture(picture, name, straight = null) {
        title = name;
        taken = { picture, straight };
        html('find-photograph').hidden = straight === null;
        input('find-straight').checked = straight !== null;
        setText(html('find-left-out'), '');
        input('find-of-picture').checked = true;
        preview.set(straight ?? picture);
        invalidate();
        showSource();
    }

    /** @param {File} picture */
    async function take(picture) {
        const own = ++turn;
        stop();
        try {
            const grey = await readPicture(picture, search.drawSvg);
            const straight = await search.straightened(grey);
            if (own !== turn) return;
            setPicture(grey, picture.name.replace(/\.\w+$/, ''), straight);
            setText(html('find-left-out'), grey.leftOut && say`Left out of this SVG: ${grey.leftOut}.`);
        } catch (error) {
            if (own === turn) problem(sentence(error));
        }
    }

    /** @param {Definition} definition */
    async function tryExample(definition) {
        const own = ++turn;
        try {
            const grey = await pictureOf(engine, definition);
            if (own !== turn) return;
            setPicture(grey, definition.title || definition.name);
            showQuestion({ axiom: definition.axiom, angle: definition.angle, n: definition.iterations });
            start();
        } catch (error) {
            problem(sentence(error));
        }
    }

    byId('find-form', HTMLFormElement).addEventListener('submit', (event) => {
        event.preventDefault();
        start();
    });
    byId('find-form', HTMLFormElement).addEventListener('input', (event) => {
        // The preview tells its own changes.
        if (event.target instanceof HTMLElement && event.target.closest('.find-known, #find-text')) invalidate();
    });
    for (const kind of ['picture', 'string']) {
        input(`find-of-${kind}`).addEventListener('change', () => {
            invalidate();
            showSource();
        });
    }
    input('find-straight').addEventListener('change', () => {
        preview.set(input('find-straight').checked ? taken.straight : taken.picture);
        invalidate();
    });
    button('find-stop').addEventListener('click', () => {
        stop();
        button(report?.isMore ? 'find-longer' : 'find-start').focus();
    });
    button('find-longer').addEventListener('click', () => void run((signal) => search.longer(signal, progress)));
    for (const id of ['find-choose', 'find-other']) button(id).addEventListener('click', () => file.click());
    button('find-back').addEventListener('click', () => {
        setPicture(null, '');
        button('find-choose').focus();
    });
    file.addEventListener('change', () => {
        const [chosen] = file.files ?? [];
        file.value = '';
        if (chosen) void take(chosen);
    });
    dialog.addEventListener('dragover', (event) => event.preventDefault());
    dialog.addEventListener('drop', (event) => {
        event.preventDefault();
        event.stopPropagation();
        const [dropped] = event.dataTransfer?.files ?? [];
        if (dropped) void take(dropped);
    });
    document.addEventListener('paste', (event) => {
        if (!dialog.open) return;
        const pasted = event.clipboardData?.getData('text/plain') ?? '';
        const drawing = !isString() && isSvg(pasted) ? new File([pasted], 'Pasted.svg') : null;
        const picture = drawing ?? (pasted ? null : pictureIn(event.clipboardData));
        if (!picture) return;
        event.preventDefault();
        void take(picture);
    });
    closes(dialog, 'close-find');
    dialog.addEventListener('close', stop);

    return {
        /** Opens the dialog, with a picture if there is one. @param {File} [picture] */
        open(picture) {
            showSource();
            dialog.showModal();
            preview.repaint();
            if (picture) void take(picture);
            else if (preview.shown === null && !isString()) button('find-choose').focus();
        },
    };
}
