/** Labelled fields of the film's dialog. */

import { make } from '../base/dom.js';

/** A list of choices. @param {string} id @param {readonly (readonly [string, string])[]} choices @param {string} label */
export function choice(id, choices, label) {
    const select = make('select', { id }, ...choices.map(([value, words]) => make('option', { value }, words)));
    return { select, row: make('label', { class: 'film-option' }, label, select) };
}

/** A number. @param {string} id @param {string} label @param {Record<string, string>} attributes */
export function numberOption(id, label, attributes) {
    const field = make('input', { id, class: 'number', type: 'number', ...attributes });
    return { field, row: make('label', { class: 'film-option' }, label, field) };
}
