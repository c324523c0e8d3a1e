/** A slider and a number field for one number of the state. */

import { input, make } from '../base/dom.js';
import { marked, plain } from '../base/numerals.js';
import { rangeOf } from '../state/state.js';
import { FIELDS } from '../tables.js';
import { numberField } from './number-field.js';
import { even, slider } from './slider.js';
import { said } from '../base/words.js';

/**
 * @param {import('../state/store.js').Store} store
 * @param {import('../state/state.js').FieldName} field
 * @param {string} id of the number field; the slider has the same id with `-slider`
 */
export function dial(store, field, id) {
    const { expected, label, unit = '', slider: scale } = FIELDS[field];
    const change = (/** @type {number} */ value, held = false) =>
        store.change({ [field]: value }, held ? `drag ${field}` : field);
    const settle = () => store.settle();
    const text = (/** @type {number} */ value) => `${marked(plain(value))} ${said(unit)}`.trim();
    const slide = slider(input(`${id}-slider`), {
        stops: stopsOf(field),
        open: Boolean(rangeOf(field).whole),
        text,
        change,
        settle,
    });
    const write = numberField(input(id), { ...rangeOf(field), expected, step: scale?.arrow ?? 1, change, settle });
    // A finger is wider than a stop of the slider.
    for (const sign of '−+') {
        const step = make('button', { class: 'button step', 'aria-label': `${said(label)} ${sign}` }, sign);
        const key = sign === '+' ? 'ArrowUp' : 'ArrowDown';
        step.addEventListener('click', () => input(id).dispatchEvent(new KeyboardEvent('keydown', { key })));
        input(id).closest('.lead')?.append(step);
    }

    return {
        /** @param {number} value */
        show(value) {
            slide.show(value);
            write(value);
        },
        limit: slide.limit,
    };
}

/** The values of a field's slider. @param {import('../state/state.js').FieldName} field */
export function stopsOf(field) {
    const { slider: scale } = FIELDS[field];
    if (!scale) return [];
    const stops = [scale.from];
    for (const [to = 0, by = 1] of scale.parts) {
        stops.push(...even(/** @type {number} */ (stops.at(-1)), to, by).slice(1));
    }
    return stops;
}
