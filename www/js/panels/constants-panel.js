/** A slider and a number field for each named constant; they edit the value in the rules. */

import { html, make, setText } from '../base/dom.js';
import { numberField } from '../controls/number-field.js';
import { needsNewScale, scaleAbout, writtenAs } from '../controls/scale.js';
import { slider } from '../controls/slider.js';
import { marked, plain } from '../base/numerals.js';
import { counted, say } from '../base/words.js';

/** @typedef {import('../protocol.js').ConstantSpan} ConstantSpan */
/** @typedef {{element: HTMLElement, name: string, number: boolean, show: (value: number | null) => void}} Row */

/** The maximum number of shown constants; others can be edited in the rules. */
const MAX_SHOWN = 40;

/**
 * The rows and the constants that they show.
 * @typedef {object} Panel
 * @property {import('../state/store.js').Store} store
 * @property {{rewrite: (constant: ConstantSpan, value: string, label: string) => void}} rules
 * @property {HTMLElement} group
 * @property {HTMLElement} list
 * @property {ConstantSpan[]} constants The constants in text order, and the rules with these constants
 * @property {string} text
 * @property {Row[]} rows
 * @property {number} serial
 * @property {boolean} held Whether a slider is being dragged; its scale must not change meanwhile
 */

/**
 * @param {import('../state/store.js').Store} store
 * @param {{rewrite: (constant: ConstantSpan, value: string, label: string) => void}} rules
 */
export function constantsPanel(store, rules) {
    /** @type {Panel} */
    const self = {
        store,
        rules,
        group: html('constants'),
        list: html('constants-list'),
        constants: [],
        text: '',
        rows: [],
        serial: 0,
        held: false,
    };

    return {
        /** @param {import('../protocol.js').Notation} notation @param {import('../controls/notation.js').Texts} texts */
        read(notation, texts) {
            if (texts.rules === store.state.rules) {
                self.constants = notation.constants;
                self.text = texts.rules;
                return show(self);
            }
            // The places of an older text are out of date, but its computed values are newer than the shown ones.
            for (const { name, value, number } of notation.constants) {
                if (!number) self.rows.find((row) => row.name === name && !row.number)?.show(value);
            }
        },
    };
}

/**
 * Writes a value into the rules.
 * @param {Panel} self
 * @param {string} name
 * @param {number} value
 * @param {string} label
 */
function set(self, name, value, label) {
    const at = self.constants.findIndex((constant) => constant.name === name);
    const constant = self.constants[at];
    // If the text has changed since, new places will come.
    if (!constant?.number || self.store.state.rules !== self.text) return;
    const written = writtenAs(value, self.text.slice(constant.start, constant.end));
    const grown = written.length - (constant.end - constant.start);
    self.rules.rewrite(constant, written, label);
    self.constants = self.constants.map((each, index) => {
        if (index === at) return { ...each, value, end: each.end + grown };
        return each.start > constant.start ? { ...each, start: each.start + grown, end: each.end + grown } : each;
    });
    self.text = self.store.state.rules;
    self.rows[at]?.show(value);
}

/** @param {Panel} self @param {ConstantSpan} constant @returns {Row} */
function newRow(self, { name, number, value }) {
    const id = `constant-${++self.serial}`;
    const label = make('label', { for: id }, make('code', {}, name));
    if (!number) {
        const output = make('output', { id, class: 'computed', title: say`Computed in the rules` });
        const element = make('div', { class: 'dial' }, label, output);
        return {
            element,
            name,
            number,
            show: (next) => setText(output, next === null ? '–' : marked(plain(next))),
        };
    }
    let stops = scaleAbout(value ?? 0);
    const range = make('input', { type: 'range', 'aria-label': say`${name}, slider` });
    const field = make('input', { id, class: 'number', type: 'text', autocomplete: 'off', spellcheck: 'false' });
    const settle = () => {
        self.held = false;
        self.store.settle();
        const now = self.constants.find((constant) => constant.name === name)?.value;
        if (now !== null && now !== undefined) show(now);
    };
    const scale = slider(range, {
        stops,
        text: (next) => `${name} = ${marked(plain(next))}`,
        change: (next) => {
            self.held = true;
            set(self, name, next, `drag ${name}`);
        },
        settle,
    });
    const showField = numberField(field, {
        low: -Number.MAX_VALUE,
        high: Number.MAX_VALUE,
        expected: say`a number`,
        step: () => /** @type {number} */ (stops[1]) - /** @type {number} */ (stops[0]),
        change: (next) => set(self, name, next, `constant ${name}`),
        settle,
    });

    /** @param {number} next */
    function show(next) {
        if (!self.held && needsNewScale(stops, next)) {
            stops = scaleAbout(next);
            scale.scale(stops);
        }
        scale.show(next);
        showField(next);
    }
    const element = make('div', { class: 'dial' }, label, range, field);
    return { element, name, number, show: (next) => next !== null && show(next) };
}

/** @param {Panel} self */
function show(self) {
    const shown = self.constants.slice(0, MAX_SHOWN);
    const fits =
        self.rows.length === shown.length &&
        self.rows.every(({ name, number }, at) => shown[at]?.name === name && shown[at]?.number === number);
    if (!fits) {
        const former = new Map(self.rows.map((row) => [`${row.name} ${row.number}`, row]));
        self.rows = shown.map(
            (constant) => former.get(`${constant.name} ${constant.number}`) ?? newRow(self, constant),
        );
        const kept = new Set(self.rows);
        for (const row of former.values()) if (!kept.has(row)) row.element.remove();
        // Moving an element takes away its focus, so elements in the right place are not moved.
        self.rows.forEach(({ element }, at) => {
            if (self.list.children[at] !== element) self.list.insertBefore(element, self.list.children[at] ?? null);
        });
    }
    shown.forEach(({ value }, at) => self.rows[at]?.show(value));
    self.group.hidden = shown.length === 0;
    const rest = self.constants.length - shown.length;
    setText(html('constants-rest'), rest > 0 ? counted(rest, '{} more in the rules.', '{} more in the rules.') : '');
}
