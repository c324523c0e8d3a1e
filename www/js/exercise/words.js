/** The words of a task: paragraphs with Markdown's emphasis, code and links. All else is text, never HTML. */

import { make } from '../base/dom.js';

/** Code, strong, emphasis, link. */
const MARKS = /`([^`\n]+)`|\*\*([^*\n]+)\*\*|[*_]([^*_\n]+)[*_]|\[([^\]\n]+)\]\((https?:\/\/[^\s)]+)\)/g;

/** @param {string} text @returns {HTMLElement[]} */
export function paragraphs(text) {
    return text
        .split(/\n\s*\n/)
        .filter((part) => part.trim() !== '')
        .map((part) => make('p', {}, ...inline(part.trim())));
}

/** @param {string} text @returns {(Node | string)[]} */
export function inline(text) {
    /** @type {(Node | string)[]} */
    const parts = [];
    let at = 0;
    for (const match of text.matchAll(MARKS)) {
        parts.push(text.slice(at, match.index));
        const [whole, code, strong, emphasis, words, address] = match;
        if (code) parts.push(make('code', {}, code));
        else if (strong) parts.push(make('strong', {}, strong));
        else if (emphasis) parts.push(make('em', {}, emphasis));
        else
            parts.push(
                make('a', { href: address ?? '', target: '_blank', rel: 'noopener noreferrer nofollow' }, words ?? ''),
            );
        at = match.index + whole.length;
    }
    return [...parts, text.slice(at)].filter((part) => part !== '');
}
