/** Code for other pages: an iframe, the web component, or a link in Markdown. Pure functions, but for the address. */

import { isWhole } from '../base/files.js';
import { writeFields } from '../state/link.js';

/** @typedef {import('../state/state.js').State} State */
/**
 * How a drawing is embedded; `theme` is empty for the page's own, and the size is in CSS pixels.
 * @typedef {{controls: readonly string[], theme: string, width: number, height: number}} Embedding
 */

/** The sizes to choose from, by name. @type {Readonly<Record<string, readonly [number, number]>>} */
export const SIZES = { small: [320, 240], medium: [480, 360], large: [640, 480] };
/** The limits of a side, in CSS pixels. */
const SHORTEST = 200;
const LONGEST = 4000;

/**
 * The address of a file for pages elsewhere, which stays when the site changes. A page in a single file has its
 * neighbours beside it.
 * @param {string} file
 */
export function stable(file) {
    return new URL(isWhole() ? file : `v1/${file}`, location.href).href;
}

/** Kept apart from the brackets, because a literal script tag would end the script of a single-file page. */
const SCRIPT = 'script';

/** Attributes for link keys whose names already have a meaning in HTML. */
const ATTRIBUTES = new Map([
    ['title', 'caption'],
    ['width', 'stroke'],
]);

/** @param {Readonly<State>} state */
const titleOf = (state) => state.title || state.name || 'L-system';

/** A side as typed, within its limits; null if the text is no number. @param {string} text */
export function readSide(text) {
    const side = /^\s*\d+\s*$/.test(text) ? Number(text) : NaN;
    return Number.isNaN(side) ? null : Math.min(LONGEST, Math.max(SHORTEST, side));
}

/** The name of a size, or `custom`. @param {number} width @param {number} height */
export function sizeName(width, height) {
    return Object.entries(SIZES).find(([, size]) => size[0] === width && size[1] === height)?.[0] ?? 'custom';
}

/**
 * The address of an embedded drawing.
 * @param {string} link of the state, with its `#`
 * @param {string} page the address of embed.html
 * @param {Pick<Embedding, 'controls' | 'theme'>} embedding
 */
export function frameAddress(link, page, { controls, theme }) {
    return (
        page +
        link +
        (controls.length > 0 ? `&controls=${controls.join()}` : '') +
        (theme === '' ? '' : `&theme=${theme}`)
    );
}

/**
 * @param {Readonly<State>} state
 * @param {string} link of the state, with its `#`
 * @param {string} page the address of embed.html
 * @param {Embedding} embedding
 */
export function frameCode(state, link, page, embedding) {
    const { width, height } = embedding;
    return `<iframe src="${attribute(frameAddress(link, page, embedding))}" title="${attribute(titleOf(state))}" width="${width}" height="${height}" style="border: 0; max-width: 100%" loading="lazy" allowfullscreen></iframe>`;
}

/**
 * @param {Readonly<State>} state
 * @param {string} script the address of l-system.js
 * @param {Embedding} embedding
 */
export function elementCode(state, script, { controls, theme, width, height }) {
    const fields = writeFields(state, String).map(
        (field) =>
            /** @type {[string, string]} */ ([field.slice(0, field.indexOf('=')), field.slice(field.indexOf('=') + 1)]),
    );
    const attributes = fields
        .filter(([key]) => key !== 'rules')
        .map(([key, value]) => /** @type {[string, string]} */ ([ATTRIBUTES.get(key) ?? key, value]));
    if (controls.length > 0) attributes.push(['controls', controls.join()]);
    if (theme !== '') attributes.push(['theme', theme]);
    attributes.push(['style', `width: ${width}px; max-width: 100%; height: ${height}px; aspect-ratio: auto`]);
    const opening = ['<l-system', ...attributes.map(([key, value]) => `${key}="${attribute(value)}"`)].join(' ');
    // Pages without scripts show the rules.
    const rules = state.rules === '' ? '' : `<pre>\n${text(state.rules)}\n</pre>`;
    return `<${SCRIPT} src="${attribute(script)}" defer></${SCRIPT}>\n${opening}>${rules}</l-system>`;
}

/**
 * The element with an exercise, as high as it needs. Pages without scripts show a link.
 * @param {string} title
 * @param {string} address of the exercise, with its hash
 * @param {string} script the address of l-system.js
 * @param {number} width at most, in CSS pixels
 */
export function exerciseCode(title, address, script, width) {
    const hash = address.slice(address.indexOf('#'));
    return `<${SCRIPT} src="${attribute(script)}" defer></${SCRIPT}>\n<l-system link="${attribute(hash)}" aria-label="${attribute(title)}" style="max-width: ${width}px; aspect-ratio: auto"><a href="${attribute(address)}">${text(title)}</a></l-system>`;
}

/** A link with the title of the drawing. @param {Readonly<State>} state @param {string} address */
export function markdownCode(state, address) {
    const title = titleOf(state)
        .replace(/\s+/g, ' ')
        .replace(/[\\[\]`*_<>]/g, '\\$&');
    // A parenthesis would end the address.
    return `[${title}](${address.replaceAll('(', '%28').replaceAll(')', '%29')})`;
}

/** @param {string} value */
const text = (value) => value.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');

/** @param {string} value */
const attribute = (value) => text(value).replaceAll('"', '&quot;').replaceAll('\n', '&#10;');
