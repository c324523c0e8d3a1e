/**
 * The account of a text: the source with every part in the tint of what became of it, beside a list of what it became.
 * Pointing at one shows the other.
 */

import { make, withCode } from '../base/dom.js';
import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').Imported} Imported */

/** The most characters of a source that are shown. */
const LONGEST = 20_000;
/** The most parts that are listed. */
const MOST = 500;

/**
 * @param {string} text the source
 * @param {Imported['account']} account
 * @param {number} entry the index of the system
 * @returns {{source: Node[], parts: HTMLElement[]}} the source around the system, and the parts of the system in order
 */
export function showAccount(text, account, entry) {
    let at = 0;
    const places = account.map((part) => {
        const start = at;
        at += part.length;
        return { ...part, start, end: at };
    });
    const own = places.filter((part) => part.entry === entry && part.fate !== 'passed').slice(0, MOST);
    const first = own[0]?.start ?? 0;
    const last = own.at(-1)?.end ?? 0;
    // Whole lines around the system.
    const from = text.lastIndexOf('\n', first - 1) + 1;
    const end = text.indexOf('\n', last);
    const to = Math.min(end < 0 ? text.length : end, from + LONGEST);
    /** @type {Node[]} */
    const source = [];
    /** @type {HTMLElement[]} */
    const parts = [];
    for (const part of places.filter((part) => part.end > from && part.start < to)) {
        const words = text.slice(Math.max(part.start, from), Math.min(part.end, to));
        if (part.entry !== entry || part.fate === 'passed' || parts.length >= MOST) {
            source.push(document.createTextNode(words));
            continue;
        }
        const mark = make('mark', { class: part.fate, title: part.words, tabindex: '0' }, words);
        const line = text.slice(0, part.start).split('\n').length;
        const place = part.fate === 'read' ? [] : [make('span', { class: 'place' }, say`Line ${String(line)}`), ' '];
        const item = make('li', { class: part.fate }, ...place, ...withCode(part.words));
        point(mark, item);
        point(item, mark);
        source.push(mark);
        parts.push(item);
    }
    if (to < (end < 0 ? text.length : end)) source.push(document.createTextNode('…'));
    return { source, parts };
}

/** Pointing at one element shows the other. @param {HTMLElement} one @param {HTMLElement} other */
function point(one, other) {
    const show = (/** @type {boolean} */ shown) => {
        other.classList.toggle('pointed', shown);
        if (shown) other.scrollIntoView({ block: 'nearest' });
    };
    for (const event of ['pointerenter', 'focus']) one.addEventListener(event, () => show(true));
    for (const event of ['pointerleave', 'blur']) one.addEventListener(event, () => show(false));
}
