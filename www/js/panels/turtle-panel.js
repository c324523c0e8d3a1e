/** What symbols do, and where the turtle starts. */

import { byId, html, input, make, setChoice, setText } from '../dom.js';
import { editor } from '../controls/editor.js';
import { numberField, optionalField } from '../controls/number-field.js';
import { DIALECTS as NAMES } from '../state.js';
import { DIALECTS } from '../tables.js';

/** @typedef {import('../engine.js').Report} Report */

/** @param {import('../store.js').Store} store */
export function turtlePanel(store) {
    const settle = () => store.settle();
    const dialect = byId('dialect', HTMLSelectElement);
    dialect.replaceChildren(...Object.entries(DIALECTS).map(([name, { label }]) => make('option', { value: name }, label)));
    dialect.addEventListener('change', () => {
        const chosen = NAMES.find((name) => name === dialect.value);
        if (chosen) store.change({ dialect: chosen }, '');
    });
    const overrides = editor(byId('overrides', HTMLTextAreaElement), html('overrides-problems'), 'overrides', {
        change: (text) => store.change({ overrides: text }, 'overrides'),
        settle,
    });
    const showHeading = numberField(input('heading'), { low: -3600, high: 3600, step: 5, settle, change: (heading) => store.change({ heading }, 'heading') });
    const showStep = numberField(input('step'), { low: 1e-9, high: 1e9, step: 1, settle, change: (step) => store.change({ step }, 'step') });
    const showX = numberField(input('start-x'), { low: -1e9, high: 1e9, step: 1, settle, change: (x) => store.change({ start: [x, store.state.start[1]] }, 'start') });
    const showY = numberField(input('start-y'), { low: -1e9, high: 1e9, step: 1, settle, change: (y) => store.change({ start: [store.state.start[0], y] }, 'start') });

    const bends = html('bends');
    const angles = { low: -3600, high: 3600, step: 1, settle };
    const showDown = optionalField(input('pitch-down'), { ...angles, change: (pitchDown) => store.change({ pitchDown }, 'pitchDown') });
    const showUp = optionalField(input('pitch-up'), { ...angles, change: (pitchUp) => store.change({ pitchUp }, 'pitchUp') });
    const showLeft = optionalField(input('roll-left'), { ...angles, change: (rollLeft) => store.change({ rollLeft }, 'rollLeft') });
    const showRight = optionalField(input('roll-right'), { ...angles, change: (rollRight) => store.change({ rollRight }, 'rollRight') });
    const showElasticity = numberField(input('elasticity'), { low: -1000, high: 1000, step: 0.01, settle, change: (elasticity) => store.change({ elasticity }, 'elasticity') });
    const showPull = ['x', 'y', 'z'].map((axis, at) =>
        numberField(input(`tropism-${axis}`), {
            low: -1000,
            high: 1000,
            step: 0.1,
            settle,
            change: (value) => {
                const [x, y, z] = store.state.tropism;
                store.change({ tropism: [at === 0 ? value : x, at === 1 ? value : y, at === 2 ? value : z] }, 'tropism');
            },
        }),
    );
    /** Whether the drawing leaves the plane, and whether it bends. */
    let solid = false;
    let bent = false;

    /** Angles in space are shown where they matter, or were given. @param {import('../state.js').State} state */
    function showSpace({ angle, pitchDown, pitchUp, rollLeft, rollRight }) {
        html('space').hidden = !solid && [pitchDown, pitchUp, rollLeft, rollRight].every((value) => value === null);
        showDown(pitchDown, angle);
        showUp(pitchUp, pitchDown ?? angle);
        showLeft(rollLeft, angle);
        showRight(rollRight, rollLeft ?? angle);
    }

    /** What each row of the legend tells, to leave alone those that stay as they are. @type {string[]} */
    let told = [];
    /** @param {Report['legend']} legend */
    function showLegend(legend) {
        const rows = html('legend');
        const tells = legend.map((entry) => JSON.stringify(entry));
        while (rows.childElementCount > legend.length) rows.lastElementChild?.remove();
        legend.forEach((entry, at) => {
            if (tells[at] === told[at]) return;
            const [row, former] = [legendRow(entry), rows.children[at]];
            if (former) former.replaceWith(row);
            else rows.append(row);
        });
        told = tells;
    }

    return {
        /** @param {import('../state.js').State} state */
        show(state) {
            setChoice(dialect, state.dialect);
            setText(html('dialect-note'), DIALECTS[state.dialect].help);
            overrides.show(state.overrides);
            showHeading(state.heading);
            showStep(state.step);
            showX(state.start[0]);
            showY(state.start[1]);
            showSpace(state);
            showElasticity(state.elasticity);
            state.tropism.forEach((value, at) => showPull[at]?.(value));
            // What begins to bend is shown; the reader may close it again.
            if (state.elasticity !== 0 && !bent) bends.setAttribute('open', '');
            bent = state.elasticity !== 0;
        },
        /** @param {import('../engine.js').Notation} notation @param {import('../notation.js').Texts} texts */
        read(notation, texts) {
            overrides.tint(notation.overrides, texts.overrides);
        },
        /** @param {Report} report */
        report(report) {
            const { ok, legend, diagnostics } = report;
            overrides.mark(diagnostics.filter(({ field }) => field === 'overrides'));
            if (!ok) return;
            solid = report.solid;
            showSpace(store.state);
            showLegend(legend);
        },
    };
}

/** @param {Report['legend'][number]} entry */
function legendRow({ symbol, actions, rewritten }) {
    const words = actions || 'draws nothing';
    return make(
        'tr',
        {},
        make('th', { scope: 'row' }, make('kbd', {}, symbol === ' ' ? '␣' : symbol)),
        make('td', {}, words, ...(rewritten ? [make('span', { class: 'rewritten', title: 'A production rewrites it at each iteration' }, 'rewritten')] : [])),
    );
}
