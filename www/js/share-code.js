/** Embed code for other pages: an iframe or the web component. Pure functions. */

import { writeFields } from './link.js';

/** @typedef {import('./state.js').State} State */

/** The height of an embedded drawing, in CSS pixels. */
const HEIGHT = 420;
/** Kept apart from the brackets, because a literal script tag would end the script of a single-file page. */
const SCRIPT = 'script';

/** Attributes for link keys whose names already have a meaning in HTML. */
const ATTRIBUTES = new Map([
    ['title', 'caption'],
    ['width', 'stroke'],
]);

/** @param {Readonly<State>} state */
const titleOf = (state) => state.title || state.name || 'L-system';

/**
 * @param {Readonly<State>} state
 * @param {string} link of the state, with its `#`
 * @param {readonly string[]} controls
 * @param {string} page the address of embed.html
 */
export function frameCode(state, link, controls, page) {
    const source = page + link + (controls.length > 0 ? `&controls=${controls.join()}` : '');
    return `<iframe src="${attribute(source)}" title="${attribute(titleOf(state))}" width="100%" height="${HEIGHT}" style="border: 0" loading="lazy" allowfullscreen></iframe>`;
}

/**
 * @param {Readonly<State>} state
 * @param {readonly string[]} controls
 * @param {string} script the address of l-system.js
 */
export function elementCode(state, controls, script) {
    const fields = writeFields(state, String).map((field) => /** @type {[string, string]} */ ([field.slice(0, field.indexOf('=')), field.slice(field.indexOf('=') + 1)]));
    const attributes = fields.filter(([key]) => key !== 'rules').map(([key, value]) => /** @type {[string, string]} */ ([ATTRIBUTES.get(key) ?? key, value]));
    if (controls.length > 0) attributes.push(['controls', controls.join()]);
    const opening = ['<l-system', ...attributes.map(([key, value]) => `${key}="${attribute(value)}"`)].join(' ');
    // Pages without scripts show the rules.
    const rules = state.rules === '' ? '' : `<pre>\n${text(state.rules)}\n</pre>`;
    return `<${SCRIPT} src="${attribute(script)}" defer></${SCRIPT}>\n${opening}>${rules}</l-system>`;
}

/** @param {string} value */
const text = (value) => value.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');

/** @param {string} value */
const attribute = (value) => text(value).replaceAll('"', '&quot;').replaceAll('\n', '&#10;');
