/**
 * The page's state: one flat value that controls, links, undo and the worker share. Nothing here touches the page.
 */

import { DIALECTS as TABLE } from './tables.js';

/** @typedef {keyof typeof import('./tables.js').DIALECTS} Dialect */
/** @typedef {'symbol' | 'single' | 'level' | 'turn' | 'generation' | 'path' | 'density'} ColourBy */
/** @typedef {'solid' | 'density'} Ink */

/**
 * Where the reader looks. `x` and `y` move the picture's centre, in fitted extents (the longer side of what Fit
 * shows), y up; `zoom` 1 is fitted.
 * @typedef {{x: number, y: number, zoom: number, fx?: number, fy?: number}} View `fx` and `fy` are to be added to `x` and `y`: what is below their precision
 */

/**
 * An L-system as its author wrote it. Angles in degrees, counter-clockwise; lengths in model units; widths in steps,
 * except `minWidth`, in CSS pixels; colours `#rrggbb`.
 * @typedef {object} Definition
 * @property {string} name
 * @property {string} title
 * @property {string} source
 * @property {string} notes
 * @property {string} axiom
 * @property {string} rules
 * @property {number} iterations 0 to 1,000
 * @property {number} angle of a left turn, and of a right one unless `rightAngle` is given
 * @property {number | null} rightAngle
 * @property {number | null} pitchDown as `angle` where null
 * @property {number | null} pitchUp as `pitchDown` where null
 * @property {number | null} rollLeft as `angle` where null
 * @property {number | null} rollRight as `rollLeft` where null
 * @property {number} heading 0 = +x, 90 = up
 * @property {number} step
 * @property {[number, number]} start
 * @property {[number, number, number]} tropism what branches bend towards: x, y, z towards the viewer
 * @property {number} elasticity how easily they bend; 0 for not at all
 * @property {number} lengthFactor what every branch multiplies lengths by
 * @property {number} angleVariation by how much angles differ at random, at most; percent
 * @property {number} lengthVariation the same of lengths
 * @property {number} growth how far what the last derivation step made has grown, 0 to 1
 * @property {Dialect} dialect
 * @property {string} overrides
 * @property {number} seed 0 to 2^32 - 1
 * @property {string[]} palette never empty
 * @property {ColourBy} colourBy
 * @property {boolean} paletteHolds by level and generation: the last colour goes on where the palette ends
 * @property {[number, number]} turnColours by turn: palette indices after a left and after a right turn
 * @property {string} background
 * @property {number} width
 * @property {number} widthFactor what every branch multiplies the width by
 * @property {number} minWidth
 * @property {Ink} ink whether strokes cover each other, or their ink adds up
 * @property {number} exposure how much of ink that adds up shows, in stops
 */

/**
 * From where a drawing in space is looked at. `azimuth` and `elevation` in degrees: 0 looks from the front, 90 from the
 * right and from above; `x`, `y`, `z` move what is in the middle, in fitted extents (the diameter of a ball around the
 * drawing), in the model's directions; `zoom` 1 is fitted; `fade`, 0 to 1, lets what is far fade into the background.
 * @typedef {{azimuth: number, elevation: number, zoom: number, x: number, y: number, z: number, perspective: boolean, fade: number}} Camera
 */

/** @typedef {Definition & {view: View | null, camera: Camera | null}} State `view` and `camera` are null while nobody has moved them. */

export const MAX_ITERATIONS = 1000;
export const MAX_PALETTE = 32;
export const MIN_ZOOM = 1e-2;
/** Where a step of a drawing 10^24 steps wide fills the picture. */
export const MAX_ZOOM = 1e25;
/** In space single precision is enough up to here. */
export const MAX_CAMERA_ZOOM = 1e4;

/** Longer texts are cut, in UTF-16 units. */
export const MOST_TEXT = { axiom: 20_000, rules: 50_000, overrides: 20_000 };

/** In the order to offer them. */
export const DIALECTS = /** @type {Dialect[]} */ (Object.keys(TABLE));
/** @type {readonly ColourBy[]} */
export const COLOUR_BY = ['symbol', 'level', 'generation', 'path', 'turn', 'density', 'single'];
/** @type {readonly Ink[]} */
export const INK = ['solid', 'density'];
/** Stops either way. */
export const MAX_EXPOSURE = 10;

/** @type {Readonly<State>} */
export const DEFAULTS = Object.freeze({
    name: '',
    title: '',
    source: '',
    notes: '',
    axiom: '',
    rules: '',
    iterations: 1,
    angle: 0,
    rightAngle: null,
    pitchDown: null,
    pitchUp: null,
    rollLeft: null,
    rollRight: null,
    heading: 90,
    step: 1,
    start: /** @type {[number, number]} */ ([0, 0]),
    tropism: /** @type {[number, number, number]} */ ([0, -1, 0]),
    elasticity: 0,
    lengthFactor: 1,
    angleVariation: 0,
    lengthVariation: 0,
    growth: 1,
    dialect: 'abop',
    overrides: '',
    seed: 0,
    palette: ['#1f5c3a', '#5f8f2f', '#b58b1e', '#b4532a', '#8c2f4b'],
    colourBy: 'symbol',
    paletteHolds: false,
    turnColours: /** @type {[number, number]} */ ([1, 2]),
    background: '#fbfaf5',
    width: 0,
    widthFactor: 1,
    minWidth: 1,
    ink: 'solid',
    exposure: 0,
    view: null,
    camera: null,
});

/**
 * Each reads a value of unknown origin and gives the nearest valid one, or undefined where there is none.
 * @type {{[Field in keyof State]: (value: unknown) => State[Field] | undefined}}
 */
const CLEAN = {
    name: text(200),
    title: text(200),
    source: text(1000),
    notes: text(10_000),
    axiom: text(MOST_TEXT.axiom),
    rules: text(MOST_TEXT.rules),
    iterations: number(0, MAX_ITERATIONS, true),
    angle: number(-3600, 3600),
    rightAngle: orNull(number(-3600, 3600)),
    pitchDown: orNull(number(-3600, 3600)),
    pitchUp: orNull(number(-3600, 3600)),
    rollLeft: orNull(number(-3600, 3600)),
    rollRight: orNull(number(-3600, 3600)),
    heading: number(-3600, 3600),
    step: number(1e-9, 1e9),
    start: (value) => (Array.isArray(value) && value.length === 2 ? pair(value.map(number(-1e9, 1e9))) : undefined),
    tropism: (value) => (Array.isArray(value) && value.length === 3 ? triple(value.map(number(-1000, 1000))) : undefined),
    elasticity: number(-1000, 1000),
    lengthFactor: number(0, 10),
    angleVariation: number(0, 100),
    lengthVariation: number(0, 100),
    growth: number(0, 1),
    dialect: oneOf(DIALECTS),
    overrides: text(MOST_TEXT.overrides),
    seed: number(0, 2 ** 32 - 1, true),
    palette: (value) => {
        const colours = Array.isArray(value) ? value.slice(0, MAX_PALETTE).map(colour) : [];
        return colours.length > 0 && colours.every((one) => one !== undefined) ? /** @type {string[]} */ (colours) : undefined;
    },
    colourBy: oneOf(COLOUR_BY),
    paletteHolds: (value) => (typeof value === 'boolean' ? value : undefined),
    turnColours: (value) => (Array.isArray(value) && value.length === 2 ? pair(value.map(number(0, MAX_PALETTE - 1, true))) : undefined),
    background: colour,
    width: number(0, 1000),
    widthFactor: number(0, 10),
    minWidth: number(0, 100),
    ink: oneOf(INK),
    exposure: number(-MAX_EXPOSURE, MAX_EXPOSURE),
    camera: orNull((value) => {
        if (typeof value !== 'object' || value === null) return undefined;
        const { azimuth, elevation, zoom, x, y, z, perspective, fade } = /** @type {Record<string, unknown>} */ (value);
        const turn = number(-360, 360)(azimuth);
        const lift = number(-90, 90)(elevation);
        const scale = number(MIN_ZOOM, MAX_CAMERA_ZOOM)(zoom);
        const haze = number(0, 1)(fade);
        const [tx, ty, tz] = [x, y, z].map(number(-100, 100));
        const numbers = [turn, lift, scale, haze, tx, ty, tz];
        if (numbers.includes(undefined) || typeof perspective !== 'boolean') return undefined;
        return /** @type {Camera} */ ({ azimuth: turn, elevation: lift, zoom: scale, x: tx, y: ty, z: tz, perspective, fade: haze });
    }),
    view: orNull((value) => {
        if (typeof value !== 'object' || value === null) return undefined;
        const { x, y, zoom, fx, fy } = /** @type {Record<string, unknown>} */ (value);
        const centre = pair([x, y].map(number(-1e6, 1e6)));
        const scale = number(MIN_ZOOM, MAX_ZOOM)(zoom);
        if (!centre || scale === undefined) return undefined;
        const fine = pair([fx, fy].map(number(-1, 1)));
        const view = { x: centre[0], y: centre[1], zoom: scale };
        return fine && (fine[0] !== 0 || fine[1] !== 0) ? { ...view, fx: fine[0], fy: fine[1] } : view;
    }),
};

/** The names of the state's fields. */
export const FIELDS = /** @type {(keyof State)[]} */ (Object.keys(DEFAULTS));

/**
 * A valid state from values of unknown origin: each field is the nearest valid value, or `base`'s where there is none.
 * Unknown fields are left out.
 * @param {object} values
 * @param {Readonly<State>} [base]
 * @returns {State}
 */
export function clean(values, base = DEFAULTS) {
    const given = /** @type {Record<string, unknown>} */ (values);
    /** @type {Record<string, unknown>} */
    const state = {};
    for (const field of FIELDS) {
        const value = Object.hasOwn(given, field) ? CLEAN[field](given[field]) : undefined;
        state[field] = value === undefined ? structuredClone(base[field]) : value;
    }
    return /** @type {State} */ (state);
}

/**
 * The nearest valid value of a field, or undefined where there is none.
 * @param {keyof State} field
 * @param {unknown} value
 */
export function cleanField(field, value) {
    return CLEAN[field](value);
}

/**
 * What the worker, files and the gallery know of a state: all but the view and the camera.
 * @param {Readonly<State>} state
 * @returns {Definition}
 */
export function definitionOf(state) {
    const { view: _, camera: __, ...definition } = state;
    return definition;
}

/**
 * Whether two values of one field are the same.
 * @param {unknown} a
 * @param {unknown} b
 */
export function same(a, b) {
    return Object.is(a, b) || (typeof a === 'object' && typeof b === 'object' && JSON.stringify(a) === JSON.stringify(b));
}

/**
 * Whether two states draw the same system, whatever their views and captions.
 * @param {Readonly<State>} a
 * @param {Readonly<State>} b
 */
export function sameSystem(a, b) {
    return FIELDS.every((field) => field === 'view' || field === 'camera' || same(a[field], b[field]));
}

/** What only captions, inks and views depend on. @type {readonly (keyof State)[]} */
const LOOKS = ['name', 'title', 'source', 'notes', 'palette', 'colourBy', 'paletteHolds', 'turnColours', 'background', 'width', 'widthFactor', 'minWidth', 'ink', 'exposure', 'view', 'camera'];

/**
 * Whether two states draw the same segments.
 * @param {Readonly<State>} a
 * @param {Readonly<State>} b
 */
export function sameDrawing(a, b) {
    return FIELDS.every((field) => LOOKS.includes(field) || same(a[field], b[field]));
}

/** @param {number} limit in UTF-16 units @returns {(value: unknown) => string | undefined} */
function text(limit) {
    // Half a surrogate pair cannot be written into a link or a file.
    return (value) => (typeof value === 'string' ? value.slice(0, limit).replace(/\r\n?/g, '\n').replace(/\p{Surrogate}/gu, '\ufffd') : undefined);
}

/** @param {number} low @param {number} high @param {boolean} [whole] @returns {(value: unknown) => number | undefined} */
function number(low, high, whole = false) {
    return (value) => {
        if (typeof value !== 'number' || !Number.isFinite(value)) return undefined;
        // Adding 0 turns -0 into 0, which links and files cannot tell apart.
        return Math.min(high, Math.max(low, whole ? Math.round(value) : value)) + 0;
    };
}

/** @template {string} T @param {readonly T[]} choices @returns {(value: unknown) => T | undefined} */
function oneOf(choices) {
    return (value) => choices.find((choice) => choice === value);
}

/** @template T @param {(value: unknown) => T | undefined} inner @returns {(value: unknown) => T | null | undefined} */
function orNull(inner) {
    return (value) => (value === null ? null : inner(value));
}

/** @param {unknown} value */
function colour(value) {
    return typeof value === 'string' && /^#[0-9a-f]{6}$/i.test(value) ? value.toLowerCase() : undefined;
}

/** @param {(number | undefined)[]} values @returns {[number, number] | undefined} */
function pair([a, b]) {
    return a === undefined || b === undefined ? undefined : [a, b];
}

/** @param {(number | undefined)[]} values @returns {[number, number, number] | undefined} */
function triple([a, b, c]) {
    return a === undefined || b === undefined || c === undefined ? undefined : [a, b, c];
}
