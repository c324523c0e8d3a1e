/** The turtle at each symbol as it is read: position, heading, stack, and the drawing so far. */

import { byId, html, make, svg } from '../base/dom.js';
import { grouped } from '../base/numerals.js';
import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').TurtleState} TurtleState */
/** @typedef {[number, number, number]} Vector */

/** The most symbols that are followed. */
const MOST = 1500;
/** The symbols of the string that are shown around the current one. */
const AROUND = 120;
/** A symbol is shown for this time while playing, in milliseconds. */
const PAUSE = 260;

/** A symbol with the number of its arguments. @param {string} module */
const kindOf = (module) =>
    `${/^\?[A-Z]\(/.exec(module)?.[0] ?? [...module][0] ?? ''}${/\(.+\)$/s.test(module) ? module.split(',').length : 0}`;

/** Right and up of the picture of a drawing in space: a little from the right and from above. */
const [TURNED, RAISED] = [(25 * Math.PI) / 180, (12 * Math.PI) / 180];
const RIGHT = [Math.cos(TURNED), 0, -Math.sin(TURNED)];
const UP = [-Math.sin(RAISED) * Math.sin(TURNED), Math.cos(RAISED), -Math.sin(RAISED) * Math.cos(TURNED)];

/**
 * The way of the turtle that is shown.
 * @typedef {object} Walk
 * @property {() => void} moved
 * @property {SVGSVGElement} picture
 * @property {TurtleState[]} states
 * @property {boolean} isSolid
 * @property {number} at
 * @property {Map<string, string>} legend The words of each symbol
 * @property {SVGPathElement | null} drawn
 * @property {SVGPathElement | null} turtle
 * @property {number} size
 */

/**
 * @param {import('./steps.js').StudyTool} tool
 * @param {(words: string) => void} told
 * @param {() => void} moved
 * @returns {import('./steps.js').Part}
 */
export function createWay(tool, told, moved) {
    /** @type {Walk} */
    const self = {
        moved,
        picture: byId('steps-picture', SVGSVGElement),
        states: [],
        isSolid: false,
        at: 0,
        legend: new Map(),
        drawn: null,
        turtle: null,
        size: 1,
    };

    let length = '0';

    return {
        get at() {
            return self.at;
        },
        get end() {
            return self.states.length - 1;
        },
        pause: PAUSE,
        words: () => say`${grouped(String(self.at))} of ${grouped(length)} symbols read`,
        async show(definition, n) {
            const made = await tool.call('trace', { definition, n, count: MOST });
            ({ states: self.states, isSolid: self.isSolid, length } = made);
            self.legend = new Map(made.legend.map(([module, words]) => [kindOf(module), words]));
            self.at = Math.min(1, self.states.length - 1);
            begin(self);
            draw(self);
            if (BigInt(length) > BigInt(MOST))
                told(
                    say`Only the first ${grouped(String(MOST))} of ${grouped(length)} symbols are followed. With fewer iterations all are.`,
                );
        },
        seek(next) {
            self.at = next;
            draw(self);
        },
    };
}

/** A point of the picture, y down. @param {Walk} self @param {Vector} point @returns {[number, number]} */
const seen = (self, point) => {
    const along = (/** @type {number[]} */ axis) => point.reduce((sum, value, at) => sum + value * (axis[at] ?? 0), 0);
    return self.isSolid ? [along(RIGHT), -along(UP)] : [point[0], -point[1]];
};

/** @param {Walk} self @param {TurtleState[]} some */
const pathOf = (self, some) =>
    some
        .flatMap(({ segment }) =>
            segment ? [`M${seen(self, segment[0]).join(' ')}L${seen(self, segment[1]).join(' ')}`] : [],
        )
        .join('');

/** @param {Walk} self */
function begin(self) {
    const points = self.states.flatMap(({ at, segment }) => [at, ...(segment ?? [])]).map((point) => seen(self, point));
    const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
    const [left, top] = [Math.min(...xs), Math.min(...ys)];
    const [wide, high] = [Math.max(...xs) - left, Math.max(...ys) - top];
    self.size = Math.max(wide, high, 1e-6);
    const margin = self.size * 0.12;
    const side = self.size + 2 * margin;
    self.picture.setAttribute('viewBox', [left + wide / 2 - side / 2, top + high / 2 - side / 2, side, side].join(' '));
    const whole = svg('path', { class: 'whole', d: pathOf(self, self.states) });
    [self.drawn, self.turtle] = [svg('path', { class: 'drawn' }), svg('path', { class: 'turtle' })];
    self.picture.style.setProperty('--unit', String(self.size / 160));
    self.picture.replaceChildren(whole, self.drawn, self.turtle);
}

/** @param {Walk} self */
function draw(self) {
    const state = self.states[self.at];
    if (!state || !self.drawn || !self.turtle) return;
    self.drawn.setAttribute('d', pathOf(self, self.states.slice(0, self.at + 1)));
    const [x, y] = seen(self, state.at);
    const [hx, hy] = seen(self, /** @type {Vector} */ (state.axes[0]));
    const [lx, ly] = seen(self, /** @type {Vector} */ (state.axes[1]));
    const by = self.size * 0.035;
    const corner = (/** @type {number} */ a, /** @type {number} */ b) =>
        `${x + by * (a * hx + b * lx)} ${y + by * (a * hy + b * ly)}`;
    self.turtle.setAttribute('d', `M${corner(1.6, 0)}L${corner(-0.8, 0.9)}L${corner(-0.4, 0)}L${corner(-0.8, -0.9)}Z`);
    const number = (/** @type {number} */ value) => String(Math.round(value * 1000) / 1000 + 0);
    const place = (/** @type {Vector} */ point) =>
        `(${point
            .slice(0, self.isSolid ? 3 : 2)
            .map(number)
            .join(', ')})`;
    const heading = state.axes[0] ?? [0, 0, 0];
    const degrees = ((Math.atan2(heading[1], heading[0]) * 180) / Math.PI + 360) % 360;
    const words = self.legend.get(kindOf(state.symbol)) ?? '';
    const stored = state.stored.map(place).join(', ');
    /** @type {[string, string][]} */
    const facts = [
        [say`Symbol`, self.at === 0 ? say`the start` : state.symbol],
        [say`Does`, self.at === 0 ? '' : words || say`nothing`],
        [say`Position`, place(state.at)],
        ...(self.isSolid
            ? [say`Heading`, say`Left`, say`Up`].map(
                  (name, axis) =>
                      /** @type {[string, string]} */ ([name, place(/** @type {Vector} */ (state.axes[axis]))]),
              )
            : [/** @type {[string, string]} */ ([say`Heading`, `${number(degrees)}°`])]),
        [
            say`Stack`,
            state.depth === 0
                ? say`empty`
                : `${state.depth}: ${stored}${state.depth > state.stored.length ? ', …' : ''}`,
        ],
    ];
    html('steps-state').replaceChildren(
        ...facts.flatMap(([name, text]) => (text === '' ? [] : [make('dt', {}, name), make('dd', {}, text)])),
    );
    const from = Math.max(1, Math.min(self.at - AROUND / 2, self.states.length - AROUND));
    const shown = self.states.slice(from, from + AROUND).map(({ symbol }, index) => {
        const place = from + index;
        const mark = make(
            'button',
            {
                class: place === self.at ? 'symbol now' : place < self.at ? 'symbol read' : 'symbol',
                tabindex: '-1',
                'aria-hidden': 'true',
            },
            symbol,
        );
        mark.addEventListener('click', () => {
            self.at = place;
            draw(self);
            self.moved();
        });
        return mark;
    });
    html('steps-string').replaceChildren(from > 1 ? '…' : '', ...shown, from + AROUND < self.states.length ? '…' : '');
}
