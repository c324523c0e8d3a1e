/**
 * The preview of a file: the first lines of a text, or the picture; on a sheet, with its margins. Meshes and files that
 * cannot be shown have the picture of the drawing.
 */

import { make, setText } from '../dom.js';
import { FORMATS, SHEETS } from '../late-tables.js';
import { say } from '../words.js';
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
 * @param {HTMLElement} frame
 * @param {object} drawing
 * @param {() => Promise<Blob>} drawing.shown a picture of the drawing as shown on the page
 * @param {(width: number, height: number) => Promise<HTMLElement>} drawing.fitted the whole drawing, in a picture of this size
 */
export function createPreview(frame, { shown, fitted }) {
    /** The address of the shown picture. */
    let address = '';
    /** The number of the last request; pictures come later, and older ones are dropped. */
    let last = 0;

    /** @param {Blob} blob */
    function imageOf(blob) {
        const old = address;
        address = URL.createObjectURL(blob);
        const image = make('img', { src: address, alt: say`The drawing` });
        if (old) image.addEventListener('load', () => URL.revokeObjectURL(old), { once: true });
        return image;
    }

    /** The drawing on a sheet, between its margins. @param {Record<string, Value>} values */
    async function sheetWith(values) {
        const { width, height, margin } = sheetOf(values);
        const inner = [width, height].map((side) => Math.max(side - 2 * margin, side / 10));
        const factor = SIDE / Math.max(...inner);
        const [wide = 1, high = 1] = inner.map((side) => Math.round(side * factor));
        const paper = make('div', { class: 'save-paper' }, make('span', {}, await fitted(wide, high)));
        paper.style.aspectRatio = `${width} / ${height}`;
        paper.style.setProperty(
            '--margins',
            [height, width].map((side) => `${Math.min(45, (100 * margin) / side)}%`).join(' '),
        );
        paper.classList.toggle('wide', width > height);
        return paper;
    }

    /** Shows what `content` makes, unless something newer is shown before. @param {Promise<HTMLElement>} content */
    async function put(content) {
        const own = ++last;
        const element = await content
            .catch(() => shown().then(imageOf))
            .catch(() => make('p', { class: 'note' }, say`Nothing to show.`));
        if (own === last) frame.replaceChildren(element);
    }

    /** @param {string} text */
    function putText(text) {
        last += 1;
        if (frame.firstElementChild?.tagName !== 'PRE')
            frame.replaceChildren(
                make('pre', { tabindex: '0', role: 'region', 'aria-label': say`Beginning of the file` }),
            );
        setText(/** @type {Element} */ (frame.firstElementChild), text);
    }

    return {
        /** Shows a file, or what is there of it. @param {Format} format @param {Record<string, Value>} values @param {import('./making.js').Made | null} made */
        async show(format, values, made) {
            const { picture, mime, content, options } = FORMATS[format];
            const isPicture = picture || content === 'mesh';
            /** @param {string} name */
            const reads = (name) => options.some((each) => each === name);
            // While the file grows, its picture stays.
            if (made?.state === 'making' && made.size > 0 && isPicture) return;
            const own = ++last;
            const text = !isPicture && made?.head ? await firstLines(made.head) : null;
            if (own !== last) return;
            frame.classList.toggle('sheet', reads('sheet'));
            frame.classList.toggle('clear', values['transparent'] === true && reads('transparent'));
            if (text !== null) return putText(text);
            // A text is on its way.
            if (!isPicture && made?.state === 'making') return;
            const isSmall = made?.blob && mime === 'image/svg+xml' && made.size <= LARGEST_PICTURE;
            // A plot is its own sheet, with the pen's lines.
            if (reads('sheet') && !isSmall) return put(sheetWith(values));
            return put((isSmall && made.blob ? Promise.resolve(made.blob) : shown()).then(imageOf));
        },

        /** Shows the drawing on a sheet without margins. @param {readonly number[]} sides in millimetres */
        showPoster(sides) {
            put(sheetWith({ sheet: sides.join('x'), margin: 0 }));
        },

        /** Shows the drawing. */
        showDrawing() {
            frame.classList.remove('clear');
            put(shown().then(imageOf));
        },

        forget() {
            last += 1;
            frame.replaceChildren();
            if (address) URL.revokeObjectURL(address);
            address = '';
        },
    };
}
