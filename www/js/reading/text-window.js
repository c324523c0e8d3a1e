/**
 * The scrolling window of the string view: its position, the visible rows, the scroll bar and the position text. The
 * reader supplies the generation and the marked symbols.
 */

import { html, setText } from '../base/dom.js';
import { grouped, shortText } from '../base/numerals.js';
import { createPages } from './pages.js';
import { REACH, REACH_TEXT, lastTop, placeText, portion, ratio, revealed, rowsOf, scrolled, within } from './places.js';
import { listenToGestures } from './row-gestures.js';
import { rowsView } from './rows.js';
import { createScrollbar } from './scrollbar.js';
import { say } from '../base/words.js';

/** @typedef {import('./places.js').Top} Top */

/** The number of rows loaded above and below the visible rows, so that scrolling is smooth. */
const SPARE = 40n;

/**
 * The rows and the place.
 * @typedef {object} Window
 * @property {() => boolean} open
 * @property {() => {chosen: bigint | null, lit: bigint | null}} marks
 * @property {() => void} arrived
 * @property {ReturnType<typeof rowsView>} rows
 * @property {ReturnType<typeof createPages>} pages
 * @property {ReturnType<typeof createScrollbar>} bar
 * @property {Top} top
 * @property {bigint} first The first visible symbol, which stays visible when the length of rows changes
 */

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
    const pages = createPages(read, generation, (given) => receive(self, given));
    const bar = createScrollbar((part) => goToPart(self, part));
    /** @type {Window} */
    const self = { open, marks, arrived, rows: rowsView(area), pages, bar, top: { row: 0n, offset: 0 }, first: 0n };

    listenToGestures(area, self.rows, {
        scroll: (pixels) => scroll(self, pixels),
        click: (index) => pages.length !== null && index < pages.length && choose(index),
    });
    new ResizeObserver(() => measure(self)).observe(area);

    return {
        pages,
        get first() {
            return self.first;
        },
        /** The fraction of the string before the window, from 0 to 1. */
        get part() {
            return ratio(self.top.row, lastTop(scale(self)).row);
        },
        show: () => show(self),
        fetchMissing: () => fetchMissing(self),
        reveal: (/** @type {bigint} */ index) => reveal(self, index),
        scroll: (/** @type {number} */ pixels) => scroll(self, pixels),
        goToPart: (/** @type {number} */ part) => goToPart(self, part),
        measure: () => measure(self),

        /** The loaded symbol at a place in the window. @param {number} clientX @param {number} clientY @returns {bigint | null} */
        symbolUnder(clientX, clientY) {
            const index = self.rows.symbolAt(clientX, clientY);
            return index !== null && pages.symbolAt(index) !== undefined ? index : null;
        },

        /** The distance that a key scrolls, in CSS pixels. @param {KeyboardEvent} event @returns {number | undefined} */
        scrollOf({ key, shiftKey }) {
            const sheet = self.rows.ruler.height - self.rows.ruler.rowHeight;
            return {
                ArrowDown: self.rows.ruler.rowHeight,
                ArrowUp: -self.rows.ruler.rowHeight,
                PageDown: sheet,
                PageUp: -sheet,
                ' ': shiftKey ? -sheet : sheet,
            }[key];
        },
    };
}

/** @param {Window} self */
const scale = (self) => ({
    rows: rowsOf(self.pages.length ?? 0n, self.rows.columns),
    rowHeight: self.rows.ruler.rowHeight,
    height: self.rows.ruler.height,
});

/** @param {Window} self */
const visibleRows = (self) => BigInt(Math.ceil(self.rows.ruler.height / self.rows.ruler.rowHeight));

/** @param {Window} self @param {import('./pages.js').Arrived} page */
function receive(self, { another, readable, full }) {
    const before = BigInt(self.rows.columns);
    // Modules with arguments may be wider than the former symbols.
    const changed = self.rows.fit(self.pages.symbols, another);
    if (changed) self.top = { row: (self.top.row * before) / BigInt(self.rows.columns), offset: 0 };
    clamp(self);
    const { chosen } = self.marks();
    if (changed && chosen !== null) reveal(self, chosen);
    show(self);
    // The window may need more symbols than the page has.
    if (readable && (changed || full)) fetchMissing(self);
    self.arrived();
}

/** Keeps the window within the string. @param {Window} self */
function clamp(self) {
    if (self.pages.length !== null) self.top = scrolled(self.top, 0, scale(self));
}

/** Fetches the visible symbols unless they are loaded. @param {Window} self */
function fetchMissing(self) {
    if (!self.open() || self.rows.ruler.height === 0) return;
    const columns = BigInt(self.rows.columns);
    const count = visibleRows(self) + 1n;
    if (self.pages.holds(self.top.row * columns, (self.top.row + count) * columns)) return;
    const start = self.top.row > SPARE ? (self.top.row - SPARE) * columns : 0n;
    self.pages.fetch(start, Number((count + 2n * SPARE) * columns));
}

/** @param {Window} self */
function show(self) {
    if (!self.open()) return;
    self.rows.show({ top: self.top, page: self.pages.page, length: self.pages.length ?? 0n, ...self.marks() });
    self.first = self.top.row * BigInt(self.rows.columns);
    const { row } = lastTop(scale(self));
    const size = Number(within((visibleRows(self) * 1000n) / (scale(self).rows || 1n), 0n, 1000n)) / 1000;
    self.bar.show({ part: ratio(self.top.row, row), size, needed: size < 1 || row > 0n || self.top.row > 0n });
    showWhere(self.pages, self.first, self.first + visibleRows(self) * BigInt(self.rows.columns));
}

/** @param {Window} self @param {Top} next */
function moveTo(self, next) {
    self.top = next;
    show(self);
    fetchMissing(self);
}

/** @param {Window} self @param {number} part of the string, from 0 to 1 */
function goToPart(self, part) {
    const last = lastTop(scale(self));
    moveTo(self, part >= 1 ? last : { row: portion(last.row, part), offset: 0 });
}

/** @param {Window} self @param {number} pixels down */
const scroll = (self, pixels) => self.pages.length !== null && moveTo(self, scrolled(self.top, pixels, scale(self)));

/** Scrolls a symbol into view, into the middle unless it is visible. @param {Window} self @param {bigint} index */
function reveal(self, index) {
    const next = revealed(self.top, index / BigInt(self.rows.columns), scale(self));
    if (next !== self.top) moveTo(self, next);
}

/** The area was resized or shown. @param {Window} self */
function measure(self) {
    if (!self.open()) return;
    const before = self.rows.columns;
    self.rows.ruler.measure();
    self.rows.fit(self.pages.symbols, true);
    if (self.rows.columns !== before) self.top = { row: self.first / BigInt(self.rows.columns), offset: 0 };
    clamp(self);
    show(self);
    fetchMissing(self);
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
