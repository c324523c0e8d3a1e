/**
 * The messages between the page and its workers, as types that both sides import. Nothing runs here. Contents that Rust
 * reads or makes have the types of messages.d.ts, which is written from Rust. docs/worker.md tells when messages are sent
 * and which ones supersede others.
 *
 * Counts and positions in strings and drawings may exceed the integers that a number holds exactly. They are big
 * integers on the way to the worker and decimal digits on the way back, counted from 0. Places on the drawing (`Place`)
 * are measured from the centre of the fitted view; the unit is the longer side of what Fit shows.
 */

export {};

/** @typedef {import('./tables.js').Definition} Definition */

// Contents of messages.

/** @typedef {import('./messages.js').Problem} Diagnostic */
/** @typedef {Diagnostic['field']} Field */
/** The properties of a definition, or its problems; if not `ok`, the last good drawing stays. @typedef {import('./messages.js').Report} Report */

/**
 * A view of a drawing in the plane. `x` and `y` move the picture's centre; the unit is the longer side of what Fit
 * shows, y up. `zoom` 1 is fitted. `fx` and `fy` are rounding remainders to add to `x` and `y`. `at` is the number, from
 * 1, of the segment whose start is the origin, and decimals for a place farther on the segment; without it, the origin is the
 * fitted centre.
 * @typedef {{x: number, y: number, zoom: number, fx?: number, fy?: number, at?: string}} View
 */

/**
 * A view of a drawing in space. `azimuth` and `elevation` are in degrees: 0 looks from the front, 90 from the right and
 * from above. `x`, `y` and `z` move the target along the model's axes; the unit is the diameter of a ball around the
 * drawing. `zoom` 1 is fitted. `fade`, from 0 to 1, fades distant parts into the background.
 * @typedef {{azimuth: number, elevation: number, zoom: number, x: number, y: number, z: number, perspective: boolean, fade: number}} Camera
 */

/** Width and height in device pixels; `ratio` is device pixels per CSS pixel. @typedef {{width: number, height: number, ratio: number}} Canvas */
/** In the plane: x to the right, y upwards, and the rounding remainders of both. In space: x, y and z of the model. @typedef {number[]} Place */
/** @typedef {import('./messages.js').Direction} Heading */
/** @typedef {import('./messages.js').Pose} Pose */
/** @typedef {import('./messages.js').SegmentFacts} SegmentFacts */
/** @typedef {import('./messages.js').PolygonFacts} PolygonFacts */
/** @typedef {import('./messages.js').AncestryLink} AncestryLink */
/** @typedef {import('./messages.js').Descendants} Descendants */
/** @typedef {import('./messages.js').StringPage} StringPage */
/** @typedef {import('./messages.js').SymbolFacts} SymbolFacts */
/** @typedef {import('./messages.js').Picked} Picked */
/** @typedef {{axiom: string, rules: string, overrides: string}} Texts */
/** @typedef {import('./messages.js').ConstantSpan} ConstantSpan */
/** @typedef {import('./messages.js').Notation} Notation */
/** @typedef {import('./messages.js').Site} Site */
/** `text` is the content of a readable text file that has problems. @typedef {import('./messages.js').FileRead & {text: string | null}} FileRead */
/** @typedef {import('./messages.js').ImportReport} Imported */
/** A format of exported files. @typedef {keyof typeof import('./late-tables.js').FORMATS} Format */

// Questions and their answers.

/**
 * The questions, by type: the fields of the question and of its answer.
 * @typedef {object} Questions
 * @property {{asked: {generation: number, start: bigint, count: number}, answer: StringPage}} string a page of a generation's string
 * @property {{asked: {generation: number, index: bigint}, answer: SymbolFacts}} symbol its ancestry, and the symbols and segments derived from it in the drawn generation
 * @property {{asked: {generation: number, index: bigint, later: number}, answer: {start: string | null}}} descendant the index of the first symbol derived from a symbol, in a later generation
 * @property {{asked: {x: number, y: number, reach: number}, answer: {anchor: import('./messages.js').Anchor | null}}} anchor a place on a segment near a place, in device pixels
 * @property {{asked: {x: number, y: number, tolerance: number}, answer: Picked}} pick the visible segment or polygon near a place, in device pixels
 * @property {{asked: {texts: Texts}, answer: Notation}} notation
 * @property {{asked: {texts: Texts, field: 'axiom' | 'rules', offset: number}, answer: {site: Site | null}}} site the module at a UTF-16 offset into a text; null for other text
 * @property {{asked: {file: Blob}, answer: FileRead}} read a file: JSON, or a picture that carries its system
 * @property {{asked: {definition: Definition, width: number, height: number, camera: Camera | null, frame: Definition | null}, answer: {bitmap: ImageBitmap | null, missing: string | null}}} thumb a small picture of another system, fitted or in the frame of a third one, in space seen by the camera or the first one; `missing` tells why there is none
 * @property {{asked: {text: string}, answer: {modules: Uint8Array | null}}} qr the QR code of a link, row by row, 1 for dark; null if the text is too long
 * @property {{asked: {}, answer: {seed: number}}} seed a new random seed
 */
/** @typedef {keyof Questions} Asked */
/** @template {Asked} [T=Asked] @typedef {{[K in T]: {type: K, id: number} & Questions[K]['asked']}[T]} Question */
/** An answer has the type and the id of its question. @template {Asked} [T=Asked] @typedef {{[K in T]: {type: K, id: number} & Questions[K]['answer']}[T]} Answer */
/** The types of questions about the newest definition's string and drawing. @typedef {'string' | 'symbol' | 'descendant' | 'anchor' | 'pick'} Reading */

// Messages.

/** A text of another language, or its forms by plural categories. @typedef {string | Record<string, string>} Entry */
/** The language of the page, and the texts by the English ones. @typedef {{language: string, words: Record<string, Entry>}} Catalogue */
/** Starts a worker; with a port (`master`), as a mate of the worker at the port's other end. @typedef {{type: 'init', wasm: WebAssembly.Module, words?: Catalogue, master?: MessagePort}} Init */
/** A new definition, in the frame of the former drawing if `still`; only the first `upto` segments are shown, or all if null. @typedef {{type: 'define', id: number, definition: Definition & {still?: boolean}, upto: bigint | null}} Define */
/** A new view; `camera` is for drawings in space. @typedef {{type: 'view', id: number, view: View, camera: Camera | null, upto: bigint | null} & Canvas} ViewMessage */
/**
 * From the page to a worker. `rest`: the rest of the core, which a worker that has only the first part calls by
 * stopping; `pong` answers `ping`; `mates` lists the ports of all current mates.
 * @typedef {Init | {type: 'rest', wasm: WebAssembly.Module} | {type: 'ping'} | {type: 'mates', ports: MessagePort[]} | Define | ViewMessage | Question} ToWorker
 */

/** The ids of the definition and view that the worker draws, and of the question that it answers, or 0. @typedef {{type: 'at', define: number, view: number, question: number}} At */
/** A picture of a definition (`id`) and a view. If not `complete`, finer pictures follow while nothing changes. @typedef {{type: 'drawn', id: number, viewId: number, bitmap: ImageBitmap} & import('./messages.js').Drawn} Picture */
/** No more pictures follow for a definition and a view. @typedef {{type: 'done', id: number, viewId: number}} Done */
/**
 * From a worker to the page. `hello`: the script runs and answers pings; `ready`: the wasm is ready too; `report`: sent
 * again when more is known; `fatal`: the worker has crashed; `isEarly`: without the rest of the core.
 * @typedef {{type: 'hello'} | {type: 'ready'} | {type: 'pong'} | At | {type: 'report', id: number, report: Report} | Picture | Done | Answer | {type: 'fatal', message: string, isEarly: boolean}} FromWorker
 */

/** @typedef {import('./messages.js').SharedPane} Pane */
/** The state that a mate needs for drawing. @typedef {{definition: Definition, view: ViewMessage, upto: bigint | null}} SharedState */
/**
 * From a worker to its mate: a pane to draw, with the state unless the mate has it. A new `round` cancels former panes.
 * @typedef {{round: number, pane: Pane, state: SharedState | null} | {round: 0, pane: null, state: null}} ToMate
 */
/** @typedef {import('./messages.js').Outcome} Outcome */
/** A mate's answer to every pane; `made` is null if the pane was cancelled. `memory`: the size of the mate's wasm memory, in bytes. @typedef {{pane: Pane, round: number, memory: number, made: {outcome: Outcome, pixels: Uint8Array<ArrayBuffer>} | null}} FromMate */

// Tools: workers that few visits need, each with a wasm of its own.

/**
 * The call of the tools that make files; its progress are the pieces of the file. `options`: those of
 * tables.js that differ from their defaults; `camera` is for drawings in space. A file is `complete` unless a limit was exceeded or the definition has errors.
 * @typedef {{asked: {definition: Definition, format: Format, options: Record<string, boolean | number | string>, view: View | null, camera: Camera | null, ratio: number, upto: bigint | null}, answer: import('./messages.js').ExportReport}} MakeFile
 */
/** @typedef {{file: MakeFile}} ExportCalls */
/** For formats of pixels. @typedef {{pixels: MakeFile}} PictureCalls */
/** The call of the tool that makes packages for learning systems. @typedef {{package: {asked: {exercises: string[], title: string, standard: string, steps: string, exercise: string, program: string, language: string, catalogue: string}, answer: Uint8Array<ArrayBuffer>}}} PackageCalls */
/** The call of the tool that reads other notations; it answers null if the text is in no known notation. @typedef {{import: {asked: {text: string}, answer: Imported | null}}} ImportCalls */
/** The call of the tool that writes other notations. @typedef {{writeAs: {asked: {definition: Definition, notation: string}, answer: import('./messages.js').WriteReport}}} WriteCalls */
/**
 * The calls of the tool for new systems; `descent` answers with an animated GIF.
 * @typedef {{surprise: {asked: {seed: number}, answer: Definition}, breed: {asked: {parents: Definition[], seed: number, count: number}, answer: Definition[]}, descent: {asked: {definitions: Definition[], side: number}, answer: Uint8Array<ArrayBuffer>}}} InventCalls
 */
/** The choices for what is heard: names and values of tables.js that differ from their defaults. @typedef {Record<string, boolean | number | string>} SoundChoices */
/** @typedef {import('./messages.js').Note} Note */
/** @typedef {import('./messages.js').Tune} Tune */
/**
 * The calls of the tool for sound, about the system of the last `listen`: some lines in drawing order, or all.
 * @typedef {{
 *     listen: {asked: {definition: Definition}, answer: null},
 *     part: {asked: {from: bigint, stride: bigint, count: number, options: SoundChoices}, answer: Tune},
 *     tune: {asked: {options: SoundChoices}, answer: Tune},
 * }} SoundCalls
 */
/** @typedef {import('./messages.js').Given} Given */
/** @typedef {import('./messages.js').Asks} Asks */
/** @typedef {import('./messages.js').Exercise} Exercise */
/** @typedef {import('./messages.js').AboutExercise} AboutExercise */
/** @typedef {import('./messages.js').Count} Count */
/** @typedef {import('./messages.js').Growth} Growth */
/** @typedef {import('./messages.js').Rows} StepRows */
/** @typedef {import('./messages.js').TurtleState} TurtleState */
/** @typedef {import('./messages.js').MarkReport} Mark */
/** @typedef {import('./messages.js').MarkedAnswer} MarkedAnswer */
/** @typedef {import('./messages.js').MistakeReport} MistakeReport */
/** @typedef {import('./messages.js').Varied} Varied */
/**
 * The progress of `markClass`: first the exercise, then a row for each answer. `picture`: 128 by 128, 0 for none, 1 for ink
 * of both, 2 for missing ink, 3 for ink that is too much.
 * @typedef {{about: import('./messages.js').AboutClass} | {row: MarkedAnswer, picture: Uint8Array | null}} ClassProgress
 */
/**
 * The calls of the tool for students. `text` is the value of `x` in a link. `pixels`: 512 by 512, 1 for ink of both, 2
 * for missing ink, 4 for ink that is too much.
 * @typedef {{
 *     variantOf: {asked: {text: string, student: string}, answer: import('./messages.js').VariantReport},
 *     open: {asked: {text: string}, answer: AboutExercise},
 *     picture: {asked: {text: string, width: number, height: number, ratio: number}, answer: Uint8Array<ArrayBuffer>},
 *     hint: {asked: {text: string, student: Definition}, answer: string | null},
 *     answer: {asked: {text: string}, answer: Definition | null},
 *     mark: {asked: {text: string, student: Definition}, answer: {mark: Mark, pixels: Uint8Array<ArrayBuffer>}},
 * }} CourseCalls
 */
/**
 * The calls of the tool for comparisons and single steps.
 * @typedef {{
 *     check: {asked: {definition: Definition, output: string}, answer: import('./messages.js').CheckReport},
 *     growth: {asked: {definition: Definition}, answer: import('./messages.js').GrowthReport},
 *     rows: {asked: {definition: Definition, n: number, start: string, count: number}, answer: StepRows},
 *     single: {asked: {definition: Definition, steps: number, rightmost: boolean}, answer: import('./messages.js').Single[]},
 *     trace: {asked: {definition: Definition, n: number, count: number}, answer: import('./messages.js').Trace},
 * }} StudyCalls
 */
/**
 * The calls of the tool for teachers.
 * @typedef {{
 *     variantsOf: {asked: {exercise: Exercise, varied: Varied[]}, answer: Definition[]},
 *     markClass: {asked: {exercise: string, text: string}, answer: {mistakes: MistakeReport[], csv: string}},
 *     write: {asked: {exercise: Exercise}, answer: string},
 * }} ClassCalls
 */
/** @typedef {import('./messages.js').FindQuestion} FindQuestion */
/** Levels of grey, row by row from above, 0 for black; `isStraight`: what a photograph shows, straightened. @typedef {{grey: Uint8Array, width: number, height: number, isStraight?: boolean}} FindPicture */
/** Where rules are searched: a picture or a string. @typedef {FindPicture | {text: string}} FindSource */
/** @typedef {import('./messages.js').Candidate} Candidate */
/** A system that a search tries before all others. @typedef {{name: string, definition: Definition}} NamedSystem */
/** A picture with the names of what of it was not drawn, with commas. @typedef {import('./find/ink.js').Grey & {leftOut: string}} DrawnPicture */
/** `work`: the systems of a picture that a search tried, or the symbols of a string that it read. @typedef {import('./messages.js').FindReport & {work: number, isMore: boolean}} FindReport */
/**
 * The calls of the tool that searches for rules. `begin` replaces the former search; `part` is which of `parts` searches
 * beside each other this one is. `search` goes on until `until` units of work are done in all, and its progress is a
 * report too. `compare` tells where the searched picture and a system differ (`differences.js`). `photograph` is what a
 * photograph shows, straightened; null if the picture is none.
 * @typedef {{
 *     begin: {asked: {source: FindSource, question: FindQuestion, part: number, parts: number, named: NamedSystem[]}, answer: null},
 *     compare: {asked: {definition: Definition}, answer: Uint8Array | null},
 *     search: {asked: {until: number}, answer: FindReport},
 *     svg: {asked: {bytes: Uint8Array<ArrayBuffer>}, answer: DrawnPicture},
 *     photograph: {asked: import('./find/ink.js').Grey, answer: DrawnPicture | null},
 *     outline: {asked: {bytes: Uint8Array<ArrayBuffer>}, answer: string | null},
 * }} FindCalls
 */
/** A film: a system with the view that it begins with, and the text of its tracks (docs/films.md). @typedef {{definition: Definition, view: View | null, camera: Camera | null, text: string}} Film */
/** @typedef {import('./messages.js').KeyObject} FilmKey */
/** @typedef {import('./messages.js').TrackObject} FilmTrack */
/** @typedef {import('./messages.js').ScriptObject} FilmScript */
/** @typedef {import('./messages.js').PresetObject} FilmPreset */
/** @typedef {import('./messages.js').SubjectObject} FilmSubject */
/**
 * The calls of the tool for films. `dive` is the text with a dive to a view about a segment, or to the segment in the
 * middle; the progress of a GIF is the number of finished frames, with the next bytes of the file.
 * @typedef {{
 *     read: {asked: {text: string}, answer: FilmScript},
 *     preset: {asked: {text: string, preset: FilmPreset}, answer: string},
 *     subjects: {asked: {definition: Definition}, answer: FilmSubject[]},
 *     frame: {asked: {film: Film, number: number, width: number, height: number}, answer: Uint8Array<ArrayBuffer>},
 *     dive: {asked: {film: Film, text: string, view: View | null}, answer: string | null},
 *     gif: {asked: {film: Film, script: FilmScript}, answer: null},
 * }} FilmCalls
 */
/** From the page to a tool: its wasm and the parts that join it, calls by name; a long one can be cancelled. @typedef {{type: 'init', wasm: WebAssembly.Module, parts: WebAssembly.Module[], words: Catalogue} | {type: 'ping'} | {type: 'cancel', id: number} | {type: 'call', id: number, call: string, asked: object}} ToTool */
/** From a tool to the page. `fatal`: the tool has crashed. @typedef {{type: 'pong'} | {type: 'answer', id: number, value: unknown} | {type: 'progress', id: number, value: unknown} | {type: 'refused', id: number, reason: unknown} | {type: 'fatal', id: number, reason: unknown}} FromTool */

/**
 * One end of a channel: sends messages `Out` and receives messages `In`.
 * @template Out, In
 * @typedef {{postMessage: {(message: Out, transfer: Transferable[]): void, (message: Out): void}, onmessage: ((event: MessageEvent<In>) => void) | null}} Channel
 */
