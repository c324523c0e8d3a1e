/**
 * The line under the rules that says what a symbol does: the symbol under the pointer, or else at the caret. The drawing
 * shows what the symbol became.
 */

import { byId, html, isTouch, make } from '../base/dom.js';
import { sameDrawing } from '../state/state.js';
import { createTrace } from './trace.js';
import { say } from '../base/words.js';

/** @typedef {import('./trace.js').TextField} TextField */
/** A symbol in a text. @typedef {{field: TextField, offset: number, symbol: string}} Written */

const HINT = isTouch() ? say`Tap a symbol to see what it does.` : say`Point at a symbol to see what it does.`;

/**
 * @param {import('../state/store.js').Store} store
 * @param {import('../engine/engine.js').Engine} engine
 * @param {{legend: ReturnType<typeof import('./legend.js').createLegend>, mark: (outline: number[][]) => void}} page `mark` marks a part of the drawing
 */
export function symbolNote(store, engine, { legend, mark }) {
    const note = html('symbol-note');
    const fields = /** @type {const} */ (['axiom', 'rules']);
    const areas = fields.map((id) => byId(id, HTMLTextAreaElement));
    /** The explained symbol. @type {Written | null} */
    let shown = null;

    const trace = createTrace(store, engine, (outline, { field, offset }) => {
        if (shown?.field !== field || shown.offset !== offset) return;
        mark(outline);
        explain(legend, note, shown, outline.length);
    });

    /** The symbol at a place; null for an arrow, white space or a comment. @param {TextField} field @param {string} text @param {number} offset @returns {Written | null} */
    function symbolAt(field, text, offset) {
        const start = text.lastIndexOf('\n', offset - 1) + 1;
        const symbol = String.fromCodePoint(text.codePointAt(offset) ?? 32);
        const isArrow = text.startsWith('->', offset) || text.startsWith('->', offset - 1);
        if (isArrow || text.slice(start).trimStart().startsWith('//') || !legend.of(symbol)) return null;
        return { field, offset, symbol };
    }

    /** @param {Written | null} written @param {boolean} [marking] */
    function show(written, marking = true) {
        if (written && marking && shown?.field === written.field && shown.offset === written.offset) return;
        shown = written;
        mark([]);
        if (!written) return note.replaceChildren(HINT);
        explain(legend, note, written, 0);
        if (marking) trace({ field: written.field, offset: written.offset });
    }

    /** The symbol before the caret, or the one behind it. */
    function caretSymbol() {
        const at = areas.findIndex((area) => area === document.activeElement);
        const [field, area] = [fields[at], areas[at]];
        if (!field || !area) return null;
        const { value, selectionStart: caret } = area;
        return (caret > 0 && symbolAt(field, value, caret - 1)) || symbolAt(field, value, caret);
    }

    /** A mark would distract while the reader types. */
    let typing = false;
    const showCaret = () => show(caretSymbol(), !typing);

    for (const [at, area] of areas.entries()) {
        area.addEventListener('pointermove', ({ clientX, clientY, pointerType }) => {
            if (pointerType !== 'mouse' || !document.caretPositionFromPoint) return;
            // The nearest border between two characters: the pointer is on either of them.
            const [left, here] = [-4, 4].map((by) => document.caretPositionFromPoint(clientX + by, clientY));
            if (left?.offsetNode !== area || here?.offsetNode !== area) return;
            show(symbolAt(/** @type {TextField} */ (fields[at]), area.value, Math.min(left.offset, here.offset)));
        });
        area.addEventListener('pointerleave', showCaret);
        area.addEventListener('input', () => (typing = true));
        area.addEventListener('keydown', ({ key }) => (typing &&= !/^(Arrow|Home|End|Page)/.test(key)));
        area.addEventListener('pointerdown', () => (typing = false));
        area.addEventListener('focus', showCaret);
        area.addEventListener('blur', showCaret);
    }
    document.addEventListener('selectionchange', showCaret);
    store.subscribe((state, before) => {
        if (sameDrawing(state, before)) return;
        // The drawing changes, so the mark is out of date.
        shown = null;
        mark([]);
    });
    show(null);
}

/**
 * @param {ReturnType<typeof import('./legend.js').createLegend>} legend
 * @param {HTMLElement} note
 * @param {Written} written
 * @param {number} corners of the mark in the drawing
 */
function explain(legend, note, { symbol }, corners) {
    const meaning = legend.of(symbol);
    if (!meaning) return note.replaceChildren(HINT);
    const where =
        corners > 1
            ? [say`What it became is marked in the drawing.`]
            : corners > 0
              ? [say`Its place is marked in the drawing.`]
              : [];
    note.replaceChildren(make('code', {}, meaning.symbol), ` ${[meaning.words, ...where].join(' ')}`);
}
