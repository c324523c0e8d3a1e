/** The fields for what symbols mean: the dialect, custom symbols, and the turtle's heading at the start. */

import { byId, html, input, make, setChoice, setText } from '../dom.js';
import { applyFix } from '../fix.js';
import { editor } from '../controls/editor.js';
import { numberField } from '../controls/number-field.js';
import { rangeOf } from '../state.js';
import { DIALECTS, FIELDS } from '../tables.js';
import { said } from '../words.js';

/** @param {import('../store.js').Store} store */
export function symbolsFields(store) {
    const settle = () => store.settle();
    const dialect = byId('dialect', HTMLSelectElement);
    dialect.replaceChildren(
        ...Object.entries(DIALECTS).map(([name, { label }]) => make('option', { value: name }, said(label))),
    );
    dialect.addEventListener('change', () => {
        store.change({ dialect: /** @type {import('../state.js').Dialect} */ (dialect.value) }, '');
    });
    const overrides = editor(byId('overrides', HTMLTextAreaElement), html('overrides-problems'), 'overrides', {
        change: (text) => store.change({ overrides: text }, 'overrides'),
        settle,
        fix: (diagnostic) => applyFix(store, diagnostic),
    });
    const showHeading = numberField(input('heading'), {
        ...rangeOf('heading'),
        expected: FIELDS.heading.expected,
        step: 5,
        settle,
        change: (heading) => store.change({ heading }, 'heading'),
    });

    return {
        /** @param {Readonly<import('../state.js').State>} state */
        show(state) {
            setChoice(dialect, state.dialect);
            setText(html('dialect-note'), said(DIALECTS[state.dialect].help));
            overrides.show(state.overrides);
            showHeading(state.heading);
        },
        /** @param {import('../protocol.js').Notation} notation @param {import('../notation.js').Texts} texts */
        read(notation, texts) {
            overrides.tint(notation.overrides, texts.overrides);
        },
        /** @param {import('../protocol.js').Report} report */
        report({ diagnostics }) {
            overrides.mark(diagnostics.filter(({ field }) => field === 'overrides'));
        },
    };
}
