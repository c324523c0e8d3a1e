/** The plant that the own functions draw, beside the true one, and the own time beside the engine's. */

import { button, byId, html, input, make, setText } from '../base/dom.js';
import { createTool } from '../engine/tool.js';
import { clean } from '../state/state.js';
import { reasonOf, say } from '../base/words.js';
import { truth } from './given.js';
import { isSame, resultOf } from './judge.js';
import { drawLines, linesOf, timesOf } from './pictures.js';
import { PLANTS, definitionOf } from './sets.js';

/** @typedef {import('./worker.js').Call} Call */
/** @typedef {import('./worker.js').Given} Given */

/** Words of more symbols are not timed. */
const MOST_SYMBOLS = 400_000;
const TRUTH = truth();

/**
 * @param {import('./tasks.js').Task} task
 * @param {import('./sets.js').Drawing} drawing
 * @param {{again: () => void, time: (calls: Call[]) => Promise<(Given | undefined)[]>}} page
 */
export function createPlants(task, drawing, { again, time }) {
    const choice = byId('plant', HTMLSelectElement);
    const steps = input('plant-n');
    const [own, real] = [byId('own-plant', HTMLCanvasElement), byId('true-plant', HTMLCanvasElement)];
    /** @type {ReturnType<typeof createTool<import('../protocol.js').StudyCalls>>} */
    const tool = createTool('study');
    /** @type {unknown} */
    let result = null;
    /** @type {string | null} */
    let word = null;
    let isDrawn = false;

    choice.append(...task.plants.map((name) => make('option', { value: name }, name)));
    const plant = () => /** @type {import('./sets.js').Plant} */ (PLANTS[choice.value] ?? PLANTS['tree4']);
    const n = () => Number(steps.value);
    /** The colours stand in the styles. */
    const ink = () => getComputedStyle(own).color;
    const axiom = () => [plant().axiom, plant().rules, n()];

    function begin() {
        [steps.max, steps.value] = [String(plant().n + 1), String(plant().n)];
        clear();
    }

    function clear() {
        setText(html('plant-steps'), say`n = ${n()}`);
        steps.style.setProperty('--at', String(n() / Number(steps.max)));
        setText(html('plant-words'), '');
        html('times').replaceChildren();
        [result, word] = [null, null];
        paint();
        again();
    }

    function paint() {
        const made = TRUTH[drawing.word]?.(...axiom());
        const expected = linesOf(TRUTH[drawing.lines]?.(made, ...drawing.values(plant())));
        drawLines(real, expected, expected, { ink: ink() });
        const lines = linesOf(result);
        const from = lines.findIndex((line, at) => !isSame(line, expected[at]));
        const wrong = from < 0 ? {} : { wrong: { from, ink: getComputedStyle(own).outlineColor } };
        drawLines(own, lines, expected, { ink: ink(), ...wrong });
        html('own-nothing').hidden = lines.length > 0;
        return { lines, expected, from };
    }

    /** What the engine finds wrong with the word, or else with the lines. */
    async function explain() {
        const definition = clean(/** @type {any} */ (definitionOf(plant(), drawing, n())));
        const table = linesOf(result).map((line) => line.flat().join(','));
        const outputs = [word, table.length > 0 ? table.join('\n') : null].filter((text) => text !== null);
        setText(html('plant-words'), say`Comparing…`);
        try {
            for (const output of outputs) {
                const { isRight, words } = await tool.call('check', { definition, output });
                setText(html('plant-words'), words);
                if (!isRight) return;
            }
        } catch (error) {
            setText(html('plant-words'), say`The drawing could not be compared (${reasonOf(error)}).`);
        }
    }

    async function measure() {
        const { rules, axiom: start, n: usual } = plant();
        const counts = Array.from({ length: usual + 4 }, (_, at) => at);
        setText(html('plant-words'), say`Measuring…`);
        await engineTime(0);
        const results = await time(counts.map((at) => ({ name: drawing.word, args: [start, rules, at], quiet: true })));
        /** @type {import('./pictures.js').Time[]} */
        const times = [];
        for (const at of counts) {
            const given = results[at];
            const symbols = Number(given?.value ?? Number.NaN);
            if (!given || given.fault || !Number.isFinite(symbols)) break;
            times.push({ n: at, symbols, own: given.ms, engine: symbols > MOST_SYMBOLS ? null : await engineTime(at) });
        }
        const isRight = times.every(({ n, symbols }) => TRUTH[drawing.word](start, rules, n).length === symbols);
        const words = isRight ? say`Both make words of the same length. The engine also compares them.` : '';
        setText(html('plant-words'), times.length === 0 ? say`There is no word to measure yet.` : words);
        html('times').replaceChildren(...(times.length > 0 ? timesOf(times) : []));
    }

    /** The engine's time for a word, which it derives and compares; null where it is not there. @param {number} at */
    async function engineTime(at) {
        const output = TRUTH[drawing.word]?.(plant().axiom, plant().rules, at);
        const start = performance.now();
        const definition = clean(/** @type {any} */ (definitionOf(plant(), drawing, at)));
        return tool.call('check', { definition, output }).then(
            () => performance.now() - start,
            () => null,
        );
    }

    choice.addEventListener('change', begin);
    steps.addEventListener('input', clear);
    button('ask-plant').addEventListener('click', explain);
    button('measure').addEventListener('click', measure);
    new ResizeObserver(() => isDrawn && paint()).observe(own);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', paint);
    requestAnimationFrame(() => {
        isDrawn = true;
        begin();
    });

    return {
        /** The calls that make the picture, after `before` others. @param {number} before @returns {Call[]} */
        calls: (before) => [
            { name: drawing.word, args: axiom() },
            { name: drawing.lines, args: [{ result: before }, ...drawing.values(plant())] },
        ],
        /** Shows the picture of a run. @param {import('./runner.js').Ran} ran @param {number} at the number of its first call */
        show(ran, at) {
            const [made, lines] = [resultOf(ran.results[at]), resultOf(ran.results[at + 1])];
            [word, result] = [typeof made === 'string' ? made : null, lines];
            const { lines: own, expected, from } = paint();
            const uses = [drawing.word, drawing.lines].filter((name) => !ran.own.includes(name));
            const is = own.length === expected.length && from < 0;
            setText(
                html('plant-words'),
                is
                    ? uses.length > 0
                        ? say`The same picture, with the given functions for what you have not written.`
                        : say`The same picture, by your own functions.`
                    : '',
            );
            button('ask-plant').hidden = is || own.length === 0;
        },
    };
}
