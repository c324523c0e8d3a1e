/**
 * The note on the drawing that says why a change is not drawn, with a remedy. It is shown while the same message in the
 * controls is out of sight.
 */

import { button, html, setText, withCode } from './dom.js';
import { applyFix, fixLabel, largestLabel } from './fix.js';
import { setLayer } from './layers.js';

/** @typedef {import('./protocol.js').Diagnostic} Diagnostic */
/** @typedef {import('./protocol.js').Report} Report */

/** Milliseconds without a keystroke before a text's mistake is shown on the drawing: half a rule is no mistake yet. */
const PAUSE = 900;
/** The time in which the browser tells whether the message in the controls is in sight, in milliseconds. */
const LAYOUT = 100;
/** A message in the controls is in sight from this height, in CSS pixels. */
const LEGIBLE = 36;

/** By field: the tab that holds it, its element, and the list of its messages. @type {Record<Diagnostic['field'], [string, string, string]>} */
const PLACES = {
    axiom: ['rules', 'axiom', 'axiom-problems'],
    rules: ['rules', 'rules', 'rules-problems'],
    overrides: ['turtle', 'overrides', 'overrides-problems'],
    numbers: ['rules', 'iterations', 'numbers-problems'],
    file: ['save', 'open-file', 'file-problems'],
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
    /** Whether the note is due, and whether the controls show its message already. */
    let due = false;
    let told = false;

    const watch = new IntersectionObserver(
        (entries) => {
            const last = entries.at(-1);
            if (!last) return;
            told =
                last.intersectionRect.height >= Math.min(LEGIBLE, last.boundingClientRect.height) &&
                last.isIntersecting;
            place();
        },
        { threshold: [0, 0.1, 0.25, 0.5, 0.75, 1] },
    );

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

    function place() {
        note.hidden = !due || told;
        setLayer(hide, !note.hidden);
    }

    function hide() {
        clearTimeout(timer);
        due = false;
        place();
    }

    /** @param {Diagnostic} found @param {number | null} largest */
    function show(found, largest) {
        html('refusal-words').replaceChildren(...withCode([`${found.message}.`, found.hint].filter(Boolean).join(' ')));
        const label =
            found.fix !== null
                ? fixLabel(found.fix)
                : found.field === 'numbers' && largest !== null
                  ? largestLabel(largest)
                  : '';
        act =
            found.fix !== null
                ? () => applyFix(store, found)
                : () => largest !== null && store.change({ iterations: largest }, '');
        remedy.hidden = label === '';
        setText(remedy, label);
        due = true;
        place();
    }

    return {
        hide,
        /** Shows the first mistake of a report, or nothing. @param {Report} report */
        report({ diagnostics, largest }) {
            clearTimeout(timer);
            mistake = diagnostics.find(({ severity }) => severity === 'error') ?? null;
            watch.disconnect();
            if (!mistake) return hide();
            const found = mistake;
            watch.observe(html(PLACES[found.field][2]));
            if (due) show(found, largest);
            else timer = setTimeout(show, found.field === 'numbers' ? LAYOUT : PAUSE, found, largest);
        },
    };
}
