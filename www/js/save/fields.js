/** The options of a format as fields, made from the table of options. */

import { make } from '../dom.js';
import { admits, defaultOf, optionOf, pixelSize, sizeOf } from './choices.js';

/** @typedef {import('./choices.js').Value} Value */
/** @typedef {import('./choices.js').FileOption} FileOption */

/** Longer sides that are offered, in pixels. */
const SIDES = [1024, 2048, 4096, 8192, 16_384];

/**
 * @param {object} dialog
 * @param {() => import('../protocol.js').Canvas} dialog.canvas
 * @param {(name: string) => number} dialog.most the most pixels along a side, for a format
 * @param {(name: string, value: Value) => void} dialog.choose
 */
export function optionFields({ canvas, most, choose }) {
    /** @param {string} name @param {FileOption} option @param {Value} value */
    function flag(name, option, value) {
        const box = make('input', { type: 'checkbox', id: `option-${name}`, checked: value === true });
        box.addEventListener('change', () => choose(name, box.checked));
        return make('label', { class: 'check', title: option.help }, box, make('span', {}, option.label));
    }

    /** @param {string} name @param {FileOption} option @param {...HTMLElement} fields */
    function row(name, option, ...fields) {
        return make('div', { class: 'save-option' }, make('label', { for: `option-${name}`, title: option.help }, option.label), ...fields);
    }

    /** @param {string} name @param {Extract<FileOption, {kind: 'word'}>} option @param {Value} value */
    function word(name, option, value) {
        const list = make('select', { id: `option-${name}` }, ...Object.entries(option.words).map(([each, label]) => make('option', { value: each }, label)));
        list.value = String(value);
        list.addEventListener('change', () => choose(name, list.value));
        return row(name, option, list);
    }

    /** @param {string} name @param {Extract<FileOption, {kind: 'number'}>} option @param {Value} value */
    function number(name, option, value) {
        let last = value;
        const field = make('input', { id: `option-${name}`, class: 'number', type: 'number', inputmode: 'decimal', min: String(option.low), max: String(option.high), step: String(option.step), value: String(value) });
        field.addEventListener('input', () => {
            const typed = field.value === '' ? NaN : Number(field.value);
            const isValid = admits(option, typed);
            field.toggleAttribute('data-wrong', !isValid);
            field.setAttribute('aria-invalid', String(!isValid));
            if (!isValid) return;
            last = typed;
            choose(name, typed);
        });
        // A value that is not possible gives way to the last one that is.
        field.addEventListener('change', () => {
            if (admits(option, field.value === '' ? NaN : Number(field.value))) return;
            field.value = String(last);
            field.removeAttribute('data-wrong');
            field.removeAttribute('aria-invalid');
        });
        return row(name, option, make('span', { class: 'save-number' }, field, ...(option.unit ? [make('span', { class: 'unit' }, option.unit)] : [])));
    }

    /** @param {string} format @param {string} name @param {Extract<FileOption, {kind: 'size'}>} option @param {Value} value */
    function size(format, name, option, value) {
        const limits = { most: Math.min(option.most, most(format)), mostPixels: option.mostPixels };
        const own = typeof value === 'string' && value.includes('x');
        const shown = canvas();
        const fits = (/** @type {number} */ side) => sizeOf(pixelSize(String(side), shown), limits) !== null;
        const offered = SIDES.filter(fits).map((side) => make('option', { value: String(side) }, pixelSize(String(side), shown).replace('x', ' × ')));
        const list = make('select', { id: `option-${name}` }, make('option', { value: '' }, `As on the page, ${pixelSize('', shown).replace('x', ' × ')}`), ...offered, make('option', { value: 'own' }, 'Other…'));
        list.value = own ? 'own' : String(value);
        const [wide = '', high = ''] = pixelSize(value, shown).split('x');
        /** @param {string} label @param {string} side */
        const side = (label, side) => make('input', { class: 'number', type: 'number', inputmode: 'numeric', min: '1', max: String(limits.most), 'aria-label': label, value: side });
        const sides = [side('Width, in pixels', wide), side('Height, in pixels', high)];
        const [width, height] = /** @type {[HTMLInputElement, HTMLInputElement]} */ (sides);
        const both = make('span', { class: 'save-sides' }, width, make('span', { 'aria-hidden': 'true' }, '×'), height, make('span', { class: 'unit' }, 'px'));
        both.hidden = !own;
        list.addEventListener('change', () => {
            both.hidden = list.value !== 'own';
            choose(name, list.value === 'own' ? `${width.value}x${height.value}` : list.value);
            if (list.value === 'own') width.focus();
        });
        for (const field of sides) {
            field.addEventListener('input', () => {
                const text = `${width.value}x${height.value}`;
                const isValid = sizeOf(text, limits) !== null;
                for (const each of sides) each.toggleAttribute('data-wrong', !isValid);
                note.hidden = isValid;
                if (isValid) choose(name, text);
            });
        }
        const note = make('p', { class: 'range-note', role: 'alert' }, `At most ${limits.most.toLocaleString('en')} pixels each way, and ${limits.mostPixels.toLocaleString('en')} in all.`);
        note.hidden = true;
        return make('div', {}, row(name, option, list), both, note);
    }

    return {
        /** The fields of some options. @param {string} format @param {readonly string[]} names @param {Record<string, Value>} values */
        of(format, names, values) {
            return names.map((name) => {
                const option = optionOf(name);
                const value = values[name] ?? defaultOf(option);
                switch (option.kind) {
                    case 'flag':
                        return flag(name, option, value);
                    case 'word':
                        return word(name, option, value);
                    case 'number':
                        return number(name, option, value);
                    case 'size':
                        return size(format, name, option, value);
                }
            });
        },
    };
}
