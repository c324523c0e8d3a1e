/**
 * A text area whose text is tinted and whose mistakes are underlined in place: the same text stands in a layer behind
 * it, in spans, while the area itself shows only caret and selection.
 */

import { make, setValue } from '../dom.js';
import { tints } from '../tint.js';

/** @typedef {import('../engine.js').Diagnostic} Diagnostic */
/** @typedef {{show: (text: string) => void, mark: (diagnostics: Diagnostic[]) => void}} Editor */

/** Longer texts are not tinted, in UTF-16 units: typing must stay quick. */
const TINTED = 8000;

/**
 * @param {HTMLTextAreaElement} area
 * @param {HTMLElement} problems the list under it
 * @param {'axiom' | 'rules' | 'overrides'} kind
 * @param {{change: (text: string) => void, settle: () => void}} on
 * @returns {Editor}
 */
export function editor(area, problems, kind, { change, settle }) {
    const layer = /** @type {HTMLElement} */ (area.previousElementSibling);
    /** @type {Diagnostic[]} */
    let marks = [];

    const paint = () => layer.replaceChildren(...pieces(area.value, kind, marks));

    area.addEventListener('input', () => {
        paint();
        change(area.value);
    });
    area.addEventListener('blur', settle);
    if (kind === 'axiom') {
        area.addEventListener('keydown', (event) => {
            if (event.key === 'Enter' && !event.isComposing) event.preventDefault();
        });
    }

    return {
        show(text) {
            if (area.value === text) return;
            setValue(area, text);
            paint();
        },
        mark(diagnostics) {
            if (JSON.stringify(diagnostics) === JSON.stringify(marks)) return;
            marks = diagnostics;
            area.setAttribute('aria-invalid', String(marks.some((mark) => mark.severity === 'error')));
            listProblems(problems, marks, area);
            paint();
        },
    };
}

/**
 * Lists diagnostics in words; where they have a place in `area`, a click goes there.
 * @param {HTMLElement} list
 * @param {Diagnostic[]} diagnostics
 * @param {HTMLTextAreaElement} [area]
 */
export function listProblems(list, diagnostics, area) {
    list.replaceChildren(
        ...diagnostics.map(({ severity, message, hint, start, end }) => {
            const words = [make('span', { class: 'problem-text' }, ...withCode(message))];
            if (hint) words.push(make('span', { class: 'problem-hint' }, ...withCode(hint)));
            if (!area) return make('li', { class: severity }, ...words);
            const go = make('button', { type: 'button', class: 'problem' }, make('span', { class: 'place' }, place(area.value, start)), ...words);
            go.addEventListener('click', () => {
                area.focus();
                area.setSelectionRange(start, Math.max(end, start));
            });
            return make('li', { class: severity }, go);
        }),
    );
}

/** What stands between backquotes is what one types. @param {string} words */
function withCode(words) {
    return words.split(/(`[^`]+`)/).map((part) => (part.length > 2 && part.startsWith('`') ? make('code', {}, part.slice(1, -1)) : part));
}

/** @param {string} text @param {number} offset */
function place(text, offset) {
    const before = text.slice(0, offset).split('\n');
    const column = [.../** @type {string} */ (before.at(-1))].length + 1;
    return text.includes('\n') ? `Line ${before.length}, column ${column}` : `Column ${column}`;
}

/**
 * The text in spans: tints and mistakes may overlap, so it is cut at every edge of either.
 * @param {string} text
 * @param {'axiom' | 'rules' | 'overrides'} kind
 * @param {Diagnostic[]} marks
 */
function pieces(text, kind, marks) {
    const spans = text.length > TINTED ? [] : tints(text, kind);
    // A mistake where something is missing has no width: underline the symbol before it.
    const wrong = marks.map(({ start, end, severity }) => (end > start ? { start, end, severity } : { start: Math.max(0, Math.min(start, text.length) - 1), end: Math.max(1, start), severity }));
    const edges = [...new Set([0, text.length, ...[...spans, ...wrong].flatMap(({ start, end }) => [start, end])])]
        .filter((edge) => edge >= 0 && edge <= text.length)
        .sort((a, b) => a - b);
    const nodes = [];
    let next = 0;
    for (let at = 0; at + 1 < edges.length; at++) {
        const from = /** @type {number} */ (edges[at]);
        const to = /** @type {number} */ (edges[at + 1]);
        while (next < spans.length && /** @type {{end: number}} */ (spans[next]).end <= from) next++;
        const span = spans[next];
        const over = wrong.filter(({ start, end }) => start <= from && end >= to).map(({ severity }) => severity);
        const names = [span && span.start <= from ? `t-${span.tint}` : '', over.includes('error') ? 'wrong' : over.length > 0 ? 'doubtful' : ''].filter(Boolean);
        const piece = text.slice(from, to);
        nodes.push(names.length > 0 ? make('span', { class: names.join(' ') }, piece) : document.createTextNode(piece));
    }
    // A line break at the end shows only when something follows it.
    nodes.push(document.createTextNode('\u200b'));
    return nodes;
}
