/** The dialog that marks the answers of a class: a table with small pictures, and the most frequent mistakes. */

import styles from '../../css/course.css';
import own from '../../css/marks.css';
import { button, byId, closes, html, input, make, setText } from '../base/dom.js';
import { download } from '../base/download.js';
import { showFailure } from '../base/failure.js';
import { addElements } from '../base/late.js';
import { Cancelled } from '../engine/tool.js';
import { language, said, say } from '../base/words.js';
import markup from './marks.html';
import { createTextIntake } from './text-intake.js';
import { classTool as tool } from './tool.js';

/** @typedef {import('../protocol.js').MarkedAnswer} MarkedAnswer */
/** @typedef {{row: MarkedAnswer, element: HTMLTableRowElement, number: number}} Line */

/** The mistakes that are listed. */
const MOST_MISTAKES = 8;
/** The side of a picture's pixels, and their colours: none, ink of both, missing, too much. */
const SIDE = 128;
const COLOURS = [
    [0, 0, 0, 0],
    [150, 150, 150, 255],
    [0, 90, 181, 255],
    [220, 80, 0, 255],
];

/** @typedef {(line: Line) => string | number} Sorting */

/** By name, with the heading. @type {[string, string, Sorting | null][]} */
const COLUMNS = [
    ['name', say`Name`, ({ row }) => row.name.toLocaleLowerCase()],
    ['by', say`By`, ({ row }) => row.by.toLocaleLowerCase()],
    ['solved', say`Solved`, ({ row }) => (row.isSolved ? 0 : 1)],
    ['agrees', say`Agrees`, ({ row }) => -row.agreement],
    ['symbols', say`Symbols`, ({ row }) => row.symbols ?? Infinity],
    ['picture', say`Picture`, null],
    ['rules', say`Rules`, ({ row }) => row.rules],
    ['remark', say`Remark`, ({ row }) => row.words],
];
/** @type {[string, string, null]} */
const VARIANT = ['variant', say`Variant`, null];

/**
 * The table of marks.
 * @typedef {object} Table
 * @property {HTMLTableRowElement | undefined} head
 * @property {HTMLTableSectionElement | undefined} body
 * @property {AbortController} marking
 * @property {Line[]} lines
 * @property {string} csv
 * @property {string} title
 * @property {Set<number> | null} chosen The numbers of the answers with the chosen mistake; null for all
 * @property {{column: string, down: boolean}} order
 */

export function createMarks() {
    addElements(markup, [styles, own]);
    const dialog = byId('class-marks', HTMLDialogElement);
    const table = dialog.querySelector('table');
    const [head, body] = [table?.tHead?.rows[0], table?.tBodies[0]];
    /** @type {Table} */
    const self = {
        head,
        body,
        marking: new AbortController(),
        lines: [],
        csv: '',
        title: '',
        chosen: null,
        order: { column: '', down: false },
    };

    const intake = createTextIntake({
        dialog,
        field: byId('marks-answers', HTMLTextAreaElement),
        file: input('marks-file'),
        opener: button('marks-open'),
        taken: (text) => void mark(self, text),
        refused: (words) => {
            clear(self);
            setText(html('marks-status'), words);
        },
    });
    input('marks-exercise').addEventListener('input', intake.later);
    byId('marks-shown', HTMLSelectElement).addEventListener('change', () => arrange(self));
    input('marks-search').addEventListener('input', () => arrange(self));
    byId('marks-asked', HTMLFormElement).addEventListener('submit', (event) => event.preventDefault());
    button('marks-save').addEventListener('click', () => {
        // Spreadsheets take the text for UTF-8 only with this mark.
        if (self.csv !== '') download(new Blob(['\ufeff', self.csv], { type: 'text/csv' }), 'marks.csv');
    });
    dialog.addEventListener('close', () => self.marking.abort());
    closes(dialog, 'close-marks');

    return {
        open() {
            dialog.showModal();
            if (self.lines.length === 0) intake.take();
        },
    };
}

/** @param {MarkedAnswer} row @param {Uint8Array | null} picture @param {boolean} hasVariants */
function lineOf(row, picture, hasVariants) {
    const { link } = row;
    const isWeb = link !== null && /^https?:/.test(link);
    const name = isWeb
        ? make('a', { href: link, target: '_blank', rel: 'noopener noreferrer' }, row.name)
        : make('span', {}, row.name);
    return make(
        'tr',
        {},
        make('td', {}, name),
        make('td', {}, row.by),
        make('td', { class: row.isSolved ? 'yes' : '' }, row.isSolved ? say`yes` : say`no`),
        make('td', { class: 'figure' }, row.percent),
        make('td', { class: 'figure' }, row.symbols === null ? '' : String(row.symbols)),
        make('td', {}, ...(picture ? [canvasOf(picture)] : [])),
        make('td', {}, make('pre', {}, row.rules)),
        make('td', {}, row.words),
        ...(hasVariants ? [make('td', { class: 'figure' }, String(row.variant))] : []),
    );
}

/** @param {Table} self @param {boolean} hasVariants */
function showHead(self, hasVariants) {
    const columns = hasVariants ? [...COLUMNS, VARIANT] : COLUMNS;
    self.head?.replaceChildren(
        ...columns.map(([column, words, sorting]) => {
            if (!sorting) return make('th', { scope: 'col' }, words);
            const sorts = make('button', { class: 'sorts' }, words);
            sorts.addEventListener('click', () => {
                self.order = { column, down: self.order.column === column && !self.order.down };
                arrange(self);
            });
            return make('th', { scope: 'col', 'data-column': column }, sorts);
        }),
    );
}

/** Sorts and filters the table. @param {Table} self */
function arrange(self) {
    const sorting = COLUMNS.find(([column]) => column === self.order.column)?.[2];
    const sign = self.order.down ? -1 : 1;
    const sorted = [...self.lines];
    if (sorting)
        sorted.sort((a, b) => {
            const [x, y] = [sorting(a), sorting(b)];
            const compared =
                typeof x === 'string' ? x.localeCompare(String(y), language, { numeric: true }) : x - Number(y);
            return sign * compared || a.number - b.number;
        });
    for (const cell of self.head?.cells ?? []) {
        const isOrder = cell.dataset['column'] === self.order.column;
        if (isOrder) cell.setAttribute('aria-sort', self.order.down ? 'descending' : 'ascending');
        else cell.removeAttribute('aria-sort');
    }
    const shown = byId('marks-shown', HTMLSelectElement).value;
    const words = input('marks-search').value.trim().toLocaleLowerCase();
    for (const { row, element, number } of sorted) {
        const isFound = `${row.name}\n${row.by}\n${row.rules}`.toLocaleLowerCase().includes(words);
        const isAsked = shown === '' || (shown === 'yes') === row.isSolved;
        element.hidden = !isFound || !isAsked || (self.chosen !== null && !self.chosen.has(number));
    }
    self.body?.replaceChildren(...sorted.map(({ element }) => element));
}

/** @param {Table} self @param {import('../protocol.js').MistakeReport[]} mistakes */
function showMistakes(self, mistakes) {
    const frequent = mistakes.filter((mistake) => mistake.answers.length > 1).slice(0, MOST_MISTAKES);
    html('marks-mistakes').replaceChildren(
        ...frequent.map(({ words, answers: numbers }) => {
            const example = self.lines[numbers[0] ?? 0]?.row.name ?? '';
            const chooses = make(
                'button',
                { 'aria-pressed': 'false', title: say`For example ${example}` },
                make('strong', {}, say`${numbers.length} of ${self.lines.length}`),
                ` ${words}`,
            );
            chooses.addEventListener('click', () => {
                const isOn = chooses.getAttribute('aria-pressed') === 'true';
                for (const other of html('marks-mistakes').querySelectorAll('button'))
                    other.setAttribute('aria-pressed', 'false');
                chooses.setAttribute('aria-pressed', String(!isOn));
                self.chosen = isOn ? null : new Set(numbers);
                arrange(self);
            });
            return make('li', {}, chooses);
        }),
    );
}

/** Ends marking, and shows no result. @param {Table} self */
function clear(self) {
    self.marking.abort();
    self.marking = new AbortController();
    self.lines = [];
    [self.chosen, self.csv] = [null, ''];
    html('marks-result').hidden = true;
    html('marks-status').replaceChildren();
}

/** @param {Table} self @param {string} text */
async function mark(self, text) {
    clear(self);
    if (text.trim() === '') return;
    const turn = self.marking;
    const status = html('marks-status');
    setText(status, say`Marking…`);
    let all = 0;
    let [hasVariants, program] = [false, ''];
    const progress = (/** @type {import('../protocol.js').ClassProgress} */ told) => {
        if (turn !== self.marking) return;
        if ('about' in told) {
            ({ title: self.title, answers: all, program } = told.about);
            hasVariants = told.about.variants > 1;
            showHead(self, hasVariants);
            self.body?.replaceChildren();
            showMistakes(self, []);
            html('marks-result').hidden = false;
            return;
        }
        const element = lineOf(told.row, told.picture, hasVariants);
        self.lines.push({ row: told.row, element, number: self.lines.length });
        self.body?.append(element);
        setText(status, say`Marking… ${self.lines.length} of ${all}`);
    };
    try {
        const exercise = input('marks-exercise').value;
        const done = await tool.call('markClass', { exercise, text }, { signal: turn.signal, progress });
        if (turn !== self.marking) return;
        if (program) {
            const { runClass } = await import('../programs/class.js');
            const shown = (/** @type {MarkedAnswer} */ row, /** @type {number} */ number) =>
                (self.lines[number] = { row, element: lineOf(row, null, hasVariants), number });
            Object.assign(done, await runClass(program, self.lines, turn.signal, shown));
        }
        self.csv = done.csv;
        showMistakes(self, done.mistakes);
        const solved = self.lines.filter(({ row }) => row.isSolved).length;
        setText(
            status,
            self.title === ''
                ? say`${solved} of ${self.lines.length} solved.`
                : say`${said(self.title)}: ${solved} of ${self.lines.length} solved.`,
        );
        arrange(self);
    } catch (error) {
        if (error instanceof Cancelled || turn !== self.marking) return;
        showFailure(status, error, () => void mark(self, text));
    }
}

/** @param {Uint8Array} picture */
function canvasOf(picture) {
    const canvas = make('canvas', { width: String(SIDE), height: String(SIDE), 'aria-hidden': 'true' });
    const pixels = new ImageData(SIDE, SIDE);
    picture.forEach((value, at) => pixels.data.set(COLOURS[value] ?? [0, 0, 0, 0], 4 * at));
    canvas.getContext('2d')?.putImageData(pixels, 0, 0);
    return canvas;
}
