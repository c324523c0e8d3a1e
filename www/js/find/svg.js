/**
 * SVG pictures from anywhere. The browser draws them as images, so that their scripts do not run and nothing is loaded;
 * this module refuses those whose drawing would stall the page, and gives the others a size. It reads tags only: what is
 * no XML is refused by the browser. Pure functions.
 */

/** The most elements that are drawn, with those that are drawn by reference. */
const MOST_SHAPES = 200_000;
/** Deeper elements are refused, before the stacks of browsers end. */
const MOST_DEPTH = 500;
/** The side of an SVG's picture, in pixels: twice that of the compared pictures. */
const SIDE = 1024;
/** Elements that may take a browser any time to draw, whatever their size. They are left out. */
const HEAVY = new Set(['filter', 'pattern', 'mask', 'marker', 'foreignObject', 'image']);

const TOO_MANY = `This SVG draws more than ${MOST_SHAPES.toLocaleString('en')} shapes. Save it as a PNG first.`;
const DAMAGED = 'This SVG is damaged.';

/** An element, and how many elements it draws with its children, without references. @typedef {{name: string, uses: string | null, children: Tag[]}} Tag */

/**
 * An SVG that can be drawn, with a width and a height; throws a sentence if it cannot.
 * @param {string} text
 * @returns {string}
 */
export function drawableSvg(text) {
    const root = { name: '', uses: null, children: /** @type {Tag[]} */ ([]) };
    /** @type {Tag[]} */
    const open = [root];
    /** @type {Map<string, Tag>} */
    const named = new Map();
    /** What is kept of the text. @type {string[]} */
    const kept = [];
    /** The end of what was read, the end of what was kept, and the depth of the heavy element that is left out. */
    let [at, from, heavy, elements] = [0, 0, 0, 0];
    for (;;) {
        const start = text.indexOf('<', at);
        if (start < 0) break;
        if (text[start + 1] === '!' || text[start + 1] === '?') {
            at = endOfOther(text, start);
            continue;
        }
        at = endOfTag(text, start);
        const tag = text.slice(start + 1, at - 1);
        const isEnd = tag.startsWith('/');
        const name = (/^\/?(?:[^\s/>:]*:)?([^\s/>]*)/.exec(tag)?.[1] ?? '').trim();
        if (isEnd) {
            if (open.length < 2) throw new Error(DAMAGED);
            open.pop();
            if (heavy > 0 && open.length < heavy) [heavy, from] = [0, at];
            continue;
        }
        if (++elements > MOST_SHAPES || open.length > MOST_DEPTH) throw new Error(TOO_MANY);
        const uses = name === 'use' ? attribute(tag, '(?:\\w+:)?href') : null;
        const id = attribute(tag, '(?:xml:)?id');
        // Browsers decode such names, so references could not be followed here.
        if (/[&%]/.test(`${uses ?? ''}${id ?? ''}`))
            throw new Error('This SVG has names with & or %, and is not opened.');
        const element = { name, uses: uses?.trim().replace(/^#/, '') ?? null, children: [] };
        if (open.length === 1 && name !== 'svg') throw new Error(DAMAGED);
        const isAlone = tag.endsWith('/');
        if (heavy === 0) {
            open.at(-1)?.children.push(element);
            if (id !== null && !named.has(id)) named.set(id, element);
        }
        if (HEAVY.has(name) && heavy === 0) {
            kept.push(text.slice(from, start));
            from = at;
            if (!isAlone) heavy = open.length + 1;
        } else if (open.length === 1) {
            kept.push(text.slice(from, start), `<${sized(tag)}>`);
            from = at;
        }
        if (!isAlone) open.push(element);
    }
    if (root.children.length !== 1 || open.length > 1) throw new Error(DAMAGED);
    if (shapesOf(root, named, new Map()) > MOST_SHAPES) throw new Error(TOO_MANY);
    return kept.join('') + text.slice(from);
}

/** The end of a comment, an instruction, a text or a declaration. @param {string} text @param {number} start */
function endOfOther(text, start) {
    const [, close] = [
        ['!--', '-->'],
        ['![CDATA[', ']]>'],
        ['?', '?>'],
    ].find(([begin = '']) => text.startsWith(begin, start + 1)) ?? ['', ''];
    if (close) {
        const end = text.indexOf(close, start);
        if (end < 0) throw new Error(DAMAGED);
        return end + close.length;
    }
    // A declaration may have others inside, between brackets.
    const [end, inside] = [text.indexOf('>', start), text.indexOf('[', start)];
    if (inside < 0 || end < inside) return end < 0 ? text.length : end + 1;
    const last = text.indexOf(']', inside);
    const declared = text.slice(inside, last < 0 ? undefined : last);
    // Entities that contain others grow exponentially, and those with elements hide them.
    if (/<!ENTITY\s[^>]*["'][^"']*(?:&|<)/i.test(declared) || last < 0)
        throw new Error('This SVG has entities inside entities, and is not opened.');
    return text.indexOf('>', last) + 1 || text.length;
}

/** The end of a tag; values of attributes may have `>`. @param {string} text @param {number} start */
function endOfTag(text, start) {
    for (let at = start + 1; at < text.length; at++) {
        const symbol = text[at];
        if (symbol === '>') return at + 1;
        if (symbol !== '"' && symbol !== "'") continue;
        at = text.indexOf(symbol, at + 1);
        if (at < 0) break;
    }
    throw new Error(DAMAGED);
}

/** The value of an attribute of a tag, or null. @param {string} tag @param {string} name a part of a regular expression */
function attribute(tag, name) {
    const found = new RegExp(`\\s${name}\\s*=\\s*(?:"([^"]*)"|'([^']*)')`).exec(tag);
    return found ? (found[1] ?? found[2] ?? '') : null;
}

/** The first tag with the size of the picture; only the ratio of the given size counts. @param {string} tag */
function sized(tag) {
    const box = (attribute(tag, 'viewBox') ?? '')
        .trim()
        .split(/[\s,]+/)
        .map(Number);
    const given = ['width', 'height'].map((name) => {
        const value = attribute(tag, name) ?? '%';
        return value.includes('%') ? NaN : parseFloat(value);
    });
    const isSize = (/** @type {number[]} */ [width = NaN, height = NaN]) =>
        width > 0 && height > 0 && Math.max(width, height) < 1e9 && Math.max(width / height, height / width) < SIDE;
    const [width = SIDE, height = SIDE] = [box.length === 4 ? box.slice(2) : [], given].find(isSize) ?? [];
    const scale = SIDE / Math.max(width, height);
    const bare = tag.replace(/\s(?:width|height)\s*=\s*(?:"[^"]*"|'[^']*')/g, '');
    const view = box.length === 4 ? '' : ` viewBox="0 0 ${width} ${height}"`;
    const size = ` width="${Math.max(1, Math.round(width * scale))}" height="${Math.max(1, Math.round(height * scale))}"${view}`;
    return bare.endsWith('/') ? `${bare.slice(0, -1)}${size}/` : bare + size;
}

/**
 * How many elements are drawn; `use` draws its target again. An element that draws itself has no end.
 * @param {Tag} element @param {Map<string, Tag>} named @param {Map<Tag, number>} known @returns {number}
 */
function shapesOf(element, named, known) {
    const before = known.get(element);
    if (before !== undefined) return before;
    known.set(element, Infinity);
    const target = element.uses === null ? undefined : named.get(element.uses);
    let total = 1 + (target ? shapesOf(target, named, known) : 0);
    for (const child of element.children) total += shapesOf(child, named, known);
    known.set(element, total);
    return total;
}
