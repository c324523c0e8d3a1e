/** The Look section: colours and strokes. */

import { button, byId, html, input, make, setChoice, setText } from '../dom.js';
import { numberField } from '../controls/number-field.js';
import { SCHEMES, hasScheme, schemePatch } from '../colour-schemes.js';
import { maxLengthOf, rangeOf } from '../state.js';
import { say } from '../words.js';

/** @type {Record<import('../state.js').ColourBy, string>} */
const NOTES = {
    symbol: '',
    level: say`First colour for the stem, next colour for its branches, and so on.`,
    generation: say`Colour by the iteration that made a symbol. A symbol that a rule copies keeps its generation.`,
    path: say`A gradient of all colours, from the first segment to the last.`,
    turn: say`First colour at the start, other colours after turns. Each branch restores the colour before it.`,
    density: say`Where ink adds up: a gradient of all colours, from the least ink to the most.`,
    single: '',
};

/** @param {import('../store.js').Store} store */
export function lookPanel(store) {
    const settle = () => store.settle();
    const wells = html('wells');

    const schemes = SCHEMES.map((scheme) => {
        const swatch = make('span', { class: 'swatch', 'aria-hidden': 'true' });
        swatch.style.background = scheme.background;
        for (const colour of scheme.palette.slice(0, 5)) {
            const stripe = make('i');
            stripe.style.background = colour;
            swatch.append(stripe);
        }
        const chip = make(
            'button',
            { type: 'button', class: 'ink', 'aria-pressed': 'false' },
            swatch,
            make('span', {}, scheme.name),
        );
        chip.addEventListener('click', () => store.change(schemePatch(scheme), ''));
        html('inks').append(chip);
        return { scheme, chip };
    });

    const inkKind = byId('ink', HTMLSelectElement);
    inkKind.addEventListener('change', () => {
        store.change({ ink: /** @type {import('../state.js').Ink} */ (inkKind.value) }, '');
    });
    let space = false;

    /** @param {import('../state.js').State} state */
    const showInk = (state) => {
        const isDensity = state.ink === 'density';
        const adds = isDensity || (state.ink !== 'solid' && !space);
        setChoice(inkKind, space && !isDensity ? 'solid' : state.ink);
        for (const option of inkKind.options) if (option.value === 'auto') option.disabled = space;
        html('exposure-row').hidden = !adds;
        html('shadows-row').hidden = !space || isDensity;
        html('shapes-row').hidden = !/^\s*shape\s/m.test(state.rules);
        setText(
            html('ink-note'),
            isDensity
                ? space
                    ? say`Overlapping strokes add up, and nothing is hidden. PNG pictures keep this; SVG files are opaque.`
                    : say`Overlapping strokes add up. PNG pictures keep this; SVG files are opaque.`
                : space
                  ? ''
                  : adds
                    ? say`Opaque, but strokes finer than a pixel add up. SVG files are opaque.`
                    : '',
        );
        for (const option of colourBy.options)
            if (option.value === 'density') option.disabled = !adds && state.colourBy !== 'density';
    };

    const colourBy = byId('colour-by', HTMLSelectElement);
    colourBy.addEventListener('change', () => {
        store.change({ colourBy: /** @type {import('../state.js').ColourBy} */ (colourBy.value) }, '');
    });
    const flags = /** @type {[HTMLInputElement, 'paletteHolds' | 'tapers' | 'shadows' | 'shapes'][]} */ ([
        [input('palette-holds'), 'paletteHolds'],
        [input('tapers'), 'tapers'],
        [input('shadows'), 'shadows'],
        [input('shapes'), 'shapes'],
    ]);
    for (const [box, name] of flags) box.addEventListener('change', () => store.change({ [name]: box.checked }, ''));
    const turnFields = ['left-colour', 'right-colour'].map((id, side) =>
        numberField(input(id), {
            low: 1,
            high: rangeOf('turnColours').high + 1,
            expected: say`a whole number above 0`,
            step: 1,
            whole: true,
            settle,
            change: (value) => {
                const [left, right] = store.state.turnColours;
                store.change({ turnColours: side === 0 ? [value - 1, right] : [left, value - 1] }, id);
            },
        }),
    );
    const auto = input('auto-look');
    /** What an automatic look chose. @type {import('../engine.js').Report['look']} */
    let chosen = null;
    auto.addEventListener('change', () => {
        const { words: _, ...values } = chosen ?? { words: '' };
        // The values chosen are the start of an own look.
        store.change(/** @type {Partial<import('../state.js').State>} */ ({ ...values, auto: auto.checked }), '');
    });
    const background = input('background');
    background.addEventListener('input', () => store.change({ background: background.value }, 'background'));
    background.addEventListener('change', settle);

    button('add-colour').addEventListener('click', () => {
        const { palette } = store.state;
        store.change({ palette: [...palette, /** @type {string} */ (palette.at(-1))] }, '');
    });
    button('remove-colour').addEventListener('click', () => {
        if (store.state.palette.length > 1) store.change({ palette: store.state.palette.slice(0, -1) }, '');
    });

    /** @param {number} index */
    function newWell(index) {
        const well = make('input', {
            type: 'color',
            class: 'well',
            'aria-label': say`Colour ${index + 1}`,
            title: say`Colour ${index + 1}`,
        });
        well.addEventListener('input', () => {
            store.change(
                { palette: store.state.palette.map((colour, at) => (at === index ? well.value : colour)) },
                `palette ${index}`,
            );
        });
        well.addEventListener('change', settle);
        return well;
    }

    return {
        /** @param {import('../engine.js').Report} report @param {import('../state.js').State} state */
        report(report, state) {
            space = report.space;
            chosen = report.look;
            setText(html('auto-note'), state.auto ? (chosen?.words ?? '') : '');
            showInk(state);
        },
        /** @param {import('../state.js').State} state */
        show(state) {
            showInk(state);
            while (wells.childElementCount > state.palette.length) wells.lastElementChild?.remove();
            while (wells.childElementCount < state.palette.length) wells.append(newWell(wells.childElementCount));
            state.palette.forEach((colour, at) => {
                const well = wells.children[at];
                if (well instanceof HTMLInputElement && well.value !== colour) well.value = colour;
            });
            button('remove-colour').disabled = state.palette.length === 1;
            button('add-colour').disabled = state.palette.length >= maxLengthOf('palette');
            for (const { scheme, chip } of schemes) chip.setAttribute('aria-pressed', String(hasScheme(state, scheme)));
            auto.checked = state.auto;
            html('own-look').hidden = state.auto;
            setChoice(colourBy, state.colourBy);
            for (const [box, name] of flags) box.checked = state[name];
            html('holds-row').hidden = state.colourBy !== 'level' && state.colourBy !== 'generation';
            html('turns-row').hidden = state.colourBy !== 'turn';
            turnFields.forEach((field, side) => field(/** @type {number} */ (state.turnColours[side]) + 1));
            setText(html('colour-note'), NOTES[state.colourBy]);
            if (background.value !== state.background) background.value = state.background;
        },
    };
}
