/** Step by step: what each symbol becomes, one symbol at a time beside all at once, and the turtle at each symbol. */

import styles from '../../css/steps.css';
import { button, byId, closes, html, input, reducedMotion, setText, setValue } from '../base/dom.js';
import { showFailure } from '../base/failure.js';
import { addElements } from '../base/late.js';
import { say } from '../base/words.js';
import { createDerivation } from './derivation.js';
import { createSingle } from './single.js';
import markup from './steps.html';
import { createWay } from './way.js';

/** @typedef {import('../state/state.js').Definition} Definition */
/** @typedef {import('../course/tool.js').StudyTool} StudyTool */
/**
 * A part of the dialog. `show` resolves when generation `n` is shown; `end` is the last place that play reaches, and
 * `words` tells where it is.
 * @typedef {{show: (definition: Definition, n: number) => Promise<void>, at: number, readonly end: number, readonly pause: number, words: () => string, seek: (at: number) => void | Promise<void>}} Part
 */

/** The fewest generations on the slider, and the most. */
const FEWEST = 6;
const MOST = 60;

/**
 * The dialog and its part.
 * @typedef {object} Dialog
 * @property {() => Definition} definition
 * @property {HTMLInputElement} slider
 * @property {HTMLButtonElement} play
 * @property {HTMLInputElement[]} choices
 * @property {Record<string, {area: string, part: Part}>} parts
 * @property {number} timer
 * @property {number} turn
 */

/**
 * @param {StudyTool} tool
 * @param {() => Definition} definition of the shown system
 */
export function createSteps(tool, definition) {
    addElements(markup, [styles]);
    const dialog = byId('steps', HTMLDialogElement);

    /** @type {Record<string, {area: string, part: Part}>} */
    const parts = {
        rows: { area: 'steps-derivation', part: createDerivation(tool, told) },
        single: { area: 'steps-both', part: createSingle(tool) },
        turtle: { area: 'steps-way', part: createWay(tool, told, () => settle(self)) },
    };
    /** @type {Dialog} */
    const self = {
        definition,
        slider: input('steps-at'),
        play: button('steps-play'),
        choices: ['rows', 'single', 'turtle'].map((name) => input(`steps-${name}`)),
        parts,
        timer: 0,
        turn: 0,
    };

    for (const choice of self.choices) choice.addEventListener('change', () => show(self));
    self.slider.addEventListener('input', () => {
        stop(self);
        void seek(self, Number(self.slider.value));
    });
    self.play.addEventListener('click', () => (self.timer ? stop(self) : start(self)));
    button('steps-back').addEventListener('click', () => (stop(self), void seek(self, part(self).at - 1)));
    button('steps-on').addEventListener('click', () => (stop(self), void seek(self, part(self).at + 1)));
    dialog.addEventListener('close', () => stop(self));
    closes(dialog, 'close-steps');
    dialog.classList.toggle('moving', !reducedMotion());

    return {
        open() {
            dialog.showModal();
            void show(self);
        },
    };
}

const told = (/** @type {string} */ words) => setText(html('steps-told'), words);

/** @param {Dialog} self */
const chosen = (self) => self.choices.find(({ checked }) => checked)?.value ?? 'rows';

/** @param {Dialog} self */
const part = (self) => /** @type {{area: string, part: Part}} */ (self.parts[chosen(self)]).part;

/** Shows the chosen part. @param {Dialog} self */
async function show(self) {
    const own = ++self.turn;
    stop(self);
    told('');
    for (const [name, { area }] of Object.entries(self.parts)) html(area).hidden = name !== chosen(self);
    const system = self.definition();
    try {
        await part(self).show(system, Math.min(system.iterations, MOST));
        if (own === self.turn) setText(html('steps-problem'), '');
    } catch (error) {
        if (own !== self.turn) return;
        for (const { area } of Object.values(self.parts)) html(area).hidden = true;
        showFailure(html('steps-problem'), error, () => show(self));
    }
    settle(self);
}

/** Shows where the chosen part is. @param {Dialog} self */
function settle(self) {
    const { at, end } = part(self);
    self.slider.max = String(chosen(self) === 'turtle' ? Math.max(1, end) : Math.max(FEWEST, Math.min(end, MOST)));
    setValue(self.slider, String(at));
    self.slider.style.setProperty('--at', String(at / Number(self.slider.max)));
    self.slider.setAttribute('aria-label', chosen(self) === 'turtle' ? say`Symbols read` : say`Generation`);
    setText(html('steps-words'), part(self).words());
    button('steps-back').disabled = at <= 0;
    button('steps-on').disabled = at >= Number(self.slider.max);
    const [back, on] =
        chosen(self) === 'turtle'
            ? [say`Previous symbol`, say`Next symbol`]
            : [say`Previous generation`, say`Next generation`];
    button('steps-back').setAttribute('aria-label', back);
    button('steps-on').setAttribute('aria-label', on);
}

/** @param {Dialog} self @param {number} at */
async function seek(self, at) {
    const sought = part(self);
    await sought.seek(Math.max(0, Math.min(Number(self.slider.max), at)));
    if (sought === part(self)) settle(self);
}

/** @param {Dialog} self */
function stop(self) {
    clearInterval(self.timer);
    self.timer = 0;
    self.play.setAttribute('aria-pressed', 'false');
    setText(self.play, say`Play`);
}

/** @param {Dialog} self */
function start(self) {
    if (part(self).at >= Number(self.slider.max)) void seek(self, 0);
    self.play.setAttribute('aria-pressed', 'true');
    setText(self.play, say`Pause`);
    self.timer = window.setInterval(() => {
        if (part(self).at >= Number(self.slider.max)) stop(self);
        else void seek(self, part(self).at + 1);
    }, part(self).pause);
}
