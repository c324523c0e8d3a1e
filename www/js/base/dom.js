/** Helpers for a page whose elements stand in its HTML and are only updated. */

const SVG = 'http://www.w3.org/2000/svg';

/**
 * The element with this id; throws if the element is missing or has another type.
 * @template {Element} T
 * @param {string} id
 * @param {new (...args: any[]) => T} type
 * @returns {T}
 */
export function byId(id, type) {
    const element = document.getElementById(id);
    if (element instanceof type) return element;
    throw new Error(`The page has no ${type.name} #${id}`);
}

/** @param {string} id */
export const button = (id) => byId(id, HTMLButtonElement);
/** @param {string} id */
export const input = (id) => byId(id, HTMLInputElement);
/** @param {string} id */
export const html = (id) => byId(id, HTMLElement);

/**
 * A new element. Children that are strings become text, never markup. A button submits no form unless it says so.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, string | boolean>} [attributes] `true` sets an empty attribute, `false` none
 * @param {...(Node | string)} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function make(tag, attributes = {}, ...children) {
    const element = document.createElement(tag);
    if (tag === 'button') element.setAttribute('type', 'button');
    for (const [name, value] of Object.entries(attributes)) {
        if (value !== false) element.setAttribute(name, value === true ? '' : value);
    }
    element.append(...children);
    return element;
}

/** Text without its backquotes. @param {string} words */
export const withoutMarks = (words) => words.replace(/`([^`]+)`/g, '$1');

/** Sets text, with the parts between backquotes as code, only if it differs. @param {Element} element @param {string} words */
export function setWords(element, words) {
    if (element.textContent !== withoutMarks(words)) element.replaceChildren(...withCode(words));
}

/** Text as nodes, with the parts between backquotes as code. @param {string} words */
export function withCode(words) {
    return words
        .split(/(`[^`]+`)/)
        .map((part) => (part.length > 2 && part.startsWith('`') ? make('code', {}, part.slice(1, -1)) : part));
}

/**
 * A new element of a picture.
 * @template {keyof SVGElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, string | number>} attributes
 * @param {...(Node | string)} children
 * @returns {SVGElementTagNameMap[K]}
 */
export function svg(tag, attributes, ...children) {
    const element = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
    element.append(...children);
    return element;
}

/** An icon from the page's sprite. @param {string} id */
export const icon = (id) => svg('svg', { 'aria-hidden': 'true' }, svg('use', { href: `#${id}` }));

/** Tells which elements come into sight in a scrolling one, or soon will. @param {Element} root @param {(element: Element) => void} seen */
export const watchSight = (root, seen) =>
    new IntersectionObserver(
        (entries) => entries.forEach(({ isIntersecting, target }) => isIntersecting && seen(target)),
        { root, rootMargin: '120px' },
    );

/**
 * Sets text only if it differs, so that assistive technology does not read it twice.
 * @param {Element} element
 * @param {string} text
 */
export function setText(element, text) {
    if (element.textContent !== text) element.textContent = text;
}

/**
 * Sets a field's text, with the caret at the end of the change.
 * @param {HTMLInputElement | HTMLTextAreaElement} field
 * @param {string} text
 */
export function setValue(field, text) {
    const old = field.value;
    if (old === text) return;
    field.value = text;
    // A slider has no caret.
    if (document.activeElement !== field || field.selectionStart === null) return;
    let tail = 0;
    while (tail < Math.min(old.length, text.length) && old.at(-1 - tail) === text.at(-1 - tail)) tail++;
    field.setSelectionRange(text.length - tail, text.length - tail);
}

/**
 * Sets the choice only if it differs, because every change makes browsers search the whole form for fields to
 * autofill.
 * @param {HTMLSelectElement} element
 * @param {string} value
 */
export function setChoice(element, value) {
    if (element.value !== value) element.value = value;
}

/**
 * Lets a button in a dialog, and a click beside the dialog, close it.
 * @param {HTMLDialogElement} dialog
 * @param {string} id of the button
 */
export function closes(dialog, id) {
    button(id).addEventListener('click', () => dialog.close());
    dialog.addEventListener('click', (event) => {
        if (event.target === dialog) dialog.close();
    });
}

/** Whether the reader points with a finger. */
export const isTouch = () => matchMedia('(pointer: coarse)').matches;

/** Whether the reader prefers reduced motion. */
export const reducedMotion = () => matchMedia('(prefers-reduced-motion: reduce)').matches;
