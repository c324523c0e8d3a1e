/** Which parts of a line of rules are what, for tinting it. Only a guess at the notation: the core reads it. Pure functions. */

/** @typedef {'comment' | 'name' | 'arrow' | 'bracket' | 'turn' | 'weight'} Tint */
/** @typedef {{start: number, end: number, tint: Tint}} Span half open, in UTF-16 units */

const ARROW = /-->|->|=>|→/;
const BRACKET = /[[\]{}]/;
const TURN = /[+\-&^|\\/<>$]/;

/**
 * The tinted spans of a line, in order.
 * @param {string} line
 * @param {'rules' | 'axiom' | 'overrides'} kind
 * @returns {Span[]}
 */
export function tints(line, kind) {
    /** @type {Span[]} */
    const spans = [];
    if (kind === 'rules') rule(line, spans);
    else if (kind === 'axiom') symbols(line, 0, spans);
    else override(line, spans);
    return spans;
}

/** @param {string} line @param {Span[]} spans */
function rule(line, spans) {
    const words = line.trimStart();
    const arrow = ARROW.exec(line);
    if (words.startsWith('//') || words.startsWith('# ')) {
        add(spans, 0, line.length, 'comment');
    } else if (arrow) {
        add(spans, 0, arrow.index, 'name');
        const from = arrow.index + arrow[0].length;
        add(spans, arrow.index, from, 'arrow');
        const weight = /:\s*[\d.,/]+\s*$/.exec(line.slice(from));
        symbols(weight ? line.slice(0, from + weight.index) : line, from, spans);
        if (weight) add(spans, from + weight.index, line.length, 'weight');
    } else {
        const name = /^\s*(#?define\s+)?[\p{L}_][\p{L}\d_]*\s*(?=[=:\s])/u.exec(line);
        if (name) add(spans, 0, name[0].length, 'name');
    }
}

/** @param {string} line @param {number} from @param {Span[]} spans */
function symbols(line, from, spans) {
    for (let at = from; at < line.length; at++) {
        const symbol = line.charAt(at);
        if (BRACKET.test(symbol)) add(spans, at, at + 1, 'bracket');
        else if (TURN.test(symbol)) add(spans, at, at + 1, 'turn');
    }
}

/** @param {string} line @param {Span[]} spans */
function override(line, spans) {
    const colon = line.indexOf(':', 1);
    if (colon < 0) return;
    add(spans, 0, colon, 'name');
    add(spans, colon, colon + 1, 'arrow');
}

/** @param {Span[]} spans @param {number} start @param {number} end @param {Tint} tint */
function add(spans, start, end, tint) {
    if (end > start) spans.push({ start, end, tint });
}
