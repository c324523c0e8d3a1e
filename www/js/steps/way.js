/** The turtle at each symbol as it is read: position, heading, stack, and the drawing so far. */

import { byId, html, make } from '../dom.js';
import { grouped } from '../numerals.js';
import { say } from '../words.js';

/** @typedef {import('../protocol.js').TurtleState} TurtleState */
/** @typedef {[number, number, number]} Vector */

/** The most symbols that are followed. */
const MOST = 1500;
/** The symbols of the string that are shown around the current one. */
const AROUND = 120;
/** A symbol is shown for this time while playing, in milliseconds. */
const PAUSE = 260;
const SVG = 'http://www.w3.org/2000/svg';

/** A symbol with the number of its arguments. @param {string} module */
const kindOf = (module) =>
    `${/^\?[A-Z]\(/.exec(module)?.[0] ?? [...module][0] ?? ''}${/\(.+\)$/s.test(module) ? module.split(',').length : 0}`;

/** Right and up of the picture of a drawing in space: a little from the right and from above. */
const [TURNED, RAISED] = [(25 * Math.PI) / 180, (12 * Math.PI) / 180];
const RIGHT = [Math.cos(TURNED), 0, -Math.sin(TURNED)];
const UP = [-Math.sin(RAISED) * Math.sin(TURNED), Math.cos(RAISED), -Math.sin(RAISED) * Math.cos(TURNED)];

/**
 * @param {import('./steps.js').CourseTool} tool
 * @param {(words: string) => void} told
 * @param {() => void} moved
 * @returns {import('./steps.js').Part}
 */
export function createWay(tool, told, moved) {
    const picture = byId('steps-picture', SVGSVGElement);
    /** @type {TurtleState[]} */
    let states = [];
    let isSolid = false;
    let length = '0';
    let at = 0;
    /** The words of each symbol. @type {Map<string, string>} */
    let legend = new Map();
    /** @type {SVGPathElement | null} */
    let drawn = null;
    /** @type {SVGPathElement | null} */
    let turtle = null;
    let size = 1;

    /** A point of the picture, y down. @param {Vector} point @returns {[number, number]} */
    const seen = (point) => {
        const along = (/** @type {number[]} */ axis) =>
            point.reduce((sum, value, at) => sum + value * (axis[at] ?? 0), 0);
        return isSolid ? [along(RIGHT), -along(UP)] : [point[0], -point[1]];
    };

    /** @param {TurtleState[]} some */
    const pathOf = (some) =>
        some
            .flatMap(({ segment }) => (segment ? [`M${seen(segment[0]).join(' ')}L${seen(segment[1]).join(' ')}`] : []))
            .join('');

    function begin() {
        const points = states.flatMap(({ at, segment }) => [at, ...(segment ?? [])]).map(seen);
        const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
        const [left, top] = [Math.min(...xs), Math.min(...ys)];
        const [wide, high] = [Math.max(...xs) - left, Math.max(...ys) - top];
        size = Math.max(wide, high, 1e-6);
        const margin = size * 0.12;
        const side = size + 2 * margin;
        picture.setAttribute('viewBox', [left + wide / 2 - side / 2, top + high / 2 - side / 2, side, side].join(' '));
        const path = (/** @type {string} */ name) => {
            const element = document.createElementNS(SVG, 'path');
            element.setAttribute('class', name);
            return element;
        };
        const whole = path('whole');
        [drawn, turtle] = [path('drawn'), path('turtle')];
        whole.setAttribute('d', pathOf(states));
        picture.style.setProperty('--unit', String(size / 160));
        picture.replaceChildren(whole, drawn, turtle);
    }

    function draw() {
        const state = states[at];
        if (!state || !drawn || !turtle) return;
        drawn.setAttribute('d', pathOf(states.slice(0, at + 1)));
        const [x, y] = seen(state.at);
        const [hx, hy] = seen(/** @type {Vector} */ (state.axes[0]));
        const [lx, ly] = seen(/** @type {Vector} */ (state.axes[1]));
        const by = size * 0.035;
        const corner = (/** @type {number} */ a, /** @type {number} */ b) =>
            `${x + by * (a * hx + b * lx)} ${y + by * (a * hy + b * ly)}`;
        turtle.setAttribute('d', `M${corner(1.6, 0)}L${corner(-0.8, 0.9)}L${corner(-0.4, 0)}L${corner(-0.8, -0.9)}Z`);
        const number = (/** @type {number} */ value) => String(Math.round(value * 1000) / 1000 + 0);
        const place = (/** @type {Vector} */ point) =>
            `(${point
                .slice(0, isSolid ? 3 : 2)
                .map(number)
                .join(', ')})`;
        const heading = state.axes[0] ?? [0, 0, 0];
        const degrees = ((Math.atan2(heading[1], heading[0]) * 180) / Math.PI + 360) % 360;
        const words = legend.get(kindOf(state.symbol)) ?? '';
        const stored = state.stored.map(place).join(', ');
        /** @type {[string, string][]} */
        const facts = [
            [say`Symbol`, at === 0 ? say`the start` : state.symbol],
            [say`Does`, at === 0 ? '' : words || say`nothing`],
            [say`Position`, place(state.at)],
            ...(isSolid
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
        const from = Math.max(1, Math.min(at - AROUND / 2, states.length - AROUND));
        const shown = states.slice(from, from + AROUND).map(({ symbol }, index) => {
            const place = from + index;
            const mark = make(
                'button',
                {
                    type: 'button',
                    class: place === at ? 'symbol now' : place < at ? 'symbol read' : 'symbol',
                    tabindex: '-1',
                    'aria-hidden': 'true',
                },
                symbol,
            );
            mark.addEventListener('click', () => {
                at = place;
                draw();
                moved();
            });
            return mark;
        });
        html('steps-string').replaceChildren(from > 1 ? '…' : '', ...shown, from + AROUND < states.length ? '…' : '');
    }

    return {
        get at() {
            return at;
        },
        get end() {
            return states.length - 1;
        },
        pause: PAUSE,
        words: () => say`${grouped(String(at))} of ${grouped(length)} symbols read`,
        async show(definition, n) {
            const made = await tool.call('trace', { definition, n, count: MOST });
            ({ states, isSolid, length } = made);
            legend = new Map(made.legend.map(([module, words]) => [kindOf(module), words]));
            at = Math.min(1, states.length - 1);
            begin();
            draw();
            if (BigInt(length) > BigInt(MOST))
                told(
                    say`Only the first ${grouped(String(MOST))} of ${grouped(length)} symbols are followed. With fewer iterations all are.`,
                );
        },
        seek(next) {
            at = next;
            draw();
        },
    };
}
