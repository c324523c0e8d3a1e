/** What the page and its worker say to each other, as types. Nothing runs here. */

export {};

/** @typedef {import('./state.js').Definition} Definition */
/** @typedef {import('./state.js').View} View */
/** @typedef {import('./state.js').Camera} Camera */
/** @typedef {'axiom' | 'rules' | 'overrides' | 'file' | 'numbers'} Field */

/**
 * @typedef {object} Diagnostic
 * @property {Field} field
 * @property {'warning' | 'error'} severity
 * @property {string} message
 * @property {string | null} hint
 * @property {number} start UTF-16 offset into the field
 * @property {number} end
 */

/**
 * What a definition means, or what is wrong with it.
 * @typedef {object} Report
 * @property {boolean} ok when false, the last good drawing stays
 * @property {Diagnostic[]} diagnostics
 * @property {string} kind `deterministic`, or those of `stochastic`, `context-sensitive`, `parametric` that hold, separated by commas
 * @property {boolean} stochastic
 * @property {boolean} solid whether the drawing leaves the plane
 * @property {boolean | null} memoised whether the drawing shares its blocks; null while unknown
 * @property {string | null} symbols exact decimal digits
 * @property {string | null} segments exact decimal digits
 * @property {number | null} blocks of the drawing; null while unknown
 * @property {number | null} largest the most iterations within the limits, where one was passed
 * @property {{symbol: string, actions: string, rewritten: boolean}[]} legend
 * @property {string | null} empty why nothing draws
 * @property {string} description the text alternative of the picture
 * @property {boolean} [past] whether it is of the last good state, because the newest was given up
 */

/** @typedef {{width: number, height: number, ratio: number}} Canvas width and height in device pixels */
/** @typedef {import('./reading/words.js').Link} Link */
/** @typedef {import('./reading/words.js').Stroke} Stroke */
/** @typedef {import('./reading/words.js').Filled} Filled */
/** How the picture is to be shown; only the first `upto` segments unless it is null. @typedef {{canvas: Canvas, view: View, camera: Camera | null, upto: bigint | null}} Look */
/**
 * A picture; `scale` is in device pixels per fitted extent at zoom 1, and `rough` tells that not every line is in its
 * place, for good. `pose` is the turtle's where only the first segments are shown: `at` in model units, `fitted` as places of
 * marks, `heading` in degrees, in space a vector.
 * @typedef {{id: number, viewId: number, complete: boolean, scale: number, rough: boolean, bitmap: ImageBitmap, pose: Pose | null} & Look} Drawn
 */
/** @typedef {{at: number[], fitted: number[], heading: number | number[], level: number}} Pose */
/** Symbols of a generation from `start` on, and how many it has, null where it is too long to be derived; `apart` tells that each ends with a line end. @typedef {{length: string | null, text: string | null, apart: boolean}} StringPage */
/** What a symbol has become: half-open ranges in decimal digits, the outline as places of marks. @typedef {{symbols: [string, string], segments: [string, string], outline: number[][]}} Part */
/** `ancestry` is empty and `part` null where neither is known; `stroke` is where its drawing begins. @typedef {{ancestry: Link[], part: Part | null, stroke: Stroke | null}} SymbolFacts */
/** One of `segment` and `polygon`, with `stroke` or `filled`, or nothing. @typedef {{segment: string | null, polygon: string | null, symbol: string | null, ancestry: Link[], stroke: Stroke | null, filled: Filled | null}} Picked */
/**
 * How texts read, be they right or wrong: the letter of its class for each UTF-16 unit, and the named constants of the rules.
 * @typedef {{axiom: string, rules: string, overrides: string, constants: Constant[]}} Notation
 */
/** `value` is null where it is wrong; it stands from `start` to `end` in the rules, and another number may take its place if it is one `number`. @typedef {{name: string, value: number | null, start: number, end: number, number: boolean}} Constant */
/** `text` is what the file says where it is readable and short. @typedef {{definition: Definition | null, diagnostics: Diagnostic[], text: string | null}} FileRead */
/** `blob` is the file, null where a limit was passed. @typedef {{blob: Blob | null, diagnostics: Diagnostic[]}} Exported */
/** A system and how it is looked at. @typedef {{definition: Definition | null, look: Look | null}} Shown */
/**
 * What went wrong. `silent` and `crashed`: the worker stopped over the drawing, or over a `question` about it, and was
 * replaced; `loading`: its files could not be loaded, and are tried again; `unloadable`: they are not; `lost`: fresh workers
 * stopped as well.
 * @typedef {{how: 'silent' | 'crashed' | 'loading' | 'unloadable' | 'lost', question: boolean, message: string}} Trouble
 */
