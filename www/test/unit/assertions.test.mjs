/** The tests' own assertions: none compares a thing with itself, and none is about constants alone. */

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';

/** `kind` is the first letter of: word, number, string or regular expression, punctuation. @typedef {{text: string, kind: 'w' | 'n' | 's' | 'p'}} Token */

const WORD = /[\w$#]+/uy;
const NUMBER = /\d[\w.]*/y;
const PUNCTUATION = /=>|\.\.\.|\?\.|[=!]==?|[<>]=?|&&|\|\||\?\?|./suy;
const REGULAR = /\/(?:\\.|\[(?:\\.|[^\]\\])*\]|[^/\\[\n])+\/\w*/y;
const QUOTED = /'(?:\\.|[^'\\])*'|"(?:\\.|[^"\\])*"/suy;
const SPACE = /(?:\s|\/\/[^\n]*|\/\*.*?\*\/)+/suy;
/** Words that are values by themselves. */
const VALUES = ['true', 'false', 'null', 'undefined', 'NaN', 'Infinity'];
/** Words after which a slash begins a regular expression. */
const BEFORE_VALUES = ['return', 'typeof', 'await', 'case', 'of', 'in'];
const COMPARISONS = ['===', '!==', '==', '!=', '<', '>', '<=', '>='];
/** What ends an operand of a comparison, besides brackets. */
const ENDS = [',', ';', '&&', '||', '??', '?', ':', '=>', '=', '!', 'return', ...COMPARISONS];

/** What stands between the parts of a choice. */
const CHOICES = ['?', ':', '&&', '||', '??'];

/** The end of a template, whose code may have templates. @param {string} source @param {number} at its first character @returns {number} */
function endOfTemplate(source, at) {
    for (let end = at + 1; end < source.length; end++) {
        if (source[end] === '\\') end += 1;
        else if (source[end] === '`') return end + 1;
        else if (source.startsWith('${', end)) {
            let depth = 0;
            do {
                if (source[end] === '`') end = endOfTemplate(source, end) - 1;
                else if (source[end] === '{') depth += 1;
                else if (source[end] === '}') depth -= 1;
                end += 1;
            } while (depth > 0 || source[end - 1] === '$');
            end -= 1;
        }
    }
    throw new Error('a template has no end');
}

/** @param {string} source @returns {Token[]} */
function tokensOf(source) {
    /** @type {Token[]} */
    const tokens = [];
    let at = 0;
    /** @param {RegExp} pattern */
    const take = (pattern) => {
        pattern.lastIndex = at;
        const text = pattern.exec(source)?.[0] ?? '';
        at += text.length;
        return text;
    };
    const valueFollows = () => {
        const last = tokens.at(-1);
        return !last || (last.kind === 'p' ? ![')', ']', '}'].includes(last.text) : BEFORE_VALUES.includes(last.text));
    };
    while ((take(SPACE), at < source.length)) {
        const begun = at;
        if (take(NUMBER)) tokens.push({ text: source.slice(begun, at), kind: 'n' });
        else if (take(WORD)) tokens.push({ text: source.slice(begun, at), kind: 'w' });
        else if (take(QUOTED) || (source[at] === '/' && valueFollows() && take(REGULAR)))
            tokens.push({ text: source.slice(begun, at), kind: 's' });
        else if (source[at] === '`') {
            at = endOfTemplate(source, at);
            const text = source.slice(begun, at);
            // A template with code is no constant.
            tokens.push({ text, kind: text.includes('${') ? 'w' : 's' });
        } else tokens.push({ text: take(PUNCTUATION), kind: 'p' });
    }
    return tokens;
}

/** @param {Token | undefined} token */
const opens = (token) => token?.kind === 'p' && ['(', '[', '{'].includes(token.text);
/** @param {Token | undefined} token */
const closes = (token) => token?.kind === 'p' && [')', ']', '}'].includes(token.text);

/** The tokens of each argument, and where the call ends. @param {Token[]} tokens @param {number} at the token after the opening bracket */
function argumentsFrom(tokens, at) {
    /** @type {Token[][]} */
    const found = [[]];
    for (let depth = 0; depth >= 0; at++) {
        const token = tokens[at];
        if (!token) throw new Error('a call has no end');
        if (opens(token)) depth += 1;
        if (closes(token)) depth -= 1;
        if (depth === 0 && token.text === ',') found.push([]);
        else if (depth >= 0) found.at(-1)?.push(token);
    }
    return found.filter((argument) => argument.length > 0);
}

/** @param {Token[]} tokens */
const textOf = (tokens) => tokens.map(({ text }) => text).join(' ');
/** @param {Token[]} tokens */
const isConstant = (tokens) => tokens.every(({ text, kind }) => kind !== 'w' || VALUES.includes(text));

/** The operand of a comparison, from the operator in one direction. @param {Token[]} tokens @param {number} at @param {1 | -1} step */
function operand(tokens, at, step) {
    const found = [];
    for (let depth = 0, place = at + step; tokens[place]; place += step) {
        const token = /** @type {Token} */ (tokens[place]);
        if (step > 0 ? opens(token) : closes(token)) depth += 1;
        if (step > 0 ? closes(token) : opens(token)) depth -= 1;
        if (depth < 0 || (depth === 0 && token.kind !== 's' && ENDS.includes(token.text))) break;
        found.push(token);
    }
    return textOf(step > 0 ? found : found.reverse());
}

/** Whether an expression is a part of a choice. A constant is a usual last part. @param {Token[]} expression @param {Token[]} tokens */
const isPart = (expression, tokens) => !isConstant(expression) && partsOf(tokens).includes(textOf(expression));

/** The parts of a choice. @param {Token[]} tokens */
function partsOf(tokens) {
    /** @type {Token[][]} */
    const parts = [[]];
    let depth = 0;
    for (const token of tokens) {
        if (opens(token)) depth += 1;
        if (closes(token)) depth -= 1;
        if (depth === 0 && token.kind === 'p' && CHOICES.includes(token.text)) parts.push([]);
        else parts.at(-1)?.push(token);
    }
    return parts.map(textOf);
}

/** The assertions of a source that cannot fail, or cannot hold. @param {string} source @returns {string[]} */
function empty(source) {
    const tokens = tokensOf(source);
    /** @type {string[]} */
    const found = [];
    for (const [at, { text, kind }] of tokens.entries()) {
        if (kind !== 'w' || !['assert', 'until'].includes(text) || tokens[at - 1]?.text === '.') continue;
        const method = text === 'assert' && tokens[at + 1]?.text === '.' ? (tokens[at + 2]?.text ?? '') : '';
        const bracket = method ? at + 3 : at + 1;
        if (tokens[bracket]?.text !== '(' || method === 'fail') continue;
        const [first = [], second = []] = argumentsFrom(tokens, bracket + 1);
        const words = `${textOf(tokens.slice(at, bracket + 1))} ${textOf(first)}, ${textOf(second)}`.slice(0, 200);
        const isTwoSided = method !== '' && method !== 'ok';
        const isSame =
            isTwoSided && (textOf(first) === textOf(second) || isPart(first, second) || isPart(second, first));
        const arrow = first.findIndex((token) => token.text === '=>');
        const isAboutConstants = isConstant(
            isTwoSided ? [...first, ...second] : text === 'until' && arrow >= 0 ? first.slice(arrow + 1) : first,
        );
        const comparesItself = first.some(
            (token, place) =>
                token.kind === 'p' &&
                COMPARISONS.includes(token.text) &&
                operand(first, place, -1) === operand(first, place, 1),
        );
        if (isSame || isAboutConstants || comparesItself) found.push(words);
    }
    return found;
}

test('assertions without content are found', () => {
    for (const source of [
        'assert.equal(a.b(c), a.b( c ));',
        "assert.equal(await page.getAttribute('#stage', 'class'), await page.getAttribute('#stage', 'class'));",
        'assert.notEqual(`${a}`, `${a}`, "words");',
        'assert.equal(a.b, c ? a.b : 1);',
        'assert.ok(true);',
        'assert(1, "words");',
        "assert.match('abc', /b(c)/);",
        'assert.deepEqual([1, 2], [1, 2]);',
        'assert.ok(b && (a.length === a.length || c));',
        'assert.ok(/* why */ a < a);',
        "until(async () => true, 'something');",
        "until(async () => (await text(page)) === (await text(page)), 'something');",
    ]) {
        assert.equal(empty(source).length, 1, source);
    }
});

test('assertions with content are not found', () => {
    for (const source of [
        'assert.equal(a(1), a(2));',
        'assert.equal(a, 1);',
        'assert.equal(a, b(a));',
        'assert.equal(a ?? 1, 1);',
        "assert.equal('a === a', b);",
        'assert.ok(a.b === a.c && a / b / c);',
        'assert.match(a, /\\/([\'"`]/);',
        'assert.equal(`${a}${`${b}`}`, `${a}`);',
        '// assert.ok(true);',
        "assert.fail('words');",
        "until(async () => (await text(page)) === 'a', 'something');",
        'assert.throws(() => a(), /b/);',
    ]) {
        assert.deepEqual(empty(source), [], source);
    }
});

test('no assertion of the tests is without content', () => {
    const folder = new URL('../', import.meta.url);
    const names = readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter((name) => name.endsWith('.mjs'));
    assert.ok(names.length > 50, `${names.length} files`);
    let assertions = 0;
    for (const name of names) {
        const source = readFileSync(new URL(name, folder), 'utf8');
        assert.deepEqual(empty(source), [], name);
        assertions += tokensOf(source).filter(({ text, kind }) => kind === 'w' && text === 'assert').length;
    }
    assert.ok(assertions > 1000, `${assertions} assertions`);
});
