/** The Rules section: axiom and productions. */

import { toast } from '../base/announce.js';
import { byId, html, setText } from '../base/dom.js';
import { applyFix } from '../base/fix.js';
import { editor } from '../controls/editor.js';
import { maxLengthOf } from '../state/state.js';
import { FIELDS } from '../tables.js';
import { said, say } from '../base/words.js';

/** @param {import('../state/store.js').Store} store */
export function rulesPanel(store) {
    const settle = () => store.settle();
    /** @param {import('../protocol.js').Diagnostic} diagnostic */
    const fix = (diagnostic) => applyFix(store, diagnostic);
    /** @param {'axiom' | 'rules'} field @param {string} text */
    const change = (field, text) => {
        store.change({ [field]: text }, field);
        if (text.length > maxLengthOf(field))
            toast(say`${said(FIELDS[field].label)} must be ${said(FIELDS[field].expected)}; the rest was cut.`);
    };
    const axiom = editor(byId('axiom', HTMLTextAreaElement), html('axiom-problems'), 'axiom', {
        change: (text) => change('axiom', text),
        settle,
        fix,
    });
    const rules = editor(byId('rules', HTMLTextAreaElement), html('rules-problems'), 'rules', {
        change: (text) => change('rules', text),
        settle,
        fix,
    });

    return {
        /** @param {import('../state/state.js').State} state */
        show(state) {
            axiom.show(state.axiom);
            rules.show(state.rules);
            setText(html('system-source'), state.source);
            setText(html('system-notes'), said(state.notes));
            html('about').hidden = state.source === '' && state.notes === '';
        },
        /** @param {import('../protocol.js').Notation} notation @param {import('../controls/notation.js').Texts} texts */
        read(notation, texts) {
            axiom.tint(notation.axiom, texts.axiom);
            rules.tint(notation.rules, texts.rules);
        },
        /**
         * Replaces the value of a constant; caret and selection stay.
         * @param {import('../protocol.js').ConstantSpan} constant
         * @param {string} value
         * @param {string} label of the change
         */
        rewrite({ start, end }, value, label) {
            store.change({ rules: rules.replace(start, end, value) }, label);
        },
        /** @param {import('../protocol.js').Report} report */
        report({ diagnostics }) {
            axiom.mark(diagnostics.filter(({ field }) => field === 'axiom'));
            rules.mark(diagnostics.filter(({ field }) => field === 'rules'));
        },
    };
}
