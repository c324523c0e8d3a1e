/** The line under the rules that says what a symbol does: the symbol under the pointer, or else at the caret. */

import { byId, html, make } from '../dom.js';

/** @typedef {import('../protocol.js').Report} Report */
/** @typedef {Report['legend'][number]} Entry */

const HINT = 'Point at a symbol to see what it does.';

/** @param {string[]} ids the text areas */
export function symbolNote(ids) {
    const note = html('symbol-note');
    const areas = ids.map((id) => byId(id, HTMLTextAreaElement));
    /** @type {Entry[]} */
    let legend = [];

    /** The entry of a symbol in a text; none for an arrow, white space or a comment. @param {string} text @param {number} at */
    function entryAt(text, at) {
        const start = text.lastIndexOf('\n', at - 1) + 1;
        const symbol = String.fromCodePoint(text.codePointAt(at) ?? 32);
        const isArrow = text.startsWith('->', at) || text.startsWith('->', at - 1);
        if (isArrow || text.slice(start).trimStart().startsWith('//')) return undefined;
        return legend.find((entry) => entry.symbol.startsWith(symbol));
    }

    /** @param {Entry | undefined} entry */
    function show(entry) {
        if (!entry) return note.replaceChildren(HINT);
        const rewritten = entry.rewritten ? '; replaced by its rule at each iteration' : '';
        note.replaceChildren(make('code', {}, entry.symbol), ` ${entry.actions || 'draws nothing'}${rewritten}.`);
    }

    /** Shows the symbol before the caret, or the one behind it. */
    function showCaret() {
        const area = areas.find((area) => area === document.activeElement);
        if (!area) return show(undefined);
        const at = area.selectionStart;
        show((at > 0 && entryAt(area.value, at - 1)) || entryAt(area.value, at));
    }

    for (const area of areas) {
        area.addEventListener('pointermove', ({ clientX, clientY, pointerType }) => {
            if (pointerType !== 'mouse' || !document.caretPositionFromPoint) return;
            // The nearest border between two characters: the pointer is on either of them.
            const [left, here] = [-4, 4].map((by) => document.caretPositionFromPoint(clientX + by, clientY));
            if (left?.offsetNode !== area || here?.offsetNode !== area) return;
            show(entryAt(area.value, Math.min(left.offset, here.offset)));
        });
        area.addEventListener('pointerleave', showCaret);
        area.addEventListener('focus', showCaret);
        area.addEventListener('blur', showCaret);
    }
    document.addEventListener('selectionchange', showCaret);
    show(undefined);

    /** Takes the symbols in use. @param {Report} report */
    return (report) => {
        if (report.ok) legend = report.legend;
    };
}
