/** Step by step: what each symbol becomes, one symbol at a time beside all at once, and the turtle at each symbol. */

import styles from '../../css/steps.css';
import { button, byId, closes, html, input, reducedMotion, setText, setValue } from '../dom.js';
import { showFailure } from '../failure.js';
import { addElements } from '../late.js';
import { say } from '../words.js';
import { createDerivation } from './derivation.js';
import { createSingle } from './single.js';
import markup from './steps.html';
import { createWay } from './way.js';

/** @typedef {import('../state.js').Definition} Definition */
/** @typedef {import('../course/tool.js').CourseTool} CourseTool */
/**
 * A part of the dialog. `show` resolves when generation `n` is shown; `end` is the last place that play reaches, and
 * `words` tells where it is.
 * @typedef {{show: (definition: Definition, n: number) => Promise<void>, at: number, readonly end: number, readonly pause: number, words: () => string, seek: (at: number) => void | Promise<void>}} Part
 */

/** The fewest generations on the slider, and the most. */
const FEWEST = 6;
const MOST = 60;

/**
 * @param {CourseTool} tool
 * @param {() => Definition} definition of the shown system
 */
export function createSteps(tool, definition) {
    addElements(markup, [styles]);
    const dialog = byId('steps', HTMLDialogElement);
    const slider = input('steps-at');
    const play = button('steps-play');
    const choices = ['rows', 'single', 'turtle'].map((name) => input(`steps-${name}`));
    const told = (/** @type {string} */ words) => setText(html('steps-told'), words);
    /** @type {Record<string, {area: string, part: Part}>} */
    const parts = {
        rows: { area: 'steps-derivation', part: createDerivation(tool, told) },
        single: { area: 'steps-both', part: createSingle(tool) },
        turtle: { area: 'steps-way', part: createWay(tool, told, () => settle()) },
    };
    let timer = 0;
    let turn = 0;

    const chosen = () => choices.find(({ checked }) => checked)?.value ?? 'rows';
    const part = () => /** @type {{area: string, part: Part}} */ (parts[chosen()]).part;

    /** Shows the chosen part. */
    async function show() {
        const own = ++turn;
        stop();
        told('');
        for (const [name, { area }] of Object.entries(parts)) html(area).hidden = name !== chosen();
        const system = definition();
        try {
            await part().show(system, Math.min(system.iterations, MOST));
            if (own === turn) setText(html('steps-problem'), '');
        } catch (error) {
            if (own !== turn) return;
            for (const { area } of Object.values(parts)) html(area).hidden = true;
            showFailure(html('steps-problem'), error, show);
        }
        settle();
    }

    /** Shows where the chosen part is. */
    function settle() {
        const { at, end } = part();
        slider.max = String(chosen() === 'turtle' ? Math.max(1, end) : Math.max(FEWEST, Math.min(end, MOST)));
        setValue(slider, String(at));
        slider.style.setProperty('--at', String(at / Number(slider.max)));
        slider.setAttribute('aria-label', chosen() === 'turtle' ? say`Symbols read` : say`Generation`);
        setText(html('steps-words'), part().words());
        button('steps-back').disabled = at <= 0;
        button('steps-on').disabled = at >= Number(slider.max);
        const [back, on] =
            chosen() === 'turtle'
                ? [say`Previous symbol`, say`Next symbol`]
                : [say`Previous generation`, say`Next generation`];
        button('steps-back').setAttribute('aria-label', back);
        button('steps-on').setAttribute('aria-label', on);
    }

    /** @param {number} at */
    async function seek(at) {
        const sought = part();
        await sought.seek(Math.max(0, Math.min(Number(slider.max), at)));
        if (sought === part()) settle();
    }

    function stop() {
        clearInterval(timer);
        timer = 0;
        play.setAttribute('aria-pressed', 'false');
        setText(play, say`Play`);
    }

    function start() {
        if (part().at >= Number(slider.max)) void seek(0);
        play.setAttribute('aria-pressed', 'true');
        setText(play, say`Pause`);
        timer = window.setInterval(() => {
            if (part().at >= Number(slider.max)) stop();
            else void seek(part().at + 1);
        }, part().pause);
    }

    for (const choice of choices) choice.addEventListener('change', show);
    slider.addEventListener('input', () => {
        stop();
        void seek(Number(slider.value));
    });
    play.addEventListener('click', () => (timer ? stop() : start()));
    button('steps-back').addEventListener('click', () => (stop(), void seek(part().at - 1)));
    button('steps-on').addEventListener('click', () => (stop(), void seek(part().at + 1)));
    dialog.addEventListener('close', stop);
    closes(dialog, 'close-steps');
    dialog.classList.toggle('moving', !reducedMotion());

    return {
        open() {
            dialog.showModal();
            void show();
        },
    };
}
