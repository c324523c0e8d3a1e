/**
 * Rows with as many symbols each: what is in sight of a long string. Symbols are found by arithmetic, not by elements;
 * those with arguments are as wide as these.
 */

import { make } from '../dom.js';
import { tintOf } from '../tint.js';
import { marginText } from './places.js';
import { partsOf, visible } from './words.js';

/** Rows are whole tens of symbols where there is room for them. */
const TEN = 10;

/** @param {HTMLElement} area */
export function rowsView(area) {
    const sheet = make('div', { class: 'rows' });
    const ruler = make('span', { class: 'ruler', 'aria-hidden': 'true' }, '0'.repeat(50));
    area.append(sheet, ruler);
    /** The rows that are shown, by number. @type {Map<bigint, {key: string, element: HTMLElement, symbols: string[]}>} */
    let shown = new Map();
    /** Symbols of a row. */
    let columns = TEN;
    /** Characters that a row has room for. */
    let room = TEN;
    /** How many of them a row should have where each is a symbol. */
    let narrow = TEN;
    let rowHeight = 22;
    let height = 0;
    let charWidth = 8;
    let margin = 60;
    let offset = 0;
    let firstRow = 0n;

    function measure() {
        const box = ruler.getBoundingClientRect();
        charWidth = box.width / 50 || 8;
        rowHeight = box.height || 22;
        height = area.clientHeight;
        margin = charWidth * 9;
        room = Math.max(1, Math.floor((area.clientWidth - margin - charWidth) / charWidth));
        narrow = room >= 2 * TEN ? room - (room % TEN) : room;
        sheet.style.setProperty('--margin', `${margin}px`);
        sheet.style.setProperty('--row', `${rowHeight}px`);
    }

    /** The symbol at a place in the page. @param {number} clientX @param {number} clientY @returns {bigint | null} */
    function symbolAt(clientX, clientY) {
        const box = area.getBoundingClientRect();
        const place = Math.floor((clientX - box.left - margin) / charWidth);
        const row = firstRow + BigInt(Math.floor((clientY - box.top + offset) / rowHeight));
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
        get rowHeight() {
            return rowHeight;
        },
        get height() {
            return height;
        },
        measure,

        /**
         * Chooses the number of columns so that these symbols have room; fewer than before, unless all is new. Says
         * whether it is another number.
         * @param {string[]} symbols
         * @param {boolean} anew
         */
        fit(symbols, anew) {
            const before = columns;
            const most = fitting(symbols, narrow, room);
            columns = anew ? most : Math.min(columns, most);
            return columns !== before;
        },

        /**
         * @param {{top: import('./places.js').Top, page: {start: bigint, symbols: string[]}, length: bigint, chosen: bigint | null, lit: bigint | null}} what
         */
        show({ top, page, length, chosen, lit }) {
            const wide = BigInt(columns);
            const count = Math.ceil(height / rowHeight) + 1;
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

/** In characters. @param {string} symbol */
const widthOf = (symbol) => (symbol.length === 1 ? 1 : [...visible(symbol)].length);

/** A mark in a row. @param {bigint | null} index @param {bigint} start @param {number} columns @param {string} name */
function marked(index, start, columns, name) {
    return index !== null && index >= start && index < start + BigInt(columns) ? [{ at: Number(index - start), name }] : [];
}

/** A row as an element. @param {bigint} start @param {string[]} symbols @param {{at: number, name: string}[]} marks */
function rowOf(start, symbols, marks) {
    const cells = make('span', { class: 'cells' });
    /** What is alike goes into one element: symbols by their tint and marks. */
    let run = '';
    let names = '';
    const flush = () => {
        if (run) cells.append(names ? make('span', { class: names }, run) : run);
        run = '';
    };
    symbols.forEach((module, at) => {
        const [symbol, given] = partsOf(module);
        const tint = tintOf(symbol);
        const own = marks.filter((mark) => mark.at === at).map(({ name }) => name);
        if (given && own.length > 0) {
            flush();
            cells.append(make('span', { class: own.join(' ') }, symbol, given));
            return;
        }
        // Others may be wider than a column in the font at hand.
        const foreign = [...symbol].length === 1 && (symbol < '\u0020' || symbol > '\u007e');
        const next = [tint ? `t-${tint}` : '', foreign ? 'foreign' : '', ...own].filter(Boolean).join(' ');
        if (next !== names || foreign) flush();
        names = next;
        run += symbol;
        if (!given) return;
        flush();
        cells.append(make('span', { class: 'given' }, given));
    });
    flush();
    return make('div', { class: 'row-line' }, make('span', { class: 'margin', 'aria-hidden': 'true' }, marginText(start)), cells);
}

/**
 * How many symbols go into every row.
 * @param {string[]} symbols
 * @param {number} wanted as many at most
 * @param {number} room of a row, in characters
 */
function fitting(symbols, wanted, room) {
    // Where a run of as many as are wanted is too long, fewer are.
    const ends = [0];
    for (const symbol of symbols) ends.push(/** @type {number} */ (ends.at(-1)) + widthOf(symbol));
    const fits = (/** @type {number} */ count) => ends.every((end, at) => at < count || end - /** @type {number} */ (ends[at - count]) <= room);
    let [some, tooMany] = [1, wanted + 1];
    while (tooMany - some > 1) {
        const between = Math.floor((some + tooMany) / 2);
        if (fits(between)) some = between;
        else tooMany = between;
    }
    return some;
}
