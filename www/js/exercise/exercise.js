/** An exercise on the embedded page: the task, the target, the mark of the own drawing, hints, and handing in. */

import { addressOf } from '../base/files.js';
import { announce, toast } from '../base/announce.js';
import { isDark } from '../state/colour-schemes.js';
import { copyKeys, copyText } from '../base/copy.js';
import { button, byId, html, input, make, setText } from '../base/dom.js';
import { DEFAULTS, clean, definitionOf, sameSystem } from '../state/state.js';
import { ASKS } from '../late-tables.js';
import { DIALECTS } from '../tables.js';
import { Cancelled, createTool } from '../engine/tool.js';
import { counted, reasonOf, said, say } from '../base/words.js';
import { answerLink, exerciseIn, startOf, studentIn, wholeOf } from './open.js';
import { createTarget } from './target.js';
import { inline, paragraphs } from './words.js';

/** @typedef {import('../state/state.js').State} State */
/** @typedef {import('../protocol.js').Mark} Mark */

/** A mark waits for a pause in typing of this length, in milliseconds. */
const PAUSE = 120;

/**
 * Opens the exercise in a hash; null if there is none. Throws if it cannot be opened.
 * @param {string} hash
 * @param {Readonly<State> | undefined} link the state in the hash
 */
export async function openExercise(hash, link) {
    const text = exerciseIn(hash);
    if (text === null) return null;
    /** @type {ReturnType<typeof createTool<import('../protocol.js').CourseCalls>>} */
    const tool = createTool('course');
    const all = await tool.call('open', { text });
    const student = studentIn(hash);
    const own = all.variants > 0 && student !== '' ? await tool.call('variantOf', { text, student }) : null;
    const about = own ? { ...(await tool.call('open', { text: own.text })), variants: all.variants } : all;
    return {
        text,
        /** The student's own variant, as `text`. */
        own: own?.text ?? text,
        variant: own?.variant ?? 1,
        about,
        tool,
        start: startOf(about, link),
        whole: (/** @type {Readonly<State>} */ state) => wholeOf(about, state),
    };
}

/** Pictures that agree less than this are never the same. */
const NEARLY = 0.98;

/** The number of errors of an answer that are told. */
const MOST_ERRORS = 1;

/**
 * An exercise on the page.
 * @typedef {object} Visit
 * @property {import('../state/store.js').Store} store
 * @property {NonNullable<Awaited<ReturnType<typeof openExercise>>>['text']} text
 * @property {NonNullable<Awaited<ReturnType<typeof openExercise>>>['own']} variantText
 * @property {NonNullable<Awaited<ReturnType<typeof openExercise>>>['about']} about
 * @property {NonNullable<Awaited<ReturnType<typeof openExercise>>>['tool']} tool
 * @property {(mark: Mark, link: string, isTouched: boolean) => void} marked
 * @property {HTMLInputElement} name
 * @property {ReturnType<typeof createTarget>} target
 * @property {AbortController} marking Stops the mark in the making
 * @property {number} timer
 * @property {boolean} solved
 * @property {boolean} isTouched Whether the student has changed anything in this visit
 * @property {number} hints
 */

/**
 * @param {import('../state/store.js').Store} store
 * @param {NonNullable<Awaited<ReturnType<typeof openExercise>>>} opened
 * @param {{marked: (mark: Mark, link: string, isTouched: boolean) => void, needs: (height: number) => void}} page
 */
export function createExercise(store, { text, own: variantText, variant, about, tool }, { marked, needs }) {
    /** @type {Visit} */
    const self = {
        store,
        text,
        variantText,
        about,
        tool,
        marked,
        name: input('student-name'),
        target: createTarget({
            picture: async (width, height, ratio) =>
                new Uint8ClampedArray((await tool.call('picture', { text: variantText, width, height, ratio })).buffer),
        }),
        marking: new AbortController(),
        timer: 0,
        solved: false,
        isTouched: false,
        hints: 0,
    };

    self.name.value = studentIn(location.hash);
    // The usual example is the answer to some exercises.
    byId('rules', HTMLTextAreaElement).placeholder = EXAMPLE;
    document.body.classList.add('exercising');
    if (about.variants > 0 && self.name.value === '') return askName(about.title);
    if (parent !== window) {
        document.body.classList.add('framed');
        // A page that gives the frame a height asks to fill it.
        if (/(^|[#&])fill=1(&|$)/.test(location.hash)) document.body.classList.add('filling');
        else new ResizeObserver(() => needs(html('app').offsetHeight)).observe(html('app'));
    }
    for (const id of ['exercise', 'target', 'mark']) html(id).hidden = false;
    setText(html('exercise-title'), said(about.title) || say`Exercise`);
    html('exercise-task').replaceChildren(...paragraphs(said(about.task || ASKS[about.asks].task)));
    showGiven(self);
    showHints(self);
    html('texts').hidden = about.text === null;
    setText(html('target-text'), about.text ?? '');
    if (about.variants > 0) {
        // The link says whose variant it is; another name would be another exercise.
        self.name.readOnly = true;
        setText(html('variant'), say`Variant ${variant} of ${about.variants + 1}, for ${self.name.value}`);
        html('variant').hidden = false;
    }
    html('handing').hidden = /(^|[#&])hand=0(&|$)/.test(location.hash);

    button('ask-hint').addEventListener('click', () => {
        self.hints += 1;
        showHints(self);
    });
    button('ask-why').addEventListener('click', async () => {
        const student = definitionOf(store.state);
        setText(html('mark-why'), say`Comparing…`);
        const words = await tool.call('hint', { text: variantText, student }).catch(() => null);
        if (sameSystem(clean(student), store.state))
            setText(
                html('mark-why'),
                words ?? say`No usual mistake explains the difference. Compare the pictures part by part.`,
            );
    });
    button('hand-in').addEventListener('click', () => handIn(self));

    button('print').addEventListener('click', () => print());
    html('mark')
        .querySelector('form')
        ?.addEventListener('submit', (event) => event.preventDefault());
    store.subscribe((state, before) => {
        self.target.setDark(isDark(state.background));
        if (sameSystem(state, before)) return;
        self.isTouched = true;
        follow(self);
        // In its own window the address keeps the answer.
        if (parent === window) history.replaceState(null, '', link(self));
    });
    self.target.setDark(isDark(store.state.background));
    void mark(self);
}

/** What the student sees and cannot change. @param {Visit} self */
function showGiven(self) {
    const values = [
        self.about.axiom === 'shown' && [say`Axiom`, self.about.fixed.axiom],
        self.about.n === 'shown' && [say`Iterations`, String(self.about.fixed.iterations)],
        self.about.angle === 'shown' && [say`Angle`, `${self.about.fixed.angle}°`],
        self.about.shownRules.trim() !== '' && [say`Rules`, self.about.shownRules],
        self.about.turtle === 'shown' &&
            self.about.fixed.dialect !== DEFAULTS.dialect && [
                say`Dialect`,
                said(DIALECTS[self.about.fixed.dialect].label),
            ],
        self.about.turtle === 'shown' &&
            self.about.fixed.overrides !== '' && [say`Symbols`, self.about.fixed.overrides],
        self.about.mostSymbols !== null && [
            say`At most`,
            counted(self.about.mostSymbols, '{} symbol in your rules', '{} symbols in your rules'),
        ],
    ];
    const shown = values.filter((value) => Array.isArray(value));
    html('given').replaceChildren(
        ...shown.flatMap(([label, value]) => [make('dt', {}, String(label)), make('dd', {}, String(value))]),
    );
    const hidden = [
        self.about.axiom === 'hidden' && say`the axiom`,
        self.about.n === 'hidden' && say`the iterations`,
        self.about.angle === 'hidden' && say`the angle`,
        self.about.turtle === 'hidden' && say`the meaning of some symbols`,
        self.about.hidesRules && say`some rules`,
    ].filter(Boolean);
    setText(html('given-hidden'), hidden.length > 0 ? say`Hidden, but in force: ${hidden.join(', ')}.` : '');
    byId('axiom', HTMLTextAreaElement)
        .closest('.field')
        ?.classList.toggle('not-asked', self.about.axiom !== 'free');
}

/** @param {Visit} self */
function showHints(self) {
    html('hints').replaceChildren(
        ...self.about.hints.slice(0, self.hints).map((hint) => make('li', {}, ...inline(said(hint)))),
    );
    html('hints').hidden = self.hints === 0;
    button('ask-hint').hidden = self.hints >= self.about.hints.length;
    setText(
        button('ask-hint'),
        self.about.hints.length > 1 ? say`Hint ${self.hints + 1} of ${self.about.hints.length}` : say`Hint`,
    );
}

/** @param {Visit} self */
const link = (self) => answerLink(self.text, self.about, self.store.state, self.name.value);

/** @param {Visit} self */
function follow(self) {
    // What was wrong with the answer before says nothing about this one.
    setText(html('mark-why'), '');
    clearTimeout(self.timer);
    self.timer = window.setTimeout(() => mark(self), PAUSE);
}

/** @param {Visit} self */
async function mark(self) {
    self.marking.abort();
    const own = (self.marking = new AbortController());
    if (self.about.asks === 'statistics') {
        // Until the mark is known, that of the answer before would look like this one's.
        setText(html('mark-percent'), '');
        setText(html('mark-words'), say`Comparing 400 seeds…`);
    }
    try {
        const { mark, pixels } = await self.tool.call(
            'mark',
            { text: self.variantText, student: definitionOf(self.store.state) },
            { signal: own.signal },
        );
        if (own !== self.marking) return;
        self.target.compare(pixels);
        show(self, mark);
    } catch (error) {
        if (error instanceof Cancelled || own !== self.marking) return;
        setText(html('mark-words'), say`The drawing could not be compared (${reasonOf(error)}).`);
    }
}

/** @param {Visit} self @param {Mark} mark */
function show(self, mark) {
    byId('mark-measure', HTMLMeterElement).value = mark.agreement;
    setText(html('mark-percent'), mark.percent);
    const words = mark.errors.length > 0 ? mark.errors.slice(0, MOST_ERRORS).join(' ') : mark.words;
    setText(html('mark-words'), mark.isSolved ? say`Solved. ${words}` : words);
    setText(
        html('mark-symbols'),
        self.about.mostSymbols === null ? '' : say`${mark.symbols} of at most ${self.about.mostSymbols} symbols`,
    );
    // Statistics that agree as far as chance allows are as good as equal ones.
    byId('mark-measure', HTMLMeterElement).high = mark.isSolved ? 0.5 : NEARLY;
    showText(self, mark.text);
    html('mark').classList.toggle('solved', mark.isSolved);
    button('ask-why').hidden = mark.isSolved || mark.errors.length > 0;
    if (mark.isSolved && !self.solved) {
        announce(say`Solved.`);
        void showAnswer(self);
    }
    self.solved ||= mark.isSolved;
    self.marked(mark, link(self), self.isTouched);
}

/**
 * Shows the answer's string, with what differs from the target marked.
 * @param {Visit} self
 * @param {string | null} text
 */
function showText(self, text) {
    if (self.about.text === null) return;
    let same = 0;
    while (same < (text ?? '').length && text?.[same] === self.about.text[same]) same += 1;
    const rest = (text ?? '').slice(same);
    html('own-text').replaceChildren((text ?? '').slice(0, same), ...(rest === '' ? [] : [make('mark', {}, rest)]));
}

/** @param {Visit} self */
async function showAnswer(self) {
    const answer = await self.tool.call('answer', { text: self.variantText }).catch(() => null);
    if (!answer) return;
    setText(html('answer-rules'), [answer.axiom, answer.rules].filter(Boolean).join('\n'));
    html('answer').hidden = false;
}

/** @param {Visit} self */
async function handIn(self) {
    const address = addressOf(link(self));
    if (await copyText(address)) return toast(say`Your answer is copied as a link. Paste it where you hand it in.`);
    const field = input('answer-link');
    field.hidden = false;
    field.value = address;
    field.select();
    toast(say`Press ${copyKeys()} to copy the link.`);
}

/** What stands in the empty field for rules. */
const EXAMPLE = 'F -> …';

/**
 * Asks for the name that decides on the variant, and opens the exercise with it.
 * @param {string} title
 */
function askName(title) {
    document.body.classList.add('asking');
    html('exercise').hidden = false;
    setText(html('exercise-title'), said(title) || say`Exercise`);
    const field = make('input', {
        id: 'variant-name',
        type: 'text',
        maxlength: '80',
        autocomplete: 'name',
        required: '',
    });
    const form = make(
        'form',
        { class: 'variant-form' },
        make('label', { for: 'variant-name' }, say`Your name or number`),
        field,
        make('button', { class: 'button primary', type: 'submit' }, say`Begin`),
        make('p', { class: 'note' }, say`Each student gets a target of their own: always the same for the same name.`),
    );
    form.addEventListener('submit', (event) => {
        event.preventDefault();
        const by = field instanceof HTMLInputElement ? field.value.trim() : '';
        if (by === '') return;
        // Other parts of the link stay, and a name that was empty goes.
        const rest = location.hash.replace(/&by=[^&]*/, '');
        history.replaceState(null, '', `${rest}&by=${encodeURIComponent(by)}`);
        location.reload();
    });
    html('exercise-task').replaceChildren(form);
    field.focus();
}
