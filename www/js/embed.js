/**
 * The embedded page: the drawing in the address, with the controls that the address asks for; or the exercise in the
 * address, on a page that has a place for it.
 */

import { toast } from './announce.js';
import { createReporter, showLast } from './caption.js';
import { button, html, input, setText, setWords } from './dom.js';
import { followKeyboard } from './controls/keyboard.js';
import { createLegend } from './controls/legend.js';
import { symbolKeys } from './controls/symbol-keys.js';
import { createDials } from './embed/dials.js';
import { connectHost } from './embed/messages.js';
import { readOptions } from './embed/options.js';
import { surroundingTheme, systemIsDark } from './embed/scheme.js';
import { watchVisibility } from './embed/visibility.js';
import { createEngine } from './engine.js';
import { createHover } from './hover.js';
import { isDark } from './colour-schemes.js';
import { createExercise, openExercise } from './exercise/exercise.js';
import { showNext } from './exercise/next.js';
import { exerciseIn } from './exercise/open.js';
import { ASKS } from './late-tables.js';
import { writeLink } from './link.js';
import { createMarks } from './marks.js';
import { followNotation } from './notation.js';
import { bestLink, openLink } from './packed.js';
import { constantsPanel } from './panels/constants-panel.js';
import { rulesPanel } from './panels/rules-panel.js';
import { symbolsFields } from './panels/symbols-fields.js';
import { createPlayback } from './playback.js';
import { createReader } from './reading/reader.js';
import { showPrintText } from './print-text.js';
import { createStage } from './stage.js';
import { createSteps } from './steps/steps.js';
import { DEFAULTS, clean, definitionOf, sameDrawing, sameSystem } from './state.js';
import { createStore } from './store.js';
import { createTool } from './tool.js';
import { QUESTION, createTrouble } from './trouble.js';
import { counted, said, say, translatePage } from './words.js';

/** @typedef {import('./state.js').State} State */
/** @typedef {import('./protocol.js').Report} Report */
/** @typedef {import('./protocol.js').Diagnostic} Diagnostic */
/** @typedef {import('./embed/options.js').Control} Control */

translatePage();

const NOTHING = say`The address of this frame contains no drawing.`;

let options = readOptions(location.hash);
showTheme();
const isExercise = exerciseIn(location.hash) !== null;
/** Whether this is the page for exercises and steps. */
const hasSteps = document.getElementById('exercise') !== null;
if ((isExercise || options.controls.includes('steps')) && !hasSteps) {
    location.replace(new URL(`exercise.html${location.hash}`, location.href));
    await new Promise(() => {});
}
const link = await openLink(location.hash);
/** Why the exercise cannot be opened; empty if it can. */
let refusal = '';
const exercise = await openExercise(location.hash, link?.state).catch((error) => {
    refusal = error instanceof Error ? say`The exercise cannot be opened: ${error.message}.` : String(error);
    return null;
});
const store = createStore(exercise ? exercise.start : link ? link.state : DEFAULTS);
/** The system that is drawn. @param {Readonly<State>} state */
const drawnOf = (state) => (exercise ? exercise.whole(state) : definitionOf(state));
/** @type {Control[]} */
let controls = controlsNow();
/** The last facts about the drawing, for the host page. */
let facts = {
    description: '',
    symbols: /** @type {string | null} */ (null),
    segments: /** @type {string | null} */ (null),
};
/** The parts that draw, created when the drawing first becomes visible. @type {ReturnType<typeof begin> | null} */
let parts = null;
let seen = false;
/** Whether the system has changed while the drawing was not visible. */
let stale = false;
/** Whether the address contains no system. */
let blank = link === null || refusal !== '';

const rules = rulesPanel(store);
const constants = constantsPanel(store, rules);
const dials = createDials(store);
/** What the symbols mean, where an exercise asks for that. */
const symbols = exercise?.about.free.includes('dialect') ? symbolsFields(store) : null;
const host = connectHost(store, {
    host: options.host,
    offer,
    theme: setTheme,
    play: (on) => parts?.playback.setPlaying(on),
    facts: () => facts,
});

offer(controls);
store.subscribe(show);
show(store.state, null);
if (hasSteps)
    button('open-steps').addEventListener(
        'click',
        createSteps(exercise?.tool ?? createTool('course'), () => drawnOf(store.state)).open,
    );
if (exercise) {
    symbolKeys(['axiom', 'rules', 'overrides']);
    followKeyboard();
    createExercise(store, exercise, {
        marked(mark, link, isTouched) {
            host.marked(mark, link, isTouched);
            if (mark.isSolved) void showNext(exercise.text);
        },
        needs: (height) => host.needs(height),
    });
}
if (!link || refusal !== '') {
    showProblem(refusal || NOTHING);
    host.error(refusal || NOTHING);
} else if (link.problems.length > 0) {
    toast(link.problems.slice(0, 3).join(' '));
    host.error(link.problems.join(' '));
}

watchVisibility(html('stage'), (now) => {
    seen = now;
    if (seen) draw();
    else parts?.playback.setPlaying(false);
});
// Printing also shows drawings that are scrolled out of view.
addEventListener('beforeprint', draw);
systemIsDark().addEventListener('change', showTheme);
addEventListener('hashchange', async () => {
    // Another exercise is another page.
    if (isExercise || exerciseIn(location.hash) !== null) return location.reload();
    options = readOptions(location.hash);
    showTheme();
    offer(options.controls);
    const opened = await openLink(location.hash);
    if (opened) store.open(opened.state);
    else showProblem(NOTHING);
});

button('reset').addEventListener('click', store.reset);
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

/** Starts drawing, or draws a changed system. */
function draw() {
    if (blank) return;
    if (!parts) parts = begin();
    else if (stale) parts.engine.define(drawnOf(store.state));
    stale = false;
}

function begin() {
    const marks = createMarks();
    let ready = false;
    const engine = createEngine({
        report: (next, past) => report(next, past),
        drawn(picture) {
            stage.drawn(picture);
            playback.drawn(picture);
            hover.drawn();
            if (!ready) host.ready();
            ready = true;
        },
        busy: (under) => html('stage').setAttribute('aria-busy', String(under)),
        troubled({ how, question }) {
            if (question) return toast(QUESTION);
            stage.setBusy(false);
            const words = trouble.show(how, engine.good.definition !== null);
            // Loading is retried automatically, so the host need not know.
            if (how !== 'loading') host.error(words);
        },
        recovered: () => trouble.hide(),
    });
    const trouble = createTrouble({
        back() {
            if (exercise) return void (store.undo() || store.reset());
            const { definition } = engine.good;
            if (definition && !sameSystem(clean(definition), store.state))
                store.change({ ...definition, view: null }, '');
            else store.setView(null);
        },
        again() {
            engine.define(drawnOf(store.state));
            stage.show(store.state, null);
        },
    });
    engine.define(drawnOf(store.state));
    followNotation(store, engine, [rules, constants, ...(symbols ? [symbols] : [])]);
    const canvas = html('drawing');
    const stage = createStage(store, engine, marks, {
        // Until the drawing has the focus, wheel and touch scroll the host page.
        takes: (event) =>
            (event instanceof PointerEvent && event.pointerType === 'mouse') ||
            (document.hasFocus() && document.activeElement === canvas),
        keys: () => [
            ...(controls.includes('angle') ? /** @type {const} */ (['angle']) : []),
            ...(controls.includes('n') ? /** @type {const} */ (['iterations']) : []),
        ],
    });
    const playback = createPlayback(engine, { turtle: marks.turtle, offered: () => controls.includes('play') });
    const legend = createLegend();
    const reader = createReader(engine, { mark: marks.part('string'), legend, opened: () => hover.forget() });
    // Symbols under the pointer are shown only with the string view, which explains them.
    const reads = () => controls.includes('string');
    const hover = createHover(engine, {
        ratio: () => stage.resolution().ratio,
        mark: marks.found,
        light: reader.light,
        choose: reader.choose,
        read: reader.read,
        reading: () => reader.open,
        upto: () => playback.upto,
        offered: reads,
    });
    const report = createReporter({
        store,
        untitled: say`L-system`,
        stage,
        drawn: [stage, reader, playback],
        edited: [legend, { report: listProblems }, dials, ...(symbols ? [symbols] : [])],
        mistaken,
        valid,
    });
    stage.show(store.state, null);
    reader.show(store.state, null);
    return { engine, stage, playback, reader, legend, hover, drawn: () => ready };
}

/** The controls that the address asks for, or those of an exercise. @returns {Control[]} */
function controlsNow() {
    if (!exercise) return options.controls;
    const { free, hidesRules, asksForRules } = exercise.about;
    const writes = asksForRules || free.includes('axiom');
    // The string and its origins would tell what is hidden.
    const reads = !hidesRules && exercise.about.axiom !== 'hidden';
    return [
        ...(writes ? ['rules'] : []),
        ...(free.includes('iterations') ? ['n'] : []),
        ...(free.includes('angle') ? ['angle'] : []),
        ...(reads ? ['string', 'steps'] : []),
        'play',
    ].map((control) => /** @type {Control} */ (control));
}

/** Shows only these controls. @param {Control[]} asked */
function offer(asked) {
    controls = asked;
    dials.offer(controls);
    const has = (/** @type {Control} */ control) => controls.includes(control);
    html('writing').hidden = !has('rules');
    html('constants-row').hidden = !has('rules');
    if (symbols) html('meaning').hidden = false;
    html('panel').hidden = !(has('n') || has('angle') || has('rules'));
    button('open-reader').hidden = !has('string');
    button('open-playback').hidden = !has('play');
    button('open-steps').hidden = !has('steps') || !hasSteps;
    if (!has('string')) parts?.reader.close();
    if (!has('play')) parts?.playback.close();
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

/** @param {Readonly<State>} state @param {Readonly<State> | null} before */
function show(state, before) {
    rules.show(state);
    dials.show(state);
    symbols?.show(state);
    parts?.stage.show(state, before);
    parts?.reader.show(state, before);
    if (before && !sameSystem(state, before)) {
        stale = true;
        blank = false;
        if (seen) draw();
    }
    if (before && !sameDrawing(state, before)) {
        parts?.hover.forget();
        parts?.playback.forget();
    }
    if (before && before.camera !== state.camera) parts?.hover.turned();
    const title = said(state.title) || state.name;
    document.title = title ? say`${title} – L-system` : say`L-system`;
    setText(html('caption-title'), exercise ? say`Yours` : title);
    button('reset').disabled = !store.canReset;
    html('stage').classList.toggle('on-dark', isDark(state.background));
    for (const id of exercise ? ['stage', 'target'] : ['stage'])
        html(id).style.setProperty('--sheet', state.background);
    showPrintText(state, before);
    address();
}

/** Lists the problems of the student's own rules below them; places behind these rules are in those that are given. @param {Report} report */
function listProblems(report) {
    const own = (/** @type {Diagnostic} */ { field, end }) => field !== 'rules' || end <= store.state.rules.length;
    rules.report(exercise ? { ...report, diagnostics: report.diagnostics.filter(own) } : report);
}

/** @param {Diagnostic} first @param {Diagnostic[]} all */
function mistaken(first, all) {
    const listed = controls.includes('rules') && ['axiom', 'rules'].includes(first.field);
    const placed = withPlace(first);
    const sentence =
        all.length > 1 ? counted(all.length - 1, '{1}, and {} more.', '{1}, and {} more.', placed) : `${placed}.`;
    const words = [sentence, first.hint].filter(Boolean).join(' ');
    // If the rules are shown, their problems are listed below them.
    showProblem(listed ? '' : words);
    if (parts?.drawn()) showLast();
    host.error(first.message, all);
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

/** @param {Report} report */
function valid({ description, symbols, segments, empty }) {
    showProblem('');
    facts = { description, symbols, segments };
    // Where an exercise asks for the string, it need not draw.
    return empty !== null && exercise && ASKS[exercise.about.asks].isText
        ? say`Nothing is drawn. Here the string counts.`
        : empty;
}

function showTheme() {
    document.documentElement.dataset.theme = options.theme ?? surroundingTheme();
}

/** @param {'light' | 'dark' | null} theme null for none */
function setTheme(theme) {
    options = { ...options, theme };
    showTheme();
}

/** Shows a problem on the drawing, or hides the last one if empty. @param {string} words */
function showProblem(words) {
    setWords(html('mistake'), words);
    html('mistake').hidden = words === '';
}

/** Links to the playground with the current state. */
async function address() {
    if (html('open').hidden) return;
    // Without a server, a folder address does not open its page.
    const place = new URL(location.protocol === 'file:' ? 'playground.html' : './', location.href);
    const state = store.state;
    html('open').setAttribute('href', new URL(writeLink(state), place).href);
    const best = await bestLink(state);
    if (state === store.state) html('open').setAttribute('href', new URL(best, place).href);
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
