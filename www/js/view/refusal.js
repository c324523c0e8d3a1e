/**
 * The note on the drawing that says why a change is not drawn, with a remedy. It is shown while the same message in the
 * controls is out of sight.
 */

import { button, html, setText, withCode } from '../base/dom.js';
import { applyFix, fixLabel, largestLabel } from '../base/fix.js';
import { setLayer } from '../base/layers.js';

/** @typedef {import('../protocol.js').Diagnostic} Diagnostic */
/** @typedef {import('../protocol.js').Report} Report */

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
 * The note and the mistake that it tells.
 * @typedef {object} Refusal
 * @property {() => void} close hides the note: the same function each time, as layers want it
 * @property {import('../state/store.js').Store} store
 * @property {HTMLElement} note
 * @property {HTMLButtonElement} remedy
 * @property {ReturnType<typeof setTimeout> | undefined} timer
 * @property {() => unknown} act
 * @property {boolean} due Whether the note is due, and whether the controls show its message already
 * @property {boolean} told
 */

/**
 * @param {import('../state/store.js').Store} store
 * @param {{open: (tab: string) => void}} tabs
 */
export function createRefusal(store, tabs) {
    /** @type {Refusal} */
    const self = {
        close: () => hide(self),
        store,
        note: html('refusal'),
        remedy: button('refusal-fix'),
        timer: undefined,
        act: () => {},
        due: false,
        told: false,
    };

    /** @type {Diagnostic | null} */
    let mistake = null;

    const watch = new IntersectionObserver(
        (entries) => {
            const last = entries.at(-1);
            if (!last) return;
            self.told =
                last.intersectionRect.height >= Math.min(LEGIBLE, last.boundingClientRect.height) &&
                last.isIntersecting;
            place(self);
        },
        { threshold: [0, 0.1, 0.25, 0.5, 0.75, 1] },
    );

    self.remedy.addEventListener('click', () => {
        hide(self);
        self.act();
    });
    button('refusal-close').addEventListener('click', () => hide(self));
    button('refusal-show').addEventListener('click', () => {
        if (!mistake) return;
        const [tab, id] = PLACES[mistake.field];
        tabs.open(tab);
        const field = html(id);
        field.focus();
        if (field instanceof HTMLTextAreaElement)
            field.setSelectionRange(mistake.start, Math.max(mistake.end, mistake.start));
    });

    return {
        hide: () => hide(self),
        /** Shows the first mistake of a report, or nothing. @param {Report} report */
        report({ diagnostics, largest }) {
            clearTimeout(self.timer);
            mistake = diagnostics.find(({ severity }) => severity === 'error') ?? null;
            watch.disconnect();
            if (!mistake) return hide(self);
            const found = mistake;
            watch.observe(html(PLACES[found.field][2]));
            if (self.due) show(self, found, largest);
            else
                self.timer = setTimeout(
                    (found, largest) => show(self, found, largest),
                    found.field === 'numbers' ? LAYOUT : PAUSE,
                    found,
                    largest,
                );
        },
    };
}

/** @param {Refusal} self */
function place(self) {
    self.note.hidden = !self.due || self.told;
    setLayer(self.close, !self.note.hidden);
}

/** @param {Refusal} self */
function hide(self) {
    clearTimeout(self.timer);
    self.due = false;
    place(self);
}

/** @param {Refusal} self @param {Diagnostic} found @param {number | null} largest */
function show(self, found, largest) {
    html('refusal-words').replaceChildren(...withCode([`${found.message}.`, found.hint].filter(Boolean).join(' ')));
    const label =
        found.fix !== null
            ? fixLabel(found.fix)
            : found.field === 'numbers' && largest !== null
              ? largestLabel(largest)
              : '';
    self.act =
        found.fix !== null
            ? () => applyFix(self.store, found)
            : () => largest !== null && self.store.change({ iterations: largest }, '');
    self.remedy.hidden = label === '';
    setText(self.remedy, label);
    self.due = true;
    place(self);
}
