/** What symbols do, and where the turtle starts. */

import { byId, html, input, make, setText } from '../dom.js';
import { editor } from '../controls/editor.js';
import { numberField } from '../controls/number-field.js';
import { DIALECTS } from '../state.js';

/** @type {Record<import('../state.js').Dialect, string>} */
const DIALECT_NOTES = {
    abop: 'F and G draw, f and g move; + and − turn, | turns round, [ and ] branch; ! thins and # thickens the stroke, \' and ; step through the colours. In space & and ^ pitch down and up, \\ and / roll left and right, and $ rolls upright. Other symbols do nothing.',
    'every-letter': 'Every symbol draws one step, except + and −, which turn, and [ and ], which branch.',
    practical: 'F and G draw; + turns left and − turns right, each by its own angle; in space > and < pitch down and up, & and ^ roll left and right; [ and ] branch. Other symbols do nothing.',
    lowercase: 'Every lower-case letter draws; + turns left and takes the second colour, − turns right and takes the third; [ and ] branch.',
    axes: 'F draws; > and < turn left and right, v and ^ pitch up and down, + and − roll left and right: turns about the z, x and y axes of a turtle that goes along its y; [ and ] branch. Other symbols do nothing.',
};

/** @param {import('../store.js').Store} store */
export function turtlePanel(store) {
    const settle = () => store.settle();
    const dialect = byId('dialect', HTMLSelectElement);
    dialect.addEventListener('change', () => {
        const chosen = DIALECTS.find((name) => name === dialect.value);
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

    let shown = '';
    return {
        /** @param {import('../state.js').State} state */
        show(state) {
            dialect.value = state.dialect;
            setText(html('dialect-note'), DIALECT_NOTES[state.dialect]);
            overrides.show(state.overrides);
            showHeading(state.heading);
            showStep(state.step);
            showX(state.start[0]);
            showY(state.start[1]);
        },
        /** @param {import('../engine.js').Notation} notation @param {import('../notation.js').Texts} texts */
        read(notation, texts) {
            overrides.tint(notation.overrides, texts.overrides);
        },
        /** @param {import('../engine.js').Report} report */
        report({ ok, legend, diagnostics }) {
            overrides.mark(diagnostics.filter(({ field }) => field === 'overrides'));
            if (!ok) return;
            const key = JSON.stringify(legend);
            if (key === shown) return;
            shown = key;
            html('legend').replaceChildren(...legend.map(legendRow));
        },
    };
}

/** @param {import('../engine.js').Report['legend'][number]} entry */
function legendRow({ symbol, actions, rewritten }) {
    const words = (Array.isArray(actions) ? actions.join(', ') : actions) || 'draws nothing';
    return make(
        'tr',
        {},
        make('th', { scope: 'row' }, make('kbd', {}, symbol === ' ' ? '␣' : symbol)),
        make('td', {}, words, ...(rewritten ? [make('span', { class: 'rewritten', title: 'A production rewrites it at each iteration' }, 'rewritten')] : [])),
    );
}
