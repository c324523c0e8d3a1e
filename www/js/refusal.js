/** The note on the drawing that says why a change is not drawn, with a remedy. */

import { button, html, setText, withCode } from './dom.js';
import { applyFix, fixLabel } from './fix.js';
import { setLayer } from './layers.js';

/** @typedef {import('./protocol.js').Diagnostic} Diagnostic */
/** @typedef {import('./protocol.js').Report} Report */

/** Milliseconds without a keystroke before a text's mistake is shown on the drawing: half a rule is no mistake yet. */
const PAUSE = 900;

/** By field: the tab that holds it, and its element. @type {Record<Diagnostic['field'], [string, string]>} */
const PLACES = {
    axiom: ['rules', 'axiom'],
    rules: ['rules', 'rules'],
    overrides: ['turtle', 'overrides'],
    numbers: ['rules', 'iterations'],
    file: ['save', 'open-file'],
};

/**
 * @param {import('./store.js').Store} store
 * @param {{open: (tab: string) => void}} tabs
 */
export function createRefusal(store, tabs) {
    const note = html('refusal');
    const remedy = button('refusal-fix');
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    let timer;
    let act = () => {};
    /** @type {Diagnostic | null} */
    let mistake = null;

    remedy.addEventListener('click', () => {
        hide();
        act();
    });
    button('refusal-close').addEventListener('click', hide);
    button('refusal-show').addEventListener('click', () => {
        if (!mistake) return;
        const [tab, id] = PLACES[mistake.field];
        tabs.open(tab);
        const field = html(id);
        field.focus();
        if (field instanceof HTMLTextAreaElement)
            field.setSelectionRange(mistake.start, Math.max(mistake.end, mistake.start));
    });

    function hide() {
        clearTimeout(timer);
        note.hidden = true;
        setLayer(hide, false);
    }

    /** @param {Diagnostic} found @param {number | null} largest */
    function show(found, largest) {
        html('refusal-words').replaceChildren(...withCode([`${found.message}.`, found.hint].filter(Boolean).join(' ')));
        const label =
            found.fix !== null
                ? fixLabel(found.fix)
                : found.field === 'numbers' && largest !== null
                  ? `Use ${largest} ${largest === 1 ? 'iteration' : 'iterations'}`
                  : '';
        act =
            found.fix !== null
                ? () => applyFix(store, found)
                : () => largest !== null && store.change({ iterations: largest }, '');
        remedy.hidden = label === '';
        setText(remedy, label);
        if (note.hidden) setLayer(hide, true);
        note.hidden = false;
    }

    return {
        hide,
        /** Shows the first mistake of a report, or nothing. @param {Report} report */
        report({ diagnostics, largest }) {
            clearTimeout(timer);
            mistake = diagnostics.find(({ severity }) => severity === 'error') ?? null;
            if (!mistake) return hide();
            const found = mistake;
            if (found.field === 'numbers' || !note.hidden) show(found, largest);
            else timer = setTimeout(show, PAUSE, found, largest);
        },
    };
}
