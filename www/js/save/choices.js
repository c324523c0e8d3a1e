/** The choices of the save dialog as values: what a file is for, its format, and the format's options. */

import { decimal } from '../base/numerals.js';
import { FILE_OPTIONS, FORMATS, PURPOSES, SHEETS } from '../late-tables.js';
import { createSettings } from '../state/rows.js';
import { counted, say } from '../base/words.js';

/** @typedef {import('../protocol.js').Format} Format */
/** @typedef {keyof typeof PURPOSES} Purpose */
/** @typedef {import('../late-tables.js').FileOption} FileOption */
/** The value of an option. A size is `WIDTHxHEIGHT`, or the longer side of a picture in the drawing's proportions, or empty for the drawing's size on the page. @typedef {boolean | number | string} Value */
/** A poster: the name of its sheet, and pixels per inch. @typedef {{sheet: string, landscape: boolean, dpi: number}} Poster */
/** @typedef {{purpose: Purpose, formats: Partial<Record<Purpose, string>>, values: Record<string, Value>, poster: Poster}} Choices */

/** The key in the storage. */
const KEY = 'save';

/** A format. @typedef {{name: Format, purposes: readonly Purpose[], label: string, help: string}} Row */

/** The purposes that have rows, in the order of the table, with their rows. @returns {{purpose: Purpose, label: string, rows: Row[]}[]} */
export function groupsOf() {
    const rows = /** @type {Row[]} */ (Object.entries(FORMATS).map(([name, format]) => ({ ...format, name })));
    const purposes = /** @type {[Purpose, string][]} */ (Object.entries(PURPOSES));
    return purposes
        .map(([purpose, label]) => ({ purpose, label, rows: rows.filter((row) => row.purposes.includes(purpose)) }))
        .filter((group) => group.rows.length > 0);
}

/** @param {string} name @returns {FileOption} */
export const optionOf = (name) =>
    /** @type {Readonly<Record<string, FileOption>>} */ (FILE_OPTIONS)[name] ?? {
        kind: 'flag',
        label: name,
        help: '',
        unit: '',
    };

/** The default of an option. @param {FileOption} option @returns {Value} */
export const defaultOf = (option) => (option.kind === 'flag' ? false : option.kind === 'size' ? '' : option.default);

/** Whether a value is possible. @param {FileOption} option @param {unknown} value @returns {value is Value} */
export function admits(option, value) {
    if (option.kind === 'flag') return typeof value === 'boolean';
    if (option.kind === 'number') return typeof value === 'number' && value >= option.low && value <= option.high;
    if (typeof value !== 'string') return false;
    if (option.kind === 'sheet') return value in option.words || sidesOf(value, option) !== null;
    return option.kind === 'word'
        ? value in option.words
        : value === '' || sizeOf(/^\d+$/.test(value) ? `${value}x1` : value, option) !== null;
}

/** The width and the height of a sheet of another size, in millimetres. @param {string} text @param {{low: number, high: number}} limits @returns {[number, number] | null} */
export function sidesOf(text, { low, high }) {
    const found = /^(\d+(?:\.\d+)?)x(\d+(?:\.\d+)?)$/.exec(text);
    const [width, height] = [Number(found?.[1]), Number(found?.[2])];
    return Math.min(width, height) >= low && Math.max(width, height) <= high ? [width, height] : null;
}

/** The width and the height of a valid size. @param {string} text @param {{most: number}} limits @returns {[number, number] | null} */
export function sizeOf(text, { most }) {
    const found = /^(\d{1,5})x(\d{1,5})$/.exec(text);
    const [width, height] = [Number(found?.[1] ?? 0), Number(found?.[2] ?? 0)];
    return Math.min(width, height) > 0 && Math.max(width, height) <= most ? [width, height] : null;
}

/** The width and the height of a picture. @param {Value | undefined} value @param {{width: number, height: number}} canvas @returns {string} */
export function pixelSize(value, { width, height }) {
    if (typeof value === 'string' && value.includes('x')) return value;
    const factor = value ? Number(value) / Math.max(width, height) : 1;
    return [width, height].map((side) => Math.max(1, Math.round(side * factor))).join('x');
}

/** The sheets and the resolutions of posters, which printers ask for. */
export const POSTERS = ['a4', 'a3', 'a2', 'a1', 'letter', 'tabloid'];
export const RESOLUTIONS = [150, 300];
/** Millimetres in an inch. */
const INCH = 25.4;

/** The sides of a poster in millimetres. @param {Poster} poster */
export function posterSides({ sheet, landscape }) {
    const [width = 210, height = 297] =
        /** @type {Readonly<Record<string, readonly number[]>>} */ (SHEETS)[sheet] ?? [];
    return landscape ? [height, width] : [width, height];
}

/** A poster's size in pixels and its resolution, as options of a picture. @param {Poster} poster @returns {Record<string, Value>} */
export const posterValues = (poster) => ({
    size: posterSides(poster)
        .map((side) => Math.round((side / INCH) * poster.dpi))
        .join('x'),
    dpi: poster.dpi,
});

/** The remembered choices, without what is no longer possible. @param {unknown} stored @param {ReturnType<typeof groupsOf>} groups @returns {Choices} */
export function choicesFrom(stored, groups) {
    const { purpose, formats, values, poster } = /** @type {Partial<Record<keyof Choices, any>>} */ (
        typeof stored === 'object' && stored ? stored : {}
    );
    const [first] = groups;
    if (!first) throw new Error('there are no formats');
    /** @type {Choices} */
    const choices = {
        purpose: (groups.find((group) => group.purpose === purpose) ?? first).purpose,
        formats: {},
        values: {},
        poster: {
            sheet: POSTERS.includes(poster?.sheet) ? poster.sheet : 'a3',
            landscape: poster?.landscape === true,
            dpi: RESOLUTIONS.includes(poster?.dpi) ? poster.dpi : 300,
        },
    };
    for (const group of groups) {
        const name = formats?.[group.purpose];
        if (group.rows.some((row) => row.name === name)) choices.formats[group.purpose] = name;
    }
    for (const [name, option] of Object.entries(FILE_OPTIONS)) {
        const value = values?.[name];
        if (admits(option, value)) choices.values[name] = value;
    }
    return choices;
}

/** The chosen row of the chosen purpose. @param {Choices} choices @param {ReturnType<typeof groupsOf>} groups @returns {Row} */
export function rowOf(choices, groups) {
    const rows = groups.find(({ purpose }) => purpose === choices.purpose)?.rows ?? [];
    const row = rows.find(({ name }) => name === choices.formats[choices.purpose]) ?? rows[0];
    if (!row) throw new Error(`there are no formats for ${choices.purpose}`);
    return row;
}

/** The options of a format that differ from their defaults. @param {Format} format @param {Choices} choices @returns {Record<string, Value>} */
export function valuesFor(format, { values }) {
    /** @type {[string, Value][]} */
    const chosen = FORMATS[format].options.map((name) => [name, values[name] ?? defaultOf(optionOf(name))]);
    return Object.fromEntries(chosen.filter(([name, value]) => value !== defaultOf(optionOf(name))));
}

/** The name of a file: formats such as `svg-compact` tell their form. @param {string} base @param {Format} format */
export function savedName(base, format) {
    const [, form] = format.split('-');
    return `${base}${form ? `_${form}` : ''}.${FORMATS[format].ending}`;
}

/** A size in bytes, in words. @param {number} bytes */
export function sizeWords(bytes) {
    if (bytes < 1000) return counted(bytes, '{} byte', '{} bytes');
    const power = Math.min(3, Math.floor(Math.log10(bytes) / 3));
    const value = bytes / 1000 ** power;
    const text = value < 9.95 ? decimal(value, 1) : Math.round(value);
    return power === 1 ? say`${text} kB` : power === 2 ? say`${text} MB` : say`${text} GB`;
}

/** The choices of the last time, as far as the browser stores them. @param {import('../state/storage.js').SafeStorage} storage */
export function rememberedChoices(storage) {
    const groups = groupsOf();
    const choices = choicesFrom(undefined, groups);
    const settings = createSettings(storage, KEY, take);
    function take() {
        Object.assign(choices, choicesFrom(settings.read(), groups));
        settings.show(choices);
    }
    take();
    return { groups, choices, remember: () => settings.write(choices) };
}
