/** The picture to find, and its differences from the own drawing. */

import { COLOURS, SIDE } from '../differences.js';
import { byId, html, input, reducedMotion, setText } from '../dom.js';
import { say } from '../words.js';

/** A blinking picture changes after this time, in milliseconds. */
const BLINK = 700;
/** Larger device pixel ratios do not show. */
const MAX_RATIO = 2;

/**
 * @param {{picture: (width: number, height: number, ratio: number) => Promise<Uint8ClampedArray<ArrayBuffer>>}} source
 */
export function createTarget({ picture }) {
    const pane = html('target');
    const canvas = byId('target-picture', HTMLCanvasElement);
    const compared = byId('target-differences', HTMLCanvasElement);
    const modes = ['target', 'differences', 'blink'].map((mode) => input(`show-${mode}`));
    /** The differences from the last marked answer. @type {Uint8Array | null} */
    let pixels = null;
    let isDark = false;
    let shownOwn = false;
    let timer = 0;
    let turn = 0;

    const mode = () => modes.find(({ checked }) => checked)?.value ?? 'target';

    async function paint() {
        const own = ++turn;
        const ratio = Math.min(MAX_RATIO, devicePixelRatio || 1);
        const [width, height] = [pane.clientWidth, pane.clientHeight].map((side) =>
            Math.max(1, Math.round(side * ratio)),
        );
        if (!width || !height || pane.clientWidth < 2) return;
        const made = await picture(width, height, ratio).catch(() => null);
        if (!made || own !== turn || made.length !== 4 * width * height) return;
        [canvas.width, canvas.height] = [width, height];
        canvas.getContext('2d')?.putImageData(new ImageData(made, width, height), 0, 0);
    }

    function show() {
        const now = mode();
        const differs = now !== 'target';
        compared.hidden = !differs || pixels === null;
        html('target-legend').hidden = now !== 'differences' || pixels === null;
        setText(
            html('target-name'),
            now === 'differences' ? say`Differences` : now === 'blink' && shownOwn ? say`Yours` : say`Target`,
        );
        if (differs && pixels) paintDifferences(pixels, now === 'blink');
        clearTimeout(timer);
        if (now === 'blink' && !reducedMotion() && document.visibilityState === 'visible') {
            timer = window.setTimeout(() => {
                shownOwn = !shownOwn;
                show();
            }, BLINK);
        }
    }

    /** @param {Uint8Array} pixels @param {boolean} blinks */
    function paintDifferences(pixels, blinks) {
        const colours = COLOURS[isDark ? 'dark' : 'light'];
        const ink = isDark ? /** @type {const} */ ([235, 235, 225]) : /** @type {const} */ ([30, 34, 28]);
        const image = new ImageData(SIDE, SIDE);
        for (const [at, value] of pixels.entries()) {
            if (value === 0) continue;
            const shown = !blinks || (shownOwn ? value !== 2 : value !== 4);
            const colour = blinks ? ink : colours[value >> 1];
            if (!shown || !colour) continue;
            image.data.set([...colour, 255], 4 * at);
        }
        compared.getContext('2d')?.putImageData(image, 0, 0);
    }

    for (const choice of modes) choice.addEventListener('change', show);
    // Without motion, a click changes the blinking picture.
    compared.addEventListener('click', () => {
        if (mode() !== 'blink') return;
        shownOwn = !shownOwn;
        show();
    });
    document.addEventListener('visibilitychange', show);
    new ResizeObserver(() => void paint()).observe(pane);

    return {
        /** @param {Uint8Array} made 512 by 512: 1 for ink of both, 2 for missing ink, 4 for ink that is too much */
        compare(made) {
            pixels = made;
            show();
        },
        /** @param {boolean} dark */
        setDark(dark) {
            isDark = dark;
            pane.classList.toggle('on-dark', dark);
            show();
        },
    };
}
