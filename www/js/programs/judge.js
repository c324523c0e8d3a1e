/** Whether a result is right, and if not, what is wrong with it in words. Only the page knows what is expected. */

import { counted, say } from '../base/words.js';
import { GIVEN, truth } from './given.js';
import { callOf } from './tasks.js';

/** @typedef {import('./runner.js').Ran} Ran */
/** @typedef {import('./worker.js').Given} Given */
/** @typedef {import('./tasks.js').Wanted} Wanted */
/** A call with its result. @typedef {{call: string, args: unknown[], expected: unknown, got: unknown, given: Given, isRight: boolean}} Tried */
/** The mark of a function: whether the program has it, its calls, and the first that fails, the smallest. @typedef {{name: string, isOwn: boolean, isRight: boolean, tried: Tried[], wrong: Tried | null}} Judged */

/** Numbers may differ by this part: programs round in other orders. */
const NEAR = 1e-6;
/** The symbols shown on each side of a difference. */
const AROUND = 12;
const TRUTH = truth();

/** Whether two values are the same, numbers nearly. @param {unknown} a @param {unknown} b @returns {boolean} */
export function isSame(a, b) {
    if (typeof a === 'number' && typeof b === 'number') return Math.abs(a - b) <= NEAR * Math.max(1, Math.abs(b));
    if (Array.isArray(a) && Array.isArray(b)) return a.length === b.length && a.every((one, at) => isSame(one, b[at]));
    if (a && b && typeof a === 'object' && typeof b === 'object') {
        const [these, those] = [Object.entries(a), /** @type {Record<string, unknown>} */ (b)];
        return these.length === Object.keys(b).length && these.every(([key, one]) => isSame(one, those[key]));
    }
    return a === b;
}

/** The result of a call; undefined if it has none. @param {Given | undefined} given */
export function resultOf(given) {
    try {
        return given?.value === undefined ? undefined : JSON.parse(given.value);
    } catch {
        return undefined;
    }
}

/** The calls of a run, by function. @param {readonly Wanted[]} functions */
export const callsOf = (functions) => functions.flatMap(({ name, tests }) => tests.map(({ args }) => ({ name, args })));

/** Judges a run of all calls of these functions. @param {readonly Wanted[]} functions @param {Ran} ran @returns {Judged[]} */
export function judged(functions, ran) {
    let at = 0;
    return functions.map(({ name, tests }) => {
        const isOwn = ran.own.includes(name);
        const tried = tests.flatMap(({ args, expected }) => {
            const given = ran.results[at++];
            if (!given || !isOwn) return [];
            const got = resultOf(given);
            const isRight = !given.fault && !given.changed && isSame(got, expected);
            return [{ call: callOf(name, args), args, expected, got, given, isRight }];
        });
        const isRight = tests.length > 0 && tried.length === tests.length && tried.every((one) => one.isRight);
        return { name, isOwn, isRight, tried, wrong: tried.find((one) => !one.isRight) ?? null };
    });
}

/** The kind of a value, for a beginner. @param {unknown} value */
function kindOf(value) {
    if (value === null || value === undefined) return say`nothing`;
    if (typeof value === 'string') return say`a text`;
    if (typeof value === 'number') return say`a number`;
    if (typeof value === 'boolean') return say`true or false`;
    return Array.isArray(value) ? say`a list` : say`a dictionary`;
}

/** What is wrong with a result that is no error. @param {string} name @param {Tried} tried @returns {string} */
export function whyWrong(name, { args, expected, got, given }) {
    if (given.changed)
        return say`The function changes what it is given. Make a new list or dictionary, or a copy, instead.`;
    if (given.nothing) {
        if (given.printed.trim() !== '') return say`The function prints its result. It must give it back: use return.`;
        return say`The function gives nothing back. Does each way through it end with return?`;
    }
    if (typeof got === 'string' && typeof expected !== 'string' && /^-?(NaN|Infinity|nan|inf)$/.test(got))
        return say`The result is no number (${got}): a value that is used in it is missing.`;
    if (kindOf(got) !== kindOf(expected))
        return say`The result is ${kindOf(got)}, and ${kindOf(expected)} is expected.`;
    const usual = usualMistake(name, args, got);
    if (usual) return usual;
    if (typeof got === 'string' && typeof expected === 'string') return textWords(got, expected);
    if (Array.isArray(got) && Array.isArray(expected)) return listWords(got, expected);
    return say`The result is ${short(got)}, and ${short(expected)} is expected.`;
}

/** The functions of a system's words that take a number of steps, and those of one step. */
const [STEPS, STEP] = [
    ['generation', 'expand'],
    ['derivation', 'expandOnce'],
];
/** Words with left and right changed. */
const mirrored = (/** @type {string} */ word) => word.replace(/[+-]/g, (sign) => (sign === '+' ? '-' : '+'));

/** A usual mistake that explains a result. @param {string} name @param {unknown[]} args @param {unknown} got */
function usualMistake(name, args, got) {
    const make = TRUTH[name];
    if (!make || !GIVEN[name]) return null;
    const gives = (/** @type {unknown[]} */ ...other) => {
        try {
            return isSame(got, make(...other));
        } catch {
            return false;
        }
    };
    const [first, second, third] = /** @type {any[]} */ (args);
    if (STEPS.includes(name)) {
        if (gives(first, second, third + 1)) return say`This is the word after one step more. Count the steps.`;
        if (third > 0 && gives(first, second, third - 1))
            return say`This is the word after one step less. Count the steps.`;
    }
    if (STEP.includes(name) || (STEPS.includes(name) && third === 1)) {
        let word = String(first);
        for (const [symbol, successor] of Object.entries(second)) word = word.replaceAll(symbol, successor);
        if (got === word)
            return say`The rules are applied one after another, so that what a rule has just written is replaced again. All symbols must be replaced at once.`;
        const only = [...String(first)].map((symbol) => second[symbol] ?? '').join('');
        if (got === only) return say`Symbols without a rule are lost. They must stay as they are.`;
    }
    if (name === 'multmat' && gives(second, first))
        return say`The factors are in the other order: this is b a, and not a b.`;
    if (
        ['multmat', 'multmatvector'].includes(name) &&
        gives(turned(first), name === 'multmat' ? turned(second) : second)
    )
        return say`Rows and columns are exchanged: a matrix is the list of its columns here.`;
    if (['r2d', 'ru', 'rl', 'rh'].includes(name)) {
        if (gives(-first))
            return say`This turns clockwise: a sine has the wrong sign, or rows and columns are exchanged.`;
        if (gives((first * 180) / Math.PI)) return say`sin and cos take radians, and the angle is in degrees.`;
    }
    if (name === 'degreetorad' && gives((first * 180 * 180) / Math.PI / Math.PI))
        return say`This makes degrees of radians. It must be the other way round.`;
    if (name === 'move2d' && gives(first, (second * 180) / Math.PI, third))
        return say`sin and cos take radians, and the angle is in degrees.`;
    if (name === 'move2d' && gives(first, 90 - second, third))
        return say`Sine and cosine are exchanged: x moves by the cosine.`;
    if (name === 'draw' || name.startsWith('axiomtoline')) return turtleMistake(name, args, got, gives);
    return null;
}

/** A usual mistake of a turtle. @param {string} name @param {any[]} args @param {unknown} got @param {(...args: unknown[]) => boolean} gives */
function turtleMistake(name, [word, ...values], got, gives) {
    if (/[+-]/.test(word) && gives(mirrored(word), ...values))
        return say`Left and right are exchanged: + turns left, that is counter-clockwise.`;
    const degrees = (/** @type {number} */ angle) => (angle * 180) / Math.PI;
    const [start, heading, left, right, step] = values;
    const turns = name === 'draw' ? [[degrees(start)]] : [];
    if (name === 'axiomtoline2d')
        for (const first of [heading, degrees(heading)])
            turns.push([start, first, degrees(left), degrees(right), step]);
    if (turns.some((other) => gives(word, ...other)))
        return say`sin and cos take radians, and the angle is in degrees.`;
    if (/\[/.test(word)) {
        if (gives(word.replace(/[[\]]/g, ''), ...values))
            return say`[ and ] do nothing: [ must keep position and direction, ] must go back to them.`;
        const expected = TRUTH[name]?.(word, ...values);
        if (Array.isArray(got) && got.length === expected?.length && isSame(got.slice(0, 1), expected.slice(0, 1)))
            return say`After ] the turtle is at a wrong place or looks in a wrong direction. [ must keep a copy of both, and ] must go back to the last one that is kept.`;
    }
    return null;
}

/** @param {any} matrix columns as rows */
const turned = (matrix) =>
    Array.isArray(matrix?.[0])
        ? matrix[0].map((/** @type {unknown} */ _, /** @type {number} */ row) =>
              matrix.map((/** @type {unknown[]} */ column) => column[row]),
          )
        : matrix;

/** The first symbol that differs. @param {string} got @param {string} expected */
function textWords(got, expected) {
    let at = 0;
    while (at < got.length && got[at] === expected[at]) at += 1;
    const piece = (/** @type {string} */ text) =>
        `${at > AROUND ? '…' : ''}${text.slice(Math.max(0, at - AROUND), at + AROUND)}${text.length > at + AROUND ? '…' : ''}` ||
        say`(empty)`;
    return say`Symbol ${at + 1} is the first that differs: ${piece(got)} instead of ${piece(expected)}.`;
}

/** The first part of a list that differs. @param {unknown[]} got @param {unknown[]} expected */
function listWords(got, expected) {
    const at = expected.findIndex((one, at) => !isSame(got[at], one));
    const isLines = Array.isArray(/** @type {any} */ (expected[0])?.[0]);
    if (at < 0 || at >= got.length) {
        return isLines
            ? counted(
                  got.length,
                  'There is {} line, and {1} are expected.',
                  'There are {} lines, and {1} are expected.',
                  expected.length,
              )
            : counted(
                  got.length,
                  'The list has {} value, and {1} are expected.',
                  'The list has {} values, and {1} are expected.',
                  expected.length,
              );
    }
    if (isLines)
        return say`Line ${at + 1} is the first that differs: ${short(got[at])} instead of ${short(expected[at])}.`;
    return say`Value ${at + 1} is the first that differs: ${short(got[at])} instead of ${short(expected[at])}.`;
}

/** A value as a short text. @param {unknown} value @param {number} [most] characters */
export function short(value, most = 120) {
    const text =
        JSON.stringify(value, (_, one) =>
            typeof one === 'number' ? (Math.abs(one) < 1e-12 ? 0 : Number(one.toPrecision(6))) : one,
        ) ?? say`nothing`;
    const spaced = text.replaceAll(',', ', ');
    return spaced.length > most ? `${spaced.slice(0, most)}…` : spaced;
}
