/** The page: connects state, worker, drawing and controls. */

import { followAddress } from './state/address.js';
import { toast } from './base/announce.js';
import { createReporter, showLast } from './view/caption.js';
import { dialRows } from './controls/dial-rows.js';
import { createDialogs } from './dialogs/dialogs.js';
import { button, html, reducedMotion, setText } from './base/dom.js';
import { createEngine } from './engine/engine.js';
import { createStored } from './favourites/stored.js';
import { createGrowing } from './motion/growing.js';
import { withThemeScheme, hasScheme, themeScheme, isDark } from './state/colour-schemes.js';
import { createMarks } from './view/marks.js';
import { followNotation } from './controls/notation.js';
import { keepOffline } from './base/offline.js';
import { blank, opening, titleOf } from './state/opening.js';
import { createMates, matesOn } from './engine/mates.js';
import { openLink } from './state/packed.js';
import { followPasting } from './dialogs/pasting.js';
import { constantsPanel } from './panels/constants-panel.js';
import { favouritesPanel } from './panels/favourites-panel.js';
import { growthPanel } from './panels/growth-panel.js';
import { savePanel } from './panels/save-panel.js';
import { lookPanel } from './panels/look-panel.js';
import { createRefusal } from './view/refusal.js';
import { followKeyboard } from './controls/keyboard.js';
import { symbolKeys } from './controls/symbol-keys.js';
import { symbolNote } from './controls/symbol-note.js';
import { rulesPanel } from './panels/rules-panel.js';
import { tabs } from './panels/tabs.js';
import { turtlePanel } from './panels/turtle-panel.js';
import { createOrbit } from './view/orbit.js';
import { createReadings } from './view/readings.js';
import { createSession } from './state/session.js';
import { openSession } from './state/sessions.js';
import { showPrintText } from './view/print-text.js';
import { createStage } from './view/stage.js';
import { clean, definitionOf, same, sameSystem } from './state/state.js';
import { createStorage } from './state/storage.js';
import { QUESTION, createTrouble } from './view/trouble.js';
import { createStore } from './state/store.js';
import { languageChoice } from './base/language.js';
import { theme, themeButton } from './base/theme.js';
import { createWind } from './motion/wind.js';
import { counted, say, translatePage } from './base/words.js';

/** @typedef {import('./state/state.js').State} State */
/** @typedef {import('./protocol.js').Report} Report */

translatePage();

/** Whether rules may have a curve, or custom symbols a leaf, whose editor then loads. */
const CURVE = /^[^\S\r\n]*curve\s/m;
const SURFACE = /\bsurface\s/i;
/** The most problems in one message; longer messages are not read. */
const MOST_PROBLEMS = 3;

/** Names the file of the program lsys, if it serves this page. @type {HTMLMetaElement | null} */
const served = document.querySelector('meta[name="lsys-file"]');
const link = await openLink(location.hash || (served?.dataset['link'] ?? ''));
const storage = createStorage(() => localStorage);
const tab = createStorage(() => sessionStorage);
const session = createSession(storage, tab);
const restored = session.start(location.hash, link?.state ?? null);
const store = createStore(restored?.state ?? link?.state ?? opening(theme()), restored?.origin);
const engine = createEngine({ report: reported, drawn, busy, troubled, recovered, doubted });
/** Whether the first state stopped the drawing on an earlier visit, and so is not drawn before the reader acts. */
let notDrawn = session.isSuspect(store.state);
if (!notDrawn) engine.define(definitionOf(store.state));
const marks = createMarks();
const stage = createStage(store, engine, marks, { isBesideTools: true });
const orbit = createOrbit(store, stage);
const readings = createReadings(engine, stage, marks);
const { playback, legend, reader } = readings;
const growing = createGrowing(store, engine, { begins: () => begins(wind), present: playback.present });
const wind = createWind(store, engine, { begins: () => begins(growing), present: playback.present });
const rules = rulesPanel(store);
const growth = growthPanel(store, engine);
const turtle = turtlePanel(store);
followNotation(store, engine, [rules, constantsPanel(store, rules), turtle]);
symbolNote(store, engine, { legend, mark: marks.part('rules') });
symbolKeys(['axiom', 'rules', 'overrides']);
followKeyboard();
const look = lookPanel(store);
const dials = dialRows(store);
const refusal = createRefusal(store, tabs());
const trouble = createTrouble({ back: goBack, again: drawAgain });
const report = createReporter({
    store,
    untitled: say`untitled system`,
    stage,
    drawn: [reader, playback, stage, orbit],
    edited: [rules, legend, growth, look, turtle, refusal, wind],
    mistaken({ message }, { length }) {
        showLast();
        return length > 1
            ? counted(
                  length - 1,
                  '{1}, and {} more. Showing the last valid drawing.',
                  '{1}, and {} more. Showing the last valid drawing.',
                  message,
              )
            : say`${message}. Showing the last valid drawing.`;
    },
});
const showAddress = followAddress(store, { open: opened });

const favourites = createStored(storage);
favouritesPanel(store, favourites);
const dialogs = createDialogs({
    store,
    engine,
    storage,
    session,
    favourites,
    stage,
    listening: { play: () => playback.presented ?? playback.setPlaying(true), present: sounded, mark: marks.sounding },
    readAt: reader.readAt,
    theme,
    restyle: (definition) => withThemeScheme(definition, theme()),
});
savePanel(store, dialogs);
followPasting(dialogs);
if (location.search === '?shared') void dialogs.open('shared');
// Files that the installed page is asked to open.
window.launchQueue?.setConsumer(async ({ files: [file] }) => file && dialogs.open('file', await file.getFile()));
for (const part of /** @type {const} */ (['leaves', 'mathematics']))
    html(part).addEventListener('toggle', () => void dialogs.open(part));
if (/[#&]film=./.test(location.hash)) void dialogs.open('film', location.hash);
engine.share(createMates(matesOn(navigator)));
languageChoice();
themeButton((next) => {
    // A system in the theme's default colours, and the opening plant, take the new theme's colours.
    const former = next === 'dark' ? 'light' : 'dark';
    const { palette, background } = hasScheme(store.state, opening(former)) ? opening(next) : themeScheme(next);
    if ([themeScheme(former), opening(former)].some((scheme) => hasScheme(store.state, scheme)))
        store.changeOrigin({ palette: [...palette], background });
});

html('skip').addEventListener('click', (event) => {
    // Following the link would replace the drawing in the address.
    event.preventDefault();
    html('drawing').focus();
});
button('undo').addEventListener('click', () => store.undo());
button('redo').addEventListener('click', () => store.redo());
button('reset').addEventListener('click', store.reset);
button('start-anew').addEventListener('click', () => {
    session.visit(blank(theme()));
    html('rules').focus();
    toast(say`New system. Undo to go back.`);
});
addEventListener('keydown', (event) => {
    const command = (event.ctrlKey || event.metaKey) && !event.altKey;
    const key = event.key.toLowerCase();
    if (!command || (key !== 'z' && key !== 'y')) return;
    event.preventDefault();
    if (key === 'y' || event.shiftKey) store.redo();
    else store.undo();
});
// The browser's undo covers only text fields, so its menu entries call the page's undo.
addEventListener('beforeinput', (event) => {
    if (event.inputType !== 'historyUndo' && event.inputType !== 'historyRedo') return;
    event.preventDefault();
    if (event.inputType === 'historyUndo') store.undo();
    else store.redo();
});

store.subscribe((state, before) => {
    if (!sameSystem(state, before)) {
        growing.forget();
        if (notDrawn) trouble.hide();
        notDrawn = false;
        engine.define(definitionOf(state));
        wind.edited();
    }
    show(state, before);
});
session.follow(store);
// The opening plant has the plain address; a restored visit has a link.
// After a quick reload the address may be out of date.
if (restored && !(link && same(restored.state, link.state))) showAddress();
show(store.state, null);
greet();
if (notDrawn) offerDrawing();
// On the very first visit the plant grows once.
if (storage.available && storage.read('visited') === undefined) {
    storage.write('visited', true);
    if (!link && !restored && !reducedMotion()) growing.greet();
}
keepOffline();
if (served) void import('./dialogs/served.js').then(({ createServed }) => createServed(served, { store, tab }));

/** @param {Readonly<State>} state @param {Readonly<State> | null} before */
function show(state, before) {
    rules.show(state);
    growth.show(state);
    turtle.show(state);
    look.show(state);
    dials.show(state);
    stage.show(state, before);
    orbit.show(state, before);
    readings.show(state, before);
    if (
        (before?.rules !== state.rules && CURVE.test(state.rules)) ||
        (before?.overrides !== state.overrides && SURFACE.test(state.overrides))
    )
        void dialogs.part('curves');
    showNames(state);
    showPrintText(state, before);
    button('undo').disabled = !store.canUndo;
    button('redo').disabled = !store.canRedo;
    button('reset').disabled = !store.canReset;
    html('stage').classList.toggle('on-dark', isDark(state.background));
    html('stage').style.setProperty('--sheet', state.background);
}

/** @param {Readonly<State>} state */
function showNames(state) {
    // The introduction is about the opening plant, edited or not.
    html('intro').hidden = state.name !== opening(theme()).name;
    const title = titleOf(state) || state.name || say`Untitled system`;
    // A system with another title is a new system, not an edited one.
    const edited = !sameSystem(state, store.origin) && state.title === store.origin.title;
    setText(html('specimen-title'), title);
    setText(html('specimen-source'), state.source);
    html('edited').hidden = !edited;
    setText(html('caption-title'), edited ? say`${title}, edited` : title);
    const heading = say`${title} – L-systems`;
    if (document.title !== heading) document.title = heading;
}

/** Growth or wind takes the place of the other. @param {{stop: () => void}} other */
function begins(other) {
    other.stop();
    playback.forget();
}

/** Sound takes the place of growth, wind and the segments. @param {import('./motion/playback.js').Show | null} show */
function sounded(show) {
    if (show && playback.presented !== show) {
        growing.stop();
        wind.stop();
        playback.stop();
    }
    playback.present(show);
}

/** @param {Report} next @param {boolean} past whether the report is about the last good state */
function reported(next, past) {
    // Do not report the intermediate states of growth and wind.
    if (!growing.moves && !wind.moves) report(next, past);
}

/** @param {import('./engine/engine.js').Drawn} picture */
function drawn(picture) {
    stage.drawn(picture);
    if (picture.complete) html('rough').hidden = !picture.rough;
    growing.drawn();
    wind.drawn();
    readings.drawn(picture);
}

/** @param {boolean} under whether a newer state is being drawn */
function busy(under) {
    html('stage').setAttribute('aria-busy', String(under));
}

/** @param {import('./engine/engine.js').Trouble} what */
function troubled({ how, question }) {
    if (question) return toast(QUESTION);
    growing.forget();
    wind.forget();
    stage.setBusy(false);
    if (engine.good.definition) showLast();
    trouble.show(how, engine.good.definition !== null);
}

function recovered() {
    trouble.hide();
}

/** @param {import('./engine/engine.js').Shown} state @param {boolean} doubtful */
function doubted({ definition, look }, doubtful) {
    if (definition)
        session.suspect(
            clean({ ...definition, view: look && store.state.view, camera: look && store.state.camera }),
            doubtful,
            look !== null,
        );
}

/** Offers to draw a system that stopped the drawing before. */
function offerDrawing() {
    setText(html('caption-text'), say`Not drawn.`);
    trouble.show('held', false);
}

/** Goes back to the last drawn state; undo returns to the state that stopped the drawing. */
function goBack() {
    const { definition, look } = engine.good;
    if (!definition || !look) return;
    const same = sameSystem(clean(definition), store.state);
    if (same) return store.setView(null);
    store.change({ ...definition, view: null, camera: look.camera && store.state.camera }, '');
}

function drawAgain() {
    engine.define(definitionOf(store.state));
    stage.show(store.state, null);
}

/** Shows a link's problems, or offers to continue the last visit. */
function greet() {
    const problems = link ? problemWords(link) : '';
    const [last] = served ? [] : session.others();
    const offered = link && !restored && last ? openSession(last) : null;
    if (last && offered && !sameSystem(offered.state, store.state)) {
        toast(problems || say`This is the link you opened.`, {
            action: { label: say`Continue where you left off`, act: () => session.resume(last) },
        });
    } else if (problems) {
        toast(problems);
    } else if (restored && !restored.again) {
        toast(say`This is where you left off.`);
    }
}

/** @param {import('./state/link.js').Link} pasted */
function opened(pasted) {
    session.visit(pasted.state);
    toast(`${say`Opened the link. Undo to go back.`} ${problemWords(pasted)}`.trim());
}

/** The first few of a link's problems. @param {import('./state/link.js').Link} link */
function problemWords({ problems }) {
    const more = problems.length - MOST_PROBLEMS;
    return [
        ...problems.slice(0, MOST_PROBLEMS),
        ...(more > 0 ? [counted(more, '{} more problem.', '{} more problems.')] : []),
    ].join(' ');
}
