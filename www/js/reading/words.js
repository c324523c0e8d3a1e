/** Where a symbol comes from, and how the turtle stands, in words. Pure functions. */

import { grouped, plain, raised } from '../numerals.js';

/** @typedef {import('../protocol.js').Link} Link */
/** @typedef {import('../protocol.js').Stroke} Stroke */
/** @typedef {import('../protocol.js').Filled} Filled */

const ORDINALS = ['first', 'second', 'third', 'fourth', 'fifth', 'sixth', 'seventh', 'eighth', 'ninth', 'tenth', 'eleventh', 'twelfth'];

/** @param {number} position counted from 0 */
export function ordinal(position) {
    const word = ORDINALS[position];
    if (word) return word;
    const number = position + 1;
    const ending = Math.floor(number / 10) % 10 === 1 ? 'th' : ({ 1: 'st', 2: 'nd', 3: 'rd' }[number % 10] ?? 'th');
    return `${grouped(String(number))}${ending}`;
}

/**
 * The symbols of a page, each with its arguments in parentheses, if any.
 * @param {string} text
 * @param {boolean} apart whether every one ends with a line end
 */
export const modulesOf = (text, apart) => (apart ? text.split('\n').slice(0, -1) : [...text]);

/**
 * A module as it is shown: its symbol, and its arguments with their parentheses, if any, their numbers to four digits.
 * @param {string} module
 * @returns {[string, string]}
 */
export function partsOf(module) {
    const [, quoted, plain, given = ''] = /^(?:`([^`]+|`)`|(.))(\(.*\))?$/su.exec(module) ?? [];
    const symbol = quoted ?? plain ?? module;
    return [symbol === ' ' ? '␣' : symbol, given.replace(/\d+(?:\.\d+)?(?:e-?\d+)?/g, fewDigits)];
}

/** The same in one. @param {string} module */
export const visible = (module) => partsOf(module).join('');

/** @param {string} number without a sign */
function fewDigits(number) {
    const value = Number(number);
    return String(Number(value.toPrecision(value < 1e4 ? 4 : 6)));
}

/** How a symbol came to be where it is: `step 5, by rule 1, third symbol`. @param {Link} link */
export function birth({ generation, production, position }) {
    if (generation === 0) return `${ordinal(position)} symbol of the axiom`;
    if (production === null) return `still there at step ${generation}`;
    return `step ${generation}, by rule ${production + 1}, ${ordinal(position)} symbol`;
}

/**
 * The chain from a symbol back to the axiom, with steps at which it only stayed left out.
 * @param {Link[]} chain from the axiom on
 * @returns {Link[]} from the symbol back
 */
export function descent(chain) {
    return chain.filter(({ generation, production }) => generation === 0 || production !== null).reverse();
}

/** The same of the last of a chain: when it came to be what it is. @param {Link[]} chain */
export function birthOf(chain) {
    const [born] = descent(chain);
    return born ? birth(born) : '';
}

/** `X at step 5, by rule 1, third symbol`. @param {Link[]} chain */
export function origin(chain) {
    const [born] = descent(chain);
    if (!born) return '';
    return born.generation === 0 ? `${visible(born.symbol)}, ${birth(born)}` : `${visible(born.symbol)} at ${birth(born)}`;
}

/**
 * A pose in words.
 * @param {Pick<import('../protocol.js').Pose, 'at' | 'heading' | 'level'>} pose
 */
export function poseText({ at, heading, level }) {
    return `At ${at.map(coordinate).join(', ')}, ${headingText(heading)}, level ${level}`;
}

/** @param {import('../protocol.js').Heading} heading */
function headingText(heading) {
    return `heading ${typeof heading === 'number' ? `${plain(Number(heading.toFixed(2)))}°` : heading.map(coordinate).join(', ')}`;
}

/** How a segment is drawn, in words. @param {Stroke} stroke */
export const strokeText = (stroke) => [headingText(stroke.heading), ...looks(stroke)].join(', ');

/** How a polygon is filled, in words. @param {Filled} filled */
export const filledText = (filled) => ['filled', ...looks(filled)].join(', ');

/** @param {{level: number, colour: number}} drawn */
function looks({ level, colour }) {
    return [...(level > 0 ? [`branch level ${level}`] : []), ...(colour !== 0 ? [`colour ${coordinate(colour)}`] : [])];
}

/** @param {number} value in model units */
export function coordinate(value) {
    if (value !== 0 && (Math.abs(value) >= 1e7 || Math.abs(value) < 1e-3)) {
        const [mantissa, exponent] = value.toExponential(3).split('e');
        return `${mantissa}·10${raised(Number(exponent))}`.replace('-', '−');
    }
    return plain(Number(value.toFixed(3))).replace('-', '−');
}
