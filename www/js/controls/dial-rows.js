/** Fills rows with a label, a slider and a number field, for the fields named in `data-field`. */

import { make } from '../base/dom.js';
import { FIELDS } from '../tables.js';
import { dial } from './dial.js';
import { said, say } from '../base/words.js';

/** Unit signs beside the field, by the unit's name. @type {Record<string, string>} */
const SIGNS = { degrees: '°', percent: '%', pixels: 'px' };

/** @param {import('../state/store.js').Store} store */
export function dialRows(store) {
    const rows = [...document.querySelectorAll('.dial[data-field]')].map((row) => {
        const field = /** @type {import('../state/state.js').FieldName} */ (row.getAttribute('data-field'));
        const id = field.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
        const { unit = '' } = FIELDS[field];
        const label = said(FIELDS[field].label);
        const number = make('input', { id, class: 'number', type: 'text', inputmode: 'decimal', autocomplete: 'off' });
        const sign = SIGNS[unit];
        row.append(
            make('label', { for: id }, label),
            make('input', { id: `${id}-slider`, type: 'range', 'aria-label': say`${label}, slider` }),
            sign
                ? make(
                      'span',
                      { class: 'with-unit' },
                      number,
                      make('span', { class: 'unit', 'aria-hidden': 'true' }, sign),
                  )
                : number,
        );
        return { field, control: dial(store, field, id) };
    });

    /** @param {import('../state/state.js').State} state */
    function show(state) {
        for (const { field, control } of rows) control.show(Number(state[field]));
    }
    return { show };
}
