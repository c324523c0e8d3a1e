/** The fields for what symbols mean: the dialect, custom symbols, and the turtle's heading at the start. */

import { byId, html, make, setChoice, setText } from '../base/dom.js';
import { applyFix } from '../base/fix.js';
import { editor } from '../controls/editor.js';
import { stateField } from '../controls/state-field.js';
import { DIALECTS } from '../tables.js';
import { said } from '../base/words.js';

/** @param {import('../state/store.js').Store} store */
export function symbolsFields(store) {
    const settle = () => store.settle();
    const dialect = byId('dialect', HTMLSelectElement);
    dialect.replaceChildren(
        ...Object.entries(DIALECTS).map(([name, { label }]) => make('option', { value: name }, said(label))),
    );
    dialect.addEventListener('change', () => {
        store.change({ dialect: /** @type {import('../state/state.js').Dialect} */ (dialect.value) }, '');
    });
    const overrides = editor(byId('overrides', HTMLTextAreaElement), html('overrides-problems'), 'overrides', {
        change: (text) => store.change({ overrides: text }, 'overrides'),
        settle,
        fix: (diagnostic) => applyFix(store, diagnostic),
    });
    const showHeading = stateField(store, 'heading', 'heading', 5);

    return {
        /** @param {Readonly<import('../state/state.js').State>} state */
        show(state) {
            setChoice(dialect, state.dialect);
            setText(html('dialect-note'), said(DIALECTS[state.dialect].help));
            overrides.show(state.overrides);
            showHeading(state.heading);
        },
        /** @param {import('../protocol.js').Notation} notation @param {import('../controls/notation.js').Texts} texts */
        read(notation, texts) {
            overrides.tint(notation.overrides, texts.overrides);
        },
        /** @param {import('../protocol.js').Report} report */
        report({ diagnostics }) {
            overrides.mark(diagnostics.filter(({ field }) => field === 'overrides'));
        },
    };
}
