/** Colours and strokes. */

import { button, byId, html, input, make, setChoice, setText } from '../dom.js';
import { FACTOR, dial } from '../controls/dial.js';
import { numberField } from '../controls/number-field.js';
import { even } from '../controls/slider.js';
import { INKS, hasInk, wearing } from '../inks.js';
import { plain } from '../numerals.js';
import { COLOUR_BY, INK, MAX_EXPOSURE, MAX_PALETTE } from '../state.js';

const WIDTHS = [...even(0, 1, 0.05), ...even(1.1, 3, 0.1), ...even(3.25, 10, 0.25), ...even(10.5, 20, 0.5)];
/** @type {Record<import('../state.js').ColourBy, string>} */
const NOTES = {
    symbol: '',
    level: 'The first colour for the stem, the next for its branches, and so on.',
    generation: 'By the iteration that made a symbol. A symbol that a rule puts in its own place stays as old as it was.',
    path: 'All colours as a gradient, from the first segment to the last.',
    turn: 'The first colour at the start, others after turns. A branch ends in the colour it began with.',
    density: 'Where ink adds up: all colours as a gradient, from the least ink to the most.',
    single: '',
};
const THIN = even(0, 8, 0.25);
const STOPS = even(-4, 4, 0.25);

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
        chip.addEventListener('click', () => store.change(wearing(ink), ''));
        html('inks').append(chip);
        return { ink, chip };
    });

    const inkKind = byId('ink', HTMLSelectElement);
    inkKind.addEventListener('change', () => {
        const chosen = INK.find((name) => name === inkKind.value);
        if (chosen) store.change({ ink: chosen }, '');
    });
    const exposure = dial(store, 'exposure', 'exposure', { stops: STOPS, text: (value) => `${plain(value)} stops`, low: -MAX_EXPOSURE, high: MAX_EXPOSURE, step: 0.25 });
    let solid = false;
    /** @param {import('../state.js').State} state */
    const showInk = (state) => {
        const adds = state.ink === 'density' && !solid;
        setChoice(inkKind, solid ? 'solid' : state.ink);
        inkKind.disabled = solid;
        html('exposure-row').hidden = !adds;
        setText(html('ink-note'), solid ? 'Drawings in space have ink that covers.' : adds ? 'Strokes that lie upon each other show as more ink. Pictures (PNG) have it; SVG files have ink that covers.' : '');
        for (const option of colourBy.options) if (option.value === 'density') option.disabled = !adds && state.colourBy !== 'density';
    };

    const colourBy = byId('colour-by', HTMLSelectElement);
    colourBy.addEventListener('change', () => {
        const chosen = COLOUR_BY.find((name) => name === colourBy.value);
        if (chosen) store.change({ colourBy: chosen }, '');
    });
    const holds = input('palette-holds');
    holds.addEventListener('change', () => store.change({ paletteHolds: holds.checked }, ''));
    const turnFields = ['left-colour', 'right-colour'].map((id, side) =>
        numberField(input(id), {
            low: 1,
            high: MAX_PALETTE,
            step: 1,
            whole: true,
            settle,
            change: (value) => {
                const [left, right] = store.state.turnColours;
                store.change({ turnColours: side === 0 ? [value - 1, right] : [left, value - 1] }, id);
            },
        }),
    );
    const background = input('background');
    background.addEventListener('input', () => store.change({ background: background.value }, 'background'));
    background.addEventListener('change', settle);

    const width = dial(store, 'width', 'width', { stops: WIDTHS, text: (value) => `${plain(value)} steps`, low: 0, high: 1000, step: 0.1 });
    const widthFactor = dial(store, 'widthFactor', 'width-factor', FACTOR);
    const thin = dial(store, 'minWidth', 'thin', { stops: THIN, text: (value) => `${plain(value)} pixels`, low: 0, high: 100, step: 0.5 });

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
        /** @param {import('../engine.js').Report} report @param {import('../state.js').State} state */
        report(report, state) {
            solid = report.solid;
            showInk(state);
        },
        /** @param {import('../state.js').State} state */
        show(state) {
            showInk(state);
            exposure.show(state.exposure);
            while (wells.childElementCount > state.palette.length) wells.lastElementChild?.remove();
            while (wells.childElementCount < state.palette.length) wells.append(newWell(wells.childElementCount));
            state.palette.forEach((colour, at) => {
                const well = wells.children[at];
                if (well instanceof HTMLInputElement && well.value !== colour) well.value = colour;
            });
            button('remove-colour').disabled = state.palette.length === 1;
            button('add-colour').disabled = state.palette.length >= MAX_PALETTE;
            for (const { ink, chip } of inks) chip.setAttribute('aria-pressed', String(hasInk(state, ink)));
            setChoice(colourBy, state.colourBy);
            holds.checked = state.paletteHolds;
            html('holds-row').hidden = state.colourBy !== 'level' && state.colourBy !== 'generation';
            html('turns-row').hidden = state.colourBy !== 'turn';
            turnFields.forEach((field, side) => field(/** @type {number} */ (state.turnColours[side]) + 1));
            setText(html('colour-note'), NOTES[state.colourBy]);
            if (background.value !== state.background) background.value = state.background;
            width.show(state.width);
            widthFactor.show(state.widthFactor);
            thin.show(state.minWidth);
        },
    };
}
