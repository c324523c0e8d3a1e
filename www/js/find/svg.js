/**
 * SVG pictures from anywhere. The browser draws them as images, so that their scripts do not run and nothing is loaded;
 * this module refuses those whose drawing would stall the page, and gives the others a size.
 */

const SVG = 'http://www.w3.org/2000/svg';
/** The most shapes, with those that are drawn by reference. */
const MOST_SHAPES = 200_000;
/** The side of an SVG's picture, in pixels: twice that of the compared pictures. */
const SIDE = 1024;
/** Elements that may take a browser any time to draw, whatever their size. */
const HEAVY = ['filter', 'pattern', 'mask', 'foreignObject', 'image'];

/**
 * An SVG that can be drawn, with a width and a height; throws a sentence if it cannot.
 * @param {string} text
 * @returns {string}
 */
export function drawableSvg(text) {
    // Entities that contain entities grow exponentially.
    if (/<!ENTITY[^>]*&(?!#)/i.test(text)) throw new Error('This SVG has entities inside entities and is not opened.');
    const parsed = new DOMParser().parseFromString(text, 'image/svg+xml');
    const root = parsed.documentElement;
    if (root.namespaceURI !== SVG || root.localName !== 'svg' || parsed.querySelector('parsererror')) throw new Error('This SVG is damaged.');
    for (const name of HEAVY) for (const element of [...root.getElementsByTagNameNS(SVG, name)]) element.remove();
    if (shapesIn(root) > MOST_SHAPES) throw new Error(`This SVG draws more than ${MOST_SHAPES.toLocaleString('en')} shapes. Save it as a PNG first.`);
    const [width, height] = sizeOf(root);
    const scale = SIDE / Math.max(width, height);
    if (!root.hasAttribute('viewBox')) root.setAttribute('viewBox', `0 0 ${width} ${height}`);
    root.setAttribute('width', String(Math.max(1, Math.round(width * scale))));
    root.setAttribute('height', String(Math.max(1, Math.round(height * scale))));
    return new XMLSerializer().serializeToString(parsed);
}

/** Width and height, of which only the ratio counts. @param {Element} root @returns {[number, number]} */
function sizeOf(root) {
    const [, , width = NaN, height = NaN] = (root.getAttribute('viewBox') ?? '').trim().split(/[\s,]+/).map(Number);
    const given = ['width', 'height'].map((name) => (/%\s*$/.test(root.getAttribute(name) ?? '%') ? NaN : parseFloat(root.getAttribute(name) ?? '')));
    const isSize = (/** @type {(number | undefined)[]} */ sides) => sides.every((side) => side !== undefined && side > 0 && side < 1e9);
    const ratio = (/** @type {number} */ wide, /** @type {number} */ high) => Math.max(wide / high, high / wide);
    for (const [wide = NaN, high = NaN] of [[width, height], given]) {
        // A line of no height is no picture.
        if (isSize([wide, high]) && ratio(wide, high) < SIDE) return [wide, high];
    }
    return [SIDE, SIDE];
}

/** How many elements the drawing visits; `use` draws its target again. @param {Element} root */
function shapesIn(root) {
    /** @type {Map<Element, number>} */
    const known = new Map();
    /** @type {Map<string, Element>} */
    const named = new Map();
    for (const element of root.querySelectorAll('[id]')) if (!named.has(element.id)) named.set(element.id, element);

    /** The elements that `element` draws. Those that are being counted draw themselves, and count as too many. @param {Element} element @returns {number} */
    function count(element) {
        const before = known.get(element);
        if (before !== undefined) return before;
        known.set(element, Infinity);
        let total = 1;
        for (const child of element.children) total += count(child);
        if (element.localName === 'use') {
            const target = named.get((element.getAttribute('href') ?? element.getAttributeNS('http://www.w3.org/1999/xlink', 'href') ?? '').replace(/^#/, ''));
            if (target) total += count(target);
        }
        known.set(element, total);
        return total;
    }

    // Recursion ends here before the browser's stack does.
    if (depthOf(root) > 500) return Infinity;
    return count(root);
}

/** How deep elements are nested. @param {Element} root */
function depthOf(root) {
    let [deepest, depth] = [0, 0];
    const walker = root.ownerDocument.createTreeWalker(root, NodeFilter.SHOW_ELEMENT);
    for (let node = walker.currentNode; ; ) {
        const child = walker.firstChild();
        if (child) {
            deepest = Math.max(deepest, ++depth);
            continue;
        }
        while (!walker.nextSibling()) {
            if (walker.currentNode === node || !walker.parentNode()) return deepest;
            depth--;
        }
    }
}
