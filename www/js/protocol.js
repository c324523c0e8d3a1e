/**
 * What the page and its workers say to each other, as types that both sides import. Nothing runs here. When messages are
 * sent, and what they supersede, is told in docs/worker.md.
 *
 * Counts and positions in strings and drawings may be larger than a number holds: they are big integers on the way to the
 * worker and decimal digits on the way back, counted from 0. Places on the drawing (`Place`) are in fitted extents, the
 * longer side of what Fit shows, from the fitted centre.
 */

export {};

/** @typedef {import('./state.js').Definition} Definition */
/** @typedef {import('./state.js').View} View */
/** @typedef {import('./state.js').Camera} Camera */

// What the messages hold.

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
 * @property {string | null} symbols exact decimal digits; null while unknown
 * @property {string | null} segments exact decimal digits; null while unknown
 * @property {number | null} blocks of the drawing; null while unknown
 * @property {number | null} largest the most iterations within the limits, where one was passed
 * @property {{symbol: string, actions: string, rewritten: boolean}[]} legend
 * @property {string | null} empty why nothing draws
 * @property {string} description the text alternative of the picture
 */

/** Width and height in device pixels; `ratio` is device pixels per CSS pixel. @typedef {{width: number, height: number, ratio: number}} Canvas */
/**
 * In the plane: to the right, upwards, and the part of each below its precision. In space: x, y and z of the model.
 * @typedef {number[]} Place
 */
/** In the plane degrees counter-clockwise from the right, in space a vector. @typedef {number | number[]} Heading */

/** The turtle behind the first segments: `at` in model units. @typedef {{at: number[], fitted: Place, heading: Heading, level: number}} Pose */
/** A segment; `from` and `to` in model units. @typedef {{from: number[], to: number[], fittedFrom: Place, fittedTo: Place, heading: Heading, level: number, colour: number}} Stroke */
/** A polygon. @typedef {{outline: Place[], level: number, colour: number}} Filled */
/**
 * One link of the chain from the axiom to a symbol, which has its arguments in parentheses, if any; `index` in decimal
 * digits, `position` in the successor (or in the axiom), `production` a number of a production, or null where the symbol
 * stayed or stands in the axiom; all from 0.
 * @typedef {{generation: number, symbol: string, index: string, production: number | null, position: number}} Link
 */
/** What a symbol has become: half-open ranges, and the outline of a polygon, of a single segment, or in the plane of all. @typedef {{symbols: [string, string], segments: [string, string], outline: Place[]}} Part */
/** Symbols of a generation, and how many it has; both null where it is too long to be derived. `apart` tells that each ends with a line end, because it may have arguments. @typedef {{length: string | null, text: string | null, apart: boolean}} StringPage */
/** `ancestry` is empty and `part` null where the derivation is too long to be remembered; `stroke` is where its drawing begins. @typedef {{ancestry: Link[], part: Part | null, stroke: Stroke | null}} SymbolFacts */
/** The number of a segment or of a polygon, with `stroke` or `filled`, and of the symbol that draws or opens it; all null where nothing is near. @typedef {{segment: string | null, polygon: string | null, symbol: string | null, ancestry: Link[], stroke: Stroke | null, filled: Filled | null}} Picked */
/** @typedef {{axiom: string, rules: string, overrides: string}} Texts */
/** `value` is null where it is wrong; it stands from `start` to `end` in the rules, and another number may take its place if it is one `number`. @typedef {{name: string, value: number | null, start: number, end: number, number: boolean}} Constant */
/**
 * How texts read, be they right or wrong: the letter of its class (crates/lsystem-wasm/src/notation.rs) for each UTF-16
 * unit, and the named constants of the rules.
 * @typedef {Texts & {constants: Constant[]}} Notation
 */
/** `text` is what the file says, where something is wrong with it and people can read it. @typedef {{definition: Definition | null, diagnostics: Diagnostic[], text: string | null}} FileRead */
/** A format of exported files. @typedef {keyof typeof import('./tables.js').FORMATS} Format */
/** `blob` is the file, null where a limit was passed. @typedef {{blob: Blob | null, diagnostics: Diagnostic[]}} Exported */

// Questions and their answers.

/**
 * What can be asked, by the type of the question: the fields of the question, and those of its answer.
 * @typedef {object} Questions
 * @property {{asked: {generation: number, start: bigint, count: number}, answer: StringPage}} string a page of a generation's string
 * @property {{asked: {generation: number, index: bigint}, answer: SymbolFacts}} symbol where it comes from, and what it has become in the generation that is drawn
 * @property {{asked: {generation: number, index: bigint, later: number}, answer: {start: string | null}}} descendant where, in a later generation, the symbols derived from another begin
 * @property {{asked: {x: number, y: number, tolerance: number}, answer: Picked}} pick what is seen near a place, in device pixels, of what is shown
 * @property {{asked: {texts: Texts}, answer: Notation}} notation
 * @property {{asked: {file: Blob}, answer: FileRead}} read a file: JSON, or a picture that carries its system
 * @property {{asked: {format: Format}, answer: Exported}} export
 * @property {{asked: {width: number, height: number, definition: Definition}, answer: {blob: Blob | null, reason: string | null}}} png the current view at another size, with the system in the file; `reason` where there is none
 * @property {{asked: {definition: Definition, width: number, height: number}, answer: {bitmap: ImageBitmap | null}}} thumb a small fitted picture of another system; null where nothing draws
 * @property {{asked: {text: string}, answer: {modules: Uint8Array | null}}} qr the code of a link, row by row, 1 for dark; null where the text is too long
 * @property {{asked: {}, answer: {seed: number}}} seed a fresh random one
 */
/** @typedef {keyof Questions} Asked */
/** @template {Asked} [T=Asked] @typedef {{[K in T]: {type: K, id: number} & Questions[K]['asked']}[T]} Question */
/** It has the type and the id of its question. @template {Asked} [T=Asked] @typedef {{[K in T]: {type: K, id: number} & Questions[K]['answer']}[T]} Answer */
/** Questions about what the newest definition derives and draws. @typedef {'string' | 'symbol' | 'descendant' | 'pick'} Reading */

// Messages.

/** Starts a worker; with a port, as a mate of the worker at its other end. @typedef {{type: 'init', wasm: WebAssembly.Module, master?: MessagePort}} Init */
/** A new state of the system; `upto` shows only the first segments, null all. @typedef {{type: 'define', id: number, definition: Definition, upto: bigint | null}} Define */
/** How the picture is to be shown; `camera` of a drawing in space. @typedef {{type: 'view', id: number, view: View, camera: Camera | null, upto: bigint | null} & Canvas} Sight */
/**
 * From the page to a worker. `ping` is answered by `pong`; `mates` has the ports of all who help from now on.
 * @typedef {Init | {type: 'ping'} | {type: 'mates', ports: MessagePort[]} | Define | Sight | Question} ToWorker
 */

/** What comes next, by ids: the newest state and view taken up, and a question, or 0. @typedef {{type: 'at', define: number, view: number, question: number}} At */
/**
 * A picture of a state (`id`) and a view. One that is not `complete` is coarse, and finer ones follow while nothing changes;
 * `scale` is in device pixels per fitted extent at zoom 1; `rough` tells that not every line is in its place, for good;
 * `slow` that mates help, or would, with a drawing in space; `pose` is null where all segments are shown.
 * @typedef {{type: 'drawn', id: number, viewId: number, complete: boolean, scale: number, rough: boolean, slow: boolean, bitmap: ImageBitmap, pose: Pose | null}} Picture
 */
/** No picture is to come for a state and a view. @typedef {{type: 'done', id: number, viewId: number}} Done */
/**
 * From a worker to the page. `hello`: the script is there and answers pings; `ready`: so is the wasm; `report` is sent again
 * when more is known; `fatal`: the worker is done for.
 * @typedef {{type: 'hello'} | {type: 'ready'} | {type: 'pong'} | At | {type: 'report', id: number, report: Report} | Picture | Done | Answer | {type: 'fatal', message: string}} FromWorker
 */

/** In pixels of the canvas; `budget` is the work that may be spent on it. @typedef {{number: number, x: number, y: number, width: number, height: number, budget: number}} Pane */
/** A state as a mate has to know it. @typedef {{definition: Definition, view: Sight, upto: bigint | null}} SharedState */
/**
 * From a worker to its mate: a pane to make, with the state unless the mate has it. Another `round` ends what is under way.
 * @typedef {{round: number, pane: Pane, state: SharedState | null} | {round: 0, pane: null, state: null}} ToMate
 */
/** What the pane took, and whether something had to go without. @typedef {{work: number, poor: boolean}} Outcome */
/** A mate's answer to every pane; without `made` where it was not made. `memory` is that of its wasm, in bytes. @typedef {{pane: Pane, round: number, memory: number, made: {outcome: Outcome, pixels: Uint8Array<ArrayBuffer>} | null}} FromMate */

/**
 * One end of a channel: it takes messages `Out` and gives messages `In`.
 * @template Out, In
 * @typedef {{postMessage: {(message: Out, transfer: Transferable[]): void, (message: Out): void}, onmessage: ((event: MessageEvent<In>) => void) | null}} Channel
 */
