/**
 * The messages between the page and its workers, as types that both sides import. Nothing runs here. docs/worker.md
 * tells when messages are sent and which ones supersede others.
 *
 * Counts and positions in strings and drawings may exceed the integers that a number holds exactly. They are big
 * integers on the way to the worker and decimal digits on the way back, counted from 0. Places on the drawing (`Place`)
 * are measured from the centre of the fitted view; the unit is the longer side of what Fit shows.
 */

export {};

/** @typedef {import('./state.js').Definition} Definition */
/** @typedef {import('./state.js').View} View */
/** @typedef {import('./state.js').Camera} Camera */

// Contents of messages.

/** @typedef {'axiom' | 'rules' | 'overrides' | 'file' | 'numbers'} Field */

/**
 * @typedef {object} Diagnostic
 * @property {Field} field
 * @property {'warning' | 'error'} severity
 * @property {string} message
 * @property {string | null} hint
 * @property {string | null} fix the text that is probably meant in place of the problem's; empty where that is to be removed
 * @property {number} start UTF-16 offset into the field
 * @property {number} end
 */

/**
 * The properties of a definition, or its problems.
 * @typedef {object} Report
 * @property {boolean} ok when false, the last good drawing stays
 * @property {Diagnostic[]} diagnostics
 * @property {string} kind `deterministic`, or a comma-separated list of `stochastic`, `context-sensitive` and `parametric`
 * @property {boolean} stochastic
 * @property {boolean} space whether the drawing leaves the plane
 * @property {boolean | null} memoised whether the drawing shares its blocks; null while unknown
 * @property {string | null} symbols exact decimal digits; null while unknown
 * @property {string | null} segments exact decimal digits; null while unknown
 * @property {number | null} blocks the number of blocks of the drawing; null while unknown
 * @property {number | null} largest the most iterations within the limits, if a limit was exceeded
 * @property {{symbol: string, actions: string, rewritten: boolean}[]} legend
 * @property {string | null} empty why the drawing is empty
 * @property {string} description the text alternative of the picture
 */

/** Width and height in device pixels; `ratio` is device pixels per CSS pixel. @typedef {{width: number, height: number, ratio: number}} Canvas */
/**
 * In the plane: x to the right, y upwards, and the rounding remainders of both. In space: x, y and z of the model.
 * @typedef {number[]} Place
 */
/** In the plane: degrees counter-clockwise from the right. In space: a vector. @typedef {number | number[]} Heading */

/** The turtle's pose after the shown segments; `at` in model units. @typedef {{at: number[], fitted: Place, heading: Heading, level: number}} Pose */
/** A segment; `from` and `to` in model units. @typedef {{from: number[], to: number[], fittedFrom: Place, fittedTo: Place, heading: Heading, level: number, colour: number}} SegmentFacts */
/** A polygon. @typedef {{outline: Place[], level: number, colour: number}} PolygonFacts */
/**
 * One link of the chain from the axiom to a symbol. `symbol` includes its arguments in parentheses; `index` is in
 * decimal digits; `position` is the place in the successor (or in the axiom); `production` is the number of a
 * production, or null if the symbol was copied or stands in the axiom. All numbers count from 0.
 * @typedef {{generation: number, symbol: string, index: string, production: number | null, position: number}} AncestryLink
 */
/** The symbols and segments derived from a symbol, as half-open ranges. `outline` surrounds a polygon, a single segment, or in the plane all of them. @typedef {{symbols: [string, string], segments: [string, string], outline: Place[]}} Descendants */
/** A page of a generation's string, and the length of the generation; both null if the generation is too long to derive. `apart`: each symbol ends with a line end, because symbols may have arguments. @typedef {{length: string | null, text: string | null, apart: boolean}} StringPage */
/** `ancestry` is empty and `part` is null if the derivation is too long to be remembered; `stroke` is the first segment of the part. @typedef {{ancestry: AncestryLink[], part: Descendants | null, stroke: SegmentFacts | null}} SymbolFacts */
/** The number of the nearest segment or polygon, its geometry (`stroke` or `filled`), and the number of the symbol that draws or opens it; all null if nothing is near. @typedef {{segment: string | null, polygon: string | null, symbol: string | null, ancestry: AncestryLink[], stroke: SegmentFacts | null, filled: PolygonFacts | null}} Picked */
/** @typedef {{axiom: string, rules: string, overrides: string}} Texts */
/** `value` is null if invalid. The value's text stands from `start` to `end` in the rules; `number`: the text is a plain number, which another number may replace. @typedef {{name: string, value: number | null, start: number, end: number, number: boolean}} ConstantSpan */
/**
 * How the syntax of texts is highlighted, valid or not: one class letter (crates/lsystem-wasm/src/notation.rs) for each
 * UTF-16 unit, and the named constants of the rules.
 * @typedef {Texts & {constants: ConstantSpan[]}} Notation
 */
/** The number of a module in the axiom, or in the successor of a production with this predecessor; numbers count from 0. @typedef {{production: number | null, predecessor: string | null, position: number}} Site */
/** `text` is the content of a readable text file that has problems. @typedef {{definition: Definition | null, diagnostics: Diagnostic[], text: string | null}} FileRead */
/**
 * Systems in the notation of another program or of a paper. `definition` is null if a system cannot be opened; a remark
 * tells what was not carried over, by line of the text (counted from 1).
 * @typedef {{notation: string, entries: {name: string, definition: Definition | null, remarks: {line: number, text: string, message: string}[]}[]}} Imported
 */
/** A format of exported files. @typedef {keyof typeof import('./late-tables.js').FORMATS} Format */

// Questions and their answers.

/**
 * The questions, by type: the fields of the question and of its answer.
 * @typedef {object} Questions
 * @property {{asked: {generation: number, start: bigint, count: number}, answer: StringPage}} string a page of a generation's string
 * @property {{asked: {generation: number, index: bigint}, answer: SymbolFacts}} symbol its ancestry, and the symbols and segments derived from it in the drawn generation
 * @property {{asked: {generation: number, index: bigint, later: number}, answer: {start: string | null}}} descendant the index of the first symbol derived from a symbol, in a later generation
 * @property {{asked: {x: number, y: number, tolerance: number}, answer: Picked}} pick the visible segment or polygon near a place, in device pixels
 * @property {{asked: {texts: Texts}, answer: Notation}} notation
 * @property {{asked: {texts: Texts, field: 'axiom' | 'rules', offset: number}, answer: {site: Site | null}}} site the module at a UTF-16 offset into a text; null for other text
 * @property {{asked: {file: Blob}, answer: FileRead}} read a file: JSON, or a picture that carries its system
 * @property {{asked: {definition: Definition, width: number, height: number, camera: Camera | null}, answer: {bitmap: ImageBitmap | null, missing: string | null}}} thumb a small fitted picture of another system, in space seen by the camera or the first one; `missing` tells why there is none
 * @property {{asked: {text: string}, answer: {modules: Uint8Array | null}}} qr the QR code of a link, row by row, 1 for dark; null if the text is too long
 * @property {{asked: {}, answer: {seed: number}}} seed a new random seed
 */
/** @typedef {keyof Questions} Asked */
/** @template {Asked} [T=Asked] @typedef {{[K in T]: {type: K, id: number} & Questions[K]['asked']}[T]} Question */
/** An answer has the type and the id of its question. @template {Asked} [T=Asked] @typedef {{[K in T]: {type: K, id: number} & Questions[K]['answer']}[T]} Answer */
/** The types of questions about the newest definition's string and drawing. @typedef {'string' | 'symbol' | 'descendant' | 'pick'} Reading */

// Messages.

/** Starts a worker; with a port (`master`), as a mate of the worker at the port's other end. @typedef {{type: 'init', wasm: WebAssembly.Module, master?: MessagePort}} Init */
/** A new definition; only the first `upto` segments are shown, or all if null. @typedef {{type: 'define', id: number, definition: Definition, upto: bigint | null}} Define */
/** A new view; `camera` is for drawings in space. @typedef {{type: 'view', id: number, view: View, camera: Camera | null, upto: bigint | null} & Canvas} ViewMessage */
/**
 * From the page to a worker. `pong` answers `ping`; `mates` lists the ports of all current mates.
 * @typedef {Init | {type: 'ping'} | {type: 'mates', ports: MessagePort[]} | Define | ViewMessage | Question} ToWorker
 */

/** The ids of the definition and view that the worker draws, and of the question that it answers, or 0. @typedef {{type: 'at', define: number, view: number, question: number}} At */
/**
 * A picture of a definition (`id`) and a view. If not `complete`, the picture is coarse, and finer pictures follow
 * while nothing changes. `scale`: device pixels per fitted extent at zoom 1; `rough`: some lines stay slightly
 * displaced even in the finest picture; `only`: the one thing in a complete picture of a single colour; `slow`: the drawing in space takes long enough for mates to help; `pose`: null
 * if all segments are shown.
 * @typedef {{type: 'drawn', id: number, viewId: number, complete: boolean, scale: number, rough: boolean, slow: boolean, only: 'background' | 'ink' | null, bitmap: ImageBitmap, pose: Pose | null}} Picture
 */
/** No more pictures follow for a definition and a view. @typedef {{type: 'done', id: number, viewId: number}} Done */
/**
 * From a worker to the page. `hello`: the script runs and answers pings; `ready`: the wasm is ready too; `report`: sent
 * again when more is known; `fatal`: the worker has crashed.
 * @typedef {{type: 'hello'} | {type: 'ready'} | {type: 'pong'} | At | {type: 'report', id: number, report: Report} | Picture | Done | Answer | {type: 'fatal', message: string}} FromWorker
 */

/** A rectangle of the canvas, in its pixels; `budget` is the most work that may be spent on the pane. @typedef {{number: number, x: number, y: number, width: number, height: number, budget: number}} Pane */
/** The state that a mate needs for drawing. @typedef {{definition: Definition, view: ViewMessage, upto: bigint | null}} SharedState */
/**
 * From a worker to its mate: a pane to draw, with the state unless the mate has it. A new `round` cancels former panes.
 * @typedef {{round: number, pane: Pane, state: SharedState | null} | {round: 0, pane: null, state: null}} ToMate
 */
/** The work spent on a pane, and whether the budget was too small to draw everything (`poor`). @typedef {{work: number, poor: boolean}} Outcome */
/** A mate's answer to every pane; `made` is null if the pane was cancelled. `memory`: the size of the mate's wasm memory, in bytes. @typedef {{pane: Pane, round: number, memory: number, made: {outcome: Outcome, pixels: Uint8Array<ArrayBuffer>} | null}} FromMate */

// Tools: workers that few visits need, each with a wasm of its own.

/**
 * The call of the tool that makes files; its progress are the pieces of the file. `options`: those of
 * tables.js that differ from their defaults; `camera` is for drawings in space. A file is `complete` unless a limit was exceeded or the definition has errors.
 * @typedef {{file: {asked: {definition: Definition, format: Format, options: Record<string, boolean | number | string>, view: View | null, camera: Camera | null, ratio: number, upto: bigint | null}, answer: {complete: boolean, diagnostics: Diagnostic[]}}}} ExportCalls
 */
/** The calls of the tool that reads other notations; null if the text is in no known notation. @typedef {{import: {asked: {text: string}, answer: Imported | null}}} ImportCalls */
/**
 * An exercise (docs/exercises.md). `rules`: how each line of the target's rules is given.
 * @typedef {'shown' | 'free' | 'hidden'} Given
 * @typedef {keyof typeof import('./late-tables.js').ASKS} Asks
 * @typedef {{title: string, task: string, hints: string[], target: Definition, axiom: Given, angle: Given, n: Given, turtle: Given, rules: Given[], first: {axiom: string, rules: string, angle: number, n: number}, asks: Asks, mostSymbols: number | null, tolerance: number | null, showsAnswer: boolean}} Exercise
 */
/**
 * What a student sees of an exercise. `text` is the beginning of the string to derive, if that is asked; `fixed` is the system without what the student found; `free` are the fields,
 * besides the rules, that the student has to find.
 * @typedef {{title: string, task: string, hints: string[], asks: Asks, axiom: Given, angle: Given, n: Given, turtle: Given, hidesRules: boolean, asksForRules: boolean, shownRules: string, mostSymbols: number | null, tolerance: number | null, text: string | null, start: Definition, fixed: Definition, free: (keyof Definition)[]}} AboutExercise
 */
/** A count: exact digits, and the logarithm to base 10 or null for 0. @typedef {{digits: string, log10: number | null}} Count */
/**
 * How the generations of a system grow. `matrix`: how many of each letter (column) a letter (row) becomes in a step.
 * @typedef {{letters: string[], letterCount: number, matrix: number[][], isRandom: boolean, dimension: number | null, table: {n: number, symbols: Count, segments: Count, letters: Count[], spread: number | null, size: [number, number] | null}[], sentences: string[]}} Growth
 */
/**
 * Symbols of a generation with what each becomes. `more`: how many symbols are not listed; `first`: the place of the
 * first one in the next generation.
 * @typedef {{families: {parent: string, children: string[], more: string, first: string}[], start: string, lengths: [string, string]}} StepRows
 */
/** The turtle after a symbol. @typedef {{symbol: string, at: [number, number, number], axes: [number, number, number][], depth: number, stored: [number, number, number][], segment: [[number, number, number], [number, number, number]] | null}} TurtleState */
/** A mark; `agreement` is from 0 to 1, and `isSame` is null if unknown; `text` is the beginning of the answer's string where the string is asked for. @typedef {{isSolved: boolean, agreement: number, percent: string, isSame: boolean | null, symbols: number, words: string, text: string | null, errors: string[]}} Mark */
/**
 * The calls of the tool for courses. `text` is the value of `x` in a link. `pixels`: 512 by 512, 1 for ink of both, 2
 * for missing ink, 4 for ink that is too much.
 * @typedef {{
 *     check: {asked: {definition: Definition, output: string}, answer: {isRight: boolean, words: string, symbol: string | null}},
 *     growth: {asked: {definition: Definition}, answer: {growth: Growth | null, why: string, csv: string, latex: string, shown: number}},
 *     rows: {asked: {definition: Definition, n: number, start: string, count: number}, answer: StepRows},
 *     single: {asked: {definition: Definition, steps: number, rightmost: boolean}, answer: {text: string, length: number, made: [number, number] | null}[]},
 *     trace: {asked: {definition: Definition, n: number, count: number}, answer: {states: TurtleState[], length: string, isSolid: boolean, legend: [string, string][]}},
 *     write: {asked: {exercise: Exercise}, answer: string},
 *     open: {asked: {text: string}, answer: AboutExercise},
 *     picture: {asked: {text: string, width: number, height: number, ratio: number}, answer: Uint8Array<ArrayBuffer>},
 *     hint: {asked: {text: string, student: Definition}, answer: string | null},
 *     answer: {asked: {text: string}, answer: Definition | null},
 *     mark: {asked: {text: string, student: Definition}, answer: {mark: Mark, pixels: Uint8Array<ArrayBuffer>}},
 * }} CourseCalls
 */
/** What is known of a system whose rules are searched; what is null is to be found out. @typedef {{axiom: string | null, angle: number | null, heading: number | null, n: number | null, draws: string | null}} FindQuestion */
/** Where rules are searched: levels of grey, row by row from above, 0 for black; or a string. @typedef {{grey: Uint8Array, width: number, height: number} | {text: string}} FindSource */
/** A system that was found, or that comes close; `agreement` is from 0 to 1. @typedef {{definition: Definition, symbols: number, agreement: number, isFound: boolean}} Candidate */
/** What a search found so far. `work`: the systems of a picture that it tried, or the symbols of a string that it read. @typedef {{candidates: Candidate[], searched: string, work: number, isMore: boolean}} FindReport */
/**
 * The calls of the tool that searches for rules. `begin` replaces the former search; `part` is which of `parts` searches
 * beside each other this one is. `search` goes on until `until` units of work are done in all, and its progress is a
 * report too.
 * @typedef {{
 *     begin: {asked: {source: FindSource, question: FindQuestion, part: number, parts: number}, answer: null},
 *     search: {asked: {until: number}, answer: FindReport},
 * }} FindCalls
 */
/** A film: a system with the view that it begins with, and the text of its tracks (docs/films.md). @typedef {{definition: Definition, view: View | null, camera: Camera | null, text: string}} Film */
/** A key of a track; `easing` is the pace to the next key. @typedef {{time: number, value: number[], easing: string}} FilmKey */
/** @typedef {{subject: string, keys: FilmKey[]}} FilmTrack */
/** The text of a film, read. `width` and `height` are in pixels. @typedef {{seconds: number, rate: number, width: number, height: number, ending: string, easing: string, frames: number, tracks: FilmTrack[]}} FilmScript */
/** A usual film; `place` has the numbers of a view, or of a camera in space. @typedef {{kind: 'growth', n: number} | {kind: 'turtle'} | {kind: 'turntable', azimuth: number} | {kind: 'dive', place: number[], space: boolean}} FilmPreset */
/** A number of a system that a track can change; `value` is the present one, and `expected` the range in words. @typedef {{name: string, label: string, value: number[] | null, expected: string}} FilmSubject */
/**
 * The calls of the tool for films. `place` are the numbers of a key that shows the segment in the middle; the progress
 * of a GIF is the number of finished frames, with the next bytes of the file.
 * @typedef {{
 *     read: {asked: {text: string}, answer: FilmScript},
 *     preset: {asked: {text: string, preset: FilmPreset}, answer: string},
 *     subjects: {asked: {definition: Definition}, answer: FilmSubject[]},
 *     frame: {asked: {film: Film, number: number, width: number, height: number}, answer: Uint8Array<ArrayBuffer>},
 *     place: {asked: {film: Film}, answer: number[] | null},
 *     gif: {asked: {film: Film, script: FilmScript}, answer: null},
 * }} FilmCalls
 */
/** From the page to a tool: calls by name; a long one can be cancelled. @typedef {{type: 'init', wasm: WebAssembly.Module} | {type: 'ping'} | {type: 'cancel', id: number} | {type: 'call', id: number, call: string, asked: object}} ToTool */
/** From a tool to the page. `fatal`: the tool has crashed. @typedef {{type: 'pong'} | {type: 'answer', id: number, value: unknown} | {type: 'progress', id: number, value: unknown} | {type: 'refused', id: number, reason: unknown} | {type: 'fatal', id: number, reason: unknown}} FromTool */

/**
 * One end of a channel: sends messages `Out` and receives messages `In`.
 * @template Out, In
 * @typedef {{postMessage: {(message: Out, transfer: Transferable[]): void, (message: Out): void}, onmessage: ((event: MessageEvent<In>) => void) | null}} Channel
 */
