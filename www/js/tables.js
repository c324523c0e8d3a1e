/** What the core knows and the page shows: written by `cargo xtask tables`, not by hand. */

/** What symbols do, by the name of the dialect in files: what it is called, and what it does in words. */
export const DIALECTS = /* @__PURE__ */ Object.freeze({
    'abop': { label: 'Algorithmic Beauty of Plants', help: 'F and G draw, f and g move; + and − turn, | turns round, [ and ] branch; ! thins and # thickens the stroke, ; and , step through the colours. { and } fill the polygon whose corners F, f and . mark, ● and ○ draw a disc and a circle. In space & and ^ pitch down and up, \\ and / roll left and right, and $ rolls upright. Other symbols do nothing.' },
    'every-letter': { label: 'Every letter draws', help: 'Every symbol draws one step, except + and −, which turn, and [ and ], which branch.' },
    'practical': { label: 'Practical: F and G draw', help: 'F and G draw; + turns left and − turns right, each by its own angle; in space > and < pitch down and up, & and ^ roll left and right; [ and ] branch. Other symbols do nothing.' },
    'lowercase': { label: 'Lower-case letters draw', help: 'Every lower-case letter draws; + turns left and takes the second colour, − turns right and takes the third; [ and ] branch.' },
    'axes': { label: 'Turns about axes', help: 'F draws; > and < turn left and right, v and ^ pitch up and down, + and − roll left and right: turns about the z, x and y axes of a turtle that goes along its y; [ and ] branch. Other symbols do nothing.' },
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
 * @property {number} lengthFactor what every branch multiplies lengths by
 * @property {number} angleVariation how much angles differ at random, at most, in percent
 * @property {number} lengthVariation how much lengths differ at random, at most, in percent
 * @property {number} growth how far the last derivation step has grown
 * @property {string} overrides symbols that do something else than in the dialect, one on each line
 * @property {string[]} palette the stroke colours
 * @property {'symbol' | 'single' | 'level' | 'turn' | 'generation' | 'path' | 'density'} colourBy what the colour follows
 * @property {boolean} paletteHolds whether by level and by generation the last colour stays where the palette ends
 * @property {[number, number]} turnColours by turn: the index in the palette, from 0, after a left and after a right turn
 * @property {string} background the colour behind the drawing
 * @property {number} width the stroke width, in steps
 * @property {number} widthFactor what every branch multiplies the width by
 * @property {number} minWidth the width of the thinnest line, in pixels
 * @property {'solid' | 'density'} ink blending of overlapping strokes: opaque (`solid`) or additive (`density`)
 * @property {number} hue by how many degrees the palette's hues are turned
 * @property {number} exposure brightness of additive blending, in stops: each doubles it
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
 * @typedef {NumberRange | {kind: 'flag' | 'colour'} | {kind: 'text' | 'colours', maxLength: number} | {kind: 'word', words: readonly string[]} | {kind: 'list', count: number, each: NumberRange} | {kind: 'record', members: Readonly<Record<string, NumberRange | {kind: 'flag'}>>}} Range
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
    axiom: { link: 'axiom', kind: 'text', maxLength: 20000, default: '', label: 'Axiom', expected: 'a text of at most 20,000 characters', affects: 'drawing' },
    rules: { link: 'rules', kind: 'text', maxLength: 50000, default: '', label: 'Productions', expected: 'a text of at most 50,000 characters', affects: 'drawing' },
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
    lengthFactor: { link: 'shorter', kind: 'number', low: 0, high: 10, default: 1, label: 'Branch length ×', expected: 'a number from 0 to 10', unit: 'times', slider: { from: 0, parts: [[2, 0.05]], arrow: 0.05 }, affects: 'drawing' },
    angleVariation: { link: 'vary', kind: 'number', low: 0, high: 100, default: 0, label: 'Angle variation', expected: 'a number from 0 to 100', unit: 'percent', slider: { from: 0, parts: [[30, 1], [100, 5]], arrow: 1 }, affects: 'drawing' },
    lengthVariation: { link: 'varylength', kind: 'number', low: 0, high: 100, default: 0, label: 'Length variation', expected: 'a number from 0 to 100', unit: 'percent', slider: { from: 0, parts: [[30, 1], [100, 5]], arrow: 1 }, affects: 'drawing' },
    growth: { link: 'growth', kind: 'number', low: 0, high: 1, default: 1, label: 'Growth', expected: 'a number from 0 to 1', affects: 'drawing' },
    overrides: { link: 'do', kind: 'text', maxLength: 20000, default: '', label: 'Custom symbols', expected: 'a text of at most 20,000 characters', affects: 'drawing' },
    palette: { link: 'palette', kind: 'colours', maxLength: 256, default: ['#1f5c3a', '#5f8f2f', '#b58b1e', '#b4532a', '#8c2f4b'], label: 'Colours', expected: 'a list of 1 to 256 colours such as "#1f5c3a"', affects: 'look' },
    colourBy: { link: 'colour', kind: 'word', words: ['symbol', 'single', 'level', 'turn', 'generation', 'path', 'density'], default: 'symbol', label: 'Colour by', expected: 'one of `symbol`, `single`, `level`, `turn`, `generation`, `path`, `density`', affects: 'look' },
    paletteHolds: { link: 'hold', kind: 'flag', default: false, label: 'Stay at the last colour', expected: 'true or false', affects: 'look' },
    turnColours: { link: 'turns', kind: 'list', count: 2, each: { kind: 'number', low: -2147483648, high: 2147483647, whole: true, expected: 'a whole number from -2,147,483,648 to 2,147,483,647' }, default: [1, 2], label: 'Colour number after a turn', expected: 'a list of 2 values, each a whole number from -2,147,483,648 to 2,147,483,647', affects: 'look' },
    background: { link: 'bg', kind: 'colour', default: '#fbfaf5', label: 'Background', expected: 'a colour such as "#1f5c3a"', affects: 'look' },
    width: { link: 'width', kind: 'number', low: 0, high: 1000000000, default: 0, label: 'Stroke width (steps)', expected: 'a number from 0 to 1,000,000,000', unit: 'steps', slider: { from: 0, parts: [[1, 0.05], [3, 0.1], [10, 0.25], [20, 0.5]], arrow: 0.1 }, affects: 'look' },
    widthFactor: { link: 'thinner', kind: 'number', low: 0, high: 10, default: 1, label: 'Width per branch level ×', expected: 'a number from 0 to 10', unit: 'times', slider: { from: 0, parts: [[2, 0.05]], arrow: 0.05 }, affects: 'look' },
    minWidth: { link: 'thin', kind: 'number', low: 0, high: 10000, default: 1, label: 'Thinnest line', expected: 'a number from 0 to 10,000', unit: 'pixels', slider: { from: 0, parts: [[8, 0.25]], arrow: 0.5 }, affects: 'look' },
    ink: { link: 'ink', kind: 'word', words: ['solid', 'density'], default: 'solid', label: 'Blending', expected: 'one of `solid`, `density`', affects: 'look' },
    hue: { link: 'hue', kind: 'number', low: -360, high: 360, default: 0, label: 'Hue', expected: 'a number from -360 to 360', unit: 'degrees', slider: { from: 0, parts: [[360, 5]], arrow: 5 }, affects: 'look' },
    exposure: { link: 'exposure', kind: 'number', low: -10, high: 10, default: 0, label: 'Exposure (stops)', expected: 'a number from -10 to 10', unit: 'stops', slider: { from: -4, parts: [[4, 0.25]], arrow: 0.25 }, affects: 'look' },
    name: { link: 'name', kind: 'text', maxLength: 200, default: '', label: 'Name', expected: 'a text of at most 200 characters', affects: 'caption' },
    source: { link: 'source', kind: 'text', maxLength: 1000, default: '', label: 'Source', expected: 'a text of at most 1,000 characters', affects: 'caption' },
    notes: { link: 'notes', kind: 'text', maxLength: 10000, default: '', label: 'Notes', expected: 'a text of at most 10,000 characters', affects: 'caption' },
    view: { link: 'view', kind: 'record', members: { x: { kind: 'number', low: -1000000, high: 1000000 }, y: { kind: 'number', low: -1000000, high: 1000000 }, zoom: { kind: 'number', low: 0.01, high: 1e25 }, fx: { kind: 'number', low: -1, high: 1 }, fy: { kind: 'number', low: -1, high: 1 } }, optional: true, default: null, label: 'View', expected: 'an object of x, y, zoom, fx, fy or nothing', affects: 'look' },
    camera: { link: 'camera', kind: 'record', members: { azimuth: { kind: 'number', low: -360, high: 360 }, elevation: { kind: 'number', low: -90, high: 90 }, zoom: { kind: 'number', low: 0.01, high: 10000 }, x: { kind: 'number', low: -100, high: 100 }, y: { kind: 'number', low: -100, high: 100 }, z: { kind: 'number', low: -100, high: 100 }, perspective: { kind: 'flag' }, fade: { kind: 'number', low: 0, high: 1 } }, optional: true, default: null, label: 'Camera', expected: 'an object of azimuth, elevation, zoom, x, y, z, perspective, fade or nothing', affects: 'look' },
});

/** Attributes of the element and the keys in links that they stand for. */
export const ATTRIBUTES = { caption: 'title', axiom: 'axiom', rules: 'rules', n: 'n', angle: 'angle', right: 'right', seed: 'seed', turtle: 'turtle', down: 'down', up: 'up', roll: 'roll', rollright: 'rollright', heading: 'heading', step: 'step', start: 'start', tropism: 'tropism', elasticity: 'elasticity', shorter: 'shorter', vary: 'vary', varylength: 'varylength', growth: 'growth', do: 'do', palette: 'palette', colour: 'colour', hold: 'hold', turns: 'turns', bg: 'bg', stroke: 'width', thinner: 'thinner', thin: 'thin', ink: 'ink', hue: 'hue', exposure: 'exposure', name: 'name', source: 'source', notes: 'notes', view: 'view', camera: 'camera' };

/** Formats of exported files by name: ending and media type of the file, what the page calls it, and what it is. */
export const FORMATS = /* @__PURE__ */ Object.freeze({
    'svg': { ending: 'svg', mime: 'image/svg+xml', label: 'SVG', help: 'Picture of strokes', picture: true, purposes: ['screen'], content: 'strokes', options: ['transparent', 'bare'] },
    'svg-compact': { ending: 'svg', mime: 'image/svg+xml', label: 'Compact SVG', help: 'Picture of strokes with each reusable part written once: a small file at any number of iterations', picture: true, purposes: ['screen'], content: 'strokes', options: ['transparent', 'bare'] },
    'plotter': { ending: 'svg', mime: 'image/svg+xml', label: 'Plotter SVG', help: 'Lines for a pen plotter, in millimetres: a layer for each colour, drawn once, with little travel', picture: true, purposes: ['plotter'], content: 'strokes', options: ['sheet', 'portrait', 'landscape', 'margin', 'pen', 'hatch', 'start', 'min-length', 'speed', 'travel-speed', 'lift'] },
    'png': { ending: 'png', mime: 'image/png', label: 'PNG', help: 'Picture of pixels', picture: true, purposes: ['screen', 'print'], content: 'pixels', options: ['size', 'dpi', 'transparent', 'bare'] },
    'pdf': { ending: 'pdf', mime: 'application/pdf', label: 'PDF', help: 'Page of strokes', picture: true, purposes: ['paper'], content: 'strokes', options: ['sheet', 'landscape', 'margin', 'whole-sheet', 'bare'] },
    'tikz': { ending: 'tikz', mime: 'text/x-tex', label: 'TikZ', help: 'Picture of strokes for LaTeX', picture: true, purposes: ['paper'], content: 'strokes', options: [] },
    'tikz-library': { ending: 'tikz', mime: 'text/x-tex', label: 'TikZ L-system', help: 'System for TikZ\'s library lindenmayersystems, which draws simple systems while LaTeX runs', picture: false, purposes: ['paper'], content: 'words', options: [] },
    'latex': { ending: 'tex', mime: 'text/x-tex', label: 'LaTeX', help: 'System typeset as in books: axiom, productions, constants and angles', picture: false, purposes: ['paper'], content: 'words', options: [] },
    'markdown': { ending: 'md', mime: 'text/markdown', label: 'Markdown', help: 'System as a list: axiom, productions, constants and angles', picture: false, purposes: ['paper'], content: 'words', options: [] },
    'bibtex': { ending: 'bib', mime: 'text/x-bibtex', label: 'BibTeX', help: 'Entries of the system\'s source and of its picture', picture: false, purposes: ['paper'], content: 'words', options: [] },
    'json': { ending: 'json', mime: 'application/json', label: 'JSON', help: 'System, to open again', picture: false, purposes: ['data'], content: 'system', options: [] },
    'txt': { ending: 'txt', mime: 'text/plain', label: 'Text', help: 'Derived string', picture: false, purposes: ['data'], content: 'string', options: [] },
    'csv': { ending: 'csv', mime: 'text/csv', label: 'CSV', help: 'Segments as a table: x0,y0,x1,y1,level,colour; in space x0,y0,z0,x1,y1,z1,level,colour', picture: false, purposes: ['data'], content: 'segments', options: [] },
    'obj': { ending: 'obj', mime: 'model/obj', label: 'OBJ', help: 'Mesh of coloured tubes, as text', picture: false, purposes: ['mesh'], content: 'mesh', options: ['finest'] },
    'glb': { ending: 'glb', mime: 'model/gltf-binary', label: 'glTF', help: 'Tubes and leaves with materials, as binary glTF: each reusable part is written once, for viewers and game engines', picture: false, purposes: ['mesh'], content: 'mesh', options: ['finest'] },
    'stl': { ending: 'stl', mime: 'model/stl', label: 'STL', help: 'Mesh of closed tubes and slabs for printers, 100 mm long', picture: false, purposes: ['mesh'], content: 'mesh', options: ['finest'] },
});

/** Notations that systems are written in, by name: what the page calls them, what they are, and the ending of files. */
export const NOTATIONS = /* @__PURE__ */ Object.freeze({
    'text': { label: 'Text', help: 'Labelled lines, as in papers, where our reader makes the same system of them', ending: 'txt' },
    'latex': { label: 'LaTeX', help: 'Table for a paper, as in The Algorithmic Beauty of Plants', ending: 'tex' },
    'tikz': { label: 'TikZ', help: 'Picture by the library lindenmayersystems, in one colour, of at most 100,000 symbols', ending: 'tex' },
    'python': { label: 'Python turtle', help: 'Program that draws with the standard module turtle', ending: 'py' },
    'p5': { label: 'p5.js sketch', help: 'Sketch that derives and draws, for the editor of p5.js', ending: 'js' },
    'js': { label: 'JavaScript object', help: 'Object for JavaScript packages: F and G draw, f moves, + and - turn by one angle, and the first heading is up', ending: 'js' },
    'fractint': { label: 'Fractint', help: 'Entry of a file, of at most 25 rules and lines of 250 characters; without the number of iterations', ending: 'l' },
    'inkscape': { label: 'Inkscape', help: 'Lines for the dialog Extensions > Render > L-system, with headings that its angles reach from upwards', ending: 'txt' },
    'houdini': { label: 'Houdini', help: 'Lines of the L-system node, with numbers as in its own symbols', ending: 'txt' },
    'cpfg': { label: 'cpfg', help: 'File with the angles as numbers; circles only filled', ending: 'l' },
    'lpy': { label: 'L-Py', help: 'Arrow rules with the angles as numbers, arithmetic without functions and powers', ending: 'lpy' },
    'anvaka': { label: 'anvaka’s page', help: 'Text for anvaka’s page, with one action for each symbol', ending: 'txt' },
});

/** What files are for, in the order of the page's dialog, with labels. */
export const PURPOSES = /* @__PURE__ */ Object.freeze({
    screen: 'Screen',
    film: 'Film',
    plotter: 'Plotter',
    paper: 'Paper',
    print: 'Print',
    mesh: '3D',
    data: 'Data',
});

/**
 * A choice for files: its values and its default, what the page calls it, and what it is.
 * @typedef {{label: string, help: string, unit: string} & ({kind: 'flag'} | {kind: 'number', low: number, high: number, step: number, default: number} | {kind: 'word', words: Readonly<Record<string, string>>, default: string} | {kind: 'size', most: number} | {kind: 'sheet', words: Readonly<Record<string, string>>, default: string, low: number, high: number})} FileOption
 */

/** Choices for files by name; each format lists those that it reads. @type {Readonly<Record<string, FileOption>>} */
export const FILE_OPTIONS = /* @__PURE__ */ Object.freeze({
    'size': { kind: 'size', most: 32768, label: 'Size', help: 'Width and height of a picture', unit: 'pixels' },
    'dpi': { kind: 'number', low: 0, high: 100000, step: 1, default: 0, label: 'Resolution', help: 'Pixels of an inch on paper, told in the file; 0 for none', unit: 'pixels per inch' },
    'transparent': { kind: 'flag', label: 'Transparent background', help: 'Leave the background out', unit: '' },
    'sheet': { kind: 'sheet', words: { 'a5': 'A5', 'a4': 'A4', 'a3': 'A3', 'a2': 'A2', 'a1': 'A1', 'letter': 'Letter', 'legal': 'Legal', 'tabloid': 'Tabloid' }, default: 'a4', low: 10, high: 10000, label: 'Sheet', help: 'Size of the paper', unit: '' },
    'portrait': { kind: 'flag', label: 'Portrait', help: 'Keep a plot\'s sheet upright, even if the drawing is larger on its side', unit: '' },
    'landscape': { kind: 'flag', label: 'Landscape', help: 'Turn the sheet, so that it is wider than tall', unit: '' },
    'margin': { kind: 'number', low: 0, high: 100, step: 1, default: 10, label: 'Margin', help: 'Margin on every side of the sheet', unit: 'mm' },
    'pen': { kind: 'number', low: 0.05, high: 20, step: 0.05, default: 0.3, label: 'Pen width', help: 'Width of the pen\'s line; smaller parts of the drawing become one stroke', unit: 'mm' },
    'hatch': { kind: 'flag', label: 'Hatch', help: 'Fill polygons and broad strokes with lines', unit: '' },
    'start': { kind: 'word', words: { 'top-left': 'Top left', 'top-right': 'Top right', 'bottom-left': 'Bottom left', 'bottom-right': 'Bottom right' }, default: 'top-left', label: 'Start corner', help: 'Corner where each pen starts and ends', unit: '' },
    'min-length': { kind: 'number', low: 0, high: 1000, step: 0.1, default: 0, label: 'Shortest line', help: 'Length under which lines are left out', unit: 'mm' },
    'speed': { kind: 'number', low: 0.1, high: 10000, step: 1, default: 50, label: 'Drawing speed', help: 'Speed of the lowered pen, for the estimate of time', unit: 'mm/s' },
    'travel-speed': { kind: 'number', low: 0.1, high: 10000, step: 1, default: 150, label: 'Travel speed', help: 'Speed of the raised pen, for the estimate of time', unit: 'mm/s' },
    'lift': { kind: 'number', low: 0, high: 60, step: 0.1, default: 0.2, label: 'Lift time', help: 'Seconds to raise and lower the pen, for the estimate of time', unit: 's' },
    'whole-sheet': { kind: 'flag', label: 'Whole sheet', help: 'Fill the sheet, instead of ending the page at the edge of the drawing', unit: '' },
    'finest': { kind: 'number', low: 0, high: 20, step: 0.1, default: 0, label: 'Finest part', help: 'Size under which parts become one tube, in percent of the longest side (in STL, 1 % is 1 mm); 0 keeps all', unit: '%' },
    'bare': { kind: 'flag', label: 'Leave the system out', help: 'Leave the system out of the file; the file cannot be opened again as a system', unit: '' },
});

/** Sheets of paper in portrait by name: width and height in millimetres. */
export const SHEETS = /* @__PURE__ */ Object.freeze({
    a5: [148, 210],
    a4: [210, 297],
    a3: [297, 420],
    a2: [420, 594],
    a1: [594, 841],
    letter: [215.9, 279.4],
    legal: [215.9, 355.6],
    tabloid: [279.4, 431.8],
});
