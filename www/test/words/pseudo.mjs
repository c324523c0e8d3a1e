/** A language that no one speaks: English with accents, a third longer, to find texts that are not told through it. */

const ACCENTS = { a: 'á', e: 'ë', i: 'ï', o: 'ö', u: 'û', y: 'ý', A: 'Á', E: 'Ë', I: 'Ï', O: 'Ö', U: 'Û' };

/** @param {string} text */
function accented(text) {
    // Code and holes stay.
    const parts = text.split(/(`[^`]*`|\{\d*\})/);
    const told = parts.map((part, at) =>
        at % 2 ? part : part.replace(/[aeiouyAEIOU]/g, (letter) => ACCENTS[/** @type {'a'} */ (letter)]),
    );
    return told.join('') + '~'.repeat(Math.ceil(text.length / 3));
}

/** @param {ReadonlyMap<string, import('./collect.mjs').Found>} found */
export function pseudo(found) {
    const entries = [...found].map(([text, { one }]) => [
        text,
        text === '1,234.5'
            ? '1.234,5'
            : one === undefined
              ? accented(text)
              : { one: accented(one), other: accented(text) },
    ]);
    return Object.fromEntries(entries);
}

/** The words of a text that are still English. @param {string} text */
export const plainWords = (text) =>
    text.match(/(?<![\p{L}\d_])[A-Za-z]*[aeiou][A-Za-z]*(?![\p{L}\d_])/gu)?.filter((word) => word.length > 2) ?? [];
