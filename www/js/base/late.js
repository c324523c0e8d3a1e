/** Parts of the page that load when they are first needed: scripts that bring their elements and styles as texts. */

import { toast } from './announce.js';
import { isWhole } from './files.js';
import { reasonOf, say, translate } from './words.js';

/** The styles on the page so far. @type {Set<string>} */
const styled = new Set();

/**
 * Makes a function that loads a part with its first call. It tells why a part could not be loaded, and the next call
 * tries again.
 * @template T
 * @param {() => Promise<T>} load
 * @returns {() => Promise<T | null>} null for a part that could not be loaded
 */
export function createLate(load) {
    /** @type {Promise<T> | null} */
    let loading = null;
    return async () => {
        try {
            return await (loading ??= load());
        } catch (error) {
            loading = null;
            toast(say`This part of the page could not be loaded (${reasonOf(error)}).`);
            return null;
        }
    };
}

/**
 * Adds a part's elements and styles to the page. Both are texts of the source, never data.
 * @param {string} markup
 * @param {readonly string[]} [styles]
 * @param {Element} [place] that gets the elements
 */
export function addElements(markup, styles = [], place = document.body) {
    const { body } = new DOMParser().parseFromString(markup, 'text/html');
    // A page in a single file has no documents beside it.
    if (isWhole()) for (const link of body.querySelectorAll('a[href^="docs/"]')) link.remove();
    translate(body);
    place.append(...body.children);
    for (const text of styles) {
        if (styled.has(text)) continue;
        styled.add(text);
        const sheet = new CSSStyleSheet();
        sheet.replaceSync(text);
        document.adoptedStyleSheets.push(sheet);
    }
}
