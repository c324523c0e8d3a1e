/** The dialog that makes an exercise of the shown system: what is given, what counts, and its link. */

import styles from '../../css/course.css';
import find from '../../css/find.css';
import gallery from '../../css/gallery.css';
import { copies } from '../base/copy.js';
import { button, byId, closes, html, input, make, setText, setValue } from '../base/dom.js';
import { showFailure } from '../base/failure.js';
import { addElements } from '../base/late.js';
import { ASKS } from '../late-tables.js';
import { exerciseIn } from '../exercise/open.js';
import { readNumber } from '../base/numerals.js';
import { showQrPicture } from '../dialogs/qr.js';
import { exerciseCode, frameCode, stable } from '../dialogs/share-code.js';
import { definitionOf } from '../state/state.js';
import { counted, said, say } from '../base/words.js';
import markup from './maker.html';
import { createOthers } from './others.js';
import { savePackage, savedWords } from './packaging.js';
import { courseTool, classTool as tool } from './tool.js';

/** @typedef {import('../protocol.js').Exercise} Exercise */
/** @typedef {import('../protocol.js').Given} Given */

/** A change waits for a pause of this length before the link is made anew, in milliseconds. */
const PAUSE = 200;
/** The size of an embedded exercise, in CSS pixels. */
const SIZE = { width: 800, height: 640 };
/** The most lines of rules with a choice of their own; further ones are to be found. */
const MOST_LINES = 60;
/** The largest limit of symbols that an exercise can have. */
const MOST_SYMBOLS = 2 ** 32 - 1;

/** @type {[Given, string][]} */
const CHOICES = [
    ['shown', say`given`],
    ['free', say`to be found`],
    ['hidden', say`hidden`],
];

/** The properties in which variants differ, in words. @type {[import('../protocol.js').Varied, string][]} */
const VARIED = [
    ['mirrored', say`mirrored`],
    ['angle', say`other angles`],
    ['letters', say`other letters`],
    ['lengths', say`other lengths`],
    ['seed', say`other seeds`],
];

/** Whether a line has something to find: not a comment, and not the heading of the rules for drawing. @param {string} line */
const isRule = (line) => line.trim() !== '' && !/^\s*(\/\/|#\s|draw\s*:\s*$)/.test(line);

/**
 * The open exercise.
 * @typedef {object} Making
 * @property {import('../dialogs/dialogs.js').Page['store']} store
 * @property {import('../dialogs/dialogs.js').Page['engine']} engine
 * @property {HTMLElement} rows
 * @property {HTMLInputElement} link
 * @property {HTMLTextAreaElement} code
 * @property {SVGSVGElement} qr
 * @property {number} turn
 */

/** @param {import('../dialogs/dialogs.js').Page} page */
export function createMaker({ store, engine }) {
    addElements(markup, [gallery, find, styles]);
    const dialog = byId('exercise-maker', HTMLDialogElement);

    /** @type {Making} */
    const self = {
        store,
        engine,
        rows: html('maker-given'),
        link: input('maker-link'),
        code: byId('maker-code', HTMLTextAreaElement),
        qr: byId('maker-qr', SVGSVGElement),
        turn: 0,
    };

    byId('maker-asks', HTMLSelectElement).append(
        ...Object.entries(ASKS).map(([value, { label }]) => make('option', { value }, said(label))),
    );
    html('maker-varied').append(
        ...VARIED.map(([value, words]) =>
            make(
                'label',
                { class: 'check' },
                make('input', { type: 'checkbox', name: 'varied', value }),
                make('span', {}, words),
            ),
        ),
    );

    let timer = 0;

    const others = createOthers(engine, courseTool, () => exercise(self));

    copies(button('maker-copy'), self.link, say`Link`, tell);
    copies(button('maker-copy-code'), self.code, say`Code`, tell);
    button('maker-package').addEventListener('click', async function pack() {
        if (self.link.value === '') return;
        tell(say`Packing…`);
        const asked = {
            exercises: [exerciseIn(self.link.value) ?? ''],
            title: input('maker-title').value.trim(),
            standard: '1.2',
        };
        await savePackage(asked).then(
            (bytes) => tell(savedWords(bytes)),
            (error) => showFailure(html('maker-status'), error, pack),
        );
    });
    dialog.addEventListener('close', others.forget);
    dialog.addEventListener('input', () => {
        others.forget();
        outdate(self);
        clearTimeout(timer);
        timer = window.setTimeout(() => refresh(self), PAUSE);
    });
    dialog.querySelector('form')?.addEventListener('submit', (event) => event.preventDefault());
    closes(dialog, 'close-maker');

    return {
        open() {
            begin(self);
            others.forget();
            setText(html('maker-status'), '');
            dialog.showModal();
            void refresh(self);
        },
    };
}

/** The properties in which variants shall differ. */
function varied() {
    const chosen = [...html('maker-varied').querySelectorAll('input:checked')];
    return VARIED.map(([value]) => value).filter((value) =>
        chosen.some((box) => box instanceof HTMLInputElement && box.value === value),
    );
}

/** The exercise with its variants, told unless a later change is under way. @param {Making} self @param {number} own */
async function withVariants(self, own) {
    const plain = exercise(self);
    const kinds = varied();
    if (kinds.length === 0) {
        setText(html('maker-variants'), '');
        return plain;
    }
    const variants = await tool.call('variantsOf', { exercise: plain, varied: kinds });
    if (own !== self.turn) return plain;
    const words =
        variants.length === 0
            ? say`These properties make no other target.`
            : counted(
                  variants.length + 1,
                  '{} target. Students type their name, and the same name gets the same target.',
                  '{} targets. Students type their name, and the same name gets the same target.',
              );
    setText(html('maker-variants'), words);
    return { ...plain, variants };
}

/** @param {string} name @param {Node | string} label @param {Given} chosen */
function row(name, label, chosen) {
    const select = make(
        'select',
        { name },
        ...CHOICES.map(([value, words]) =>
            make('option', value === chosen ? { value, selected: '' } : { value }, words),
        ),
    );
    return make('label', { class: 'maker-row' }, make('span', {}, label), select);
}

/** @param {Making} self @param {string} name @returns {Given} */
function given(self, name) {
    const select = self.rows.querySelector(`select[name="${name}"]`);
    return /** @type {Given} */ (select instanceof HTMLSelectElement ? select.value : 'free');
}

/** @param {Making} self */
function begin(self) {
    const { axiom, rules, angle, iterations, title, name } = self.store.state;
    setValue(input('maker-title'), title || name);
    const lines = rules.split('\n').slice(0, MOST_LINES);
    self.rows.replaceChildren(
        row('axiom', make('span', {}, say`Start (axiom)`, ' ', make('code', {}, axiom.slice(0, 40))), 'shown'),
        row('n', say`Iterations: ${String(iterations)}`, 'shown'),
        row('angle', say`Angle: ${String(angle)}°`, 'shown'),
        row('turtle', say`Meaning of the symbols`, 'shown'),
        ...lines.flatMap((line, at) =>
            !isRule(line) ? [] : [row(`line-${at}`, make('code', {}, line.slice(0, 80)), 'free')],
        ),
    );
}

/** @param {Making} self @returns {Exercise} */
function exercise(self) {
    const state = self.store.state;
    const text = (/** @type {string} */ id) => byId(id, HTMLTextAreaElement).value;
    const symbols = readNumber(input('maker-symbols').value);
    const percent = readNumber(input('maker-percent').value);
    return {
        title: input('maker-title').value.trim(),
        task: text('maker-task').trim(),
        hints: text('maker-hints')
            .split('\n')
            .map((hint) => hint.trim())
            .filter(Boolean),
        target: { ...definitionOf(state), notes: '' },
        variants: [],
        axiom: given(self, 'axiom'),
        angle: given(self, 'angle'),
        n: given(self, 'n'),
        turtle: given(self, 'turtle'),
        rules: state.rules
            .split('\n')
            .slice(0, MOST_LINES)
            .map((line, at) => (isRule(line) ? given(self, `line-${at}`) : 'shown')),
        first: {
            axiom: state.axiom.slice(0, 1),
            rules: text('maker-first').trim(),
            angle: 90,
            n: Math.min(state.iterations, 1),
        },
        program: byId('maker-asks', HTMLSelectElement).value === 'program' ? text('maker-program').trim() : '',
        asks: /** @type {import('../protocol.js').Asks} */ (byId('maker-asks', HTMLSelectElement).value),
        mostSymbols: symbols === null ? null : Math.min(Math.max(0, Math.round(symbols)), MOST_SYMBOLS),
        tolerance: percent === null || percent <= 0 || percent >= 100 ? null : percent / 100,
        showsAnswer: input('maker-answer').checked,
    };
}

/** No link and no code are shown or copied that are older than a change. @param {Making} self */
function outdate(self) {
    self.link.value = '';
    self.code.value = '';
    html('maker-try').removeAttribute('href');
    return ++self.turn;
}

/** @param {Making} self */
async function refresh(self) {
    const own = outdate(self);
    const made = await withVariants(self, own)
        .then((exercise) => tool.call('write', { exercise }))
        .catch((error) => error);
    if (own !== self.turn) return;
    const fine = typeof made === 'string' && /^[\w-]+$/.test(made);
    html('maker-made').hidden = !fine;
    if (!fine) return showFailure(html('maker-problem'), made, () => refresh(self));
    setText(html('maker-problem'), '');
    const address = new URL(`exercise.html#v=1&x=${made}`, location.href).href;
    self.link.value = address;
    html('maker-try').setAttribute('href', address);
    const title = input('maker-title').value.trim() || 'Exercise';
    self.code.value = input('maker-frame').checked
        ? frameCode({ ...self.store.state, title }, `#v=1&x=${made}`, stable('exercise.html'), {
              controls: [],
              theme: '',
              ...SIZE,
          })
        : exerciseCode(title, address, stable('l-system.js'), SIZE.width);
    const modules = await self.engine.qr(address).catch(() => null);
    if (own !== self.turn) return;
    self.qr.toggleAttribute('hidden', modules === null);
    if (modules) showQrPicture(self.qr, modules);
}

const tell = (/** @type {string} */ words) => setText(html('maker-status'), words);
