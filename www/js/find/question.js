/** The fields for what is known of a system. An empty field is to be found out. */

import { valueOf } from '../controls/arithmetic.js';
import { input, setValue } from '../base/dom.js';
import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').FindQuestion} FindQuestion */

/** @type {(keyof FindQuestion)[]} */
const FIELDS = ['axiom', 'angle', 'n', 'draws', 'heading'];
/** The fields with numbers, with what is expected of them. @type {Partial<Record<keyof FindQuestion, string>>} */
const NUMBERS = {
    angle: say`The angle is expected in degrees.`,
    n: say`A whole number of iterations is expected.`,
    heading: say`The heading is expected in degrees.`,
};

/** @param {keyof FindQuestion} name */
const field = (name) => input(`find-${name}`);

/** What the fields say; throws a sentence if one of them says nothing. @returns {FindQuestion} */
export function readQuestion() {
    const read = (/** @type {keyof FindQuestion} */ name) => {
        const text = field(name).value.trim();
        const expected = NUMBERS[name];
        if (text === '') return null;
        if (expected === undefined) return text;
        const value = valueOf(text.replace(/\s*°$/, ''));
        if (value === null || (name === 'n' && (value < 1 || !Number.isInteger(value)))) {
            field(name).focus();
            throw new Error(expected);
        }
        return value;
    };
    return /** @type {FindQuestion} */ (Object.fromEntries(FIELDS.map((name) => [name, read(name)])));
}

/** @param {Partial<FindQuestion>} question */
export function showQuestion(question) {
    for (const name of FIELDS)
        setValue(field(name), question[name] === null || question[name] === undefined ? '' : String(question[name]));
}
