/**
 * A text area with syntax highlighting and underlined problems. A layer behind the area shows the same text in coloured
 * spans; the area itself shows only caret and selection.
 */

import { make, setValue, withCode } from '../base/dom.js';
import { fixLabel } from '../base/fix.js';
import { maxLengthOf } from '../state/state.js';
import { carryOver, spansOf } from './tint.js';
import { counted, say } from '../base/words.js';

/** @typedef {import('../protocol.js').Diagnostic} Diagnostic */
/**
 * @typedef {object} Editor
 * @property {(text: string) => void} show
 * @property {(start: number, end: number, text: string) => string} replace replaces a part of the text; caret and
 *   selection stay. Returns the whole text.
 * @property {(letters: string, text: string) => void} tint colours the text by class letters, if `text` is still shown
 * @property {(diagnostics: Diagnostic[]) => void} mark
 */

/** Longer lines are not coloured, in UTF-16 units. */
const TINTED = 4000;
/** Larger texts are shown by the area alone, without colours and marks, because laying them out twice is slow. */
const MOST_LINES = 2000;
const MOST_UNITS = 100_000;
/** The maximum number of listed problems; further ones are only counted. */
const MOST_LISTED = 50;
/** Columns beyond this one are counted in UTF-16 units, which is faster than characters. */
const COUNTED = 10_000;

/**
 * @param {HTMLTextAreaElement} area
 * @param {HTMLElement} problems the list under it
 * @param {'axiom' | 'rules' | 'overrides'} kind
 * @param {{change: (text: string) => void, settle: () => void, fix: (diagnostic: Diagnostic) => void}} on
 * @returns {Editor}
 */
export function editor(area, problems, kind, { change, settle, fix }) {
    const layer = /** @type {HTMLElement} */ (area.previousElementSibling);
    /** @type {Diagnostic[]} */
    let marks = [];
    /** The text of the layer, and its class letters. */
    let text = '';
    let letters = '';

    /** A key for each line of the layer, so that unchanged lines are not updated. @type {string[]} */
    let shown = [];

    function paint() {
        if (area.value !== text) {
            letters = carryOver(letters, text, area.value);
            text = area.value;
        }
        const plain = text.length > MOST_UNITS || hasMoreLines(text, MOST_LINES);
        area.parentElement?.classList.toggle('plain', plain);
        const lines = plain ? [] : linesOf(text, marks, letters);
        const keys = lines.map((line) => JSON.stringify(line));
        const most = Math.min(keys.length, shown.length);
        let head = 0;
        while (head < most && keys[head] === shown[head]) head++;
        let tail = 0;
        while (tail < most - head && keys.at(-1 - tail) === shown.at(-1 - tail)) tail++;
        const old = [...layer.children].slice(head, shown.length - tail);
        const fresh = lines.slice(head, lines.length - tail);
        const lasting = Math.min(old.length, fresh.length);
        const last = old.at(-1) ?? layer.children[head - 1];
        fresh.slice(0, lasting).forEach((line, at) => {
            if (keys[head + at] !== shown[head + at]) old[at]?.replaceChildren(...pieces(line));
        });
        for (const gone of old.slice(lasting)) gone.remove();
        const more = fresh.slice(lasting).map((line) => make('span', {}, ...pieces(line)));
        if (last) last.after(...more);
        else layer.prepend(...more);
        shown = keys;
    }

    area.addEventListener('input', () => {
        paint();
        change(area.value);
    });
    // One character more than allowed, so that pasting too much is noticed and reported.
    area.maxLength = maxLengthOf(kind) + 1;
    area.addEventListener('blur', settle);
    if (kind === 'axiom') {
        area.addEventListener('keydown', (event) => {
            if (event.key === 'Enter' && !event.isComposing) event.preventDefault();
        });
    }

    return {
        show(next) {
            if (area.value === next) return;
            setValue(area, next);
            paint();
        },
        replace(start, end, part) {
            area.setRangeText(part, start, end, 'preserve');
            paint();
            return area.value;
        },
        tint(next, of) {
            if (of !== text || next === letters) return;
            letters = next;
            paint();
        },
        mark(all) {
            const diagnostics = all.filter((one) => !isMinus(area.value, one));
            if (JSON.stringify(diagnostics) === JSON.stringify(marks)) return;
            marks = diagnostics;
            area.setAttribute('aria-invalid', String(marks.some((mark) => mark.severity === 'error')));
            listProblems(problems, marks, area.value, { area, fix });
            paint();
        },
    };
}

/** Whether a warning only says that a minus sign of typography is read as a minus. @param {string} text @param {Diagnostic} diagnostic */
const isMinus = (text, { severity, start, end }) => severity === 'warning' && text.slice(start, end) === '\u2212';

/**
 * Lists diagnostics. With a `text`, each item has its place in the text; with an `area`, a click on the item goes to
 * that place, and a button applies the remedy.
 * @param {HTMLElement} list
 * @param {Diagnostic[]} diagnostics
 * @param {string} [text]
 * @param {{area: HTMLTextAreaElement, fix: (diagnostic: Diagnostic) => void}} [editor]
 */
export function listProblems(list, diagnostics, text, editor) {
    const place = text === undefined ? null : placesIn(text);
    list.replaceChildren(
        ...diagnostics.slice(0, MOST_LISTED).map((diagnostic) => {
            const { severity, message, hint, start, end } = diagnostic;
            const words = [make('span', { class: 'problem-text' }, ...withCode(message))];
            if (place) words.unshift(make('span', { class: 'place' }, place(start)));
            if (hint) words.push(make('span', { class: 'problem-hint' }, ...withCode(hint)));
            if (!editor) return make('li', { class: severity }, ...words);
            const { area, fix } = editor;
            const go = make('button', { class: 'problem' }, ...words);
            go.addEventListener('click', () => {
                area.focus();
                area.setSelectionRange(start, Math.max(end, start));
            });
            if (diagnostic.fix === null) return make('li', { class: severity }, go);
            const remedy = make('button', { class: 'button fix' }, fixLabel(diagnostic.fix));
            remedy.addEventListener('click', () => fix(diagnostic));
            return make('li', { class: severity }, go, remedy);
        }),
    );
    const more = diagnostics.length - MOST_LISTED;
    if (more > 0)
        list.append(
            make(
                'li',
                {},
                make('span', { class: 'problem-text' }, counted(more, '{} more problem.', '{} more problems.')),
            ),
        );
}

/** Describes places in a text by line and column. @param {string} text @returns {(offset: number) => string} */
export function placesIn(text) {
    const starts = [0];
    for (let at = text.indexOf('\n'); at >= 0; at = text.indexOf('\n', at + 1)) starts.push(at + 1);
    return (offset) => {
        const line = lineOf(starts, offset);
        const before = text.slice(starts[line], offset);
        const column = (before.length > COUNTED ? before.length : [...before].length) + 1;
        return starts.length > 1
            ? say`Line ${String(line + 1)}, column ${String(column)}`
            : say`Column ${String(column)}`;
    };
}

/** The last line that starts at or before an offset. @param {number[]} starts @param {number} offset */
function lineOf(starts, offset) {
    let [low, high] = [0, starts.length];
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (/** @type {number} */ (starts[middle]) <= offset) low = middle;
        else high = middle;
    }
    return low;
}

/** @param {string} text @param {number} most */
function hasMoreLines(text, most) {
    let lines = 1;
    for (let at = text.indexOf('\n'); at >= 0 && lines <= most; at = text.indexOf('\n', at + 1)) lines += 1;
    return lines > most;
}

/** @typedef {{start: number, end: number, severity: 'warning' | 'error'}} Mark */
/** @typedef {{text: string, letters: string, marks: Mark[]}} Line */

/**
 * The lines of a text, with their line breaks, class letters and problems, by offsets into the line.
 * @param {string} text
 * @param {Diagnostic[]} diagnostics
 * @param {string} [letters] one for each UTF-16 unit
 * @returns {Line[]}
 */
export function linesOf(text, diagnostics, letters = '') {
    // A problem where something is missing has no width: underline the symbol before it.
    const marks = diagnostics.map(({ start, end, severity }) =>
        end > start
            ? { start, end, severity }
            : { start: Math.max(0, Math.min(start, text.length) - 1), end: Math.max(1, start), severity },
    );
    marks.sort((a, b) => a.start - b.start);
    /** Marks that have begun and may continue. @type {Mark[]} */
    let open = [];
    let next = 0;
    let from = 0;
    const lines = text.split(/(?<=\n)/);
    // A final line break starts one more line.
    if (text.endsWith('\n')) lines.push('');
    return lines.map((line) => {
        const [first, last] = [from, from + line.length];
        from = last;
        open = open.filter(({ end }) => end > first);
        for (let mark = marks[next]; mark && mark.start < last; mark = marks[++next])
            if (mark.end > first) open.push(mark);
        const inside = open.slice();
        return {
            text: line,
            letters: letters.slice(first, last),
            marks: inside.map(({ start, end, severity }) => ({
                start: Math.max(0, start - first),
                end: Math.min(end - first, line.length),
                severity,
            })),
        };
    });
}

/**
 * The spans of a line. Colours and problems may overlap, so the line is cut at the edges of both.
 * @param {Line} line
 */
function pieces({ text, letters, marks }) {
    const spans = text.length > TINTED ? [] : spansOf(letters);
    const edges = [
        ...new Set([0, text.length, ...[...spans, ...marks].flatMap(({ start, end }) => [start, end])]),
    ].sort((a, b) => a - b);
    const nodes = [];
    let next = 0;
    for (let at = 0; at + 1 < edges.length; at++) {
        const from = /** @type {number} */ (edges[at]);
        const to = /** @type {number} */ (edges[at + 1]);
        while (next < spans.length && /** @type {{end: number}} */ (spans[next]).end <= from) next++;
        const span = spans[next];
        const over = marks.filter(({ start, end }) => start <= from && end >= to).map(({ severity }) => severity);
        const names = [
            span && span.start <= from ? `t-${span.tint}` : '',
            over.includes('error') ? 'wrong' : over.length > 0 ? 'doubtful' : '',
        ].filter(Boolean);
        const piece = text.slice(from, to);
        nodes.push(names.length > 0 ? make('span', { class: names.join(' ') }, piece) : document.createTextNode(piece));
    }
    return nodes;
}
