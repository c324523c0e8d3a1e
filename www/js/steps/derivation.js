/** One derivation step: every symbol with what it becomes under it, all at once. */

import { button, html, make } from '../base/dom.js';
import { grouped } from '../base/numerals.js';
import { reasonOf, say } from '../base/words.js';

/** @typedef {import('../protocol.js').StepRows} StepRows */

/** The symbols of a row. */
const COUNT = 60;
/** A generation is shown for this time while playing, in milliseconds. */
const PAUSE = 1400;

/**
 * The list of steps.
 * @typedef {object} Derivation
 * @property {import('./steps.js').StudyTool} tool
 * @property {(words: string) => void} told
 * @property {HTMLElement} list
 * @property {import('./steps.js').Definition | null} definition
 * @property {number} at
 * @property {bigint} start
 * @property {number} turn
 * @property {StepRows | null} rows
 */

/**
 * @param {import('./steps.js').StudyTool} tool
 * @param {(words: string) => void} told
 * @returns {import('./steps.js').Part}
 */
export function createDerivation(tool, told) {
    /** @type {Derivation} */
    const self = { tool, told, list: html('steps-families'), definition: null, at: 0, start: 0n, turn: 0, rows: null };

    let end = 0;

    self.list.addEventListener('keydown', (event) => {
        const items = [...self.list.children].filter((item) => item instanceof HTMLElement);
        const now = items.findIndex((item) => item === document.activeElement);
        const next = { ArrowRight: now + 1, ArrowLeft: now - 1, Home: 0, End: items.length - 1 }[event.key];
        const item = next === undefined ? undefined : items[Math.max(0, Math.min(items.length - 1, next))];
        if (!item) return;
        event.preventDefault();
        items.forEach((each) => (each.tabIndex = each === item ? 0 : -1));
        item.focus();
    });
    button('steps-earlier').addEventListener('click', () => move(self, self.start - BigInt(COUNT)));
    button('steps-later').addEventListener('click', () => move(self, self.start + BigInt(COUNT)));

    return {
        get at() {
            return self.at;
        },
        get end() {
            return end;
        },
        pause: PAUSE,
        words: () =>
            self.rows
                ? say`Generation ${self.at}: ${grouped(self.rows.lengths[0])} symbols. Generation ${self.at + 1}: ${grouped(self.rows.lengths[1])}.`
                : say`Generation ${self.at} cannot be read.`,
        async show(next, n) {
            self.definition = next;
            end = n;
            [self.at, self.start] = [0, 0n];
            await read(self);
        },
        seek(next) {
            [self.at, self.start] = [next, 0n];
            return read(self).catch((error) => told(reasonOf(error)));
        },
    };
}

/** @param {Derivation} self */
async function read(self) {
    if (!self.definition) return;
    const own = ++self.turn;
    const made = await self.tool
        .call('rows', { definition: self.definition, n: self.at, start: String(self.start), count: COUNT })
        .catch((error) => {
            if (own !== self.turn) return null;
            self.rows = null;
            self.list.replaceChildren();
            for (const id of ['steps-earlier', 'steps-later']) button(id).disabled = true;
            throw error;
        });
    if (own !== self.turn || !made) return;
    self.rows = made;
    self.start = BigInt(made.start);
    self.list.replaceChildren(...made.families.map((given0, index) => family(self, given0, index)));
    self.list.classList.remove('arriving');
    void self.list.offsetWidth;
    self.list.classList.add('arriving');
    button('steps-earlier').disabled = self.start === 0n;
    button('steps-later').disabled = self.start + BigInt(made.families.length) >= BigInt(made.lengths[0]);
    self.told(rest(self));
}

/** @param {Derivation} self @param {StepRows['families'][number]} family @param {number} index */
function family(self, { parent, children, more }, index) {
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
    const tell = () => self.told(wordsOf(self, index));
    item.addEventListener('pointerenter', tell);
    item.addEventListener('pointerleave', () => self.told(rest(self)));
    item.addEventListener('focus', tell);
    return item;
}

/** @param {Derivation} self */
const rest = (self) =>
    self.rows
        ? say`Symbols ${grouped(String(self.start + 1n))} to ${grouped(String(self.start + BigInt(self.rows.families.length)))} of ${grouped(self.rows.lengths[0])}.`
        : '';

/** @param {Derivation} self @param {number} index */
function wordsOf(self, index) {
    const family = self.rows?.families[index];
    if (!family) return '';
    const place = grouped(String(self.start + BigInt(index) + 1n));
    const count = BigInt(family.children.length) + BigInt(family.more);
    const first = BigInt(family.first) + 1n;
    const where =
        count === 0n
            ? say`It is deleted.`
            : count === 1n
              ? say`It becomes symbol ${grouped(String(first))} of generation ${self.at + 1}.`
              : say`It becomes symbols ${grouped(String(first))} to ${grouped(String(first + count - 1n))} of generation ${self.at + 1}.`;
    return `${say`${family.parent} is symbol ${place} of generation ${self.at}.`} ${where}`;
}

/** @param {Derivation} self @param {bigint} next */
function move(self, next) {
    self.start = next < 0n ? 0n : next;
    void read(self).catch((error) => self.told(reasonOf(error)));
}
