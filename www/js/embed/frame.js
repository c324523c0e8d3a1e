/** The frame of an embedded drawing: the drawing in the address, with its controls, or the student's of an exercise. */

import { toast } from '../base/announce.js';
import { createReporter, showLast } from '../view/caption.js';
import { button, html, input, setText, setWords } from '../base/dom.js';
import { createDials } from './dials.js';
import { connectHost } from './messages.js';
import { readOptions } from './options.js';
import { surroundingTheme, systemIsDark } from './scheme.js';
import { watchVisibility } from './visibility.js';
import { createEngine } from '../engine/engine.js';
import { isDark } from '../state/colour-schemes.js';
import { exerciseIn } from '../exercise/open.js';
import { writeLink } from '../state/link.js';
import { createMarks } from '../view/marks.js';
import { followNotation } from '../controls/notation.js';
import { bestLink, openLink } from '../state/packed.js';
import { constantsPanel } from '../panels/constants-panel.js';
import { rulesPanel } from '../panels/rules-panel.js';
import { symbolsFields } from '../panels/symbols-fields.js';
import { showPrintText } from '../view/print-text.js';
import { createReadings } from '../view/readings.js';
import { createStage } from '../view/stage.js';
import { DEFAULTS, clean, definitionOf, sameSystem } from '../state/state.js';
import { createStore } from '../state/store.js';
import { QUESTION, createTrouble } from '../view/trouble.js';
import { counted, said, say } from '../base/words.js';

/** @typedef {import('../state/state.js').State} State */
/** @typedef {import('../protocol.js').Report} Report */
/** @typedef {import('../protocol.js').Diagnostic} Diagnostic */
/** @typedef {import('./options.js').Control} Control */

/**
 * What an exercise says of the drawing, which is the student's.
 * @typedef {object} Task
 * @property {Readonly<State>} start
 * @property {(state: Readonly<State>) => import('../state/state.js').Definition} whole the system that is drawn
 * @property {Control[]} controls
 * @property {boolean} asksForSymbols whether the student says what the symbols mean
 * @property {boolean} asksForText whether the string counts, and not the drawing
 */

const NOTHING = say`The address of this frame contains no drawing.`;

/**
 * The page and the drawing in it.
 * @typedef {object} Frame
 * @property {Task | null} task
 * @property {boolean} hasSteps
 * @property {ReturnType<typeof readOptions>} options
 * @property {ReturnType<typeof createStore>} store
 * @property {Control[]} controls
 * @property {{description: string, symbols: string | null, segments: string | null}} facts The last facts about the drawing, for the host page
 * @property {ReturnType<typeof begin> | null} parts The parts that draw, created when the drawing first becomes visible
 * @property {boolean} seen
 * @property {boolean} stale Whether the system has changed while the drawing was not visible
 * @property {boolean} blank Whether the address contains no system
 * @property {ReturnType<typeof rulesPanel>} rules
 * @property {ReturnType<typeof constantsPanel>} constants
 * @property {ReturnType<typeof createDials>} dials
 * @property {ReturnType<typeof symbolsFields> | null} symbols What the symbols mean, where an exercise asks for that
 * @property {ReturnType<typeof connectHost>} host
 */

/**
 * @param {object} given
 * @param {import('../state/link.js').Link | null} given.link in the address
 * @param {Task | null} [given.task]
 * @param {string} [given.refusal] why the exercise cannot be opened
 * @param {boolean} [given.hasSteps] whether this page has the steps of the drawing's making
 */
export function createFrame({ link, task = null, refusal = '', hasSteps = false }) {
    const options = readOptions(location.hash);
    const store = createStore(task?.start ?? link?.state ?? DEFAULTS);

    const rules = rulesPanel(store);
    const constants = constantsPanel(store, rules);
    const dials = createDials(store);
    const symbols = task?.asksForSymbols ? symbolsFields(store) : null;
    const host = connectHost(store, {
        host: options.host,
        offer: (asked) => offer(self, asked),
        theme: (theme) => setTheme(self, theme),
        play: (on) => self.parts?.playback.setPlaying(on),
        facts: () => self.facts,
    });
    /** @type {Frame} */
    const self = {
        task,
        hasSteps,
        options,
        store,
        controls: task?.controls ?? options.controls,
        facts: { description: '', symbols: null, segments: null },
        parts: null,
        seen: false,
        stale: false,
        blank: link === null || refusal !== '',
        rules,
        constants,
        dials,
        symbols,
        host,
    };

    showTheme(self);
    offer(self, self.controls);
    store.subscribe((state, before) => show(self, state, before));
    show(self, store.state, null);
    if (!link || refusal !== '') {
        showProblem(refusal || NOTHING);
        host.error(refusal || NOTHING);
    } else if (link.problems.length > 0) {
        toast(link.problems.slice(0, 3).join(' '));
        host.error(link.problems.join(' '));
    }

    listen(self);
    return { store, host, drawn: (/** @type {Readonly<State>} */ state) => drawnOf(self, state) };
}

/** @param {Frame} self */
function listen(self) {
    watchVisibility(html('stage'), (now) => {
        self.seen = now;
        if (self.seen) draw(self);
        else self.parts?.playback.setPlaying(false);
    });
    // Printing also shows drawings that are scrolled out of view.
    addEventListener('beforeprint', () => draw(self));
    systemIsDark().addEventListener('change', () => showTheme(self));
    const isExercise = exerciseIn(location.hash) !== null;
    addEventListener('hashchange', async () => {
        // Another exercise is another page.
        if (isExercise || exerciseIn(location.hash) !== null) return location.reload();
        self.options = readOptions(location.hash);
        showTheme(self);
        offer(self, self.options.controls);
        const opened = await openLink(location.hash);
        if (opened) self.store.open(opened.state);
        else showProblem(NOTHING);
    });

    button('reset').addEventListener('click', self.store.reset);
    html('drawing').addEventListener('keydown', (event) => {
        // Without focus, keys and wheel belong to the host page again.
        if (event.key === 'Escape') html('drawing').blur();
    });
    // A package has no playground beside it.
    html('open').hidden = /(^|[#&])away=0(&|$)/.test(location.hash);
    html('open').addEventListener('click', openPlayground);
    button('away-close').addEventListener('click', () => {
        html('away').hidden = true;
        html('open').focus();
    });
}

/** The system that is drawn. @param {Frame} self @param {Readonly<State>} state */
const drawnOf = (self, state) => (self.task ? self.task.whole(state) : definitionOf(state));

/** Starts drawing, or draws a changed system. @param {Frame} self */
function draw(self) {
    if (self.blank) return;
    if (!self.parts) self.parts = begin(self);
    else if (self.stale) self.parts.engine.define(drawnOf(self, self.store.state));
    self.stale = false;
}

/** @param {Frame} self */
function begin(self) {
    const marks = createMarks();
    let ready = false;
    const engine = createEngine({
        report: (next, past) => report(next, past),
        drawn(picture) {
            stage.drawn(picture);
            readings.drawn(picture);
            if (!ready) self.host.ready();
            ready = true;
        },
        busy: (under) => html('stage').setAttribute('aria-busy', String(under)),
        troubled({ how, question }) {
            if (question) return toast(QUESTION);
            stage.setBusy(false);
            const words = trouble.show(how, engine.good.definition !== null);
            // Loading is retried automatically, so the host need not know.
            if (how !== 'loading') self.host.error(words);
        },
        recovered: () => trouble.hide(),
    });
    const trouble = createTrouble({
        back() {
            if (self.task) return void (self.store.undo() || self.store.reset());
            const { definition } = engine.good;
            if (definition && !sameSystem(clean(definition), self.store.state))
                self.store.change({ ...definition, view: null }, '');
            else self.store.setView(null);
        },
        again() {
            engine.define(drawnOf(self, self.store.state));
            stage.show(self.store.state, null);
        },
    });
    engine.define(drawnOf(self, self.store.state));
    followNotation(self.store, engine, [self.rules, self.constants, ...(self.symbols ? [self.symbols] : [])]);
    const canvas = html('drawing');
    const stage = createStage(self.store, engine, marks, {
        // Until the drawing has the focus, wheel and touch scroll the host page.
        takes: (event) =>
            (event instanceof PointerEvent && event.pointerType === 'mouse') ||
            (document.hasFocus() && document.activeElement === canvas),
        keys: () => [
            ...(self.controls.includes('angle') ? /** @type {const} */ (['angle']) : []),
            ...(self.controls.includes('n') ? /** @type {const} */ (['iterations']) : []),
        ],
    });
    const readings = createReadings(engine, stage, marks, (control) => self.controls.includes(control));
    const { playback, legend, reader } = readings;
    const report = createReporter({
        store: self.store,
        untitled: say`L-system`,
        stage,
        drawn: [stage, reader, playback],
        edited: [
            legend,
            { report: (report) => listProblems(self, report) },
            self.dials,
            ...(self.symbols ? [self.symbols] : []),
        ],
        mistaken: (first, all) => mistaken(self, first, all),
        valid: (given) => valid(self, given),
    });
    stage.show(self.store.state, null);
    readings.show(self.store.state, null);
    return { engine, stage, playback, reader, readings, drawn: () => ready };
}

/** Shows only these controls. @param {Frame} self @param {Control[]} asked */
function offer(self, asked) {
    self.controls = asked;
    self.dials.offer(self.controls);
    const has = (/** @type {Control} */ control) => self.controls.includes(control);
    html('writing').hidden = !has('rules');
    html('constants-row').hidden = !has('rules');
    if (self.symbols) html('meaning').hidden = false;
    html('panel').hidden = !(has('n') || has('angle') || has('rules'));
    button('open-reader').hidden = !has('string');
    button('open-playback').hidden = !has('play');
    button('open-steps').hidden = !has('steps') || !self.hasSteps;
    if (!has('string')) self.parts?.reader.close();
    if (!has('play')) self.parts?.playback.close();
    button('reset').hidden = html('panel').hidden;
    document.body.classList.toggle('with-rules', has('rules'));
    setText(
        html('keys'),
        [
            has('angle') && say`Left and right arrows change the angle.`,
            has('n') && say`Up and down arrows change the iterations.`,
            say`Shift and arrows move the picture, plus and minus zoom, zero fits the picture.`,
            has('play') && say`Space plays the drawing.`,
            say`Escape leaves the drawing.`,
        ]
            .filter(Boolean)
            .join(' '),
    );
}

/** @param {Frame} self @param {Readonly<State>} state @param {Readonly<State> | null} before */
function show(self, state, before) {
    self.rules.show(state);
    self.dials.show(state);
    self.symbols?.show(state);
    self.parts?.stage.show(state, before);
    if (before && !sameSystem(state, before)) {
        self.stale = true;
        self.blank = false;
        if (self.seen) draw(self);
    }
    self.parts?.readings.show(state, before);
    const title = said(state.title) || state.name;
    document.title = title ? say`${title} – L-system` : say`L-system`;
    setText(html('caption-title'), self.task ? say`Yours` : title);
    button('reset').disabled = !self.store.canReset;
    html('stage').classList.toggle('on-dark', isDark(state.background));
    for (const id of self.task ? ['stage', 'target'] : ['stage'])
        html(id).style.setProperty('--sheet', state.background);
    showPrintText(state, before);
    address(self);
}

/**
 * Lists the problems of the student's own rules below them; places behind these rules are in those that are given.
 * @param {Frame} self
 * @param {Report} report
 */
function listProblems(self, report) {
    const own = (/** @type {Diagnostic} */ { field, end }) => field !== 'rules' || end <= self.store.state.rules.length;
    self.rules.report(self.task ? { ...report, diagnostics: report.diagnostics.filter(own) } : report);
}

/** @param {Frame} self @param {Diagnostic} first @param {Diagnostic[]} all */
function mistaken(self, first, all) {
    const listed = self.controls.includes('rules') && ['axiom', 'rules'].includes(first.field);
    const placed = withPlace(first);
    const sentence =
        all.length > 1 ? counted(all.length - 1, '{1}, and {} more.', '{1}, and {} more.', placed) : `${placed}.`;
    const words = [sentence, first.hint].filter(Boolean).join(' ');
    // If the rules are shown, their problems are listed below them.
    showProblem(listed ? '' : words);
    if (self.parts?.drawn()) showLast();
    self.host.error(first.message, all);
    return words;
}

/** A message with the field that it is about. @param {Diagnostic} diagnostic */
function withPlace({ message, field }) {
    switch (field) {
        case 'axiom':
            return say`${message} (in the axiom)`;
        case 'rules':
            return say`${message} (in the rules)`;
        case 'overrides':
            return say`${message} (in the overrides)`;
        case 'file':
            return say`${message} (in the file)`;
        default:
            return message;
    }
}

/** @param {Frame} self @param {Report} report */
function valid(self, { description, symbols, segments, empty }) {
    showProblem('');
    self.facts = { description, symbols, segments };
    // Where an exercise asks for the string, it need not draw.
    return empty !== null && self.task?.asksForText ? say`Nothing is drawn. Here the string counts.` : empty;
}

/** @param {Frame} self */
function showTheme(self) {
    document.documentElement.dataset.theme = self.options.theme ?? surroundingTheme();
}

/** @param {Frame} self @param {'light' | 'dark' | null} theme null for none */
function setTheme(self, theme) {
    self.options = { ...self.options, theme };
    showTheme(self);
}

/** Shows a problem on the drawing, or hides the last one if empty. @param {string} words */
function showProblem(words) {
    setWords(html('mistake'), words);
    html('mistake').hidden = words === '';
}

/** Links to the playground with the current state. @param {Frame} self */
async function address(self) {
    if (html('open').hidden || !URL.canParse('./', location.href)) return;
    // Without a server, a folder address does not open its page.
    const place = new URL(location.protocol === 'file:' ? 'playground.html' : './', location.href);
    const state = self.store.state;
    html('open').setAttribute('href', new URL(writeLink(state), place).href);
    const best = await bestLink(state);
    if (state === self.store.state) html('open').setAttribute('href', new URL(best, place).href);
}

/** @param {MouseEvent} event */
function openPlayground(event) {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    const href = String(html('open').getAttribute('href'));
    const opened = open(href, '_blank');
    if (opened) {
        opened.opener = null;
        return;
    }
    // A sandbox without popups: show the address, for another window.
    html('away').hidden = false;
    const field = input('away-address');
    field.value = href;
    field.focus();
    field.select();
}
