/** Colours and strokes. */

import { button, byId, html, input, make } from '../dom.js';
import { even, slider } from '../controls/slider.js';
import { numberField } from '../controls/number-field.js';
import { INKS, hasInk } from '../inks.js';
import { plain } from '../numerals.js';
import { COLOUR_BY, MAX_PALETTE } from '../state.js';

const WIDTHS = [...even(0, 1, 0.05), ...even(1.1, 3, 0.1), ...even(3.25, 10, 0.25), ...even(10.5, 20, 0.5)];
const THIN = even(0, 8, 0.25);

/** @param {import('../store.js').Store} store */
export function lookPanel(store) {
    const settle = () => store.settle();
    const wells = html('wells');

    const inks = INKS.map((ink) => {
        const swatch = make('span', { class: 'swatch', 'aria-hidden': 'true' });
        swatch.style.background = ink.background;
        for (const colour of ink.palette.slice(0, 5)) {
            const stripe = make('i');
            stripe.style.background = colour;
            swatch.append(stripe);
        }
        const chip = make('button', { type: 'button', class: 'ink', 'aria-pressed': 'false' }, swatch, make('span', {}, ink.name));
        chip.addEventListener('click', () => store.change({ palette: [...ink.palette], background: ink.background }, ''));
        html('inks').append(chip);
        return { ink, chip };
    });

    const colourBy = byId('colour-by', HTMLSelectElement);
    colourBy.addEventListener('change', () => {
        const chosen = COLOUR_BY.find((name) => name === colourBy.value);
        if (chosen) store.change({ colourBy: chosen }, '');
    });
    const background = input('background');
    background.addEventListener('input', () => store.change({ background: background.value }, 'background'));
    background.addEventListener('change', settle);

    const width = { settle, change: (/** @type {number} */ value, held = false) => store.change({ width: value }, held ? 'drag width' : 'width') };
    const thin = { settle, change: (/** @type {number} */ value, held = false) => store.change({ minWidth: value }, held ? 'drag minWidth' : 'minWidth') };
    const widthSlider = slider(input('width-slider'), { stops: WIDTHS, text: (value) => `${plain(value)} steps`, ...width });
    const showWidth = numberField(input('width'), { low: 0, high: 1000, step: 0.1, ...width });
    const thinSlider = slider(input('thin-slider'), { stops: THIN, text: (value) => `${plain(value)} pixels`, ...thin });
    const showThin = numberField(input('thin'), { low: 0, high: 100, step: 0.5, ...thin });

    button('add-colour').addEventListener('click', () => {
        const { palette } = store.state;
        store.change({ palette: [...palette, /** @type {string} */ (palette.at(-1))] }, '');
    });
    button('remove-colour').addEventListener('click', () => {
        if (store.state.palette.length > 1) store.change({ palette: store.state.palette.slice(0, -1) }, '');
    });

    /** @param {number} index */
    function newWell(index) {
        const well = make('input', { type: 'color', class: 'well', 'aria-label': `Colour ${index + 1}`, title: `Colour ${index + 1}` });
        well.addEventListener('input', () => {
            store.change({ palette: store.state.palette.map((colour, at) => (at === index ? well.value : colour)) }, `palette ${index}`);
        });
        well.addEventListener('change', settle);
        return well;
    }

    return {
        /** @param {import('../state.js').State} state */
        show(state) {
            while (wells.childElementCount > state.palette.length) wells.lastElementChild?.remove();
            while (wells.childElementCount < state.palette.length) wells.append(newWell(wells.childElementCount));
            state.palette.forEach((colour, at) => {
                const well = wells.children[at];
                if (well instanceof HTMLInputElement && well.value !== colour) well.value = colour;
            });
            button('remove-colour').disabled = state.palette.length === 1;
            button('add-colour').disabled = state.palette.length >= MAX_PALETTE;
            for (const { ink, chip } of inks) chip.setAttribute('aria-pressed', String(hasInk(state, ink)));
            colourBy.value = state.colourBy;
            if (background.value !== state.background) background.value = state.background;
            widthSlider.show(state.width);
            showWidth(state.width);
            thinSlider.show(state.minWidth);
            showThin(state.minWidth);
        },
    };
}
