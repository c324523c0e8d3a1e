/** The four pictures of the assignment, to try the search with one click. */

import { make } from '../base/dom.js';
import { jsonOf } from '../base/files.js';
import { clean, definitionOf } from '../state/state.js';
import { emptyThumb, paintThumb } from '../dialogs/thumb.js';
import { say } from '../base/words.js';
import { pixelsOf } from './picture.js';

/** @typedef {import('../state/state.js').Definition} Definition */
/** @typedef {import('./ink.js').Grey} Grey */

/** The systems by their paths in the gallery, with their names here. */
const EXAMPLES = {
    left_plant: say`Left plant`,
    crossout: say`Crossout`,
    hexerode: say`Hexerode`,
    flower_plant: say`Flower plant`,
};
/** The side of a small picture, in CSS pixels, and of a picture to search, in pixels. */
const SIDE = 96;
const SEARCHED = 768;

/** A definition as black lines on white. @param {Definition} definition @returns {Definition} */
export const blackOnWhite = (definition) => ({
    ...definition,
    palette: ['#000000'],
    background: '#ffffff',
    colourBy: 'single',
    ink: 'solid',
    width: 0,
    widthFactor: 1,
    minWidth: 1,
    hue: 0,
});

/**
 * The picture of a system to search; throws a sentence if it cannot be drawn.
 * @param {import('../engine/engine.js').Engine} engine @param {Definition} definition @returns {Promise<Grey>}
 */
export async function pictureOf(engine, definition) {
    const { bitmap, missing } = await engine.thumb(blackOnWhite(definition), SEARCHED, SEARCHED);
    if (!bitmap) throw new Error(missing ?? say`There is no picture.`);
    const grey = pixelsOf(bitmap, bitmap.width, bitmap.height);
    bitmap.close();
    return grey;
}

/**
 * Fills a row with the examples.
 * @param {HTMLElement} row
 * @param {import('../engine/engine.js').Engine} engine
 * @param {{restyle: (definition: Definition) => Definition, choose: (definition: Definition) => void}} page
 */
export async function fillExamples(row, engine, { restyle, choose }) {
    /** @type {import('../dialogs/shelves.js').Entry[]} */
    const entries = await jsonOf('gallery.json');
    for (const [name, label] of Object.entries(EXAMPLES)) {
        const entry = entries.find(({ path }) => path.replace(/\.json$/, '') === `assignment-8/${name}`);
        if (!entry) continue;
        const definition = definitionOf(clean(entry.definition));
        const picture = emptyThumb();
        const card = make(
            'button',
            { class: 'card', 'data-example': name },
            picture,
            make('span', { class: 'card-title' }, label),
        );
        const styled = restyle(definition);
        picture.style.background = styled.background;
        card.addEventListener('click', () => choose(definition));
        row.append(card);
        paintThumb(picture, engine, styled, SIDE).catch(() => {});
    }
}
