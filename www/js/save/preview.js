/**
 * The preview of a file: the first lines of a text, or the picture; on a sheet, with its margins. Meshes and files that
 * cannot be shown have the picture of the drawing.
 */

import { make, setText } from '../base/dom.js';
import { FORMATS, SHEETS } from '../late-tables.js';
import { say } from '../base/words.js';
import { sidesOf } from './choices.js';

/** @typedef {import('../protocol.js').Format} Format */
/** @typedef {import('./choices.js').Value} Value */

/** Larger pictures are not shown themselves, in bytes: the browser would take long. */
const LARGEST_PICTURE = 1 << 20;
/** The most lines and characters of a line that are shown. */
const LINES = 24;
const LINE = 120;

/** The first lines of a text; null if the bytes are no text. @param {Blob} head */
export async function firstLines(head) {
    try {
        // The last character may be cut.
        const text = new TextDecoder('utf-8', { fatal: true }).decode(await head.arrayBuffer(), { stream: true });
        if (text.includes('\0')) return null;
        return text
            .split('\n')
            .slice(0, LINES)
            .map((line) => (line.length > LINE ? `${line.slice(0, LINE)}…` : line))
            .join('\n');
    } catch {
        return null;
    }
}

/** The sheet of some values, in millimetres. @param {Record<string, Value>} values */
export function sheetOf(values) {
    const name = String(values['sheet'] ?? 'a4');
    const [width = 210, height = 297] =
        /** @type {Readonly<Record<string, readonly number[]>>} */ (SHEETS)[name] ??
        sidesOf(name, { low: 0, high: Infinity }) ??
        [];
    const margin = Number(values['margin'] ?? 10);
    return values['landscape'] === true && width < height
        ? { width: height, height: width, margin }
        : { width, height, margin };
}

/** The longer side of the picture on a sheet, in pixels. */
const SIDE = 700;

/**
 * The frame and what it shows.
 * @typedef {object} Preview
 * @property {HTMLElement} frame
 * @property {() => Promise<Blob>} shown
 * @property {(width: number, height: number) => Promise<HTMLElement>} fitted
 * @property {string} address The address of the shown picture
 * @property {number} last The number of the last request; pictures come later, and older ones are dropped
 */

/**
 * @param {HTMLElement} frame
 * @param {object} drawing
 * @param {() => Promise<Blob>} drawing.shown a picture of the drawing as shown on the page
 * @param {(width: number, height: number) => Promise<HTMLElement>} drawing.fitted the whole drawing, in a picture of this size
 */
export function createPreview(frame, { shown, fitted }) {
    /** @type {Preview} */
    const self = { frame, shown, fitted, address: '', last: 0 };

    return {
        /** Shows a file, or what is there of it. @param {Format} format @param {Record<string, Value>} values @param {import('./making.js').Made | null} made */
        show: (format, values, made) => showFile(self, format, values, made),

        /** Shows the drawing on a sheet without margins. @param {readonly number[]} sides in millimetres */
        showPoster(sides) {
            put(self, sheetWith(self, { sheet: sides.join('x'), margin: 0 }));
        },

        forget() {
            self.last += 1;
            frame.replaceChildren();
            if (self.address) URL.revokeObjectURL(self.address);
            self.address = '';
        },
    };
}

/** @param {Preview} self @param {Blob} blob */
function imageOf(self, blob) {
    const old = self.address;
    self.address = URL.createObjectURL(blob);
    const image = make('img', { src: self.address, alt: say`The drawing` });
    if (old) image.addEventListener('load', () => URL.revokeObjectURL(old), { once: true });
    return image;
}

/** The drawing on a sheet, between its margins. @param {Preview} self @param {Record<string, Value>} values */
async function sheetWith(self, values) {
    const { width, height, margin } = sheetOf(values);
    const inner = [width, height].map((side) => Math.max(side - 2 * margin, side / 10));
    const factor = SIDE / Math.max(...inner);
    const [wide = 1, high = 1] = inner.map((side) => Math.round(side * factor));
    const paper = make('div', { class: 'save-paper' }, make('span', {}, await self.fitted(wide, high)));
    paper.style.aspectRatio = `${width} / ${height}`;
    paper.style.setProperty(
        '--margins',
        [height, width].map((side) => `${Math.min(45, (100 * margin) / side)}%`).join(' '),
    );
    paper.classList.toggle('wide', width > height);
    return paper;
}

/**
 * Shows what `content` makes, unless something newer is shown before.
 * @param {Preview} self
 * @param {Promise<HTMLElement>} content
 */
async function put(self, content) {
    const own = ++self.last;
    const element = await content
        .catch(() => self.shown().then((blob) => imageOf(self, blob)))
        .catch(() => make('p', { class: 'note' }, say`Nothing to show.`));
    if (own === self.last) self.frame.replaceChildren(element);
}

/** @param {Preview} self @param {string} text */
function putText(self, text) {
    self.last += 1;
    if (self.frame.firstElementChild?.tagName !== 'PRE')
        self.frame.replaceChildren(
            make('pre', { tabindex: '0', role: 'region', 'aria-label': say`Beginning of the file` }),
        );
    setText(/** @type {Element} */ (self.frame.firstElementChild), text);
}

/**
 * @param {Preview} self
 * @param {Format} format
 * @param {Record<string, Value>} values
 * @param {import('./making.js').Made | null} made
 */
async function showFile(self, format, values, made) {
    const { picture, mime, content, options } = FORMATS[format];
    const isPicture = picture || content === 'mesh';
    /** @param {string} name */
    const reads = (name) => options.some((each) => each === name);
    // While the file grows, its picture stays.
    if (made?.state === 'making' && made.size > 0 && isPicture) return;
    const own = ++self.last;
    const text = !isPicture && made?.head ? await firstLines(made.head) : null;
    if (own !== self.last) return;
    self.frame.classList.toggle('sheet', reads('sheet'));
    self.frame.classList.toggle('clear', values['transparent'] === true && reads('transparent'));
    if (text !== null) return putText(self, text);
    // A text is on its way.
    if (!isPicture && made?.state === 'making') return;
    const isSmall = made?.blob && mime === 'image/svg+xml' && made.size <= LARGEST_PICTURE;
    // A plot is its own sheet, with the pen's lines.
    if (reads('sheet') && !isSmall) return put(self, sheetWith(self, values));
    return put(
        self,
        (isSmall && made.blob ? Promise.resolve(made.blob) : self.shown()).then((blob) => imageOf(self, blob)),
    );
}
