/** The Look section: colours and strokes. */

import { button, byId, html, input, make, setChoice, setText } from '../base/dom.js';
import { numberField } from '../controls/number-field.js';
import { SCHEMES, hasScheme, schemePatch } from '../state/colour-schemes.js';
import { maxLengthOf, rangeOf } from '../state/state.js';
import { COLOURINGS } from '../tables.js';
import { said, say } from '../base/words.js';

/**
 * The fields and the last report.
 * @typedef {object} Look
 * @property {import('../state/store.js').Store} store
 * @property {HTMLElement} wells
 * @property {{scheme: typeof SCHEMES[number], chip: HTMLButtonElement}[]} schemes
 * @property {HTMLSelectElement} inkKind
 * @property {boolean} space
 * @property {HTMLSelectElement} colourBy
 * @property {[HTMLInputElement, 'paletteHolds' | 'tapers' | 'shadows' | 'shapes'][]} flags
 * @property {((value: number) => void)[]} turnFields
 * @property {HTMLInputElement} auto
 * @property {HTMLInputElement} background
 */

/** @param {import('../state/store.js').Store} store */
export function lookPanel(store) {
    const inkKind = byId('ink', HTMLSelectElement);
    inkKind.addEventListener('change', () => {
        store.change({ ink: /** @type {import('../state/state.js').Ink} */ (inkKind.value) }, '');
    });

    const colourBy = byId('colour-by', HTMLSelectElement);
    for (const [value, { label }] of Object.entries(COLOURINGS))
        colourBy.append(make('option', { value }, said(label)));
    colourBy.addEventListener('change', () => {
        store.change({ colourBy: /** @type {import('../state/state.js').ColourBy} */ (colourBy.value) }, '');
    });
    const flags = /** @type {[HTMLInputElement, 'paletteHolds' | 'tapers' | 'shadows' | 'shapes'][]} */ ([
        [input('palette-holds'), 'paletteHolds'],
        [input('tapers'), 'tapers'],
        [input('shadows'), 'shadows'],
        [input('shapes'), 'shapes'],
    ]);
    for (const [box, name] of flags) box.addEventListener('change', () => store.change({ [name]: box.checked }, ''));
    const turnFields = [turnField(store, 'left-colour', 0), turnField(store, 'right-colour', 1)];
    const auto = input('auto-look');
    /** What an automatic look chose. @type {import('../engine/engine.js').Report['look']} */
    let chosen = null;
    auto.addEventListener('change', () => {
        const { words: _, ...values } = chosen ?? { words: '' };
        // The values chosen are the start of an own look.
        store.change(/** @type {Partial<import('../state/state.js').State>} */ ({ ...values, auto: auto.checked }), '');
    });
    const background = input('background');
    /** @type {Look} */
    const self = {
        store,
        wells: html('wells'),
        schemes: SCHEMES.map((scheme) => ({ scheme, chip: schemeChip(store, scheme) })),
        inkKind,
        space: false,
        colourBy,
        flags,
        turnFields,
        auto,
        background,
    };

    background.addEventListener('input', () => store.change({ background: background.value }, 'background'));
    background.addEventListener('change', store.settle);

    button('add-colour').addEventListener('click', () => {
        const { palette } = store.state;
        store.change({ palette: [...palette, /** @type {string} */ (palette.at(-1))] }, '');
    });
    button('remove-colour').addEventListener('click', () => {
        if (store.state.palette.length > 1) store.change({ palette: store.state.palette.slice(0, -1) }, '');
    });

    return {
        /** @param {import('../engine/engine.js').Report} report @param {import('../state/state.js').State} state */
        report(report, state) {
            self.space = report.space;
            chosen = report.look;
            setText(html('auto-note'), state.auto ? (chosen?.words ?? '') : '');
            showInk(self, state);
        },
        /** @param {import('../state/state.js').State} state */
        show: (state) => showLook(self, state),
    };
}

/**
 * A button that takes a colour scheme.
 * @param {import('../state/store.js').Store} store
 * @param {typeof SCHEMES[number]} scheme
 */
function schemeChip(store, scheme) {
    const swatch = make('span', { class: 'swatch', 'aria-hidden': 'true' });
    swatch.style.background = scheme.background;
    for (const colour of scheme.palette.slice(0, 5)) {
        const stripe = make('i');
        stripe.style.background = colour;
        swatch.append(stripe);
    }
    const chip = make('button', { class: 'ink', 'aria-pressed': 'false' }, swatch, make('span', {}, scheme.name));
    chip.addEventListener('click', () => store.change(schemePatch(scheme), ''));
    html('inks').append(chip);
    return chip;
}

/**
 * A field for the colour of the turns to one side.
 * @param {import('../state/store.js').Store} store
 * @param {string} id
 * @param {0 | 1} side
 */
function turnField(store, id, side) {
    return numberField(input(id), {
        low: 1,
        high: rangeOf('turnColours').high + 1,
        expected: say`a whole number above 0`,
        step: 1,
        whole: true,
        settle: store.settle,
        change: (value) => {
            const [left, right] = store.state.turnColours;
            store.change({ turnColours: side === 0 ? [value - 1, right] : [left, value - 1] }, id);
        },
    });
}

/** @param {Look} self @param {import('../state/state.js').State} state */
const showInk = (self, state) => {
    const isDensity = state.ink === 'density';
    const adds = isDensity || (state.ink !== 'solid' && !self.space);
    setChoice(self.inkKind, self.space && !isDensity ? 'solid' : state.ink);
    for (const option of self.inkKind.options) if (option.value === 'auto') option.disabled = self.space;
    html('exposure-row').hidden = !adds;
    html('shadows-row').hidden = !self.space || isDensity;
    html('shapes-row').hidden = !/^\s*shape\s/m.test(state.rules);
    setText(
        html('ink-note'),
        isDensity
            ? self.space
                ? say`Overlapping strokes add up, and nothing is hidden. PNG pictures keep this; SVG files are opaque.`
                : say`Overlapping strokes add up. PNG pictures keep this; SVG files are opaque.`
            : self.space
              ? ''
              : adds
                ? say`Opaque, but strokes finer than a pixel add up. SVG files are opaque.`
                : '',
    );
    for (const option of self.colourBy.options)
        if (option.value === 'density') option.disabled = !adds && state.colourBy !== 'density';
};

/** @param {Look} self @param {number} index */
function newWell(self, index) {
    const well = make('input', {
        type: 'color',
        class: 'well',
        'aria-label': say`Colour ${index + 1}`,
        title: say`Colour ${index + 1}`,
    });
    well.addEventListener('input', () => {
        self.store.change(
            { palette: self.store.state.palette.map((colour, at) => (at === index ? well.value : colour)) },
            `palette ${index}`,
        );
    });
    well.addEventListener('change', self.store.settle);
    return well;
}

/** @param {Look} self @param {import('../state/state.js').State} state */
function showLook(self, state) {
    showInk(self, state);
    while (self.wells.childElementCount > state.palette.length) self.wells.lastElementChild?.remove();
    while (self.wells.childElementCount < state.palette.length)
        self.wells.append(newWell(self, self.wells.childElementCount));
    state.palette.forEach((colour, at) => {
        const well = self.wells.children[at];
        if (well instanceof HTMLInputElement && well.value !== colour) well.value = colour;
    });
    button('remove-colour').disabled = state.palette.length === 1;
    button('add-colour').disabled = state.palette.length >= maxLengthOf('palette');
    for (const { scheme, chip } of self.schemes) chip.setAttribute('aria-pressed', String(hasScheme(state, scheme)));
    self.auto.checked = state.auto;
    html('own-look').hidden = state.auto;
    setChoice(self.colourBy, state.colourBy);
    for (const [box, name] of self.flags) box.checked = state[name];
    html('holds-row').hidden = state.colourBy !== 'level' && state.colourBy !== 'generation';
    html('turns-row').hidden = state.colourBy !== 'turn';
    self.turnFields.forEach((field, side) => field(/** @type {number} */ (state.turnColours[side]) + 1));
    setText(html('colour-note'), said(COLOURINGS[state.colourBy].help));
    if (self.background.value !== state.background) self.background.value = state.background;
}
