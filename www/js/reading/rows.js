/**
 * Rows with equal numbers of symbols: the visible part of a long string. Symbols are found by arithmetic, not by
 * elements. Arguments make symbols wider.
 */

import { make } from '../base/dom.js';
import { tintOf } from '../controls/tint.js';
import { marginText } from './places.js';
import { partsOf, visible } from './words.js';

/** Rows have a multiple of ten symbols, if there is room. */
const TEN = 10;

/** @param {HTMLElement} area */
export function rowsView(area) {
    const sheet = make('div', { class: 'rows' });
    area.append(sheet);
    const ruler = createRuler(area, sheet);
    /** The shown rows, by number. @type {Map<bigint, {key: string, element: HTMLElement, symbols: string[]}>} */
    let shown = new Map();
    /** The number of symbols in a row. */
    let columns = TEN;
    let offset = 0;
    let firstRow = 0n;

    /** The symbol at a place in the window. @param {number} clientX @param {number} clientY @returns {bigint | null} */
    function symbolAt(clientX, clientY) {
        const box = area.getBoundingClientRect();
        const place = Math.floor((clientX - box.left - ruler.margin) / ruler.charWidth);
        const row = firstRow + BigInt(Math.floor((clientY - box.top + offset) / ruler.rowHeight));
        const symbols = shown.get(row)?.symbols ?? [];
        if (place < 0) return null;
        let end = 0;
        const column = symbols.findIndex((symbol) => place < (end += widthOf(symbol)));
        return column < 0 ? null : row * BigInt(columns) + BigInt(column);
    }

    return {
        get columns() {
            return columns;
        },
        ruler,

        /**
         * Sets the number of columns so that the symbols fit. Without `anew` the number may only decrease.
         * Returns whether the number has changed.
         * @param {string[]} symbols
         * @param {boolean} anew
         */
        fit(symbols, anew) {
            const before = columns;
            const most = mostFitting(symbols, ruler.maxColumns, ruler.room);
            columns = anew ? most : Math.min(columns, most);
            return columns !== before;
        },

        /**
         * @param {{top: import('./places.js').Top, page: {start: bigint, symbols: string[]}, length: bigint, chosen: bigint | null, lit: bigint | null}} what
         */
        show({ top, page, length, chosen, lit }) {
            const wide = BigInt(columns);
            const count = Math.ceil(ruler.height / ruler.rowHeight) + 1;
            /** @type {typeof shown} */
            const next = new Map();
            for (let at = 0; at < count; at++) {
                const row = top.row + BigInt(at);
                const start = row * wide;
                if (start >= length) break;
                const from = Number(start - page.start);
                const symbols = from < 0 ? [] : page.symbols.slice(from, from + columns);
                const marks = [...marked(chosen, start, columns, 'chosen'), ...marked(lit, start, columns, 'lit')];
                const key = `${columns} ${symbols.join('')} ${marks.map(({ at: place, name }) => `${name}${place}`).join()}`;
                const old = shown.get(row);
                next.set(row, old?.key === key ? old : { key, element: rowOf(start, symbols, marks), symbols });
            }
            for (const [row, { element }] of shown) if (next.get(row)?.element !== element) element.remove();
            let after = /** @type {Element | null} */ (sheet.firstElementChild);
            for (const { element } of next.values()) {
                if (element === after) after = after.nextElementSibling;
                else sheet.insertBefore(element, after);
            }
            shown = next;
            firstRow = top.row;
            offset = top.offset;
            sheet.style.transform = `translateY(${-offset}px)`;
        },

        symbolAt,
    };
}

/** The sizes of rows, in CSS pixels. @param {HTMLElement} area @param {HTMLElement} sheet */
function createRuler(area, sheet) {
    const ruler = make('span', { class: 'ruler', 'aria-hidden': 'true' }, '0'.repeat(50));
    area.append(ruler);
    const self = {
        /** The number of characters that fit in a row, and the most symbols in a row. */
        room: TEN,
        maxColumns: TEN,
        rowHeight: 22,
        height: 0,
        charWidth: 8,
        margin: 60,

        measure() {
            const box = ruler.getBoundingClientRect();
            self.charWidth = box.width / 50 || 8;
            self.rowHeight = box.height || 22;
            self.height = area.clientHeight;
            self.margin = self.charWidth * 9;
            self.room = Math.max(1, Math.floor((area.clientWidth - self.margin - self.charWidth) / self.charWidth));
            self.maxColumns = self.room >= 2 * TEN ? self.room - (self.room % TEN) : self.room;
            sheet.style.setProperty('--margin', `${self.margin}px`);
            sheet.style.setProperty('--row', `${self.rowHeight}px`);
        },
    };
    return self;
}

/** The width of a symbol, in characters. @param {string} symbol */
const widthOf = (symbol) => (symbol.length === 1 ? 1 : [...visible(symbol)].length);

/** The mark of a symbol, if the symbol is in the row. @param {bigint | null} index @param {bigint} start @param {number} columns @param {string} name */
function marked(index, start, columns, name) {
    return index !== null && index >= start && index < start + BigInt(columns)
        ? [{ at: Number(index - start), name }]
        : [];
}

/** A row as an element. @param {bigint} start @param {string[]} symbols @param {{at: number, name: string}[]} marks */
function rowOf(start, symbols, marks) {
    const cells = make('span', { class: 'cells' });
    /** Symbols with equal tint and marks share an element. */
    let run = '';
    let names = '';
    const flush = () => {
        if (run) cells.append(names ? make('span', { class: names }, run) : run);
        run = '';
    };
    symbols.forEach((module, at) => {
        const [symbol, args] = partsOf(module);
        const tint = tintOf(symbol);
        const own = marks.filter((mark) => mark.at === at).map(({ name }) => name);
        if (args && own.length > 0) {
            flush();
            cells.append(make('span', { class: own.join(' ') }, symbol, args));
            return;
        }
        // Other characters may be wider than a column.
        const foreign = [...symbol].length === 1 && (symbol < '\u0020' || symbol > '\u007e');
        const next = [tint ? `t-${tint}` : '', foreign ? 'foreign' : '', ...own].filter(Boolean).join(' ');
        if (next !== names || foreign) flush();
        names = next;
        run += symbol;
        if (!args) return;
        flush();
        cells.append(make('span', { class: 'args' }, args));
    });
    flush();
    return make(
        'div',
        { class: 'row-line' },
        make('span', { class: 'margin', 'aria-hidden': 'true' }, marginText(start)),
        cells,
    );
}

/**
 * The most symbols per row such that every row fits.
 * @param {string[]} symbols
 * @param {number} wanted the most symbols
 * @param {number} room of a row, in characters
 */
function mostFitting(symbols, wanted, room) {
    // Any run of `count` symbols must fit; search for the largest such count.
    const ends = [0];
    for (const symbol of symbols) ends.push(/** @type {number} */ (ends.at(-1)) + widthOf(symbol));
    const fits = (/** @type {number} */ count) =>
        ends.every((end, at) => at < count || end - /** @type {number} */ (ends[at - count]) <= room);
    let [fitting, tooMany] = [1, wanted + 1];
    while (tooMany - fitting > 1) {
        const between = Math.floor((fitting + tooMany) / 2);
        if (fits(between)) fitting = between;
        else tooMany = between;
    }
    return fitting;
}
