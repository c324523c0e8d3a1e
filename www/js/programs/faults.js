/** Errors of programs in the words of a beginner. The interpreter's own words stand behind them. */

import { say } from '../base/words.js';
import { LONGEST } from './runner.js';

/** @typedef {import('./worker.js').Fault} Fault */

/** By the type of the error. @type {Readonly<Record<string, (message: string) => string>>} */
const WORDS = {
    Endless: () => say`The program was ended after ${LONGEST / 1000} seconds. Is there a loop that never ends?`,
    Crash: () => say`The program was ended: it takes too much memory, or calls itself without end.`,
    MemoryError: () => say`The program takes too much memory. Does something grow without end?`,
    RecursionError: () => say`The function calls itself without end, or much too often.`,
    OverflowError: (message) =>
        message.includes('printed') ? say`The program prints too much.` : say`A number or a result is too large.`,
    RangeError: (message) => {
        if (message.includes('call stack')) return say`The function calls itself without end, or much too often.`;
        if (message.includes('printed')) return say`The program prints too much.`;
        return say`A text or a list is too large.`;
    },
    IndentationError: () =>
        say`The indentation is wrong: lines of one block begin with the same number of blanks, and a line below a colon with more.`,
    TabError: () => say`Tabs and blanks are mixed at the beginning of the line. Use blanks only.`,
    SyntaxError: () =>
        say`This is not written as the language wants it. Look at brackets, quotes and colons here and on the line before.`,
    NameError: (message) =>
        say`The name ${nameIn(message)} is not known here. Is it written in the same way everywhere, and set before?`,
    UnboundLocalError: (message) => say`The name ${nameIn(message)} is used before it has a value.`,
    ReferenceError: (message) =>
        say`The name ${nameIn(message)} is not known here. Is it written in the same way everywhere, and set before?`,
    KeyError: (message) => say`The dictionary has no entry ${message}. Symbols without a rule stay as they are.`,
    IndexError: () => say`The list is shorter than the index, or it is empty. Counting begins at 0.`,
    EOFError: () => say`The program waits for input, and nobody types here.`,
    ZeroDivisionError: () => say`Something is divided by zero.`,
    AttributeError: (message) => say`A value has not what is behind its dot: ${message}.`,
    TypeError: (message) => {
        if (/argument|is not a function/.test(message) && !/unsupported|must be/.test(message))
            return say`A function is called with too few or too many values, or it is none: ${message}.`;
        if (/undefined|null|None/.test(message))
            return say`A value is missing where one is needed: ${message}. Does a function give nothing back?`;
        return say`Values of these kinds do not go together: ${message}.`;
    },
    ValueError: (message) => say`A value is not as it must be: ${message}.`,
};

/** @param {string} message */
const nameIn = (message) => /'([^']+)'|^(\S+) is not defined/.exec(message)?.slice(1).find(Boolean) ?? message;

/** @param {Fault} fault */
export function faultWords(fault) {
    const known = WORDS[fault.type];
    const words = known ? known(fault.message) : say`An error: ${fault.message}.`;
    const place = fault.line === null ? '' : `${say`Line ${fault.line}:`} `;
    return `${place}${words}`;
}
