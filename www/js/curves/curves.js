/** The editors of the curves in the rules, and of those of leaves: a plot for each, whose points are the text's. */

import styles from '../../css/curves.css';
import { html, make } from '../base/dom.js';
import { addElements } from '../base/late.js';
import { say } from '../base/words.js';
import { curvesIn, written } from './curve.js';
import markup from './curves.html';
import { FRESH, PARTS, leavesIn, missingFrom, numbersOf, withCurve } from './leaf.js';
import { createPlot } from './plot.js';

/** The parts of a leaf, in words. @type {Readonly<Record<string, string>>} */
const WORDS = { outline: say`outline`, midrib: say`midrib`, margins: say`margins` };

/** @typedef {import('./curve.js').Point} Point */
/** A curve, with the change that gives it other points. @typedef {{name: string, label: string, points: readonly Point[], isLeaf: boolean, changed: (points: readonly Point[]) => {rules: string} | {surfaces: string}}} Editable */

/** @param {string} text @param {{start: number, end: number}} place @param {string} by */
const replaced = (text, { start, end }, by) => text.slice(0, start) + by + text.slice(end);

/** @param {{rules: string, surfaces: string}} state @returns {Editable[]} */
const editableIn = ({ rules, surfaces }) => [
    ...curvesIn(rules).map((curve) => ({
        name: curve.name,
        label: curve.name,
        points: curve.points,
        isLeaf: false,
        changed: (/** @type {readonly Point[]} */ points) => ({ rules: replaced(rules, curve, written(points)) }),
    })),
    ...leavesIn(surfaces).flatMap((leaf) =>
        PARTS.map((part, at) => ({
            name: `${leaf.name}: ${part}`,
            label: `${leaf.name}: ${WORDS[part]}`,
            points: leaf.curves[at] ?? [],
            isLeaf: true,
            changed: (/** @type {readonly Point[]} */ points) => ({
                surfaces: replaced(surfaces, leaf, numbersOf(withCurve(leaf.curves, at, points))),
            }),
        })),
    ),
];

/** @param {import('../dialogs/dialogs.js').Page} page */
export function createCurves({ store }) {
    const group = html('curves');
    addElements(markup, [styles], group);
    const list = html('curves-list');
    const leaves = html('curves-leaves');
    /** @type {import('./plot.js').Plot[]} */
    let plots = [];

    /** Writes points into the text. @param {string} name @param {readonly Point[]} points @param {boolean} held */
    function set(name, points, held) {
        const curve = editableIn(store.state).find((own) => own.name === name);
        if (curve) store.change(curve.changed(points), `${held ? 'drag ' : ''}curve ${name}`);
    }

    /** A button that makes a leaf for a surface without one. @param {string} name */
    function maker(name) {
        const add = make('button', { class: 'button quiet' }, say`Make a leaf for surface ${name}`);
        add.addEventListener('click', () => {
            const { surfaces } = store.state;
            store.change({ surfaces: `${surfaces && `${surfaces}\n`}${name}: ${numbersOf(FRESH)}` }, `leaf ${name}`);
        });
        return add;
    }

    function show() {
        const { overrides, surfaces } = store.state;
        const curves = editableIn(store.state);
        const missing = missingFrom(overrides, surfaces);
        group.hidden = curves.length + missing.length === 0;
        const fits = plots.length === curves.length && plots.every(({ name }, at) => curves[at]?.name === name);
        if (!fits) {
            plots = curves.map(({ name, label, isLeaf }) =>
                createPlot(name, label, {
                    change: (points, held) => set(name, points, held),
                    settle: () => store.settle(),
                    isFixed: isLeaf,
                }),
            );
            list.replaceChildren(...plots.map(({ element }) => element));
        }
        curves.forEach(({ points }, at) => plots[at]?.show(points));
        leaves.replaceChildren(...missing.map(maker));
    }

    store.subscribe((state, before) => {
        const { rules, overrides, surfaces } = before;
        if (state.rules !== rules || state.overrides !== overrides || state.surfaces !== surfaces) show();
    });
    show();
    return { open: show };
}
