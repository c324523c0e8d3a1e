/** The editors of the curves in the rules: a plot for each, whose points are the text's. */

import styles from '../../css/curves.css';
import { html } from '../dom.js';
import { addElements } from '../late.js';
import { curvesIn, written } from './curve.js';
import markup from './curves.html';
import { createPlot } from './plot.js';

/** @typedef {import('./curve.js').Point} Point */

/** @param {import('../dialogs.js').Page} page */
export function createCurves({ store }) {
    const group = html('curves');
    addElements(markup, [styles], group);
    const list = html('curves-list');
    /** @type {import('./plot.js').Plot[]} */
    let plots = [];

    /** Writes points into the rules. @param {string} name @param {readonly Point[]} points @param {boolean} held */
    function set(name, points, held) {
        const { rules } = store.state;
        const curve = curvesIn(rules).find((own) => own.name === name);
        if (!curve) return;
        const label = `${held ? 'drag ' : ''}curve ${name}`;
        store.change({ rules: rules.slice(0, curve.start) + written(points) + rules.slice(curve.end) }, label);
    }

    function show() {
        const curves = curvesIn(store.state.rules);
        group.hidden = curves.length === 0;
        const fits = plots.length === curves.length && plots.every(({ name }, at) => curves[at]?.name === name);
        if (!fits) {
            plots = curves.map(({ name }) =>
                createPlot(name, { change: (points, held) => set(name, points, held), settle: () => store.settle() }),
            );
            list.replaceChildren(...plots.map(({ element }) => element));
        }
        curves.forEach(({ points }, at) => plots[at]?.show(points));
    }

    store.subscribe((state, before) => {
        if (state.rules !== before.rules) show();
    });
    show();
    return { open: show };
}
