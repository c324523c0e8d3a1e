/** The programs of a class, run one by one in a frame of the page for programs, which alone may run them. */

import { make } from '../base/dom.js';
import { Cancelled } from '../engine/tool.js';
import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').MarkedAnswer} MarkedAnswer */
/** What the frame tells of an answer. @typedef {{at: number, isSolved: boolean, agreement: number, words: string, code: string}} Told */

/** The frame is given up after this time without a word, in milliseconds: the interpreter may have to load. */
const LONGEST = 120_000;

/** A cell of a table: no spreadsheet shall take it for a formula. @param {string | number} value */
const cell = (value) =>
    `"${String(value)
        .replace(/^(?=\s*[=+\-@|])/, "'")
        .replaceAll('"', '""')}"`;

/**
 * Marks the answers of these rows, and tells each row. Returns the table as CSV, and the mistakes that several have.
 * @param {string} x the exercise
 * @param {readonly {row: MarkedAnswer}[]} lines
 * @param {AbortSignal} signal
 * @param {(row: MarkedAnswer, at: number) => unknown} marked
 */
export async function runClass(x, lines, signal, marked) {
    const frame = make('iframe', { hidden: true, title: '', src: `program.html#v=1&x=${x}&class=1` });
    const all = lines.map(({ row }) => row);
    document.body.append(frame);
    try {
        await new Promise((resolve, reject) => {
            let timer = 0;
            let at = -1;
            const wait = () => {
                clearTimeout(timer);
                timer = window.setTimeout(() => reject(new Error(say`the page for programs does not answer`)), LONGEST);
            };
            addEventListener(
                'message',
                (/** @type {MessageEvent<{program?: Told | null}>} */ { source, origin, data }) => {
                    if (source !== frame.contentWindow || origin !== location.origin || data.program === undefined)
                        return;
                    const [row, told] = [all[at], data.program];
                    if (row && told) {
                        const { isSolved, agreement, words, code } = told;
                        const percent = `${Math.floor(100 * agreement)} %`;
                        all[at] = {
                            ...row,
                            isSolved,
                            agreement,
                            percent,
                            symbols: null,
                            rules: code.slice(0, 2000),
                            words,
                        };
                        marked(/** @type {MarkedAnswer} */ (all[at]), at);
                    }
                    at += 1;
                    wait();
                    if (at >= all.length) resolve(null);
                    else frame.contentWindow?.postMessage({ answer: all[at]?.link ?? '' }, location.origin);
                },
                { signal },
            );
            signal.addEventListener('abort', () => reject(new Cancelled()));
            wait();
        });
    } finally {
        frame.remove();
    }
    /** @type {Map<string, number[]>} */
    const found = new Map();
    for (const [at, { words, isSolved }] of all.entries())
        if (!isSolved) found.set(words, [...(found.get(words) ?? []), at]);
    const mistakes = [...found]
        .map(([words, answers]) => ({ words, answers }))
        .sort((a, b) => b.answers.length - a.answers.length);
    const cells = all.map(({ name, by, isSolved, agreement, words, link }) =>
        [name, by, isSolved ? 'yes' : 'no', Math.floor(100 * agreement), words, link ?? ''].map(cell).join(','),
    );
    return { csv: ['name,by,solved,agreement_percent,remark,link', ...cells, ''].join('\n'), mistakes };
}
