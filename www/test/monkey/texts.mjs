/** Texts and files that the monkey types, opens and drops. */

import { deflateSync } from 'node:zlib';
import { writeLink } from '../../js/state/link.js';
import { clean } from '../../js/state/state.js';
import { DAMAGED, SCRIPTS } from '../unit/hostile.mjs';
import { randomState } from '../unit/random.mjs';

/** @typedef {() => number} Roll in [0, 1) */

/** @template T @param {Roll} roll @param {readonly T[]} choices @returns {T} */
export const pick = (roll, choices) => /** @type {T} */ (choices[Math.floor(roll() * choices.length)]);

/** A whole number from 0 to `most` - 1. @param {Roll} roll @param {number} most */
export const whole = (roll, most) => Math.floor(roll() * most);

/** Systems that can be drawn, of every kind. @type {readonly (Partial<import('../../js/state/state.js').State>)[]} */
export const SYSTEMS = [
    { axiom: 'F', rules: 'F -> F[+F]F[-F]F', iterations: 4, angle: 25.7 },
    { axiom: 'X', rules: 'X -> F[+X]F[-X]+X\nF -> FF', iterations: 30, angle: 20, colourBy: 'level' },
    { axiom: 'F', rules: 'F -> F[+F]F[-F]F : 0.5\nF -> F[+F]F : 0.5', iterations: 6, angle: 25, seed: 7 },
    {
        axiom: 'A(1, 10)',
        rules: 'r = 0.9\nA(l, w) : l > 0.1 -> !(w)F(l)[+(30)A(l*r, w*0.7)][-(30)A(l*r, w*0.7)]',
        iterations: 9,
        angle: 30,
        width: 0.05,
    },
    { axiom: 'baaa', rules: 'ignore: +-\nb < a -> b\nb -> a', iterations: 3, angle: 60, overrides: 'a: draw\nb: draw' },
    {
        axiom: 'A',
        rules: 'A -> [&FA]/////[&FA]///////[&FA]\nF -> S/////F\nS -> F',
        iterations: 5,
        angle: 22.5,
        width: 0.1,
    },
    { axiom: 'F+F+F+F', rules: 'F -> F+F-F-FF+F+F-F', iterations: 3, angle: 90, ink: 'density' },
    { axiom: '{.F+F+F+F.}', rules: 'F -> FF', iterations: 2, angle: 90 },
    { axiom: 'F', rules: 'F -> F+F--F+F', iterations: 40, angle: 60 },
    { axiom: 'F', rules: '', iterations: 0, angle: 0 },
];

const PRODUCTIONS = [
    'F -> FF',
    'F -> F[+F]F[-F]F',
    'X -> F[+X]F[-X]+X',
    'A(l) : l > 0.1 -> F(l)A(l*0.9)',
    'A < B > C -> D',
    'ignore: +-',
    'r = 0.9',
    'draw: A -> F',
    '// words',
    'F -> F : 0.5',
    'F -> *',
    'p1: F → F+F',
    '`->` -> F',
];
const BROKEN = [
    'F ->',
    '-> F',
    'F',
    'F -> F[',
    'F -> ]F',
    'A( -> F',
    'A(l) : l > -> F',
    'r = ',
    'F -> F : x',
    'F -> F : -1',
    '] -> [',
    'ignore:',
    'draw:',
    'F -> F(1,',
    '`',
    'A(x,x) -> F',
    'r = r',
    'F -> F(1/0)',
];
/** Characters that look like characters of the notation, and others that editors often mishandle. */
const LOOKALIKES = [
    'F −> F＋F',
    'Ｆ -> FF',
    'F ⟶ F+F',
    '“F” -> ‘F’',
    'F – F',
    'F\u00a0->\u00a0F',
    'F\u200b -> F\u200dF',
    '\ufeffF -> F',
    'А -> F',
    '[+F] ⇒ F',
    '\u202eF -> F\u202c',
    '🌿 -> F🌿',
    'é -> é',
    'F\t->\tF\r\nX -> F\r',
];
const JUNK = [
    ...SCRIPTS,
    '{"initial": "F"}',
    'https://example.org/#v=1',
    '%00%ff',
    '\u0001\u001b[2J',
    '((((((((((((((',
    '[[[[[[[[[[[[',
    ']]]]',
    '1e999',
    '::::',
    '\n\n\n\n',
    ' ',
    '',
];

/** A text for rules, valid or not. @param {Roll} roll @returns {string} */
export function rulesText(roll) {
    const kind = roll();
    const lines = (/** @type {readonly string[]} */ from, /** @type {number} */ most) =>
        Array.from({ length: 1 + whole(roll, most) }, () => pick(roll, from)).join('\n');
    if (kind < 0.4) return String(pick(roll, SYSTEMS).rules);
    if (kind < 0.55) return lines(PRODUCTIONS, 5);
    if (kind < 0.7) return lines([...PRODUCTIONS, ...BROKEN], 5);
    if (kind < 0.8) return lines(LOOKALIKES, 3);
    if (kind < 0.9) return lines(JUNK, 3);
    return longText(roll);
}

/** @param {Roll} roll @returns {string} */
export function axiomText(roll) {
    const kind = roll();
    if (kind < 0.5) return String(pick(roll, SYSTEMS).axiom);
    if (kind < 0.7) return Array.from({ length: whole(roll, 30) }, () => pick(roll, [...'FFFFXA+-[]!|'])).join('');
    if (kind < 0.8) return pick(roll, LOOKALIKES);
    if (kind < 0.93) return pick(roll, JUNK);
    return pick(roll, ['F', 'F+', '[F]', 'X']).repeat(1 + whole(roll, 8000));
}

/** @param {Roll} roll @returns {string} */
export function overridesText(roll) {
    return pick(roll, [
        'G: move',
        'A: draw 10',
        'B: turn left 90, draw',
        'F: draw\nX: draw 2',
        'F:',
        ': draw',
        'F: fly',
        'F: draw\n'.repeat(500),
        'é: draw',
        ...JUNK,
    ]);
}

/** Texts near and beyond the maximum length of a field. @param {Roll} roll */
function longText(roll) {
    const line = pick(roll, [
        'F -> FF',
        '// words of a comment that is long',
        'X -> F[+X]F[-X]+X',
        'F -> F+F : 1',
        'junk junk junk',
    ]);
    return `${line}\n`.repeat(1 + whole(roll, Math.ceil(60_000 / line.length)));
}

/** A text for a number field. @param {Roll} roll */
export function numberText(roll) {
    const number = () => String(Math.round((roll() - 0.3) * 10 ** whole(roll, 6)) / pick(roll, [1, 10, 1000]));
    return roll() < 0.5
        ? number()
        : pick(roll, [
              '',
              '0',
              '1',
              '-1',
              '90',
              '25,7',
              '−5',
              '1e3',
              '1e999',
              '-',
              '.',
              '5.',
              'x',
              '٣',
              '1 000',
              '0x10',
              '60°',
              '3 steps',
              '50 %',
              '10^12',
              '9'.repeat(60),
              'NaN',
              'Infinity',
              '1e-12',
          ]);
}

/** A hash: a valid link, a random state, or a hostile link. @param {Roll} roll @returns {string} */
export function hash(roll) {
    const kind = roll();
    if (kind < 0.6) return writeLink(clean(pick(roll, SYSTEMS)));
    if (kind < 0.7) return writeLink({ ...randomState(roll), iterations: whole(roll, 20) });
    if (kind < 0.75) return pick(roll, ['', '#', '#drawing', '#v=1', '#a=b']);
    return pick(roll, DAMAGED).hash;
}

/** A file to drop or to choose. @param {Roll} roll @returns {{name: string, mimeType: string, buffer: Buffer}} */
export function file(roll) {
    const system = pick(roll, SYSTEMS);
    const json = JSON.stringify({
        name: 'dropped',
        initial: system.axiom,
        rules: String(system.rules).split('\n'),
        angle_deg: system.angle,
        num_iters: system.iterations,
        turtle: { dialect: 'abop' },
    });
    const noise = Buffer.from(Array.from({ length: 400 }, () => whole(roll, 256)));
    const png = Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), noise]);
    const favourites = JSON.stringify({
        format: 'l-systems favourites',
        version: 1,
        favourites: Array.from({ length: whole(roll, 600) }, (_, at) => ({
            name: `f${at}`,
            link: hash(roll).slice(0, 2000),
        })),
    });
    /** @type {[string, string, Buffer | string][]} */
    const files = [
        ['system.json', 'application/json', json],
        ['system.json', 'application/json', json],
        ['cut.json', 'application/json', json.slice(0, whole(roll, json.length))],
        ['deep.json', 'application/json', '['.repeat(100_000)],
        ['lines.json', 'application/json', '\n'.repeat(1_000_000)],
        ['empty.json', 'application/json', ''],
        ['favourites.json', 'application/json', favourites],
        ['noise.json', 'application/json', noise],
        ['utf16.json', 'application/json', Buffer.from(`\ufeff${json}`, 'utf16le')],
        ['noise.png', 'image/png', png],
        [
            'noise.svg',
            'image/svg+xml',
            `<svg xmlns="http://www.w3.org/2000/svg"><metadata>${json}</metadata><script>alert(1)</script></svg>`,
        ],
        ['bomb.png', 'image/png', deflateSync(Buffer.alloc(1 << 22))],
        ['words.txt', 'text/plain', 'F -> FF'],
    ];
    const [name, mimeType, content] = pick(roll, files);
    return { name, mimeType, buffer: Buffer.from(content) };
}
