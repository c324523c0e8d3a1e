/** The preview of a picture: its ink, the crop with corners to drag or to move by keys, and the threshold. */

import { button, byId, html, input, make, setText } from '../dom.js';
import { say } from '../words.js';
import { darkIsLess, inkMap, inkShare, levelOf, withCorner } from './ink.js';

/** @typedef {import('./ink.js').Grey} Grey */
/** @typedef {import('./ink.js').Choice} Choice */
/** @typedef {[import('./ink.js').End, import('./ink.js').Side]} Corner */

/** The longer side of the preview, in pixels. */
const SIDE = 640;
/** An arrow key moves a corner by this part of the picture; with Shift by ten times as much. */
const STEP = 0.005;

/** @type {[Corner, string][]} */
const CORNERS = [
    [['top', 'left'], say`Top left`],
    [['top', 'right'], say`Top right`],
    [['bottom', 'left'], say`Bottom left`],
    [['bottom', 'right'], say`Bottom right`],
];
/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** @param {{changed: () => void}} dialog */
export function createPreview({ changed }) {
    const frame = html('find-frame');
    const canvas = byId('find-preview', HTMLCanvasElement);
    const box = html('find-crop');
    const slider = input('find-level');
    const kind = byId('find-ink', HTMLSelectElement);
    /** @type {Grey | null} */
    let picture = null;
    /** @type {Choice} */
    let choice = { crop: { left: 0, top: 0, right: 0, bottom: 0 }, level: 127, isDark: true };
    let waits = false;

    const handles = CORNERS.map(([corner, name]) => {
        const handle = make('button', { type: 'button', class: `find-corner ${corner.join(' ')}` });
        handle.addEventListener('keydown', (event) => {
            const arrow = ARROWS[event.key];
            if (!arrow || !picture) return;
            event.preventDefault();
            const step = Math.max(1, STEP * (event.shiftKey ? 10 : 1) * Math.max(picture.width, picture.height));
            move(corner, choice.crop[corner[1]] + arrow[0] * step, choice.crop[corner[0]] + arrow[1] * step);
        });
        handle.addEventListener('pointerdown', (event) => {
            if (event.button !== 0) return;
            event.preventDefault();
            handle.focus();
            handle.setPointerCapture(event.pointerId);
        });
        handle.addEventListener('pointermove', (event) => {
            if (!picture || !handle.hasPointerCapture(event.pointerId)) return;
            const { left, top, width, height } = canvas.getBoundingClientRect();
            move(
                corner,
                ((event.clientX - left) / width) * picture.width,
                ((event.clientY - top) / height) * picture.height,
            );
        });
        box.append(handle);
        return { handle, corner, name };
    });

    /** @param {Corner} corner @param {number} x @param {number} y */
    function move(corner, x, y) {
        if (!picture) return;
        choice = { ...choice, crop: withCorner(choice.crop, corner, x, y, picture) };
        edited();
    }

    function edited() {
        showSoon();
        changed();
    }

    function showSoon() {
        if (waits) return;
        waits = true;
        requestAnimationFrame(() => {
            waits = false;
            show();
        });
    }

    function show() {
        if (!picture) return;
        const { width, height } = picture;
        const scale = Math.min(1, SIDE / Math.max(width, height));
        const [wide, high] = [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
        if (canvas.width !== wide || canvas.height !== high) [canvas.width, canvas.height] = [wide, high];
        const style = getComputedStyle(frame);
        const [ink, paper] = [rgbOf(style.color), rgbOf(style.backgroundColor)];
        const map = inkMap(picture, choice, wide, high);
        const pixels = new ImageData(wide, high);
        for (let at = 0; at < map.length; at++) {
            const share = (map[at] ?? 0) / 255;
            for (let channel = 0; channel < 3; channel++)
                pixels.data[4 * at + channel] = (ink[channel] ?? 0) * share + (paper[channel] ?? 0) * (1 - share);
            pixels.data[4 * at + 3] = 255;
        }
        canvas.getContext('2d')?.putImageData(pixels, 0, 0);
        frame.style.aspectRatio = `${width} / ${height}`;
        frame.style.setProperty('--ratio', String(width / height));
        const { left, top, right, bottom } = choice.crop;
        const percent = (/** @type {number} */ part) => `${100 * part}%`;
        Object.assign(box.style, {
            left: percent(left / width),
            top: percent(top / height),
            right: percent(1 - right / width),
            bottom: percent(1 - bottom / height),
        });
        for (const {
            handle,
            corner: [end, side],
            name,
        } of handles) {
            const whole = (/** @type {number} */ part) => `${Math.round(100 * part)} %`;
            handle.setAttribute(
                'aria-label',
                say`${name} corner of the crop: ${whole(choice.crop[side] / width)} from the left, ${whole(choice.crop[end] / height)} from the top. Arrow keys move it.`,
            );
        }
        slider.value = String(choice.level);
        slider.style.setProperty('--at', String(choice.level / 254));
        kind.value = choice.isDark ? 'dark' : 'light';
        const share = inkShare(picture, choice);
        setText(
            html('find-ink-note'),
            share === 0
                ? say`Nothing is ink here. Move the threshold.`
                : share > 0.5
                  ? say`${Math.round(100 * share)} % of the picture is ink. Lines cover less: move the threshold, or take the other kind of lines.`
                  : '',
        );
    }

    /** Takes the threshold and the kind of lines that fit the crop. */
    function fit() {
        if (!picture) return;
        const level = levelOf(picture, choice.crop);
        choice = { ...choice, level, isDark: darkIsLess(picture, choice.crop, level) };
        edited();
    }

    slider.addEventListener('input', () => {
        choice = { ...choice, level: Number(slider.value) };
        edited();
    });
    kind.addEventListener('change', () => {
        choice = { ...choice, isDark: kind.value === 'dark' };
        edited();
    });
    button('find-whole').addEventListener('click', () => {
        if (!picture) return;
        choice = { ...choice, crop: { left: 0, top: 0, right: picture.width, bottom: picture.height } };
        fit();
    });

    return {
        /** The picture and what of it is ink. */
        get shown() {
            return picture && { picture, choice };
        },

        /** Shows a picture, or none. @param {Grey | null} next */
        set(next) {
            picture = next;
            if (!next) return;
            choice = { ...choice, crop: { left: 0, top: 0, right: next.width, bottom: next.height } };
            fit();
        },

        /** @param {HTMLCanvasElement} copy */
        copyTo(copy) {
            [copy.width, copy.height] = [canvas.width, canvas.height];
            copy.getContext('2d')?.drawImage(canvas, 0, 0);
        },

        /** Paints the preview again, in the present theme. */
        repaint: showSoon,
    };
}

/** The numbers of a colour as browsers compute it, `rgb(1, 2, 3)`. @param {string} colour */
const rgbOf = (colour) => (colour.match(/[\d.]+/g) ?? []).slice(0, 3).map(Number);
