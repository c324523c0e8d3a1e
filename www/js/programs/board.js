/** The functions of an exercise: what each must do, what it gave and what was expected, and what is wrong. */

import { make, setText } from '../base/dom.js';
import { say } from '../base/words.js';
import { faultWords } from './faults.js';
import { short, whyWrong } from './judge.js';
import { callOf } from './tasks.js';

/** @typedef {import('./judge.js').Judged} Judged */
/** @typedef {import('./runner.js').Language} Language */

/** The calls of a function that are shown before it is written, and afterwards. */
const [EXAMPLES, MOST] = [3, 7];

/** The head of a function, to begin with. @param {string} name @param {string} params @param {Language} language */
const headOf = (name, params, language) =>
    language === 'python' ? `def ${name}(${params}):\n    ` : `function ${name}(${params}) {\n    \n}\n`;

/**
 * @param {HTMLElement} list
 * @param {import('./tasks.js').Task} task
 * @param {{begin: (text: (language: Language) => string) => void}} page
 */
export function createBoard(list, { functions }, { begin }) {
    const rows = functions.map(({ name, params, says, tests }) => {
        const [sign, words] = [
            make('span', { class: 'sign', role: 'img' }),
            make('p', { class: 'why', role: 'status' }),
        ];
        const body = make('tbody');
        const starts = make('button', { class: 'button quiet' }, say`Write it`);
        starts.addEventListener('click', () => begin((language) => headOf(name, params, language)));
        const asks = make('button', { class: 'button quiet', hidden: true }, say`What is wrong?`);
        const heads = [say`Call`, say`Expected`, say`Yours`];
        const head = heads.map((title) => make('th', { scope: 'col' }, title));
        const row = make(
            'details',
            { class: 'function', name: 'functions' },
            make('summary', {}, sign, make('code', {}, `${name}(${params})`)),
            make('p', { class: 'says' }, says),
            make('p', { class: 'ways' }, starts, asks),
            words,
            make('div', { class: 'calls' }, make('table', {}, make('thead', {}, make('tr', {}, ...head)), body)),
        );
        const line = (
            /** @type {string} */ call,
            /** @type {unknown} */ expected,
            /** @type {string} */ got,
            /** @type {string} */ kind,
        ) =>
            make(
                'tr',
                { class: kind },
                ...[call, short(expected), got].map((text, at) =>
                    make('td', { 'data-head': heads[at] ?? '' }, make('code', {}, text)),
                ),
            );
        body.append(
            ...tests.slice(0, EXAMPLES).map(({ args, expected }) => line(callOf(name, args), expected, '', '')),
        );
        list.append(row);
        /** @type {Judged | null} */
        let last = null;
        asks.addEventListener('click', () => {
            if (last?.wrong) setText(words, `${last.wrong.call}: ${whyWrong(name, last.wrong)}`);
        });
        return {
            row,
            /** @param {Judged} now */
            show(now) {
                last = now;
                const state = now.isRight ? 'right' : now.isOwn ? 'wrong' : 'missing';
                row.dataset['state'] = state;
                const names = { right: say`right`, wrong: say`not right yet`, missing: say`not written yet` };
                sign.setAttribute('aria-label', names[state]);
                starts.hidden = now.isOwn;
                asks.hidden = !now.wrong || now.wrong.given.fault !== undefined;
                const fault = now.wrong?.given.fault;
                setText(words, fault ? `${now.wrong?.call}: ${faultWords(fault)}` : '');
                if (now.tried.length === 0) return;
                const first = now.wrong ? Math.max(0, now.tried.indexOf(now.wrong) - 2) : 0;
                body.replaceChildren(
                    ...now.tried
                        .slice(first, first + MOST)
                        .map(({ call, expected, got, given, isRight }) =>
                            line(
                                call,
                                expected,
                                given.fault ? given.fault.type : given.nothing ? say`nothing` : short(got),
                                isRight ? 'right' : 'wrong',
                            ),
                        ),
                );
            },
        };
    });
    const [one] = rows;
    if (one) one.row.open = true;
    return {
        /** @param {readonly Judged[]} all */
        show(all) {
            const open = rows.findIndex(({ row }) => row.open);
            for (const [at, row] of rows.entries()) if (all[at]) row.show(all[at]);
            // Whoever works on a function sees it; a right one gives way to the next that is not.
            const next = all.findIndex((judged) => judged.isOwn && !judged.isRight);
            const after = next < 0 ? all.findIndex((judged) => !judged.isRight) : next;
            const at = open >= 0 && !all[open]?.isRight && all[open]?.isOwn ? open : after;
            for (const [number, { row }] of rows.entries()) row.open = number === at;
        },
    };
}
