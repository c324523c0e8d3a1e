/** The origin of a symbol and the pose of the turtle, in words. Pure functions. */

import { grouped, plain, raised } from '../numerals.js';

/** @typedef {import('../protocol.js').AncestryLink} AncestryLink */
/** @typedef {import('../protocol.js').SegmentFacts} SegmentFacts */
/** @typedef {import('../protocol.js').PolygonFacts} PolygonFacts */

const ORDINALS = [
    'first',
    'second',
    'third',
    'fourth',
    'fifth',
    'sixth',
    'seventh',
    'eighth',
    'ninth',
    'tenth',
    'eleventh',
    'twelfth',
];

/** @param {number} position counted from 0 */
export function ordinal(position) {
    const word = ORDINALS[position];
    if (word) return word;
    const number = position + 1;
    const ending = Math.floor(number / 10) % 10 === 1 ? 'th' : ({ 1: 'st', 2: 'nd', 3: 'rd' }[number % 10] ?? 'th');
    return `${grouped(String(number))}${ending}`;
}

/**
 * The modules of a page: symbols with their arguments, if any.
 * @param {string} text
 * @param {boolean} apart whether every module ends with a line end
 */
export const modulesOf = (text, apart) => (apart ? text.split('\n').slice(0, -1) : [...text]);

/**
 * The shown symbol and arguments of a module; arguments are in parentheses, with numbers to four digits.
 * @param {string} module
 * @returns {[string, string]}
 */
export function partsOf(module) {
    const [, quoted, plain, args = ''] = /^(?:`([^`]+|`)`|(.))(\(.*\))?$/su.exec(module) ?? [];
    const symbol = quoted ?? plain ?? module;
    return [symbol === ' ' ? '␣' : symbol, args.replace(/\d+(?:\.\d+)?(?:e-?\d+)?/g, fewDigits)];
}

/** The shown text of a module. @param {string} module */
export const visible = (module) => partsOf(module).join('');

/** @param {string} number without a sign */
function fewDigits(number) {
    const value = Number(number);
    return String(Number(value.toPrecision(value < 1e4 ? 4 : 6)));
}

/** The origin of a link's symbol: `step 5, by rule 1, third symbol`. @param {AncestryLink} link */
export function birth({ generation, production, position }) {
    if (generation === 0) return `${ordinal(position)} symbol of the axiom`;
    if (production === null) return `copied at step ${generation}`;
    return `step ${generation}, by rule ${production + 1}, ${ordinal(position)} symbol`;
}

/**
 * The chain from a symbol back to the axiom, without the steps that only copied it.
 * @param {AncestryLink[]} chain from the axiom on
 * @returns {AncestryLink[]} from the symbol back
 */
export function descent(chain) {
    return chain.filter(({ generation, production }) => generation === 0 || production !== null).reverse();
}

/** The origin of the last symbol of a chain. @param {AncestryLink[]} chain */
export function birthOf(chain) {
    const [born] = descent(chain);
    return born ? birth(born) : '';
}

/** `X at step 5, by rule 1, third symbol`. @param {AncestryLink[]} chain */
export function origin(chain) {
    const [born] = descent(chain);
    if (!born) return '';
    return born.generation === 0
        ? `${visible(born.symbol)}, ${birth(born)}`
        : `${visible(born.symbol)} at ${birth(born)}`;
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

/** The look of a segment, in words. @param {SegmentFacts} stroke */
export const strokeText = (stroke) => [headingText(stroke.heading), ...looks(stroke)].join(', ');

/** The look of a polygon, in words. @param {PolygonFacts} filled */
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
