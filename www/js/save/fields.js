/** The options of a format as fields, made from the table of options. */

import { make } from '../base/dom.js';
import { said, say, shown } from '../base/words.js';
import {
    POSTERS,
    RESOLUTIONS,
    admits,
    defaultOf,
    optionOf,
    pixelSize,
    posterSides,
    sidesOf,
    sizeOf,
} from './choices.js';
import { sheetOf } from './preview.js';

/** @typedef {import('./choices.js').Value} Value */
/** @typedef {import('./choices.js').FileOption} FileOption */

/** Longer sides that are offered, in pixels. */
const SIDES = [1024, 2048, 4096, 8192, 16_384, 32_768];

/** @type {[string, string][]} */
const ORIENTATIONS = [
    ['portrait', say`Portrait`],
    ['landscape', say`Landscape`],
];

/** The name of a sheet with its sides in millimetres and inches. @param {string} name */
function sheetWords(name) {
    const sides = posterSides({ sheet: name, landscape: false, dpi: 0 });
    const inches = sides.map((side) => shown(Math.round(side / 2.54) / 10));
    const label = name.length > 2 ? name.charAt(0).toUpperCase() + name.slice(1) : name.toUpperCase();
    return say`${said(label)}, ${sides.map(Math.round).join(' × ')} mm, ${inches.join(' × ')} in`;
}

/**
 * @param {object} dialog
 * @param {() => import('../protocol.js').Canvas} dialog.canvas
 * @param {(name: string, value: Value) => void} dialog.choose
 */
export function optionFields({ canvas, choose }) {
    return {
        /** The fields of a poster. @param {import('./choices.js').Poster} poster @param {(changed: Partial<import('./choices.js').Poster>) => void} change */
        poster: (poster, change) => [
            list(
                'poster-sheet',
                say`Sheet`,
                POSTERS.map((name) => [name, sheetWords(name)]),
                poster.sheet,
                (sheet) => change({ sheet }),
            ),
            list(
                'poster-orientation',
                say`Orientation`,
                ORIENTATIONS,
                poster.landscape ? 'landscape' : 'portrait',
                (chosen) => change({ landscape: chosen === 'landscape' }),
            ),
            list(
                'poster-dpi',
                say`Resolution`,
                RESOLUTIONS.map((dpi) => [String(dpi), say`${dpi} pixels per inch`]),
                String(poster.dpi),
                (dpi) => change({ dpi: Number(dpi) }),
            ),
        ],

        /** The fields of some options. @param {readonly string[]} names @param {Record<string, Value>} values */
        of(names, values) {
            const isFree = names.includes('portrait');
            return names
                .filter((name) => name !== 'portrait')
                .map((name) => {
                    if (name === 'landscape') return orientation(choose, isFree, values);
                    const option = optionOf(name);
                    const value = values[name] ?? defaultOf(option);
                    switch (option.kind) {
                        case 'flag':
                            return flag(choose, name, option, value);
                        case 'word':
                            return word(choose, name, option, value);
                        case 'number':
                            return number(choose, name, option, value);
                        case 'size':
                            return size(canvas, choose, name, option, value);
                        case 'sheet':
                            return sheet(choose, name, option, value);
                    }
                });
        },
    };
}

/**
 * @param {(name: string, value: Value) => void} choose
 * @param {string} name
 * @param {FileOption} option
 * @param {Value} value
 */
function flag(choose, name, option, value) {
    const box = make('input', { type: 'checkbox', id: `option-${name}`, checked: value === true });
    box.addEventListener('change', () => choose(name, box.checked));
    return make('label', { class: 'check', title: said(option.help) }, box, make('span', {}, said(option.label)));
}

/** @param {string} name @param {FileOption} option @param {...HTMLElement} fields */
function row(name, option, ...fields) {
    return make(
        'div',
        { class: 'save-option' },
        make('label', { for: `option-${name}`, title: said(option.help) }, said(option.label)),
        ...fields,
    );
}

/**
 * @param {(name: string, value: Value) => void} choose
 * @param {string} name
 * @param {Extract<FileOption, {kind: 'word'}>} option
 * @param {Value} value
 */
function word(choose, name, option, value) {
    const list = make(
        'select',
        { id: `option-${name}` },
        ...Object.entries(option.words).map(([each, label]) => make('option', { value: each }, said(label))),
    );
    list.value = String(value);
    list.addEventListener('change', () => choose(name, list.value));
    return row(name, option, list);
}

/**
 * @param {(name: string, value: Value) => void} choose
 * @param {string} name
 * @param {Extract<FileOption, {kind: 'number'}>} option
 * @param {Value} value
 */
function number(choose, name, option, value) {
    let last = value;
    const field = make('input', {
        id: `option-${name}`,
        class: 'number',
        type: 'number',
        inputmode: 'decimal',
        min: String(option.low),
        max: String(option.high),
        step: String(option.step),
        value: String(value),
    });
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
    return row(
        name,
        option,
        make(
            'span',
            { class: 'save-number' },
            field,
            ...(option.unit ? [make('span', { class: 'unit' }, said(option.unit))] : []),
        ),
    );
}

/**
 * A list of sizes, whose last entry shows fields for both sides.
 * @param {(name: string, value: Value) => void} choose
 * @param {string} name @param {FileOption} option
 * @param {{value: string, offered: [string, string][], sides: string[], unit: [string, string], step: string, isValid: (text: string) => boolean, range: string}} what
 *   `sides` are shown first; `unit` is long and short; `range` tells what is valid
 */
function sized(choose, name, option, { value, offered, sides, unit, step, isValid, range }) {
    const [long, short] = unit;
    const isOwn = !offered.some(([each]) => each === value);
    const list = make(
        'select',
        { id: `option-${name}` },
        ...[...offered, ['own', say`Other…`]].map(([each = '', label = '']) => make('option', { value: each }, label)),
    );
    list.value = isOwn ? 'own' : value;
    const fields = [say`Width, in ${long}`, say`Height, in ${long}`].map((side, at) =>
        make('input', {
            class: 'number',
            type: 'number',
            inputmode: 'decimal',
            min: '1',
            step,
            'aria-label': side,
            value: sides[at] ?? '',
        }),
    );
    const [width, height] = /** @type {[HTMLInputElement, HTMLInputElement]} */ (fields);
    const both = make(
        'span',
        { class: 'save-sides' },
        width,
        make('span', { 'aria-hidden': 'true' }, '×'),
        height,
        make('span', { class: 'unit' }, short),
    );
    const note = make('p', { class: 'range-note', role: 'alert' }, range);
    both.hidden = !isOwn;
    note.hidden = true;
    const text = () => `${width.value}x${height.value}`;
    function check() {
        const isFine = list.value !== 'own' || isValid(text());
        for (const field of fields) field.toggleAttribute('data-wrong', !isFine);
        note.hidden = isFine;
        if (isFine) choose(name, list.value === 'own' ? text() : list.value);
    }
    list.addEventListener('change', () => {
        both.hidden = list.value !== 'own';
        check();
        if (list.value === 'own') width.focus();
    });
    for (const field of fields) field.addEventListener('input', check);
    return make('div', {}, row(name, option, list), both, note);
}

/**
 * @param {() => import('../protocol.js').Canvas} canvas
 * @param {(name: string, value: Value) => void} choose
 * @param {string} name
 * @param {Extract<FileOption, {kind: 'size'}>} option
 * @param {Value} value
 */
function size(canvas, choose, name, option, value) {
    const shown = canvas();
    const words = (/** @type {string} */ size) => pixelSize(size, shown).replace('x', ' × ');
    const fits = SIDES.map(String).filter((side) => sizeOf(pixelSize(side, shown), option) !== null);
    return sized(choose, name, option, {
        value: String(value),
        offered: [
            ['', say`As on the page, ${words('')}`],
            ...fits.map((side) => /** @type {[string, string]} */ ([side, words(side)])),
        ],
        sides: pixelSize(value, shown).split('x'),
        unit: [say`pixels`, 'px'],
        step: '1',
        isValid: (text) => sizeOf(text, option) !== null,
        range: say`At most ${option.most} pixels each way.`,
    });
}

/**
 * @param {(name: string, value: Value) => void} choose
 * @param {string} name
 * @param {Extract<FileOption, {kind: 'sheet'}>} option
 * @param {Value} value
 */
function sheet(choose, name, option, value) {
    const { width, height } = sheetOf({ sheet: value });
    return sized(choose, name, option, {
        value: String(value),
        offered: Object.entries(option.words).map(([each, label]) => [each, said(label)]),
        sides: [String(width), String(height)],
        unit: [say`millimetres`, 'mm'],
        step: 'any',
        isValid: (text) => sidesOf(text, option) !== null,
        range: say`From ${option.low} to ${option.high} mm each way.`,
    });
}

/** @param {string} id @param {string} label @param {[string, string][]} words @param {string} value @param {(value: string) => void} change */
function list(id, label, words, value, change) {
    const element = make('select', { id }, ...words.map(([each, shown]) => make('option', { value: each }, shown)));
    element.value = value;
    element.addEventListener('change', () => change(element.value));
    return make('div', { class: 'save-option' }, make('label', { for: id }, label), element);
}

/**
 * Upright or on its side, as one choice of two flags; without `portrait`, a sheet is upright unless turned.
 * @param {(name: string, value: Value) => void} choose
 * @param {boolean} isFree
 * @param {Record<string, Value>} values
 */
function orientation(choose, isFree, values) {
    const value = values['landscape'] === true ? 'landscape' : isFree && values['portrait'] !== true ? '' : 'portrait';
    return list(
        'option-orientation',
        say`Orientation`,
        [...(isFree ? /** @type {[string, string][]} */ ([['', say`As the drawing`]]) : []), ...ORIENTATIONS],
        value,
        (chosen) => {
            choose('landscape', chosen === 'landscape');
            choose('portrait', chosen === 'portrait' && isFree);
        },
    );
}
