/** Leaves for the shown system: five outlines as pictures, each a press. */

import styles from '../../css/leaves.css';
import { html, make } from '../base/dom.js';
import { addElements } from '../base/late.js';
import { DEFAULTS, definitionOf } from '../state/state.js';
import { GREEN, withLeaves } from '../state/leaves.js';
import { say } from '../base/words.js';
import markup from './leaves.html';
import { emptyThumb, paintThumb } from './thumb.js';

/** The outlines (docs/notation.md). */
const SHAPES = { heart: say`Heart`, lance: say`Lance`, oak: say`Oak`, petal: say`Petal`, needle: say`Needle` };
const SIDE = 44;

/** @param {import('./dialogs.js').Page} page */
export function createLeaves({ store, engine }) {
    const acts = Object.entries(SHAPES).map(([shape, words]) => {
        const picture = emptyThumb();
        const act = make('button', { class: 'button leaf', type: 'button' }, picture, words);
        act.addEventListener('click', () => store.change(withLeaves(store.state, shape), ''));
        const leaf = { ...definitionOf(DEFAULTS), axiom: 'L', overrides: `L: leaf ${shape} 1`, palette: [GREEN] };
        void paintThumb(picture, engine, { ...leaf, background: '#ffffff' }, SIDE).catch(() => {});
        return act;
    });
    addElements(markup, [styles], html('leaves'));
    html('leaf-acts').append(...acts);
    return { open() {} };
}
