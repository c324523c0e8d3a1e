/** What the mathematics says: how the generations grow, in words, as a plot, a matrix and a table. */

import styles from '../../css/course.css';
import { button, html, make, setText, svg } from '../base/dom.js';
import { download, fileName } from '../base/download.js';
import { copyText } from '../base/copy.js';
import { showFailure } from '../base/failure.js';
import { addElements } from '../base/late.js';
import { raised, shortText } from '../base/numerals.js';
import { definitionOf, sameSystem } from '../state/state.js';
import { counted, language, say } from '../base/words.js';
import markup from './mathematics.html';
import { studyTool as tool } from './tool.js';

/** @typedef {import('../protocol.js').Growth} Growth */

/** The plot's size, in its own units, and its margins. */
const [WIDTH, HEIGHT, LEFT, BOTTOM, TOP] = [320, 150, 34, 20, 8];
/** The most generations in the plot and in the table. */
const MOST_SHOWN = 40;

/** @param {import('../dialogs/dialogs.js').Page} page */
export function createMathematics({ store, open }) {
    const part = html('mathematics');
    addElements(markup, [styles], part);
    /** The last answer, for the files. @type {{csv: string, latex: string} | null} */
    let made = null;
    /** The state that is shown. @type {Readonly<import('../state/state.js').State> | null} */
    let shown = null;
    let turn = 0;

    async function show() {
        if (!(part instanceof HTMLDetailsElement) || !part.open) return;
        const state = store.state;
        if (shown && sameSystem(shown, state)) return;
        shown = state;
        const own = ++turn;
        /** @type {unknown} */
        let failure = null;
        const answer = await tool.call('growth', { definition: definitionOf(state) }).catch((error) => {
            failure = error;
            return null;
        });
        if (own !== turn) return;
        made = answer?.growth ? answer : null;
        html('math-known').hidden = made === null;
        html('math-words').replaceChildren(
            ...(answer?.growth?.sentences ?? [answer?.why || say`This could not be computed.`]).map((words) =>
                make('p', {}, words),
            ),
        );
        if (failure) {
            // The same system is asked for again.
            shown = null;
            return showFailure(html('math-words'), failure, show);
        }
        if (!answer?.growth) return;
        plot(answer.growth, state.iterations);
        matrix(answer.growth, answer.shown);
        table(answer.growth, state.iterations);
    }

    store.subscribe(() => void show());
    button('math-csv').addEventListener(
        'click',
        () => made && download(new Blob([made.csv], { type: 'text/csv' }), `${fileName(store.state)}_growth.csv`),
    );
    button('math-project').addEventListener('click', () => void open('projector', 'mathematics'));
    button('math-latex').addEventListener('click', async () => {
        if (!made) return;
        if (await copyText(made.latex)) setText(html('math-status'), say`LaTeX copied`);
        else download(new Blob([made.latex], { type: 'text/x-tex' }), `${fileName(store.state)}_growth.tex`);
    });

    return {
        /** Shows the growth of the present system, if this part of the page is open. */
        open() {
            shown = null;
            return show();
        },
    };
}

/** @param {Growth} growth @param {number} n */
function plot(growth, n) {
    const rows = growth.table
        .slice(0, Math.max(n, 8) + 1)
        .filter((_, at, all) => all.length <= 4 * MOST_SHOWN || at % Math.ceil(all.length / (4 * MOST_SHOWN)) === 0);
    const most = Math.max(1, ...rows.flatMap(({ symbols, segments }) => [symbols.log10 ?? 0, segments.log10 ?? 0]));
    const last = rows.at(-1)?.n ?? 1;
    const x = (/** @type {number} */ at) => LEFT + (at / Math.max(1, last)) * (WIDTH - LEFT - 8);
    const y = (/** @type {number} */ log) => HEIGHT - BOTTOM - (log / most) * (HEIGHT - BOTTOM - TOP);
    /** @param {'symbols' | 'segments'} what */
    const line = (what) =>
        svg('polyline', {
            class: what,
            points: rows
                .flatMap((row) =>
                    row[what].log10 === null ? [] : [`${x(row.n).toFixed(1)},${y(row[what].log10 ?? 0).toFixed(1)}`],
                )
                .join(' '),
        });
    const step = Math.max(1, Math.ceil(most / 4));
    const marks = Array.from({ length: Math.floor(most / step) + 1 }, (_, at) => at * step);
    const now = rows.find((row) => row.n === n);
    const picture = svg('svg', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img' });
    picture.append(
        svg(
            'title',
            {},
            `${say`Symbols and segments by generation, on a logarithmic scale.`} ${growth.sentences[0] ?? ''}`,
        ),
        ...marks.flatMap((log) => [
            svg('line', { class: 'grid', x1: LEFT, x2: WIDTH - 8, y1: y(log), y2: y(log) }),
            svg(
                'text',
                { x: LEFT - 4, y: y(log) + 3, 'text-anchor': 'end' },
                log === 0 ? '1' : log === 1 ? '10' : `10${raised(log)}`,
            ),
        ]),
        svg('line', { class: 'now', x1: x(n), x2: x(n), y1: TOP, y2: HEIGHT - BOTTOM }),
        line('symbols'),
        line('segments'),
        ...(now?.segments.log10 == null ? [] : [svg('circle', { cx: x(n), cy: y(now.segments.log10), r: 3 })]),
        svg('text', { x: LEFT, y: HEIGHT - 6 }, '0'),
        svg('text', { x: WIDTH - 8, y: HEIGHT - 6, 'text-anchor': 'end' }, String(last)),
        svg(
            'text',
            { x: x(n), y: HEIGHT - 6, 'text-anchor': 'middle', class: n > 0 && n < last ? '' : 'unseen-text' },
            n > 0 && n < last ? `n = ${n}` : '',
        ),
    );
    html('math-plot').replaceChildren(picture);
}

/** @param {Growth} growth @param {number} most */
function matrix(growth, most) {
    const letters = growth.letters.slice(0, most);
    const head = make(
        'tr',
        {},
        make('td', {}),
        ...letters.map((letter) => make('th', { scope: 'col' }, make('code', {}, letter))),
    );
    const rows = letters.map((letter, at) =>
        make(
            'tr',
            {},
            make('th', { scope: 'row' }, make('code', {}, letter)),
            ...letters.map((_, to) => make('td', {}, number(growth.matrix[at]?.[to] ?? 0))),
        ),
    );
    html('math-matrix').replaceChildren(
        make(
            'caption',
            {},
            growth.isRandom
                ? say`What a letter becomes in one step, on average`
                : say`What a letter becomes in one step`,
        ),
        head,
        ...rows,
    );
    const more = growth.letterCount - letters.length;
    setText(html('math-more'), more > 0 ? counted(more, 'And {} more letter.', 'And {} more letters.') : '');
}

/** @param {Growth} growth @param {number} n */
function table(growth, n) {
    const from = Math.max(0, Math.min(n - MOST_SHOWN / 2, growth.table.length - MOST_SHOWN));
    const rows = growth.table
        .slice(from, from + MOST_SHOWN)
        .map((row) =>
            make(
                'tr',
                row.n === n ? { class: 'now', 'aria-current': 'true' } : {},
                make('th', { scope: 'row' }, String(row.n)),
                make('td', { title: row.symbols.digits }, short(row.symbols.digits)),
                make('td', { title: row.segments.digits }, short(row.segments.digits)),
                make(
                    'td',
                    {},
                    row.spread !== null
                        ? `± ${number(row.spread)}`
                        : row.size
                          ? `${number(row.size[0])} × ${number(row.size[1])}`
                          : '',
                ),
            ),
        );
    html('math-table').replaceChildren(
        make('caption', { class: 'unseen' }, say`Generations`),
        make(
            'tr',
            {},
            ...['n', say`Symbols`, say`Segments`, growth.isRandom ? say`Spread` : say`Size`].map((words) =>
                make('th', { scope: 'col' }, words),
            ),
        ),
        ...rows,
    );
}

/** @param {string} digits */
const short = (digits) => (/^\d+$/.test(digits) ? shortText(digits) : digits);

/** A number with at most three decimals. @param {number} value */
const number = (value) =>
    Math.abs(value) >= 1e6
        ? value.toExponential(2)
        : (Math.round(value * 1000) / 1000 + 0).toLocaleString(language, { useGrouping: false });
