/** What the core knows and the page shows: written by `cargo xtask tables`, not by hand. */

/** What symbols do, by the name of the dialect in files: what it is called, and what it does in words. */
export const DIALECTS = /* @__PURE__ */ Object.freeze({
    'abop': { label: 'Algorithmic Beauty of Plants', help: 'F and G draw, f and g move; + and − turn, | turns round, [ and ] branch; ! thins and # thickens the stroke, ; and , step through the colours. { and } fill the polygon whose corners F, f and . mark, ● and ○ draw a disc and a circle. In space & and ^ pitch down and up, \\ and / roll left and right, and $ rolls upright. Other symbols do nothing.' },
    'every-letter': { label: 'Every letter draws', help: 'Every symbol draws one step, except + and −, which turn, and [ and ], which branch.' },
    'practical': { label: 'Practical: F and G draw', help: 'F and G draw; + turns left and − turns right, each by its own angle; in space > and < pitch down and up, & and ^ roll left and right; [ and ] branch. Other symbols do nothing.' },
    'lowercase': { label: 'Lower-case letters draw', help: 'Every lower-case letter draws; + turns left and takes the second colour, − turns right and takes the third; [ and ] branch.' },
    'axes': { label: 'Turns about axes', help: 'F draws; > and < turn left and right, v and ^ pitch up and down, + and − roll left and right: turns about the z, x and y axes of a turtle that goes along its y; [ and ] branch. Other symbols do nothing.' },
});

/** What the colour follows, by its name in files: what it is called, and a note. */
export const COLOURINGS = /* @__PURE__ */ Object.freeze({
    symbol: { label: 'colour symbols', help: '' },
    level: { label: 'branch level', help: 'First colour for the stem, next colour for its branches, and so on.' },
    generation: { label: 'generation', help: 'Colour by the iteration that made a symbol. A symbol that a rule copies keeps its generation.' },
    path: { label: 'distance along path', help: 'A gradient of all colours, from the first segment to the last.' },
    turn: { label: 'turns', help: 'First colour at the start, other colours after turns. Each branch restores the colour before it.' },
    density: { label: 'amount of ink', help: 'Where ink adds up: a gradient of all colours, from the least ink to the most.' },
    single: { label: 'one colour', help: '' },
});

/**
 * An L-system as its author wrote it.
 * @typedef {object} Definition
 * @property {string} title a title for people
 * @property {string} axiom the axiom
 * @property {string} rules productions and constants, one on each line
 * @property {number} iterations derivation steps
 * @property {number} angle degrees of a left turn, and of a right one unless it has an angle of its own
 * @property {number | null} rightAngle degrees of a right turn; as `angle` where it is missing
 * @property {number} seed the number that selects among random choices
 * @property {'abop' | 'every-letter' | 'practical' | 'lowercase' | 'axes'} dialect the table of what symbols do
 * @property {number | null} pitchDown degrees of pitching down; as `angle` where it is missing
 * @property {number | null} pitchUp degrees of pitching up; as pitching down where it is missing
 * @property {number | null} rollLeft degrees of rolling left; as `angle` where it is missing
 * @property {number | null} rollRight degrees of rolling right; as rolling left where it is missing
 * @property {number} heading the heading at the start, in degrees counter-clockwise from +x
 * @property {number} step the step length, in model units
 * @property {[number, number]} start where the turtle starts, in model units, x right and y up
 * @property {[number, number, number]} tropism the direction that branches bend towards: x, y, and z towards the viewer
 * @property {number} elasticity how easily branches bend, 0 for not at all
 * @property {[number, number]} sway the sway of branches in the wind: its strength, and its phase from 0 to 360, in degrees
 * @property {number} lengthFactor what every branch multiplies lengths by
 * @property {number} angleVariation how much angles differ at random, at most, in percent
 * @property {number} lengthVariation how much lengths differ at random, at most, in percent
 * @property {number} growth how far the last derivation step has grown
 * @property {string} overrides symbols that do something else than in the dialect, one on each line
 * @property {string} surfaces surfaces that symbols draw, one on each line: a letter, a colon, and the 16 control points of each Bezier patch, each point as its distances ahead, left and up
 * @property {string[]} palette the stroke colours
 * @property {'symbol' | 'single' | 'level' | 'turn' | 'generation' | 'path' | 'density'} colourBy what the colour follows
 * @property {boolean} paletteHolds whether by level and by generation the last colour stays where the palette ends
 * @property {[number, number]} turnColours by turn: the index in the palette, from 0, after a left and after a right turn
 * @property {string} background the colour behind the drawing
 * @property {number} width the stroke width, in steps
 * @property {number} widthFactor what every branch multiplies the width by
 * @property {boolean} tapers whether each line runs from its own width to the width with which its branch goes on
 * @property {number} minWidth the width of the thinnest line, in pixels
 * @property {number} maxWidth the width of the thickest line, in percent of the picture's longer side; 0 for no limit
 * @property {'auto' | 'solid' | 'density'} ink blending of overlapping strokes: opaque (`solid`), additive (`density`), or opaque but additive where strokes are finer than pixels (`auto`)
 * @property {number} hue by how many degrees the palette's hues are turned
 * @property {number} exposure brightness of additive blending, in stops: each doubles it
 * @property {boolean} shadows whether a drawing in space has soft shadows
 * @property {boolean} shapes whether the drawing has the outlines of the shapes in the rules, in a faint colour
 * @property {boolean} auto whether widths, and what the colour follows, are chosen after the system in place of the values given
 * @property {string} name a short name, unique within its folder
 * @property {string} source where the system was published
 * @property {string} notes what a reader should know
 */

/**
 * What a number may be, and in words; `whole` where it has no fraction.
 * @typedef {{kind: 'number', low: number, high: number, whole?: boolean, expected?: string}} NumberRange
 */

/**
 * What a value may be.
 * @typedef {NumberRange | {kind: 'flag' | 'colour'} | {kind: 'text' | 'colours', maxLength: number} | {kind: 'word', words: readonly string[]} | {kind: 'list', count: number, each: NumberRange} | {kind: 'record', members: Readonly<Record<string, NumberRange | {kind: 'flag'} | {kind: 'text', maxLength: number}>>}} Range
 */

/**
 * A field of the state: its key in links, its default, what it must be in words, what the page calls it, the values
 * under its slider (up to which value they are how far apart) and what an arrow key adds, and what has to be made anew where it changes.
 * @typedef {Range & {link: string, optional?: boolean, default: unknown, label: string, expected: string, unit?: string, slider?: {from: number, parts: readonly (readonly number[])[], arrow: number}, affects: string}} FieldSpec
 */

/** @typedef {keyof Definition | 'view' | 'camera'} FieldName */

/** The fields of the state by name, in the order in which links write them. @type {Readonly<Record<FieldName, FieldSpec>>} */
export const FIELDS = /* @__PURE__ */ Object.freeze({
    title: { link: 'title', kind: 'text', maxLength: 200, default: '', label: 'Title', expected: 'a text of at most 200 characters', affects: 'caption' },
    axiom: { link: 'axiom', kind: 'text', maxLength: 1048576, default: '', label: 'Axiom', expected: 'a text of at most 1,048,576 characters', affects: 'drawing' },
    rules: { link: 'rules', kind: 'text', maxLength: 50000, default: '', label: 'Rules', expected: 'a text of at most 50,000 characters', affects: 'drawing' },
    iterations: { link: 'n', kind: 'number', low: 0, high: 1000, whole: true, default: 1, label: 'Iterations', expected: 'a whole number from 0 to 1,000', unit: 'iterations', slider: { from: 0, parts: [[24, 1], [40, 2], [100, 5], [120, 20], [150, 30], [200, 50], [300, 100], [700, 200], [1000, 300]], arrow: 1 }, affects: 'drawing' },
    angle: { link: 'angle', kind: 'number', low: -Infinity, high: Infinity, default: 0, label: 'Angle', expected: 'a number', unit: 'degrees', slider: { from: 0, parts: [[180, 0.5]], arrow: 1 }, affects: 'drawing' },
    rightAngle: { link: 'right', kind: 'number', low: -Infinity, high: Infinity, optional: true, default: null, label: 'Right turns', expected: 'a number or nothing', unit: 'degrees', slider: { from: 0, parts: [[180, 0.5]], arrow: 1 }, affects: 'drawing' },
    seed: { link: 'seed', kind: 'number', low: 0, high: 4294967295, whole: true, default: 0, label: 'Seed', expected: 'a whole number from 0 to 4,294,967,295', affects: 'drawing' },
    dialect: { link: 'turtle', kind: 'word', words: ['abop', 'every-letter', 'practical', 'lowercase', 'axes'], default: 'abop', label: 'Dialect', expected: 'one of `abop`, `every-letter`, `practical`, `lowercase`, `axes`', affects: 'drawing' },
    pitchDown: { link: 'down', kind: 'number', low: -Infinity, high: Infinity, optional: true, default: null, label: 'Pitch down', expected: 'a number or nothing', unit: 'degrees', affects: 'drawing' },
    pitchUp: { link: 'up', kind: 'number', low: -Infinity, high: Infinity, optional: true, default: null, label: 'Pitch up', expected: 'a number or nothing', unit: 'degrees', affects: 'drawing' },
    rollLeft: { link: 'roll', kind: 'number', low: -Infinity, high: Infinity, optional: true, default: null, label: 'Roll left', expected: 'a number or nothing', unit: 'degrees', affects: 'drawing' },
    rollRight: { link: 'rollright', kind: 'number', low: -Infinity, high: Infinity, optional: true, default: null, label: 'Roll right', expected: 'a number or nothing', unit: 'degrees', affects: 'drawing' },
    heading: { link: 'heading', kind: 'number', low: -Infinity, high: Infinity, default: 90, label: 'Heading', expected: 'a number', unit: 'degrees', affects: 'drawing' },
    step: { link: 'step', kind: 'number', low: 1e-9, high: 1000000000, default: 1, label: 'Step', expected: 'a number from 1e-9 to 1,000,000,000', affects: 'drawing' },
    start: { link: 'start', kind: 'list', count: 2, each: { kind: 'number', low: -1000000000, high: 1000000000, expected: 'a number from -1,000,000,000 to 1,000,000,000' }, default: [0, 0], label: 'Start of the turtle', expected: 'a list of 2 values, each a number from -1,000,000,000 to 1,000,000,000', affects: 'drawing' },
    tropism: { link: 'tropism', kind: 'list', count: 3, each: { kind: 'number', low: -1000, high: 1000, expected: 'a number from -1,000 to 1,000' }, default: [0, -1, 0], label: 'Tropism', expected: 'a list of 3 values, each a number from -1,000 to 1,000', affects: 'drawing' },
    elasticity: { link: 'elasticity', kind: 'number', low: -1000, high: 1000, default: 0, label: 'Elasticity', expected: 'a number from -1,000 to 1,000', affects: 'drawing' },
    sway: { link: 'sway', kind: 'list', count: 2, each: { kind: 'number', low: -3600, high: 3600, expected: 'a number from -3,600 to 3,600' }, default: [0, 0], label: 'Sway', expected: 'a list of 2 values, each a number from -3,600 to 3,600', affects: 'drawing' },
    lengthFactor: { link: 'shorter', kind: 'number', low: 0, high: 10, default: 1, label: 'Branch length ×', expected: 'a number from 0 to 10', unit: 'times', slider: { from: 0, parts: [[2, 0.05]], arrow: 0.05 }, affects: 'drawing' },
    angleVariation: { link: 'vary', kind: 'number', low: 0, high: 100, default: 0, label: 'Angle variation', expected: 'a number from 0 to 100', unit: 'percent', slider: { from: 0, parts: [[30, 1], [100, 5]], arrow: 1 }, affects: 'drawing' },
    lengthVariation: { link: 'varylength', kind: 'number', low: 0, high: 100, default: 0, label: 'Length variation', expected: 'a number from 0 to 100', unit: 'percent', slider: { from: 0, parts: [[30, 1], [100, 5]], arrow: 1 }, affects: 'drawing' },
    growth: { link: 'growth', kind: 'number', low: 0, high: 1, default: 1, label: 'Growth', expected: 'a number from 0 to 1', affects: 'drawing' },
    overrides: { link: 'do', kind: 'text', maxLength: 20000, default: '', label: 'Custom symbols', expected: 'a text of at most 20,000 characters', affects: 'drawing' },
    surfaces: { link: 'surfaces', kind: 'text', maxLength: 20000, default: '', label: 'Surfaces', expected: 'a text of at most 20,000 characters', affects: 'drawing' },
    palette: { link: 'palette', kind: 'colours', maxLength: 256, default: ['#1f5c3a', '#5f8f2f', '#b58b1e', '#b4532a', '#8c2f4b'], label: 'Colours', expected: 'a list of 1 to 256 colours such as "#1f5c3a"', affects: 'look' },
    colourBy: { link: 'colour', kind: 'word', words: ['symbol', 'single', 'level', 'turn', 'generation', 'path', 'density'], default: 'symbol', label: 'Colour by', expected: 'one of `symbol`, `single`, `level`, `turn`, `generation`, `path`, `density`', affects: 'look' },
    paletteHolds: { link: 'hold', kind: 'flag', default: false, label: 'Stay at the last colour', expected: 'true or false', affects: 'look' },
    turnColours: { link: 'turns', kind: 'list', count: 2, each: { kind: 'number', low: -2147483648, high: 2147483647, whole: true, expected: 'a whole number from -2,147,483,648 to 2,147,483,647' }, default: [1, 2], label: 'Colour number after a turn', expected: 'a list of 2 values, each a whole number from -2,147,483,648 to 2,147,483,647', affects: 'look' },
    background: { link: 'bg', kind: 'colour', default: '#fbfaf5', label: 'Background', expected: 'a colour such as "#1f5c3a"', affects: 'look' },
    width: { link: 'width', kind: 'number', low: 0, high: 1000000000, default: 0, label: 'Stroke width (steps)', expected: 'a number from 0 to 1,000,000,000', unit: 'steps', slider: { from: 0, parts: [[1, 0.05], [3, 0.1], [10, 0.25], [20, 0.5]], arrow: 0.1 }, affects: 'look' },
    widthFactor: { link: 'thinner', kind: 'number', low: 0, high: 10, default: 1, label: 'Width per branch level ×', expected: 'a number from 0 to 10', unit: 'times', slider: { from: 0, parts: [[2, 0.05]], arrow: 0.05 }, affects: 'look' },
    tapers: { link: 'taper', kind: 'flag', default: true, label: 'Tapered lines', expected: 'true or false', affects: 'look' },
    minWidth: { link: 'thin', kind: 'number', low: 0, high: 10000, default: 1, label: 'Thinnest line', expected: 'a number from 0 to 10,000', unit: 'pixels', slider: { from: 0, parts: [[8, 0.25]], arrow: 0.5 }, affects: 'look' },
    maxWidth: { link: 'thick', kind: 'number', low: 0, high: 100, default: 2, label: 'Thickest line (%)', expected: 'a number from 0 to 100', unit: 'percent', slider: { from: 0, parts: [[4, 0.25], [20, 1]], arrow: 0.5 }, affects: 'look' },
    ink: { link: 'ink', kind: 'word', words: ['auto', 'solid', 'density'], default: 'auto', label: 'Blending', expected: 'one of `auto`, `solid`, `density`', affects: 'look' },
    hue: { link: 'hue', kind: 'number', low: -360, high: 360, default: 0, label: 'Hue', expected: 'a number from -360 to 360', unit: 'degrees', slider: { from: 0, parts: [[360, 5]], arrow: 5 }, affects: 'look' },
    exposure: { link: 'exposure', kind: 'number', low: -10, high: 10, default: 0, label: 'Exposure (stops)', expected: 'a number from -10 to 10', unit: 'stops', slider: { from: -4, parts: [[4, 0.25]], arrow: 0.25 }, affects: 'look' },
    shadows: { link: 'shadows', kind: 'flag', default: true, label: 'Shadows', expected: 'true or false', affects: 'look' },
    shapes: { link: 'shapes', kind: 'flag', default: true, label: 'Shapes', expected: 'true or false', affects: 'drawing' },
    auto: { link: 'auto', kind: 'flag', default: false, label: 'Automatic look', expected: 'true or false', affects: 'look' },
    name: { link: 'name', kind: 'text', maxLength: 200, default: '', label: 'Name', expected: 'a text of at most 200 characters', affects: 'caption' },
    source: { link: 'source', kind: 'text', maxLength: 1000, default: '', label: 'Source', expected: 'a text of at most 1,000 characters', affects: 'caption' },
    notes: { link: 'notes', kind: 'text', maxLength: 10000, default: '', label: 'Notes', expected: 'a text of at most 10,000 characters', affects: 'caption' },
    view: { link: 'view', kind: 'record', members: { x: { kind: 'number', low: -1000000, high: 1000000 }, y: { kind: 'number', low: -1000000, high: 1000000 }, zoom: { kind: 'number', low: 0.01, high: 1e301 }, fx: { kind: 'number', low: -1, high: 1 }, fy: { kind: 'number', low: -1, high: 1 }, at: { kind: 'text', maxLength: 3001 } }, optional: true, default: null, label: 'View', expected: 'an object of x, y, zoom, fx, fy, at or nothing', affects: 'look' },
    camera: { link: 'camera', kind: 'record', members: { azimuth: { kind: 'number', low: -360, high: 360 }, elevation: { kind: 'number', low: -90, high: 90 }, zoom: { kind: 'number', low: 0.01, high: 10000 }, x: { kind: 'number', low: -100, high: 100 }, y: { kind: 'number', low: -100, high: 100 }, z: { kind: 'number', low: -100, high: 100 }, perspective: { kind: 'flag' }, fade: { kind: 'number', low: 0, high: 1 } }, optional: true, default: null, label: 'Camera', expected: 'an object of azimuth, elevation, zoom, x, y, z, perspective, fade or nothing', affects: 'look' },
});

/** Attributes of the element and the keys in links that they stand for. */
export const ATTRIBUTES = { caption: 'title', axiom: 'axiom', rules: 'rules', n: 'n', angle: 'angle', right: 'right', seed: 'seed', turtle: 'turtle', down: 'down', up: 'up', roll: 'roll', rollright: 'rollright', heading: 'heading', step: 'step', start: 'start', tropism: 'tropism', elasticity: 'elasticity', sway: 'sway', shorter: 'shorter', vary: 'vary', varylength: 'varylength', growth: 'growth', do: 'do', surfaces: 'surfaces', palette: 'palette', colour: 'colour', hold: 'hold', turns: 'turns', bg: 'bg', stroke: 'width', thinner: 'thinner', taper: 'taper', thin: 'thin', thick: 'thick', ink: 'ink', hue: 'hue', exposure: 'exposure', shadows: 'shadows', shapes: 'shapes', auto: 'auto', name: 'name', source: 'source', notes: 'notes', view: 'view', camera: 'camera' };
