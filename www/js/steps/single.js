/** All symbols at once, as in an L-system, beside one symbol at a time, as in a grammar of Chomsky. */

import { byId, html, make } from '../base/dom.js';
import { grouped } from '../base/numerals.js';
import { say } from '../base/words.js';

/** The most steps in the table. */
const MOST = 24;
/** The symbols of a string that are shown. */
const SHOWN = 48;
/** A step is shown for this time while playing, in milliseconds. */
const PAUSE = 900;

/**
 * @param {import('./steps.js').StudyTool} tool
 * @returns {import('./steps.js').Part}
 */
export function createSingle(tool) {
    let at = 0;
    /** @type {{text: string, length: string}[]} */
    let all = [];
    /** @type {{text: string, length: number, made: [number, number] | null}[]} */
    let singles = [];
    const order = byId('steps-order', HTMLSelectElement);
    /** The shown system. @type {import('../protocol.js').Definition | null} */
    let system = null;

    const askSingles = (/** @type {import('../protocol.js').Definition} */ definition) =>
        tool.call('single', { definition, steps: MOST, rightmost: order.value === 'rightmost' });

    order.addEventListener('change', async () => {
        if (!system) return;
        const asked = system;
        const answer = await askSingles(asked).catch(() => null);
        if (!answer || asked !== system) return;
        singles = answer;
        draw();
    });

    function draw() {
        const rows = Array.from({ length: at + 1 }, (_, step) => {
            const [together, alone] = [all[step], singles[step]];
            return make(
                'tr',
                step === at ? { class: 'now' } : {},
                make('th', { scope: 'row' }, String(step)),
                make('td', {}, together ? grouped(together.length) : ''),
                make('td', {}, make('code', {}, together ? cut(together.text) : '')),
                make('td', {}, alone ? grouped(String(alone.length)) : ''),
                make('td', {}, ...(alone ? marked(alone) : [say`no rule fits`])),
            );
        });
        const head = make(
            'tr',
            {},
            ...[say`Step`, say`Symbols`, say`All at once`, say`Symbols`, say`One at a time`].map((words) =>
                make('th', { scope: 'col' }, words),
            ),
        );
        html('steps-table').replaceChildren(head, ...rows);
        html('steps-both').scrollTop = html('steps-both').scrollHeight;
    }

    return {
        get at() {
            return at;
        },
        get end() {
            return MOST;
        },
        pause: PAUSE,
        words: () =>
            say`Step ${at}: ${grouped(all[at]?.length ?? '') || say`too many`} symbols all at once, ${String((singles[at] ?? singles.at(-1))?.length ?? 0)} one at a time.`,
        async show(definition) {
            singles = await askSingles(definition);
            system = definition;
            all = [];
            for (let n = 0; n <= MOST; n++) {
                const rows = await tool.call('rows', { definition, n, start: '0', count: SHOWN + 1 }).catch(() => null);
                if (!rows) break;
                all.push({ text: rows.families.map(({ parent }) => parent).join(''), length: rows.lengths[0] });
            }
            at = Math.min(4, MOST);
            draw();
        },
        seek(next) {
            at = next;
            draw();
        },
    };
}

/** @param {string} text */
const cut = (text) => (text.length > SHOWN ? `${text.slice(0, SHOWN)}…` : text || 'ε');

/** A string with the symbols that the step made. @param {{text: string, made: [number, number] | null}} single */
function marked({ text, made }) {
    if (!made) return [make('code', {}, cut(text))];
    const [from, count] = made;
    const symbols = [...text];
    const [before, new_, after] = [
        symbols.slice(0, from),
        symbols.slice(from, from + count),
        symbols.slice(from + count),
    ].map((part) => part.join(''));
    if (from + count > SHOWN) return [make('code', {}, cut(text))];
    return [make('code', {}, before ?? '', make('mark', {}, new_ || '·'), after ? cut(after) : '')];
}
