/**
 * Words in the reader's language. The English text stands in the page and is the key of its translations, as in
 * gettext; `{}` in it stands for a value or an element. A translation may number them, from `{0}`, to put them in
 * another order. `lang/` has a folder for each language. Other modules wait for the words of this one, so that texts
 * can be used at once.
 */

import './settled.js';
import { carriedLanguage, jsonOf } from './files.js';
import { LANGUAGES } from '../languages.js';

/** The words of the language that is wanted; English if they do not come. */
export const ours = await catalogue(wanted());

/** The reader's language, a key of `LANGUAGES`, and all translations; none in English. */
export const { language, words } = ours;

const plurals = new Intl.PluralRules(language);
const whole = new Intl.NumberFormat(language, { maximumFractionDigits: 0 });

/** The language that a single file has inside, else that of the link, else the one that the reader chose, else the browser's first that there is. */
function wanted() {
    if (typeof document === 'undefined') return 'en';
    const link = new URLSearchParams(location.search).get('lang');
    const asked = [carriedLanguage(), link, kept(), ...navigator.languages];
    const codes = asked.map((name) => name?.toLowerCase().split('-')[0] ?? '');
    return codes.find((code) => Object.hasOwn(LANGUAGES, code)) ?? 'en';
}

/** The language that the reader chose on this page. */
function kept() {
    try {
        return localStorage.getItem('language');
    } catch {
        return null;
    }
}

/** @param {string} language @returns {Promise<import('../protocol.js').Catalogue>} */
async function catalogue(language) {
    const english = { language: 'en', words: {} };
    if (language === 'en') return english;
    try {
        // Some pages have words of their own besides.
        const files = ['words', document.documentElement?.dataset['catalogue'] ?? []].flat();
        const all = await Promise.all(files.map((file) => jsonOf(`lang/${language}/${file}.json`)));
        return { language, words: Object.assign({}, ...all) };
    } catch {
        // A page without its words is still a page.
        return english;
    }
}

/**
 * A sentence in the reader's language. Values are texts, or numbers that are written in the language's way.
 * @param {TemplateStringsArray} strings
 * @param {...(string | number)} values
 */
export function say(strings, ...values) {
    return fill(said(strings.join('{}')), values);
}

/**
 * The translation of a text from a table or a file, or the text itself.
 * @param {string} text
 */
export function said(text) {
    const entry = Object.hasOwn(words, text) ? words[text] : text;
    return typeof entry === 'string' ? entry : text;
}

/** Why something failed. @param {unknown} error */
export function reasonOf(error) {
    // Browsers say `Failed to fetch`.
    if (error instanceof TypeError && !navigator.onLine)
        return say`you are offline, and this part of the page is not kept on this device`;
    return error instanceof Error ? error.message : String(error);
}

/**
 * A text with a number in the form that the number needs; `{}` is the number, and others are the values.
 * @param {number | bigint} number
 * @param {string} one the English text for one
 * @param {string} other the English text for other numbers, the key of its translations
 * @param {...(string | number)} values
 */
export function counted(number, one, other, ...values) {
    const entry = Object.hasOwn(words, other) ? words[other] : { one, other };
    const form = typeof entry === 'object' ? (entry[plurals.select(Number(number))] ?? entry.other) : entry;
    return fill(form ?? other, [whole.format(number), ...values]);
}

/**
 * A text with its values.
 * @param {string} text
 * @param {readonly (string | number)[]} values
 */
function fill(text, values) {
    let next = 0;
    return text.replace(/\{(\d*)\}/g, (_, digits) => shown(values[digits === '' ? next++ : Number(digits)] ?? ''));
}

/**
 * A number as the reader's language writes it; other texts stay. What readers type and files have both kinds of marks.
 * @param {string | number} value
 */
export function shown(value) {
    return typeof value === 'number' ? value.toLocaleString(language) : value;
}

/** Puts the page's own words into the reader's language. */
export function translatePage() {
    const page = document.documentElement;
    page.lang = language;
    translate(page);
    delete page.dataset.words;
}

/** Elements whose texts are the same in all languages. */
export const SAME = 'script, style, svg, code, kbd, pre, textarea, [translate="no"]';
/** Attributes that are read to people. */
export const READ = ['title', 'aria-label', 'aria-roledescription', 'placeholder', 'alt'];

/**
 * Puts an element, and all in it, into the reader's language. An element's own text is one sentence, in which each
 * element inside is a `{}`.
 * @param {Element | Document | DocumentFragment} root of the page's own markup, never of data
 */
export function translate(root) {
    if (language === 'en') return;
    const inside = root.querySelectorAll('*');
    for (const element of 'matches' in root ? [root, ...inside] : inside) {
        const document = element.getAttribute('href')?.match(/^(docs\/[a-z-]+)\.html(#.*)?$/);
        if (document) element.setAttribute('href', `${document[1]}.${language}.html${document[2] ?? ''}`);
        for (const name of READ) {
            const text = element.getAttribute(name);
            if (text) element.setAttribute(name, said(text));
        }
        if (element.closest(SAME)) continue;
        const text = sentence(element);
        if (text === null) continue;
        const found = said(text);
        if (found !== text) compose(element, found);
    }
}

/**
 * The text that an element has itself, with `{}` for each element inside; null if it has none.
 * @param {Element} element
 */
export function sentence(element) {
    let text = '';
    for (const node of element.childNodes) {
        if (node.nodeType === 3) text += node.nodeValue;
        else if (node.nodeType === 1) text += '{}';
    }
    text = text.replace(/\s+/g, ' ').trim();
    return /\p{L}/u.test(text) ? text : null;
}

/**
 * Puts a sentence into an element, and the elements that it had to their places in it.
 * @param {Element} element
 * @param {string} text
 */
function compose(element, text) {
    const children = [...element.children];
    let next = 0;
    const parts = text.split(/(\{\d*\})/).map((part) => {
        const hole = /^\{(\d*)\}$/.exec(part);
        return hole ? (children[hole[1] === '' ? next++ : Number(hole[1])] ?? '') : part;
    });
    element.replaceChildren(...parts);
}
