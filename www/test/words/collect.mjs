/**
 * All English texts that a person can read, which are the keys of the catalogues in `lang/`: from the calls in the scripts
 * and in the core, from the markup, and from the tables and files that the page shows.
 */

import { readFileSync, readdirSync } from 'node:fs';
import { parse } from 'acorn';
import { parseHTML } from 'linkedom';
import { READ, SAME, sentence } from '../../js/base/words.js';

const root = new URL('../../../', import.meta.url);
/** @param {string} name */
const read = (name) => readFileSync(new URL(name, root), 'utf8');

/**
 * The files below a folder with an ending.
 * @param {string} folder
 * @param {string} ending
 */
function list(folder, ending) {
    const found = readdirSync(new URL(folder, root), { recursive: true, encoding: 'utf8' });
    return found
        .filter((name) => name.endsWith(ending))
        .map((name) => `${folder}/${name}`)
        .sort();
}

/**
 * A text: where it is read first, and whether it has plural forms.
 * @typedef {{place: string, isCounted: boolean, one?: string}} Found
 */

/** All texts. @returns {Map<string, Found>} */
export function collect() {
    /** @type {Map<string, Found>} */
    const found = new Map();
    /** @param {string} place @param {string} text @param {string} [one] */
    const add = (place, text, one) => {
        if (/\p{L}{2}/u.test(text) && !found.has(text))
            found.set(text, { place, isCounted: one !== undefined, ...(one === undefined ? {} : { one }) });
    };
    add('the name of the language itself', 'English');
    found.set('1,234.5', { place: 'marks in numbers', isCounted: false });
    for (const name of [...list('www', '.html')].filter((name) => isOurs(name) && !name.startsWith('www/docs')))
        ofMarkup(name, add);
    for (const name of list('www/js', '.js')) ofScript(name, add);
    for (const name of list('crates', '.rs')) if (isProduct(name)) ofRust(name, add);
    ofTables(add);
    return found;
}

/** @param {string} name */
const isOurs = (name) => !name.includes('node_modules') && !name.startsWith('www/test/');

/** The crates that speak to people. @param {string} name */
const isProduct = (name) =>
    /^crates\/(lsys|site|lsystem[a-z-]*)\/src\//.test(name) &&
    !/(^|\/)tests?(\/|\.rs$)/.test(name) &&
    name !== 'crates/lsystem-base/src/words.rs';

/** @typedef {(place: string, text: string, one?: string) => void} Add */

/** @param {string} name @param {Add} add */
function ofMarkup(name, add) {
    const text = read(name);
    const { document } = parseHTML(text.includes('<html') ? text : `<!doctype html><html><body>${text}</body></html>`);
    for (const element of document.querySelectorAll('*')) {
        for (const attribute of READ) {
            const words = element.getAttribute(attribute);
            if (words) add(name, words);
        }
        if (element.closest(SAME)) continue;
        const words = sentence(element);
        if (words) add(name, words);
    }
}

/** @param {string} name @param {Add} add */
function ofScript(name, add) {
    const text = read(name);
    const tree = parse(text, { ecmaVersion: 'latest', sourceType: 'module' });
    visit(tree, (node) => {
        if (node.type === 'TaggedTemplateExpression' && node.tag.name === 'say')
            add(name, node.quasi.quasis.map((/** @type {any} */ part) => part.value.cooked).join('{}'));
        if (node.type !== 'CallExpression') return;
        const [, second, third] = node.arguments.map(literal);
        if (node.callee.name === 'said') for (const text of choices(node.arguments[0])) add(name, text);
        if (node.callee.name === 'counted' && second !== null && third !== null) add(name, third, second);
    });
}

/** The text of a literal, or null. @param {any} node @returns {string | null} */
function literal(node) {
    if (node?.type === 'Literal' && typeof node.value === 'string') return node.value;
    if (node?.type === 'TemplateLiteral' && node.quasis.length === 1) return node.quasis[0].value.cooked;
    return null;
}

/** The texts that an expression chooses from. @param {any} node @returns {string[]} */
function choices(node) {
    if (node?.type === 'ConditionalExpression') return [...choices(node.consequent), ...choices(node.alternate)];
    const text = literal(node);
    return text === null ? [] : [text];
}

/** @param {any} node @param {(node: any) => void} see */
function visit(node, see) {
    if (Array.isArray(node)) for (const one of node) visit(one, see);
    else if (node && typeof node === 'object') {
        if (typeof node.type === 'string') see(node);
        for (const value of Object.values(node)) if (value && typeof value === 'object') visit(value, see);
    }
}

const STRING = String.raw`"((?:[^"\\]|\\[\s\S])*)"`;
const RUST = new RegExp(
    String.raw`\b(?:say|word)!\(\s*${STRING}|\bcounted!\((?:[^"]|'"')*?,\s*${STRING},\s*${STRING}`,
    'g',
);

/** @param {string} name @param {Add} add */
function ofRust(name, add) {
    // Comments show examples.
    const text = read(name).replace(/^\s*\/\/.*$/gm, '');
    for (const [, plain, one, other] of text.matchAll(RUST)) {
        if (plain !== undefined) add(name, unescape(plain));
        else add(name, unescape(other ?? ''), unescape(one ?? ''));
    }
}

/** A Rust literal's text. @param {string} text */
function unescape(text) {
    const plain = { n: '\n', t: '\t', '"': '"', '\\': '\\', "'": "'", 0: '\0' };
    return text.replace(/\\(?:\n\s*|u\{([0-9a-fA-F]+)\}|x([0-9a-fA-F]{2})|(.))/g, (_, long, short, one) =>
        long || short
            ? String.fromCodePoint(Number.parseInt(long ?? short, 16))
            : one === undefined
              ? ''
              : (plain[/** @type {'n'} */ (one)] ?? one),
    );
}

/** @param {Add} add */
function ofTables(add) {
    /** @type {string[]} */
    const told = [];
    for (const name of ['www/js/tables.js', 'www/js/late-tables.js']) {
        const tree = parse(read(name), { ecmaVersion: 'latest', sourceType: 'module' });
        visit(tree, (node) => {
            if (node.type !== 'Property') return;
            const [key, text] = [node.key.name ?? node.key.value, literal(node.value)];
            if (text !== null && ['label', 'help', 'task', 'unit', 'expected'].includes(key)) add(name, text);
            if (text && key === 'help') told.push(text);
            // The names of choices.
            if (key === 'words')
                visit(node.value, (inside) => inside.type === 'Property' && add(name, literal(inside.value) ?? ''));
        });
        visit(tree, (node) => {
            if (node.type !== 'VariableDeclarator' || node.id.name !== 'PURPOSES') return;
            visit(node.init, (inside) => inside.type === 'Property' && add(name, literal(inside.value) ?? ''));
        });
    }
    /** @param {string} name @param {any} value @param {string} [key] */
    const ofJson = (name, value, key = '') => {
        if (typeof value === 'string') {
            if (['title', 'notes', 'task', 'hints'].includes(key)) add(name, value);
            // Sources are citations, or these words.
            if (key === 'source' && /^(Composed|Found by) [^,;(]*$/.test(value)) add(name, value);
        } else if (Array.isArray(value)) for (const one of value) ofJson(name, one, key);
        else if (value) for (const [inside, one] of Object.entries(value)) ofJson(name, one, inside);
    };
    // The help of the program, but for the lines that it makes of the help of options.
    for (const text of JSON.parse(read('crates/lsys/help.json')))
        if (!told.some((option) => text !== option && text.startsWith(option) && text.includes('[default: ')))
            add('crates/lsys/help.json', text);
    ofJson('www/exercises.json', JSON.parse(read('www/exercises.json')));
    for (const name of list('data_in', '.json')) {
        try {
            ofJson(name, JSON.parse(read(name)));
        } catch {
            // Files with comments have no words for people but these.
            for (const [, key, text] of read(name).matchAll(/"(title|notes)":\s*("(?:[^"\\]|\\.)*")/g))
                ofJson(name, JSON.parse(text ?? '""'), key);
        }
    }
}
