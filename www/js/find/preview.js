/** The preview of a picture: its ink, the crop with corners to drag or to move by keys, and the threshold. */

import { button, byId, html, input, make, setText } from '../base/dom.js';
import { say } from '../base/words.js';
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

/**
 * The preview and the choice.
 * @typedef {object} Cropping
 * @property {() => void} changed
 * @property {HTMLElement} frame
 * @property {HTMLCanvasElement} canvas
 * @property {HTMLElement} box
 * @property {HTMLInputElement} slider
 * @property {HTMLSelectElement} kind
 * @property {Grey | null} picture
 * @property {Choice} choice
 * @property {boolean} waits
 * @property {{handle: HTMLButtonElement, corner: Corner, name: string}[]} handles
 */

/** @param {{changed: () => void}} dialog */
export function createPreview({ changed }) {
    /** @type {Cropping} */
    const self = {
        changed,
        frame: html('find-frame'),
        canvas: byId('find-preview', HTMLCanvasElement),
        box: html('find-crop'),
        slider: input('find-level'),
        kind: byId('find-ink', HTMLSelectElement),
        picture: null,
        choice: { crop: { left: 0, top: 0, right: 0, bottom: 0 }, level: 127, isDark: true },
        waits: false,
        handles: [],
    };

    self.handles.push(...CORNERS.map(([corner, name]) => newHandle(self, corner, name)));
    self.slider.addEventListener('input', () => {
        self.choice = { ...self.choice, level: Number(self.slider.value) };
        edited(self);
    });
    self.kind.addEventListener('change', () => {
        self.choice = { ...self.choice, isDark: self.kind.value === 'dark' };
        edited(self);
    });
    button('find-whole').addEventListener('click', () => setPicture(self, self.picture));

    return {
        /** The picture and what of it is ink. */
        get shown() {
            return self.picture && { picture: self.picture, choice: self.choice };
        },

        /** Shows a picture, or none. @param {Grey | null} next */
        set: (next) => setPicture(self, next),

        /** @param {HTMLCanvasElement} copy */
        copyTo(copy) {
            [copy.width, copy.height] = [self.canvas.width, self.canvas.height];
            copy.getContext('2d')?.drawImage(self.canvas, 0, 0);
        },

        /** Paints the preview again, in the present theme. */
        repaint: () => showSoon(self),
    };
}

/** @param {Cropping} self @param {Corner} corner @param {string} name */
function newHandle(self, corner, name) {
    const handle = make('button', { class: `find-corner ${corner.join(' ')}` });
    handle.addEventListener('keydown', (event) => {
        const arrow = ARROWS[event.key];
        if (!arrow || !self.picture) return;
        event.preventDefault();
        const step = Math.max(1, STEP * (event.shiftKey ? 10 : 1) * Math.max(self.picture.width, self.picture.height));
        move(
            self,
            corner,
            self.choice.crop[corner[1]] + arrow[0] * step,
            self.choice.crop[corner[0]] + arrow[1] * step,
        );
    });
    handle.addEventListener('pointerdown', (event) => {
        if (event.button !== 0) return;
        event.preventDefault();
        handle.focus();
        handle.setPointerCapture(event.pointerId);
    });
    handle.addEventListener('pointermove', (event) => {
        if (!self.picture || !handle.hasPointerCapture(event.pointerId)) return;
        const { left, top, width, height } = self.canvas.getBoundingClientRect();
        move(
            self,
            corner,
            ((event.clientX - left) / width) * self.picture.width,
            ((event.clientY - top) / height) * self.picture.height,
        );
    });
    self.box.append(handle);
    return { handle, corner, name };
}

/** @param {Cropping} self @param {Corner} corner @param {number} x @param {number} y */
function move(self, corner, x, y) {
    if (!self.picture) return;
    self.choice = { ...self.choice, crop: withCorner(self.choice.crop, corner, x, y, self.picture) };
    edited(self);
}

/** @param {Cropping} self */
function edited(self) {
    showSoon(self);
    self.changed();
}

/** @param {Cropping} self */
function showSoon(self) {
    if (self.waits) return;
    self.waits = true;
    requestAnimationFrame(() => {
        self.waits = false;
        show(self);
    });
}

/** @param {Cropping} self */
function show(self) {
    if (!self.picture) return;
    const { width, height } = self.picture;
    const scale = Math.min(1, SIDE / Math.max(width, height));
    const [wide, high] = [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
    if (self.canvas.width !== wide || self.canvas.height !== high)
        [self.canvas.width, self.canvas.height] = [wide, high];
    const style = getComputedStyle(self.frame);
    const [ink, paper] = [rgbOf(style.color), rgbOf(style.backgroundColor)];
    const map = inkMap(self.picture, self.choice, wide, high);
    const pixels = new ImageData(wide, high);
    for (let at = 0; at < map.length; at++) {
        const share = (map[at] ?? 0) / 255;
        for (let channel = 0; channel < 3; channel++)
            pixels.data[4 * at + channel] = (ink[channel] ?? 0) * share + (paper[channel] ?? 0) * (1 - share);
        pixels.data[4 * at + 3] = 255;
    }
    self.canvas.getContext('2d')?.putImageData(pixels, 0, 0);
    self.frame.style.aspectRatio = `${width} / ${height}`;
    self.frame.style.setProperty('--ratio', String(width / height));
    const { left, top, right, bottom } = self.choice.crop;
    const percent = (/** @type {number} */ part) => `${100 * part}%`;
    Object.assign(self.box.style, {
        left: percent(left / width),
        top: percent(top / height),
        right: percent(1 - right / width),
        bottom: percent(1 - bottom / height),
    });
    for (const {
        handle,
        corner: [end, side],
        name,
    } of self.handles) {
        const whole = (/** @type {number} */ part) => `${Math.round(100 * part)} %`;
        handle.setAttribute(
            'aria-label',
            say`${name} corner of the crop: ${whole(self.choice.crop[side] / width)} from the left, ${whole(self.choice.crop[end] / height)} from the top. Arrow keys move it.`,
        );
    }
    self.slider.value = String(self.choice.level);
    self.slider.style.setProperty('--at', String(self.choice.level / 254));
    self.kind.value = self.choice.isDark ? 'dark' : 'light';
    const share = inkShare(self.picture, self.choice);
    setText(
        html('find-ink-note'),
        share === 0
            ? say`Nothing is ink here. Move the threshold.`
            : share > 0.5
              ? say`${Math.round(100 * share)} % of the picture is ink. Lines cover less: move the threshold, or take the other kind of lines.`
              : '',
    );
}

/** Takes the threshold and the kind of lines that fit the crop. @param {Cropping} self */
function fit(self) {
    if (!self.picture) return;
    const level = levelOf(self.picture, self.choice.crop);
    self.choice = { ...self.choice, level, isDark: darkIsLess(self.picture, self.choice.crop, level) };
    edited(self);
}

/** @param {Cropping} self @param {Grey | null} next */
function setPicture(self, next) {
    self.picture = next;
    if (!next) return;
    self.choice = { ...self.choice, crop: { left: 0, top: 0, right: next.width, bottom: next.height } };
    fit(self);
}

/** The numbers of a colour as browsers compute it, `rgb(1, 2, 3)`. @param {string} colour */
const rgbOf = (colour) => (colour.match(/[\d.]+/g) ?? []).slice(0, 3).map(Number);
