/** The Turtle section: actions of symbols, and the start of the turtle. */

import { button, html, input, make, setText } from '../base/dom.js';
import { numberField, optionalField } from '../controls/number-field.js';
import { rangeOf } from '../state/state.js';
import { FIELDS } from '../tables.js';
import { stateField } from '../controls/state-field.js';
import { symbolsFields } from './symbols-fields.js';
import { say } from '../base/words.js';

/** @typedef {import('../engine/engine.js').Report} Report */
/** @typedef {import('../state/state.js').FieldName} FieldName */
/** @typedef {import('../state/state.js').State} State */

/** @param {import('../state/store.js').Store} store */
export function turtlePanel(store) {
    const symbols = symbolsFields(store);
    const showStep = stateField(store, 'step', 'step', 1);
    const showStart = listFields(store, 'start', ['start-x', 'start-y'], 1);

    const [showBends, showSways] = [opener('bends'), opener('sways')];
    const [showDown, showUp, showLeft, showRight] = [
        optionalAngle(store, 'pitchDown', 'pitch-down'),
        optionalAngle(store, 'pitchUp', 'pitch-up'),
        optionalAngle(store, 'rollLeft', 'roll-left'),
        optionalAngle(store, 'rollRight', 'roll-right'),
    ];
    const showElasticity = stateField(store, 'elasticity', 'elasticity', 0.01);
    const showPull = listFields(store, 'tropism', ['tropism-x', 'tropism-y', 'tropism-z'], 0.1);
    const showSway = listFields(store, 'sway', ['sway-strength', 'sway-phase'], 1);
    /** Whether the drawing is in space. */
    let space = false;

    /** Shows the angles in space if the drawing is in space or an angle is set. @param {import('../state/state.js').State} state */
    function showSpace({ angle, pitchDown, pitchUp, rollLeft, rollRight }) {
        html('space').hidden = !space && [pitchDown, pitchUp, rollLeft, rollRight].every((value) => value === null);
        showDown(pitchDown, angle);
        showUp(pitchUp, pitchDown ?? angle);
        showLeft(rollLeft, angle);
        showRight(rollRight, rollLeft ?? angle);
    }

    /** What makes an empty drawing draw. @type {Report['mend']} */
    let mend = null;
    button('mend').addEventListener('click', () => mend && store.change(/** @type {Partial<State>} */ (mend), ''));

    /** A key for each row of the legend, so that unchanged rows are not updated. @type {string[]} */
    let shownKeys = [];
    /** @param {Report['legend']} legend */
    function showLegend(legend) {
        const rows = html('legend');
        const keys = legend.map((entry) => JSON.stringify(entry));
        while (rows.childElementCount > legend.length) rows.lastElementChild?.remove();
        legend.forEach((entry, at) => {
            if (keys[at] === shownKeys[at]) return;
            const [row, former] = [legendRow(entry), rows.children[at]];
            if (former) former.replaceWith(row);
            else rows.append(row);
        });
        shownKeys = keys;
    }

    return {
        /** @param {import('../state/state.js').State} state */
        show(state) {
            symbols.show(state);
            showStep(state.step);
            showStart(state.start);
            showSpace(state);
            showElasticity(state.elasticity);
            showPull(state.tropism);
            showSway(state.sway);
            showBends(state.elasticity !== 0);
            showSways(state.sway[0] !== 0);
        },
        read: symbols.read,
        /** @param {Report} report */
        report(report) {
            const { ok, legend } = report;
            symbols.report(report);
            if (!ok) return;
            space = report.space;
            showSpace(store.state);
            showLegend(legend);
            showHint(store, legend);
            ({ mend } = report);
            button('mend').hidden = !mend;
            const n = mend && 'iterations' in mend ? mend.iterations : null;
            setText(button('mend'), n === null ? say`Let every letter draw` : say`Show generation ${n}`);
        },
    };
}

/**
 * A field for an optional angle.
 * @param {import('../state/store.js').Store} store
 * @param {FieldName} field
 * @param {string} id
 */
function optionalAngle(store, field, id) {
    return optionalField(input(id), {
        ...rangeOf(field),
        expected: FIELDS[field].expected,
        step: 1,
        settle: store.settle,
        change: (value) => store.change({ [field]: value }, field),
    });
}

/**
 * Fields for the numbers of a list.
 * @param {import('../state/store.js').Store} store
 * @param {'start' | 'tropism' | 'sway'} field
 * @param {string[]} ids
 * @param {number} step
 */
function listFields(store, field, ids, step) {
    const { expected = '', ...range } = rangeOf(field);
    const show = ids.map((id, at) =>
        numberField(input(id), {
            ...range,
            expected,
            step,
            settle: store.settle,
            change: (value) => store.change({ [field]: store.state[field].with(at, value) }, field),
        }),
    );
    return (/** @type {readonly number[]} */ values) => values.forEach((value, at) => show[at]?.(value));
}

/**
 * Tells letters that draw nothing, which many courses let draw.
 * @param {import('../state/store.js').Store} store
 * @param {Report['legend']} legend
 */
function showHint(store, legend) {
    const silent = legend
        .filter(({ symbol, idle }) => idle && /^[A-Za-z]/.test(symbol))
        .map(({ symbol }) => symbol.charAt(0));
    html('legend-hint').hidden = silent.length === 0 || store.state.dialect === 'every-letter';
    const [names, last = ''] = [silent.slice(0, -1).join(', '), silent.at(-1)];
    setText(
        html('legend-hint'),
        names
            ? say`${names} and ${last} draw nothing (course assignments: every letter draws).`
            : say`${last} draws nothing (course assignments: every letter draws).`,
    );
}

/** Opens fields when their effect begins; the reader may close them. @param {string} id */
function opener(id) {
    let begun = false;
    return (/** @type {boolean} */ acts) => {
        if (acts && !begun) html(id).setAttribute('open', '');
        begun = acts;
    };
}

/** @param {Report['legend'][number]} entry */
function legendRow({ symbol, actions, rewritten }) {
    return make(
        'tr',
        {},
        make('th', { scope: 'row' }, make('kbd', {}, symbol === ' ' ? '␣' : symbol)),
        make(
            'td',
            {},
            actions,
            ...(rewritten
                ? [
                      make(
                          'span',
                          { class: 'rewritten', title: say`A rule rewrites this symbol at each iteration` },
                          say`rewritten`,
                      ),
                  ]
                : []),
        ),
    );
}
