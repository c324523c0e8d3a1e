/** A slider and a number field for one number of the state. */

import { input } from '../dom.js';
import { plain } from '../numerals.js';
import { rangeOf } from '../state.js';
import { FIELDS } from '../tables.js';
import { numberField } from './number-field.js';
import { slider } from './slider.js';

/**
 * @param {import('../store.js').Store} store
 * @param {import('../state.js').FieldName} field
 * @param {string} id of the number field; the slider has the same id with `-slider`
 * @param {readonly number[]} [stops] the slider's values, if not those of the table
 */
export function dial(store, field, id, stops = stopsOf(field)) {
    const { expected, unit = '', slider: scale } = FIELDS[field];
    const change = (/** @type {number} */ value, held = false) =>
        store.change({ [field]: value }, held ? `drag ${field}` : field);
    const settle = () => store.settle();
    const text = (/** @type {number} */ value) => `${plain(value)} ${unit}`.trim();
    const slide = slider(input(`${id}-slider`), { stops, text, change, settle });
    const write = numberField(input(id), { ...rangeOf(field), expected, step: scale?.arrow ?? 1, change, settle });
    return {
        /** @param {number} value */
        show(value) {
            slide.show(value);
            write(value);
        },
        limit: slide.limit,
    };
}

/** The values of a field's slider. @param {import('../state.js').FieldName} field */
export function stopsOf(field) {
    const { slider: scale } = FIELDS[field];
    if (!scale) return [];
    const stops = [scale.from];
    for (const [to = 0, by = 1] of scale.parts) {
        const from = /** @type {number} */ (stops.at(-1));
        for (let at = 1; at <= Math.round((to - from) / by); at++) stops.push(Number((from + at * by).toFixed(6)));
    }
    return stops;
}
