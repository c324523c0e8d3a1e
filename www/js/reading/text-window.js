/**
 * The scrolling window of the string view: its position, the visible rows, the scroll bar and the position text. The
 * reader supplies the generation and the marked symbols.
 */

import { html, setText } from '../dom.js';
import { grouped, shortText } from '../numerals.js';
import { createPages } from './pages.js';
import { REACH, REACH_TEXT, lastTop, placeText, portion, ratio, revealed, rowsOf, scrolled, within } from './places.js';
import { listenToGestures } from './row-gestures.js';
import { rowsView } from './rows.js';
import { createScrollbar } from './scrollbar.js';
import { say } from '../words.js';

/** @typedef {import('./places.js').Top} Top */

/** The number of rows loaded above and below the visible rows, so that scrolling is smooth. */
const SPARE = 40n;

/**
 * @param {HTMLElement} area
 * @param {object} reader
 * @param {Parameters<typeof createPages>[0]} reader.read
 * @param {() => boolean} reader.open
 * @param {() => number} reader.generation
 * @param {() => {chosen: bigint | null, lit: bigint | null}} reader.marks
 * @param {() => void} reader.arrived more of the string was loaded
 * @param {(index: bigint) => void} reader.choose
 */
export function createTextWindow(area, { read, open, generation, marks, arrived, choose }) {
    const rows = rowsView(area);
    const pages = createPages(read, generation, receive);
    const bar = createScrollbar(goToPart);
    /** @type {Top} */
    let top = { row: 0n, offset: 0 };
    /** The first visible symbol, which stays visible when the length of rows changes. */
    let first = 0n;

    const scale = () => ({
        rows: rowsOf(pages.length ?? 0n, rows.columns),
        rowHeight: rows.rowHeight,
        height: rows.height,
    });
    const visibleRows = () => BigInt(Math.ceil(rows.height / rows.rowHeight));

    /** @param {import('./pages.js').Arrived} page */
    function receive({ another, readable, full }) {
        const before = BigInt(rows.columns);
        // Modules with arguments may be wider than the former symbols.
        const changed = rows.fit(pages.symbols, another);
        if (changed) top = { row: (top.row * before) / BigInt(rows.columns), offset: 0 };
        clamp();
        const { chosen } = marks();
        if (changed && chosen !== null) reveal(chosen);
        show();
        // The window may need more symbols than the page has.
        if (readable && (changed || full)) fetchMissing();
        arrived();
    }

    /** Keeps the window within the string. */
    function clamp() {
        if (pages.length !== null) top = scrolled(top, 0, scale());
    }

    /** Fetches the visible symbols unless they are loaded. */
    function fetchMissing() {
        if (!open() || rows.height === 0) return;
        const columns = BigInt(rows.columns);
        const count = visibleRows() + 1n;
        if (pages.holds(top.row * columns, (top.row + count) * columns)) return;
        const start = top.row > SPARE ? (top.row - SPARE) * columns : 0n;
        pages.fetch(start, Number((count + 2n * SPARE) * columns));
    }

    function show() {
        if (!open()) return;
        rows.show({ top, page: pages.page, length: pages.length ?? 0n, ...marks() });
        first = top.row * BigInt(rows.columns);
        const { row } = lastTop(scale());
        const size = Number(within((visibleRows() * 1000n) / (scale().rows || 1n), 0n, 1000n)) / 1000;
        bar.show({ part: ratio(top.row, row), size, needed: size < 1 || row > 0n || top.row > 0n });
        showWhere(pages, first, first + visibleRows() * BigInt(rows.columns));
    }

    /** @param {Top} next */
    function moveTo(next) {
        top = next;
        show();
        fetchMissing();
    }

    /** @param {number} part of the string, from 0 to 1 */
    function goToPart(part) {
        const last = lastTop(scale());
        moveTo(part >= 1 ? last : { row: portion(last.row, part), offset: 0 });
    }

    /** @param {number} pixels down */
    const scroll = (pixels) => pages.length !== null && moveTo(scrolled(top, pixels, scale()));

    /** Scrolls a symbol into view, into the middle unless it is visible. @param {bigint} index */
    function reveal(index) {
        const next = revealed(top, index / BigInt(rows.columns), scale());
        if (next !== top) moveTo(next);
    }

    /** The area was resized or shown. */
    function measure() {
        if (!open()) return;
        const before = rows.columns;
        rows.measure();
        rows.fit(pages.symbols, true);
        if (rows.columns !== before) top = { row: first / BigInt(rows.columns), offset: 0 };
        clamp();
        show();
        fetchMissing();
    }

    listenToGestures(area, rows, {
        scroll,
        click: (index) => pages.length !== null && index < pages.length && choose(index),
    });
    new ResizeObserver(measure).observe(area);

    return {
        pages,
        get first() {
            return first;
        },
        /** The fraction of the string before the window, from 0 to 1. */
        get part() {
            return ratio(top.row, lastTop(scale()).row);
        },
        show,
        fetchMissing,
        reveal,
        scroll,
        goToPart,
        measure,

        /** The loaded symbol at a place in the window. @param {number} clientX @param {number} clientY @returns {bigint | null} */
        symbolUnder(clientX, clientY) {
            const index = rows.symbolAt(clientX, clientY);
            return index !== null && pages.symbolAt(index) !== undefined ? index : null;
        },

        /** The distance that a key scrolls, in CSS pixels. @param {KeyboardEvent} event @returns {number | undefined} */
        scrollOf({ key, shiftKey }) {
            const sheet = rows.height - rows.rowHeight;
            return {
                ArrowDown: rows.rowHeight,
                ArrowUp: -rows.rowHeight,
                PageDown: sheet,
                PageUp: -sheet,
                ' ': shiftKey ? -sheet : sheet,
            }[key];
        },
    };
}

/** Shows which symbols are visible. @param {ReturnType<typeof createPages>} pages @param {bigint} first @param {bigint} end */
function showWhere({ length, digits, reason }, first, end) {
    const where = html('reader-where');
    if (length === null) return setText(where, reason || '…');
    if (length === 0n) return setText(where, say`There are no symbols.`);
    const last = within(end, 0n, length);
    const [from, to, all] = [placeText(first + 1n, 20), placeText(last), shortText(digits)];
    setText(
        where,
        length === REACH
            ? say`${from} to ${to} of ${all}, of which the first ${REACH_TEXT} can be read`
            : say`${from} to ${to} of ${all}`,
    );
    where.title = say`From ${grouped(String(first + 1n))} to ${grouped(String(last))} of ${grouped(digits)} symbols`;
}
