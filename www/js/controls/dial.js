/** A slider and a number field for the same number of the state. */

import { input } from '../dom.js';
import { plain } from '../numerals.js';
import { numberField } from './number-field.js';
import { even, slider } from './slider.js';

/** @typedef {{stops: readonly number[], text: (value: number) => string, low: number, high: number, step: number, whole?: boolean}} Dial `stops` and `text` of the slider, the rest of the field */

/** Half a turn under the slider, ten turns either way in the field. @type {Dial} */
export const DEGREES = { stops: even(0, 180, 0.5), text: (value) => `${plain(value)} degrees`, low: -3600, high: 3600, step: 1 };
/** What every branch multiplies something by. @type {Dial} */
export const FACTOR = { stops: even(0, 2, 0.05), text: (value) => `times ${plain(value)}`, low: 0, high: 10, step: 0.05 };

/**
 * @param {import('../store.js').Store} store
 * @param {keyof import('../state.js').State} field
 * @param {string} id of the number field; `-slider` behind it is the slider's
 * @param {Dial} range
 */
export function dial(store, field, id, range) {
    const change = (/** @type {number} */ value, held = false) => store.change({ [field]: value }, held ? `drag ${field}` : field);
    const settle = () => store.settle();
    const slide = slider(input(`${id}-slider`), { ...range, change, settle });
    const write = numberField(input(id), { ...range, change, settle });
    return {
        /** @param {number} value */
        show(value) {
            slide.show(value);
            write(value);
        },
        limit: slide.limit,
    };
}
