/** The picture to find, and its differences from the own drawing. */

import { COLOURS, SIDE } from '../base/differences.js';
import { byId, html, input, reducedMotion, setText } from '../base/dom.js';
import { say } from '../base/words.js';

/** A blinking picture changes after this time, in milliseconds. */
const BLINK = 700;
/** Larger device pixel ratios do not show. */
const MAX_RATIO = 2;

/**
 * The picture of the target.
 * @typedef {object} Target
 * @property {(width: number, height: number, ratio: number) => Promise<Uint8ClampedArray<ArrayBuffer>>} picture
 * @property {HTMLElement} pane
 * @property {HTMLCanvasElement} canvas
 * @property {HTMLCanvasElement} compared
 * @property {HTMLInputElement[]} modes
 * @property {Uint8Array | null} pixels The differences from the last marked answer
 * @property {boolean} isDark
 * @property {boolean} shownOwn
 * @property {number} timer
 * @property {number} turn
 */

/**
 * @param {{picture: (width: number, height: number, ratio: number) => Promise<Uint8ClampedArray<ArrayBuffer>>}} source
 */
export function createTarget({ picture }) {
    /** @type {Target} */
    const self = {
        picture,
        pane: html('target'),
        canvas: byId('target-picture', HTMLCanvasElement),
        compared: byId('target-differences', HTMLCanvasElement),
        modes: ['target', 'differences', 'blink'].map((mode) => input(`show-${mode}`)),
        pixels: null,
        isDark: false,
        shownOwn: false,
        timer: 0,
        turn: 0,
    };

    for (const choice of self.modes) choice.addEventListener('change', () => show(self));
    // Without motion, a click changes the blinking picture.
    self.compared.addEventListener('click', () => {
        if (mode(self) !== 'blink') return;
        self.shownOwn = !self.shownOwn;
        show(self);
    });
    document.addEventListener('visibilitychange', () => show(self));
    new ResizeObserver(() => void paint(self)).observe(self.pane);

    return {
        /** @param {Uint8Array} made 512 by 512: 1 for ink of both, 2 for missing ink, 4 for ink that is too much */
        compare(made) {
            self.pixels = made;
            show(self);
        },
        /** @param {boolean} dark */
        setDark(dark) {
            self.isDark = dark;
            self.pane.classList.toggle('on-dark', dark);
            show(self);
        },
    };
}

/** @param {Target} self */
const mode = (self) => self.modes.find(({ checked }) => checked)?.value ?? 'target';

/** @param {Target} self */
async function paint(self) {
    const own = ++self.turn;
    const ratio = Math.min(MAX_RATIO, devicePixelRatio || 1);
    const [width, height] = [self.pane.clientWidth, self.pane.clientHeight].map((side) =>
        Math.max(1, Math.round(side * ratio)),
    );
    if (!width || !height || self.pane.clientWidth < 2) return;
    const made = await self.picture(width, height, ratio).catch(() => null);
    if (!made || own !== self.turn || made.length !== 4 * width * height) return;
    [self.canvas.width, self.canvas.height] = [width, height];
    self.canvas.getContext('2d')?.putImageData(new ImageData(made, width, height), 0, 0);
}

/** @param {Target} self */
function show(self) {
    const now = mode(self);
    const differs = now !== 'target';
    self.compared.hidden = !differs || self.pixels === null;
    html('target-legend').hidden = now !== 'differences' || self.pixels === null;
    setText(
        html('target-name'),
        now === 'differences' ? say`Differences` : now === 'blink' && self.shownOwn ? say`Yours` : say`Target`,
    );
    if (differs && self.pixels) paintDifferences(self, self.pixels, now === 'blink');
    clearTimeout(self.timer);
    if (now === 'blink' && !reducedMotion() && document.visibilityState === 'visible') {
        self.timer = window.setTimeout(() => {
            self.shownOwn = !self.shownOwn;
            show(self);
        }, BLINK);
    }
}

/** @param {Target} self @param {Uint8Array} pixels @param {boolean} blinks */
function paintDifferences(self, pixels, blinks) {
    const colours = COLOURS[self.isDark ? 'dark' : 'light'];
    const ink = self.isDark ? /** @type {const} */ ([235, 235, 225]) : /** @type {const} */ ([30, 34, 28]);
    const image = new ImageData(SIDE, SIDE);
    for (const [at, value] of pixels.entries()) {
        if (value === 0) continue;
        const shown = !blinks || (self.shownOwn ? value !== 2 : value !== 4);
        const colour = blinks ? ink : colours[value >> 1];
        if (!shown || !colour) continue;
        image.data.set([...colour, 255], 4 * at);
    }
    self.compared.getContext('2d')?.putImageData(image, 0, 0);
}
