/** The exercises of the gallery: cards that open an exercise in a window of its own. */

import { make } from '../base/dom.js';
import { emptyThumb } from '../dialogs/thumb.js';
import { said, say } from '../base/words.js';
import { GROUPS } from './published.js';
import { courseTool } from './tool.js';

/** @typedef {import('./published.js').Entry} Entry */

/** The shelf's name, and its filter. */
export const EXERCISES = say`Exercises`;

/** @param {Entry} entry */
export function exerciseCard({ title, shelf, text, x }) {
    const picture = emptyThumb();
    const missing = make('code', { class: 'card-missing', hidden: text === null }, text ?? '');
    const card = make(
        'a',
        { class: 'card', href: `exercise.html#v=1&x=${x}`, target: '_blank', rel: 'noopener' },
        make('span', { class: 'card-picture' }, picture, missing),
        make('span', { class: 'card-title' }, said(title)),
        make('span', { class: 'card-kind' }, GROUPS[shelf] ?? ''),
    );
    return { card, picture, missing };
}

/**
 * Draws the target of an exercise.
 * @param {HTMLCanvasElement} picture
 * @param {string} x
 * @param {number} side in CSS pixels
 */
export async function paintExercise(picture, x, side) {
    const pixels = Math.round(side * Math.min(2, devicePixelRatio || 1));
    const made = await courseTool.call('picture', { text: x, width: pixels, height: pixels, ratio: pixels / side });
    [picture.width, picture.height] = [pixels, pixels];
    picture.getContext('2d')?.putImageData(new ImageData(new Uint8ClampedArray(made.buffer), pixels, pixels), 0, 0);
    picture.classList.add('inked');
}
