/** The dialog that finds the rules of a picture or a string. */

import gallery from '../../css/gallery.css';
import legend from '../../css/differences.css';
import styles from '../../css/find.css';
import { toast } from '../base/announce.js';
import { button, byId, closes, html, input, setText } from '../base/dom.js';
import { addElements } from '../base/late.js';
import { Cancelled, SILENT } from '../engine/tool.js';
import { reasonOf, say } from '../base/words.js';
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

/** @typedef {import('../state/state.js').Definition} Definition */
/** @typedef {import('../protocol.js').FindReport} FindReport */

/** A text of several formats that begins as SVG does. @param {string} text */
const isSvg = (text) => /^\s*</.test(text) && text.includes('<svg');

/** @param {unknown} error */
const sentence = (error) => {
    const words = reasonOf(error);
    if (words === SILENT) return say`The search has stopped, because it did not answer. Try again.`;
    return `${words.charAt(0).toUpperCase()}${words.slice(1)}${/[.!?]$/.test(words) ? '' : '.'}`;
};

/**
 * The dialog and its search.
 * @typedef {object} Finding
 * @property {import('../dialogs/dialogs.js').Page['engine']} engine
 * @property {import('../dialogs/dialogs.js').Page['restyle']} restyle
 * @property {HTMLDialogElement} dialog
 * @property {HTMLTextAreaElement} text
 * @property {HTMLInputElement} file
 * @property {ReturnType<typeof createSearch>} search
 * @property {ReturnType<typeof createPreview>} preview
 * @property {ReturnType<typeof createResults>} results
 * @property {AbortController | null} running Stops the running search
 * @property {FindReport | null} report What was found so far
 * @property {{picture: import('./ink.js').Grey | null, straight: import('./ink.js').Grey | null}} taken The picture that was taken, and what it shows if it is a photograph
 * @property {string} title The title of what is opened
 * @property {number} turn The newest picture that is being read
 * @property {boolean} hasExamples
 */

/** @param {import('../dialogs/dialogs.js').Page} page */
export function createFinding({ store, engine, restyle }) {
    addElements(markup, [gallery, styles, legend]);

    const search = createSearch();
    const preview = createPreview({ changed: () => invalidate(self) });
    const results = createResults({
        engine,
        restyle,
        compared: search.compared,
        open({ definition }) {
            stop(self);
            self.dialog.close();
            store.open(restyle({ ...definition, title: self.title && `Rules of ${self.title}` }));
            toast(say`Opened. Undo to go back; “Rules from a picture” has the other systems.`);
        },
    });
    /** @type {Finding} */
    const self = {
        engine,
        restyle,
        dialog: byId('find', HTMLDialogElement),
        text: byId('find-string', HTMLTextAreaElement),
        file: input('find-file'),
        search,
        preview,
        results,
        running: null,
        report: null,
        taken: { picture: null, straight: null },
        title: '',
        turn: 0,
        hasExamples: false,
    };

    byId('find-form', HTMLFormElement).addEventListener('submit', (event) => {
        event.preventDefault();
        start(self);
    });
    byId('find-form', HTMLFormElement).addEventListener('input', (event) => {
        // The preview tells its own changes.
        if (event.target instanceof HTMLElement && event.target.closest('.find-known, #find-text')) invalidate(self);
    });
    for (const kind of ['picture', 'string']) {
        input(`find-of-${kind}`).addEventListener('change', () => {
            invalidate(self);
            showSource(self);
        });
    }
    input('find-straight').addEventListener('change', () => straighten(self));

    button('find-stop').addEventListener('click', () => stopAndFocus(self));

    button('find-longer').addEventListener(
        'click',
        () => void run(self, (signal) => search.longer(signal, (next) => progress(self, next))),
    );
    for (const id of ['find-choose', 'find-other']) button(id).addEventListener('click', () => self.file.click());
    button('find-back').addEventListener('click', () => goBack(self));

    self.file.addEventListener('change', () => takeChosen(self));

    self.dialog.addEventListener('dragover', (event) => event.preventDefault());
    self.dialog.addEventListener('drop', (event) => takeDropped(self, event));

    document.addEventListener('paste', (event) => takePasted(self, event));

    closes(self.dialog, 'close-find');
    self.dialog.addEventListener('close', () => stop(self));

    return {
        /** Opens the dialog, with a picture if there is one. @param {File} [picture] */
        open(picture) {
            showSource(self);
            self.dialog.showModal();
            preview.repaint();
            if (picture) void take(self, picture);
            else if (preview.shown === null && !isString()) button('find-choose').focus();
        },
    };
}

const isString = () => input('find-of-string').checked;

/** @param {Finding} self */
function showSource(self) {
    const has = self.preview.shown !== null;
    html('find-text').hidden = !isString();
    html('find-empty').hidden = isString() || has;
    html('find-picture').hidden = isString() || !has;
    button('find-start').disabled = !isString() && !has;
    if (isString() || has || self.hasExamples) return;
    self.hasExamples = true;
    fillExamples(html('find-examples'), self.engine, {
        restyle: self.restyle,
        choose: (definition) => tryExample(self, definition),
    }).catch(() => (self.hasExamples = false));
}

/** What was found is no longer about what is shown. @param {Finding} self */
function invalidate(self) {
    stop(self);
    self.report = null;
    self.results.clear();
    problem('');
    html('find-results').hidden = true;
    showActs(self);
}

/** @param {Finding} self */
function showActs(self) {
    button('find-start').hidden = self.running !== null;
    button('find-stop').hidden = self.running === null;
    button('find-longer').hidden = self.running !== null || !self.report?.isMore;
    html('find-busy').hidden = self.running === null;
}

/** @param {string} words */
const problem = (words) => setText(html('find-problem'), words);

/** @param {Finding} self @param {FindReport} next */
function progress(self, next) {
    self.report = next;
    const section = html('find-results');
    const isNew = section.hidden;
    section.hidden = false;
    self.results.show(next, { isString: isString(), isRunning: self.running !== null });
    setText(html('find-work'), workWords(next, isString()));
    // On a phone the results stand below the fields.
    if (isNew) {
        const copy = byId('find-searched-picture', HTMLCanvasElement);
        copy.hidden = isString();
        self.preview.copyTo(copy);
        section.scrollIntoView({ block: 'start' });
    }
}

/**
 * Runs a search, or goes on with one.
 * @param {Finding} self
 * @param {(signal: AbortSignal) => Promise<FindReport>} work
 */
async function run(self, work) {
    stop(self);
    problem('');
    const own = (self.running = new AbortController());
    showActs(self);
    button('find-stop').focus();
    try {
        const last = await work(own.signal);
        if (self.running !== own) return;
        self.running = null;
        progress(self, last);
    } catch (error) {
        if (self.running !== own) return;
        self.running = null;
        // What was found stays; the search cannot go on.
        if (self.report) progress(self, (self.report = { ...self.report, isMore: false }));
        if (!(error instanceof Cancelled) && !self.report?.candidates.length) problem(sentence(error));
    }
    showActs(self);
    if (document.activeElement === document.body) button(self.report?.isMore ? 'find-longer' : 'find-start').focus();
}

/** @param {Finding} self */
function stop(self) {
    if (!self.running) return;
    self.running.abort();
    self.running = null;
    if (self.report) progress(self, self.report);
    showActs(self);
}

/** @param {Finding} self */
function start(self) {
    invalidate(self);
    const { shown } = self.preview;
    try {
        const question = readQuestion();
        if (isString()) {
            if (self.text.value.trim() === '') throw new Error(say`Type or paste a string.`);
            self.title = '';
            return void run(self, (signal) =>
                self.search.begin({ text: self.text.value }, question, signal, (next) => progress(self, next)),
            );
        }
        if (!shown) throw new Error(say`Open a picture first.`);
        if (inkShare(shown.picture, shown.choice) === 0) throw new Error(say`Nothing is ink here. Move the threshold.`);
        const isStraight = shown.picture === self.taken.straight;
        const source = { ...inked(shown.picture, shown.choice), isStraight };
        void run(self, async (signal) =>
            self.search.begin(source, question, signal, (next) => progress(self, next), {
                named: await namedSystems(),
            }),
        );
    } catch (error) {
        problem(sentence(error));
    }
}

/**
 * @param {Finding} self
 * @param {import('./ink.js').Grey | null} picture
 * @param {string} name
 * @param {import('./ink.js').Grey | null} [straight] what it shows, if it is a photograph
 */
function setPicture(self, picture, name, straight = null) {
    self.title = name;
    self.taken = { picture, straight };
    html('find-photograph').hidden = straight === null;
    input('find-straight').checked = straight !== null;
    setText(html('find-left-out'), '');
    input('find-of-picture').checked = true;
    self.preview.set(straight ?? picture);
    invalidate(self);
    showSource(self);
}

/** @param {Finding} self @param {File} picture */
async function take(self, picture) {
    const own = ++self.turn;
    stop(self);
    try {
        const grey = await readPicture(picture, self.search.drawSvg);
        const straight = await self.search.straightened(grey);
        if (own !== self.turn) return;
        setPicture(self, grey, picture.name.replace(/\.\w+$/, ''), straight);
        setText(html('find-left-out'), grey.leftOut && say`Left out of this SVG: ${grey.leftOut}.`);
    } catch (error) {
        if (own === self.turn) problem(sentence(error));
    }
}

/** @param {Finding} self @param {Definition} definition */
async function tryExample(self, definition) {
    const own = ++self.turn;
    try {
        const grey = await pictureOf(self.engine, definition);
        if (own !== self.turn) return;
        setPicture(self, grey, definition.title || definition.name);
        showQuestion({ axiom: definition.axiom, angle: definition.angle, n: definition.iterations });
        start(self);
    } catch (error) {
        problem(sentence(error));
    }
}

/** @param {Finding} self */
function straighten(self) {
    self.preview.set(input('find-straight').checked ? self.taken.straight : self.taken.picture);
    invalidate(self);
}

/** @param {Finding} self */
function stopAndFocus(self) {
    stop(self);
    button(self.report?.isMore ? 'find-longer' : 'find-start').focus();
}

/** @param {Finding} self */
function goBack(self) {
    setPicture(self, null, '');
    button('find-choose').focus();
}

/** @param {Finding} self */
function takeChosen(self) {
    const [chosen] = self.file.files ?? [];
    self.file.value = '';
    if (chosen) void take(self, chosen);
}

/** @param {Finding} self @param {DragEvent} event */
function takeDropped(self, event) {
    event.preventDefault();
    event.stopPropagation();
    const [dropped] = event.dataTransfer?.files ?? [];
    if (dropped) void take(self, dropped);
}

/** @param {Finding} self @param {ClipboardEvent} event */
function takePasted(self, event) {
    if (!self.dialog.open) return;
    const pasted = event.clipboardData?.getData('text/plain') ?? '';
    const drawing = !isString() && isSvg(pasted) ? new File([pasted], 'Pasted.svg') : null;
    const picture = drawing ?? (pasted ? null : pictureIn(event.clipboardData));
    if (!picture) return;
    event.preventDefault();
    void take(self, picture);
}
