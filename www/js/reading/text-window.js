/**
 * The window through which the string is read: where it stands, what is in sight of the string, and the bar and the words
 * that tell of that. The reader says which generation is shown and which symbols are marked.
 */

import { html, setText } from '../dom.js';
import { grouped, shortText } from '../numerals.js';
import { createPages } from './pages.js';
import { REACH, lastTop, placeText, portion, ratio, revealed, rowsOf, scrolled, within } from './places.js';
import { listenToGestures } from './row-gestures.js';
import { rowsView } from './rows.js';
import { createScrollbar } from './scrollbar.js';

/** @typedef {import('./places.js').Top} Top */

/** Rows that are asked for above and below those in sight, so that scrolling finds them there. */
const SPARE = 40n;

/**
 * @param {HTMLElement} area
 * @param {object} reader
 * @param {Parameters<typeof createPages>[0]} reader.read
 * @param {() => boolean} reader.open
 * @param {() => number} reader.generation
 * @param {() => {chosen: bigint | null, lit: bigint | null}} reader.marks
 * @param {() => void} reader.arrived more of the string is known
 * @param {(index: bigint) => void} reader.choose
 */
export function createTextWindow(area, { read, open, generation, marks, arrived, choose }) {
    const rows = rowsView(area);
    const pages = createPages(read, generation, receive);
    const bar = createScrollbar(goToPart);
    /** @type {Top} */
    let top = { row: 0n, offset: 0 };
    /** The first symbol in sight, which stays there when rows become longer or shorter. */
    let first = 0n;

    const scale = () => ({ rows: rowsOf(pages.length ?? 0n, rows.columns), rowHeight: rows.rowHeight, height: rows.height });
    const rowsInSight = () => BigInt(Math.ceil(rows.height / rows.rowHeight));

    /** @param {import('./pages.js').Arrived} page */
    function receive({ another, readable, full }) {
        const before = BigInt(rows.columns);
        // Modules with their arguments may need more room than those before.
        const changed = rows.fit(pages.symbols, another);
        if (changed) top = { row: (top.row * before) / BigInt(rows.columns), offset: 0 };
        settle();
        const { chosen } = marks();
        if (changed && chosen !== null) reveal(chosen);
        show();
        // Rows may have become longer, or more, while it was on its way.
        if (readable && (changed || full)) need();
        arrived();
    }

    /** Keeps the window within the string. */
    function settle() {
        if (pages.length !== null) top = scrolled(top, 0, scale());
    }

    /** Asks for what is in sight, unless it is at hand. */
    function need() {
        if (!open() || rows.height === 0) return;
        const columns = BigInt(rows.columns);
        const count = rowsInSight() + 1n;
        if (pages.holds(top.row * columns, (top.row + count) * columns)) return;
        const start = top.row > SPARE ? (top.row - SPARE) * columns : 0n;
        pages.fetch(start, Number((count + 2n * SPARE) * columns));
    }

    function show() {
        if (!open()) return;
        rows.show({ top, page: pages.page, length: pages.length ?? 0n, ...marks() });
        first = top.row * BigInt(rows.columns);
        const { row } = lastTop(scale());
        const size = Number(within((rowsInSight() * 1000n) / (scale().rows || 1n), 0n, 1000n)) / 1000;
        bar.show({ part: ratio(top.row, row), size, needed: size < 1 || row > 0n || top.row > 0n });
        showWhere(pages, first, first + rowsInSight() * BigInt(rows.columns));
    }

    /** @param {Top} next */
    function stand(next) {
        top = next;
        show();
        need();
    }

    /** @param {number} part of the string, from 0 to 1 */
    function goToPart(part) {
        const last = lastTop(scale());
        stand(part >= 1 ? last : { row: portion(last.row, part), offset: 0 });
    }

    /** @param {number} pixels down */
    const scroll = (pixels) => pages.length !== null && stand(scrolled(top, pixels, scale()));

    /** Brings a symbol into sight, and into the middle where it was far. @param {bigint} index */
    function reveal(index) {
        const next = revealed(top, index / BigInt(rows.columns), scale());
        if (next !== top) stand(next);
    }

    /** The area has another size, or is shown again. */
    function measure() {
        if (!open()) return;
        const before = rows.columns;
        rows.measure();
        rows.fit(pages.symbols, true);
        if (rows.columns !== before) top = { row: first / BigInt(rows.columns), offset: 0 };
        settle();
        show();
        need();
    }

    listenToGestures(area, rows, { scroll, click: (index) => pages.length !== null && index < pages.length && choose(index) });
    new ResizeObserver(measure).observe(area);

    return {
        pages,
        get first() {
            return first;
        },
        /** Which part of the string is before the window, from 0 to 1. */
        get part() {
            return ratio(top.row, lastTop(scale()).row);
        },
        show,
        need,
        reveal,
        scroll,
        goToPart,
        measure,

        /** How far a key scrolls, in CSS pixels. @param {KeyboardEvent} event @returns {number | undefined} */
        reachOf({ key, shiftKey }) {
            const sheet = rows.height - rows.rowHeight;
            return { ArrowDown: rows.rowHeight, ArrowUp: -rows.rowHeight, PageDown: sheet, PageUp: -sheet, ' ': shiftKey ? -sheet : sheet }[key];
        },
    };
}

/** Tells which symbols are in sight. @param {ReturnType<typeof createPages>} pages @param {bigint} first @param {bigint} end */
function showWhere({ length, digits, why }, first, end) {
    const where = html('reader-where');
    if (length === null) return setText(where, why || '…');
    if (length === 0n) return setText(where, 'There are no symbols.');
    const last = within(end, 0n, length);
    const beyond = length === REACH ? ', of which the first 3.4 × 10³⁸ can be read' : '';
    setText(where, `${placeText(first + 1n, 20)} to ${placeText(last)} of ${shortText(digits)}${beyond}`);
    where.title = `From ${grouped(String(first + 1n))} to ${grouped(String(last))} of ${grouped(digits)} symbols`;
}
