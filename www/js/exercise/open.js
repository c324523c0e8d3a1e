/** Exercises in links: `#v=1&x=...` and what the student found (docs/exercises.md). */

import { writeFields } from '../state/link.js';
import { DEFAULTS, clean, same } from '../state/state.js';

/** @typedef {import('../state/state.js').State} State */
/** @typedef {import('../state/state.js').Definition} Definition */
/** @typedef {import('../protocol.js').AboutExercise} AboutExercise */

/** The longest name in an answer, in characters. */
const LONGEST_NAME = 80;

/** The exercise in a hash; null if there is none. @param {string} hash */
export const exerciseIn = (hash) => /^#?(?:[^]*&)?x=([\w-]+)/.exec(hash)?.[1] ?? null;

/** The student's name in the link of an answer. @param {string} hash */
export function studentIn(hash) {
    try {
        return decodeURIComponent(/^#?(?:[^]*&)?by=([^&]*)/.exec(hash)?.[1] ?? '').slice(0, LONGEST_NAME);
    } catch {
        return '';
    }
}

/** The fields that the student finds. @param {AboutExercise} about @returns {(keyof Definition)[]} */
const foundFields = (about) => ['rules', ...about.free];

/**
 * The state with which a visit starts: the exercise's own start, and what the link has of an answer.
 * @param {AboutExercise} about
 * @param {Readonly<State> | undefined} link
 */
export function startOf(about, link) {
    const found = foundFields(about).filter((field) => link && !same(link[field], DEFAULTS[field]));
    return clean({ ...about.start, ...Object.fromEntries(found.map((field) => [field, link?.[field]])) });
}

/**
 * The whole system of a student: what was found, and all that is given. The student's rules come first, so that places
 * in them stay where they are.
 * @param {Pick<AboutExercise, 'fixed' | 'free'>} about
 * @param {Readonly<Definition>} state
 * @returns {Definition}
 */
export function wholeOf(about, state) {
    const found = Object.fromEntries(about.free.map((field) => [field, state[field]]));
    return { ...about.fixed, ...found, rules: `${state.rules}\n${about.fixed.rules}` };
}

/**
 * The hash of an answer.
 * @param {string} text the exercise
 * @param {AboutExercise} about
 * @param {Readonly<State>} state
 * @param {string} by
 */
export function answerLink(text, about, state, by) {
    const found = Object.fromEntries(foundFields(about).map((field) => [field, state[field]]));
    const fields = writeFields(clean(found), escape);
    const name = by.trim().slice(0, LONGEST_NAME);
    return ['#v=1', `x=${text}`, ...fields, ...(name === '' ? [] : [`by=${escape(name)}`])].join('&');
}

/** Escapes more than other links do: answers pass through forms, which read a plus sign as a space. @param {string} value */
const escape = (value) =>
    encodeURIComponent(value).replace(/[()]/g, (character) => (character === '(' ? '%28' : '%29'));
