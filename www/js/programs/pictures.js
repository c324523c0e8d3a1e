/** Pictures of lines, the own ones and the true ones at the same place and size, and the times of words. */

import { make, svg } from '../base/dom.js';
import { say } from '../base/words.js';

/** @typedef {number[][]} Line */

/** More lines are not drawn. */
const MOST = 200_000;
/** The part of the picture that stays free at each side. */
const FREE = 0.06;

/** The lines of a result; those that are none are left out. Ends may stand in one list. @param {unknown} value @returns {Line[]} */
export function linesOf(value) {
    if (!Array.isArray(value)) return [];
    const isPoint = (/** @type {any} */ point) =>
        Array.isArray(point) && point.length >= 2 && point.every(Number.isFinite);
    return value.slice(0, MOST).filter((line) => Array.isArray(line) && isPoint(line[0]) && isPoint(line[1]));
}

/** A point in space as seen from the front, a little from the right and above. @param {number[]} point */
const flat = ([x = 0, y = 0, z = 0]) => [x + 0.35 * z, y + 0.18 * z];

/**
 * Draws lines, fitted as the extent of `frame`, so that the same lines lie at the same place.
 * @param {HTMLCanvasElement} canvas
 * @param {readonly Line[]} lines
 * @param {readonly Line[]} frame
 * @param {{ink: string, wrong?: {from: number, ink: string}}} look `wrong` colours the lines from this one on
 */
export function drawLines(canvas, lines, frame, { ink, wrong }) {
    const ratio = Math.min(2, devicePixelRatio || 1);
    const [width = 0, height = 0] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.round(side * ratio));
    const context = canvas.getContext('2d');
    if (!context || width < 2 || height < 2) return;
    [canvas.width, canvas.height] = [width, height];
    const extent = [Infinity, Infinity, -Infinity, -Infinity];
    for (const end of (frame.length > 0 ? frame : lines).flat()) {
        const [x = 0, y = 0] = flat(end);
        extent[0] = Math.min(extent[0] ?? 0, x);
        extent[1] = Math.min(extent[1] ?? 0, y);
        extent[2] = Math.max(extent[2] ?? 0, x);
        extent[3] = Math.max(extent[3] ?? 0, y);
    }
    const [left = 0, bottom = 0, right = 0, top = 0] = extent;
    const scale =
        (1 - 2 * FREE) * Math.min(width / Math.max(right - left, 1e-9), height / Math.max(top - bottom, 1e-9));
    const size = Math.min(scale, Math.max(width, height));
    const place = (/** @type {number[] | undefined} */ point) => {
        const [x = 0, y = 0] = flat(point ?? []);
        return /** @type {const} */ ([
            width / 2 + (x - (left + right) / 2) * size,
            height / 2 - (y - (top + bottom) / 2) * size,
        ]);
    };
    context.lineCap = 'round';
    context.lineWidth = ratio * (lines.length > 2000 ? 0.9 : 1.4);
    const parts = wrong
        ? /** @type {const} */ ([
              [lines.slice(0, wrong.from), ink],
              [lines.slice(wrong.from), wrong.ink],
          ])
        : /** @type {const} */ ([[lines, ink]]);
    for (const [part, colour] of parts) {
        context.strokeStyle = colour;
        context.beginPath();
        for (const [from, to] of part) {
            context.moveTo(...place(from));
            context.lineTo(...place(to));
        }
        context.stroke();
    }
}

/** How long words take, by the number of steps. @typedef {{n: number, symbols: number, own: number, engine: number | null}} Time */

/** A table and a plot of times. @param {readonly Time[]} times */
export function timesOf(times) {
    const [width, height, edge] = [320, 150, 26];
    const most = Math.max(1, ...times.flatMap(({ own, engine }) => [own, engine ?? 0]));
    const [low, high] = [-1, Math.ceil(Math.log10(most))];
    const x = (/** @type {number} */ n) => edge + ((width - edge - 8) * n) / Math.max(1, times.at(-1)?.n ?? 1);
    const y = (/** @type {number} */ ms) =>
        height - edge - ((height - edge - 8) * (Math.log10(Math.max(ms, 0.1)) - low)) / (high - low || 1);
    const way = (/** @type {(time: Time) => number | null} */ of) =>
        times
            .filter((time) => of(time) !== null)
            .map((time) => `${x(time.n)},${y(of(time) ?? 0)}`)
            .join(' ');
    const plot = svg(
        'svg',
        { viewBox: `0 0 ${width} ${height}`, class: 'times-plot', 'aria-hidden': 'true' },
        ...Array.from({ length: high - low + 1 }, (_, at) =>
            svg('line', { x1: edge, x2: width, y1: y(10 ** (low + at)), y2: y(10 ** (low + at)), class: 'grid' }),
        ),
        ...Array.from({ length: high - low + 1 }, (_, at) => {
            const label = svg('text', { x: edge - 4, y: y(10 ** (low + at)) + 3, 'text-anchor': 'end' });
            label.textContent = String(10 ** (low + at));
            return label;
        }),
        svg('polyline', { points: way(({ engine }) => engine), class: 'engine' }),
        svg('polyline', { points: way(({ own }) => own), class: 'own' }),
    );
    const head = ['n', say`Symbols`, say`Yours (ms)`, say`Engine (ms)`].map((words) =>
        make('th', { scope: 'col' }, words),
    );
    const cell = (/** @type {string} */ words) => make('td', { class: 'figure' }, words);
    const rows = times.map(({ n, symbols, own, engine }) =>
        make(
            'tr',
            {},
            cell(String(n)),
            cell(symbols.toLocaleString()),
            cell(own.toFixed(1)),
            cell(engine === null ? '' : engine.toFixed(1)),
        ),
    );
    return [
        plot,
        make('table', { class: 'times' }, make('thead', {}, make('tr', {}, ...head)), make('tbody', {}, ...rows)),
    ];
}
