/** A slider and a number field for each named constant; they edit the value in the rules. */

import { html, make, setText } from '../dom.js';
import { numberField } from '../controls/number-field.js';
import { needsNewScale, scaleAbout, writtenAs } from '../controls/scale.js';
import { slider } from '../controls/slider.js';
import { marked, plain } from '../numerals.js';
import { counted, say } from '../words.js';

/** @typedef {import('../protocol.js').ConstantSpan} ConstantSpan */
/** @typedef {{element: HTMLElement, name: string, number: boolean, show: (value: number | null) => void}} Row */

/** The maximum number of shown constants; others can be edited in the rules. */
const MAX_SHOWN = 40;

/**
 * @param {import('../store.js').Store} store
 * @param {{rewrite: (constant: ConstantSpan, value: string, label: string) => void}} rules
 */
export function constantsPanel(store, rules) {
    const group = html('constants');
    const list = html('constants-list');
    /** The constants in text order, and the rules with these constants. @type {ConstantSpan[]} */
    let constants = [];
    let text = '';
    /** @type {Row[]} */
    let rows = [];
    let serial = 0;
    /** Whether a slider is being dragged; its scale must not change meanwhile. */
    let held = false;

    /** Writes a value into the rules. @param {string} name @param {number} value @param {string} label */
    function set(name, value, label) {
        const at = constants.findIndex((constant) => constant.name === name);
        const constant = constants[at];
        // If the text has changed since, new places will come.
        if (!constant?.number || store.state.rules !== text) return;
        const written = writtenAs(value, text.slice(constant.start, constant.end));
        const grown = written.length - (constant.end - constant.start);
        rules.rewrite(constant, written, label);
        constants = constants.map((each, index) => {
            if (index === at) return { ...each, value, end: each.end + grown };
            return each.start > constant.start ? { ...each, start: each.start + grown, end: each.end + grown } : each;
        });
        text = store.state.rules;
        rows[at]?.show(value);
    }

    /** @param {ConstantSpan} constant @returns {Row} */
    function newRow({ name, number, value }) {
        const id = `constant-${++serial}`;
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
            held = false;
            store.settle();
            const now = constants.find((constant) => constant.name === name)?.value;
            if (now !== null && now !== undefined) show(now);
        };
        const scale = slider(range, {
            stops,
            text: (next) => `${name} = ${marked(plain(next))}`,
            change: (next) => {
                held = true;
                set(name, next, `drag ${name}`);
            },
            settle,
        });
        const showField = numberField(field, {
            low: -Number.MAX_VALUE,
            high: Number.MAX_VALUE,
            expected: say`a number`,
            step: () => /** @type {number} */ (stops[1]) - /** @type {number} */ (stops[0]),
            change: (next) => set(name, next, `constant ${name}`),
            settle,
        });

        /** @param {number} next */
        function show(next) {
            if (!held && needsNewScale(stops, next)) {
                stops = scaleAbout(next);
                scale.scale(stops);
            }
            scale.show(next);
            showField(next);
        }
        const element = make('div', { class: 'dial' }, label, range, field);
        return { element, name, number, show: (next) => next !== null && show(next) };
    }

    function show() {
        const shown = constants.slice(0, MAX_SHOWN);
        const fits =
            rows.length === shown.length &&
            rows.every(({ name, number }, at) => shown[at]?.name === name && shown[at]?.number === number);
        if (!fits) {
            const former = new Map(rows.map((row) => [`${row.name} ${row.number}`, row]));
            rows = shown.map((constant) => former.get(`${constant.name} ${constant.number}`) ?? newRow(constant));
            const kept = new Set(rows);
            for (const row of former.values()) if (!kept.has(row)) row.element.remove();
            // Moving an element takes away its focus, so elements in the right place are not moved.
            rows.forEach(({ element }, at) => {
                if (list.children[at] !== element) list.insertBefore(element, list.children[at] ?? null);
            });
        }
        shown.forEach(({ value }, at) => rows[at]?.show(value));
        group.hidden = shown.length === 0;
        const rest = constants.length - shown.length;
        setText(
            html('constants-rest'),
            rest > 0 ? counted(rest, '{} more in the rules.', '{} more in the rules.') : '',
        );
    }

    return {
        /** @param {import('../protocol.js').Notation} notation @param {import('../notation.js').Texts} texts */
        read(notation, texts) {
            if (texts.rules === store.state.rules) {
                constants = notation.constants;
                text = texts.rules;
                return show();
            }
            // The places of an older text are out of date, but its computed values are newer than the shown ones.
            for (const { name, value, number } of notation.constants) {
                if (!number) rows.find((row) => row.name === name && !row.number)?.show(value);
            }
        },
    };
}
