/** One derivation step: every symbol with what it becomes under it, all at once. */

import { button, html, make } from '../dom.js';
import { grouped } from '../numerals.js';
import { say } from '../words.js';

/** @typedef {import('../protocol.js').StepRows} StepRows */

/** The symbols of a row. */
const COUNT = 60;
/** A generation is shown for this time while playing, in milliseconds. */
const PAUSE = 1400;

/**
 * @param {import('./steps.js').CourseTool} tool
 * @param {(words: string) => void} told
 * @returns {import('./steps.js').Part}
 */
export function createDerivation(tool, told) {
    const list = html('steps-families');
    /** @type {import('./steps.js').Definition | null} */
    let definition = null;
    let at = 0;
    let end = 0;
    let start = 0n;
    let turn = 0;
    /** @type {StepRows | null} */
    let rows = null;

    async function read() {
        if (!definition) return;
        const own = ++turn;
        const made = await tool
            .call('rows', { definition, n: at, start: String(start), count: COUNT })
            .catch((error) => {
                if (own !== turn) return null;
                rows = null;
                list.replaceChildren();
                for (const id of ['steps-earlier', 'steps-later']) button(id).disabled = true;
                throw error;
            });
        if (own !== turn || !made) return;
        rows = made;
        start = BigInt(made.start);
        list.replaceChildren(...made.families.map(family));
        list.classList.remove('arriving');
        void list.offsetWidth;
        list.classList.add('arriving');
        button('steps-earlier').disabled = start === 0n;
        button('steps-later').disabled = start + BigInt(made.families.length) >= BigInt(made.lengths[0]);
        told(rest());
    }

    /** @param {StepRows['families'][number]} family @param {number} index */
    function family({ parent, children, more }, index) {
        const stays = children.length === 1 && children[0] === parent;
        const becomes =
            children.length === 0
                ? [make('span', { class: 'gone' }, say`nothing`)]
                : children.map((child) => make('code', {}, child));
        if (more !== '0') becomes.push(make('span', { class: 'more' }, `+${grouped(more)}`));
        const item = make(
            'li',
            {
                class: stays ? 'family stays' : 'family',
                tabindex: index === 0 ? '0' : '-1',
                'aria-label': stays
                    ? say`${parent} stays`
                    : children.length === 0
                      ? say`${parent} becomes nothing`
                      : say`${parent} becomes ${children.join('')}`,
            },
            make('code', { class: 'parent' }, parent),
            make('span', { class: 'children' }, ...becomes),
        );
        const tell = () => told(wordsOf(index));
        item.addEventListener('pointerenter', tell);
        item.addEventListener('pointerleave', () => told(rest()));
        item.addEventListener('focus', tell);
        return item;
    }

    const rest = () =>
        rows
            ? say`Symbols ${grouped(String(start + 1n))} to ${grouped(String(start + BigInt(rows.families.length)))} of ${grouped(rows.lengths[0])}.`
            : '';

    /** @param {number} index */
    function wordsOf(index) {
        const family = rows?.families[index];
        if (!family) return '';
        const place = grouped(String(start + BigInt(index) + 1n));
        const count = BigInt(family.children.length) + BigInt(family.more);
        const first = BigInt(family.first) + 1n;
        const where =
            count === 0n
                ? say`It is deleted.`
                : count === 1n
                  ? say`It becomes symbol ${grouped(String(first))} of generation ${at + 1}.`
                  : say`It becomes symbols ${grouped(String(first))} to ${grouped(String(first + count - 1n))} of generation ${at + 1}.`;
        return `${say`${family.parent} is symbol ${place} of generation ${at}.`} ${where}`;
    }

    /** @param {bigint} next */
    function move(next) {
        start = next < 0n ? 0n : next;
        void read().catch((error) => told(error instanceof Error ? error.message : String(error)));
    }

    list.addEventListener('keydown', (event) => {
        const items = [...list.children].filter((item) => item instanceof HTMLElement);
        const now = items.findIndex((item) => item === document.activeElement);
        const next = { ArrowRight: now + 1, ArrowLeft: now - 1, Home: 0, End: items.length - 1 }[event.key];
        const item = next === undefined ? undefined : items[Math.max(0, Math.min(items.length - 1, next))];
        if (!item) return;
        event.preventDefault();
        items.forEach((each) => (each.tabIndex = each === item ? 0 : -1));
        item.focus();
    });
    button('steps-earlier').addEventListener('click', () => move(start - BigInt(COUNT)));
    button('steps-later').addEventListener('click', () => move(start + BigInt(COUNT)));

    return {
        get at() {
            return at;
        },
        get end() {
            return end;
        },
        pause: PAUSE,
        words: () =>
            rows
                ? say`Generation ${at}: ${grouped(rows.lengths[0])} symbols. Generation ${at + 1}: ${grouped(rows.lengths[1])}.`
                : say`Generation ${at} cannot be read.`,
        async show(next, n) {
            definition = next;
            end = n;
            [at, start] = [0, 0n];
            await read();
        },
        seek(next) {
            [at, start] = [next, 0n];
            return read().catch((error) => told(error instanceof Error ? error.message : String(error)));
        },
    };
}
