/** Which parts of a rules text are what, for tinting it. Only a guess at the notation: the core reads it. Pure functions. */

/** @typedef {'comment' | 'name' | 'arrow' | 'bracket' | 'turn' | 'weight'} Tint */
/** @typedef {{start: number, end: number, tint: Tint}} Span half open, in UTF-16 units */

const ARROW = /-->|->|=>|→/;
const BRACKET = /[[\]{}]/;
const TURN = /[+\-&^|\\/<>$]/;

/**
 * The tinted spans of a text, in order.
 * @param {string} text
 * @param {'rules' | 'axiom' | 'overrides'} kind
 * @returns {Span[]}
 */
export function tints(text, kind) {
    /** @type {Span[]} */
    const spans = [];
    let start = 0;
    for (const line of text.split('\n')) {
        if (kind === 'rules') rule(line, start, spans);
        else if (kind === 'axiom') symbols(line, 0, start, spans);
        else override(line, start, spans);
        start += line.length + 1;
    }
    return spans;
}

/** @param {string} line @param {number} offset @param {Span[]} spans */
function rule(line, offset, spans) {
    const words = line.trimStart();
    const arrow = ARROW.exec(line);
    if (words.startsWith('//') || words.startsWith('# ')) {
        add(spans, offset, 0, line.length, 'comment');
    } else if (arrow) {
        add(spans, offset, 0, arrow.index, 'name');
        const from = arrow.index + arrow[0].length;
        add(spans, offset, arrow.index, from, 'arrow');
        const weight = /:\s*[\d.,/]+\s*$/.exec(line.slice(from));
        symbols(weight ? line.slice(0, from + weight.index) : line, from, offset, spans);
        if (weight) add(spans, offset, from + weight.index, line.length, 'weight');
    } else {
        const name = /^\s*(#?define\s+)?[\p{L}_][\p{L}\d_]*\s*(?=[=:\s])/u.exec(line);
        if (name) add(spans, offset, 0, name[0].length, 'name');
    }
}

/** @param {string} line @param {number} from @param {number} offset @param {Span[]} spans */
function symbols(line, from, offset, spans) {
    for (let at = from; at < line.length; at++) {
        const symbol = line.charAt(at);
        if (BRACKET.test(symbol)) add(spans, offset, at, at + 1, 'bracket');
        else if (TURN.test(symbol)) add(spans, offset, at, at + 1, 'turn');
    }
}

/** @param {string} line @param {number} offset @param {Span[]} spans */
function override(line, offset, spans) {
    const colon = line.indexOf(':', 1);
    if (colon < 0) return;
    add(spans, offset, 0, colon, 'name');
    add(spans, offset, colon, colon + 1, 'arrow');
}

/** @param {Span[]} spans @param {number} offset @param {number} start @param {number} end @param {Tint} tint */
function add(spans, offset, start, end, tint) {
    if (end > start) spans.push({ start: offset + start, end: offset + end, tint });
}
