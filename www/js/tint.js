/**
 * Colours of texts. The core says what each UTF-16 unit of a text is, as a letter; here the letters of a line become
 * spans. Pure functions.
 */

/** By the core's letter (`Class` in `classes.rs`); what is not here has no tint. @type {Record<string, string>} */
const TINTS = {
    c: 'comment',
    h: 'heading',
    m: 'mark',
    p: 'predecessor',
    x: 'context',
    i: 'condition',
    w: 'weight',
    k: 'constant',
    a: 'parameter',
    f: 'function',
    n: 'number',
    b: 'bracket',
    t: 'turn',
};

/** @typedef {{start: number, end: number, tint: string}} Span half open, in UTF-16 units */

/**
 * The tinted spans of a line, in order.
 * @param {string} letters one for each UTF-16 unit of the line
 * @returns {Span[]}
 */
export function spansOf(letters) {
    /** @type {Span[]} */
    const spans = [];
    for (const { 0: run, index } of letters.matchAll(/(.)\1*/gs)) {
        const tint = TINTS[run.charAt(0)];
        if (tint) spans.push({ start: index, end: index + run.length, tint });
    }
    return spans;
}

/**
 * Letters for a text that was edited, until the core has read it: what stays keeps its letters, what is new has those
 * of what it stands behind.
 * @param {string} letters
 * @param {string} before the text they belong to
 * @param {string} after
 */
export function carryOver(letters, before, after) {
    if (letters.length !== before.length) return '_'.repeat(after.length);
    const { head, tail } = edit(before, after);
    const fresh = after.length - tail - head;
    const like = head > 0 && !/\s/.test(after.charAt(head - 1)) ? letters.charAt(head - 1) : '_';
    return letters.slice(0, head) + like.repeat(fresh) + letters.slice(letters.length - tail);
}

/**
 * How many units two texts have in common at their start and at their end.
 * @param {string} before
 * @param {string} after
 */
export function edit(before, after) {
    const most = Math.min(before.length, after.length);
    let head = 0;
    while (head < most && before.charCodeAt(head) === after.charCodeAt(head)) head++;
    let tail = 0;
    while (tail < most - head && before.charCodeAt(before.length - 1 - tail) === after.charCodeAt(after.length - 1 - tail)) tail++;
    return { head, tail };
}

/**
 * The tint of a symbol of a string, if it has one.
 * @param {string} symbol
 */
export function tintOf(symbol) {
    if (/[[\]{}]/.test(symbol)) return 'bracket';
    return /[+\-&^|\\/<>$]/.test(symbol) ? 'turn' : '';
}
