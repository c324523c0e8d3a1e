/** Arithmetic in number fields, such as 360/7. */

const TOKEN = /\s*(\d+\.?\d*(?:e[+-]?\d+)?|\.\d+(?:e[+-]?\d+)?|[-+*/^()])/giy;

/**
 * The value of a text of numbers, + - * / ^ and parentheses; null if the text is anything else, or the value is not finite.
 * @param {string} text
 * @returns {number | null}
 */
export function valueOf(text) {
    const tokens = tokensOf(text.trim().replaceAll('−', '-').replaceAll('×', '*').replaceAll('÷', '/'));
    if (!tokens) return null;
    let at = 0;
    /** Takes the next token if it is one of these. @param {string[]} wanted */
    const take = (...wanted) => (wanted.includes(tokens[at] ?? '') ? tokens[at++] : undefined);

    /** @returns {number} */
    function sum() {
        let value = product();
        for (let sign = take('+', '-'); sign; sign = take('+', '-')) value += sign === '+' ? product() : -product();
        return value;
    }

    /** @returns {number} */
    function product() {
        let value = signed();
        for (let sign = take('*', '/'); sign; sign = take('*', '/'))
            value = sign === '*' ? value * signed() : value / signed();
        return value;
    }

    /** @returns {number} */
    function signed() {
        return take('-') ? -signed() : take('+') ? signed() : power();
    }

    /** @returns {number} */
    function power() {
        const base = atom();
        return take('^') ? base ** signed() : base;
    }

    /** @returns {number} */
    function atom() {
        if (take('(')) {
            const value = sum();
            return take(')') ? value : NaN;
        }
        const token = tokens?.[at++] ?? '';
        return /^[\d.]/.test(token) ? Number(token) : NaN;
    }

    const value = sum();
    return at === tokens.length && Number.isFinite(value) ? value : null;
}

/** The longest text that is read. */
const LONGEST = 200;

/** @param {string} text @returns {string[] | null} */
function tokensOf(text) {
    const tokens = [];
    if (text.length > LONGEST) return null;
    TOKEN.lastIndex = 0;
    for (let from = 0; from < text.length; from = TOKEN.lastIndex) {
        const token = TOKEN.exec(text);
        if (!token) return null;
        tokens.push(String(token[1]));
    }
    return tokens;
}
