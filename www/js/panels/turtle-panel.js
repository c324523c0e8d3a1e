/** What symbols do, and where the turtle starts. */

import { byId, html, input, make, setChoice, setText } from '../dom.js';
import { editor } from '../controls/editor.js';
import { numberField, optionalField } from '../controls/number-field.js';
import { rangeOf } from '../state.js';
import { DIALECTS, FIELDS } from '../tables.js';

/** @typedef {import('../engine.js').Report} Report */
/** @typedef {import('../state.js').FieldName} FieldName */

/** @param {import('../store.js').Store} store */
export function turtlePanel(store) {
    const settle = () => store.settle();
    const dialect = byId('dialect', HTMLSelectElement);
    dialect.replaceChildren(...Object.entries(DIALECTS).map(([name, { label }]) => make('option', { value: name }, label)));
    dialect.addEventListener('change', () => {
        store.change({ dialect: /** @type {import('../state.js').Dialect} */ (dialect.value) }, '');
    });
    const overrides = editor(byId('overrides', HTMLTextAreaElement), html('overrides-problems'), 'overrides', {
        change: (text) => store.change({ overrides: text }, 'overrides'),
        settle,
    });
    const showHeading = plainField('heading', 'heading', 5);
    const showStep = plainField('step', 'step', 1);
    const showStart = listFields('start', ['start-x', 'start-y'], 1);

    const bends = html('bends');
    const [showDown, showUp, showLeft, showRight] = [leftOut('pitchDown', 'pitch-down'), leftOut('pitchUp', 'pitch-up'), leftOut('rollLeft', 'roll-left'), leftOut('rollRight', 'roll-right')];
    const showElasticity = plainField('elasticity', 'elasticity', 0.01);
    const showPull = listFields('tropism', ['tropism-x', 'tropism-y', 'tropism-z'], 0.1);
    /** Whether the drawing leaves the plane, and whether it bends. */
    let solid = false;
    let bent = false;

    /** A number. @param {FieldName} field @param {string} id @param {number} step */
    function plainField(field, id, step) {
        return numberField(input(id), { ...rangeOf(field), wanted: FIELDS[field].wanted, step, settle, change: (value) => store.change({ [field]: value }, field) });
    }

    /** An angle that may be left out. @param {FieldName} field @param {string} id */
    function leftOut(field, id) {
        return optionalField(input(id), { ...rangeOf(field), wanted: FIELDS[field].wanted, step: 1, settle, change: (value) => store.change({ [field]: value }, field) });
    }

    /** The numbers of a list. @param {'start' | 'tropism'} field @param {string[]} ids @param {number} step */
    function listFields(field, ids, step) {
        const { wanted = '', ...range } = rangeOf(field);
        const show = ids.map((id, at) => numberField(input(id), { ...range, wanted, step, settle, change: (value) => store.change({ [field]: store.state[field].with(at, value) }, field) }));
        return (/** @type {readonly number[]} */ values) => values.forEach((value, at) => show[at]?.(value));
    }

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
            showStart(state.start);
            showSpace(state);
            showElasticity(state.elasticity);
            showPull(state.tropism);
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
