/** A field for a number of the state. */

import { input } from '../base/dom.js';
import { rangeOf } from '../state/state.js';
import { FIELDS } from '../tables.js';
import { numberField } from './number-field.js';

/**
 * @param {import('../state/store.js').Store} store
 * @param {import('../tables.js').FieldName} field
 * @param {string} id
 * @param {number} step
 */
export const stateField = (store, field, id, step) =>
    numberField(input(id), {
        ...rangeOf(field),
        expected: FIELDS[field].expected,
        step,
        settle: store.settle,
        change: (value) => store.change({ [field]: value }, field),
    });
