/**
 * Syntax highlighting. The core classifies each UTF-16 unit of a text by a letter; this module turns the letters of a
 * line into coloured spans. Pure functions.
 */

/** Tints by the core's class letters (crates/lsystem-session/src/notation.rs); other letters have no tint. @type {Record<string, string>} */
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
 * Letters for an edited text, until the core has classified it: unchanged units keep their letters, and inserted units
 * get the letter of the unit before them.
 * @param {string} letters
 * @param {string} before the text of the letters
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
    while (
        tail < most - head &&
        before.charCodeAt(before.length - 1 - tail) === after.charCodeAt(after.length - 1 - tail)
    )
        tail++;
    return { head, tail };
}

/**
 * The tint of a symbol in the string view, or ''.
 * @param {string} symbol
 */
export function tintOf(symbol) {
    if (/[[\]{}]/.test(symbol)) return 'bracket';
    return /[+\-&^|\\/<>$]/.test(symbol) ? 'turn' : '';
}
