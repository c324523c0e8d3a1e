/** The origin of a symbol and the pose of the turtle, in words. Pure functions. */

import { grouped, listed, marked, plain, raised } from '../base/numerals.js';
import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').AncestryLink} AncestryLink */
/** @typedef {import('../protocol.js').SegmentFacts} SegmentFacts */
/** @typedef {import('../protocol.js').PolygonFacts} PolygonFacts */

const ORDINALS = [
    say`first`,
    say`second`,
    say`third`,
    say`fourth`,
    say`fifth`,
    say`sixth`,
    say`seventh`,
    say`eighth`,
    say`ninth`,
    say`tenth`,
    say`eleventh`,
    say`twelfth`,
];

/** @param {number} position counted from 0 */
export function ordinal(position) {
    const word = ORDINALS[position];
    if (word) return word;
    const number = position + 1;
    const digits = grouped(String(number));
    switch (Math.floor(number / 10) % 10 === 1 ? 0 : number % 10) {
        case 1:
            return say`${digits}st`;
        case 2:
            return say`${digits}nd`;
        case 3:
            return say`${digits}rd`;
        default:
            return say`${digits}th`;
    }
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
    if (generation === 0) return say`${ordinal(position)} symbol of the axiom`;
    if (production === null) return say`copied at step ${String(generation)}`;
    return say`step ${String(generation)}, by rule ${String(production + 1)}, ${ordinal(position)} symbol`;
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
        : say`${visible(born.symbol)} at ${birth(born)}`;
}

/**
 * A pose in words.
 * @param {Pick<import('../protocol.js').Pose, 'at' | 'heading' | 'level'>} pose
 */
export function poseText({ at, heading, level }) {
    return say`At ${listed(at.map(coordinate))}, ${headingText(heading)}, level ${String(level)}`;
}

/** @param {import('../protocol.js').Heading} heading */
function headingText(heading) {
    return typeof heading === 'number'
        ? say`heading ${marked(plain(Number(heading.toFixed(2))))}°`
        : say`heading ${listed(heading.map(coordinate))}`;
}

/** The look of a segment, in words. @param {SegmentFacts} stroke */
export const strokeText = (stroke) => [headingText(stroke.heading), ...looks(stroke)].join(', ');

/** The look of a polygon, in words. @param {PolygonFacts} filled */
export const filledText = (filled) => [say`filled`, ...looks(filled)].join(', ');

/** @param {{level: number, colour: number}} drawn */
function looks({ level, colour }) {
    return [
        ...(level > 0 ? [say`branch level ${String(level)}`] : []),
        ...(colour !== 0 ? [say`colour ${coordinate(colour)}`] : []),
    ];
}

/** @param {number} value in model units */
export function coordinate(value) {
    if (value !== 0 && (Math.abs(value) >= 1e7 || Math.abs(value) < 1e-3)) {
        const [mantissa, exponent] = value.toExponential(3).split('e');
        return `${marked(String(mantissa))}·10${raised(Number(exponent))}`.replace('-', '−');
    }
    return marked(plain(Number(value.toFixed(3)))).replace('-', '−');
}
