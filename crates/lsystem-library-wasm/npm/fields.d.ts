// Fields, formats and options: written by `cargo xtask tables` from the tables of the core, not by hand.

/** All fields of a system. */
export interface Fields {
    /** a title for people: a text of at most 200 characters */
    title: string;
    /** the axiom: a text of at most 1,048,576 characters */
    axiom: string;
    /** productions and constants, one on each line: a text of at most 50,000 characters */
    rules: string;
    /** derivation steps: a whole number from 0 to 1,000 */
    iterations: number;
    /** degrees of a left turn, and of a right one unless it has an angle of its own: a number */
    angle: number;
    /** degrees of a right turn; as `angle` where it is missing: a number or nothing */
    rightAngle: number | null;
    /** the number that selects among random choices: a whole number from 0 to 4,294,967,295 */
    seed: number;
    /** the table of what symbols do: one of `abop`, `every-letter`, `practical`, `lowercase`, `axes` */
    dialect: 'abop' | 'every-letter' | 'practical' | 'lowercase' | 'axes';
    /** degrees of pitching down; as `angle` where it is missing: a number or nothing */
    pitchDown: number | null;
    /** degrees of pitching up; as pitching down where it is missing: a number or nothing */
    pitchUp: number | null;
    /** degrees of rolling left; as `angle` where it is missing: a number or nothing */
    rollLeft: number | null;
    /** degrees of rolling right; as rolling left where it is missing: a number or nothing */
    rollRight: number | null;
    /** the heading at the start, in degrees counter-clockwise from +x: a number */
    heading: number;
    /** the step length, in model units: a number from 1e-9 to 1,000,000,000 */
    step: number;
    /** where the turtle starts, in model units, x right and y up: a list of 2 values, each a number from -1,000,000,000 to 1,000,000,000 */
    start: [number, number];
    /** the direction that branches bend towards: x, y, and z towards the viewer: a list of 3 values, each a number from -1,000 to 1,000 */
    tropism: [number, number, number];
    /** how easily branches bend, 0 for not at all: a number from -1,000 to 1,000 */
    elasticity: number;
    /** the sway of branches in the wind: its strength, and its phase from 0 to 360, in degrees: a list of 2 values, each a number from -3,600 to 3,600 */
    sway: [number, number];
    /** what every branch multiplies lengths by: a number from 0 to 10 */
    lengthFactor: number;
    /** how much angles differ at random, at most, in percent: a number from 0 to 100 */
    angleVariation: number;
    /** how much lengths differ at random, at most, in percent: a number from 0 to 100 */
    lengthVariation: number;
    /** how far the last derivation step has grown: a number from 0 to 1 */
    growth: number;
    /** symbols that do something else than in the dialect, one on each line: a text of at most 20,000 characters */
    overrides: string;
    /** surfaces that symbols draw, one on each line: a letter, a colon, and the 16 control points of each Bezier patch, each point as its distances ahead, left and up: a text of at most 20,000 characters */
    surfaces: string;
    /** the stroke colours: a list of 1 to 256 colours such as "#1f5c3a" */
    palette: string[];
    /** what the colour follows: one of `symbol`, `single`, `level`, `turn`, `generation`, `path`, `density` */
    colourBy: 'symbol' | 'single' | 'level' | 'turn' | 'generation' | 'path' | 'density';
    /** whether by level and by generation the last colour stays where the palette ends: true or false */
    paletteHolds: boolean;
    /** by turn: the index in the palette, from 0, after a left and after a right turn: a list of 2 values, each a whole number from -2,147,483,648 to 2,147,483,647 */
    turnColours: [number, number];
    /** the colour behind the drawing: a colour such as "#1f5c3a" */
    background: string;
    /** the stroke width, in steps: a number from 0 to 1,000,000,000 */
    width: number;
    /** what every branch multiplies the width by: a number from 0 to 10 */
    widthFactor: number;
    /** whether each line runs from its own width to the width with which its branch goes on: true or false */
    tapers: boolean;
    /** the width of the thinnest line, in pixels: a number from 0 to 10,000 */
    minWidth: number;
    /** the width of the thickest line, in percent of the picture's longer side; 0 for no limit: a number from 0 to 100 */
    maxWidth: number;
    /** blending of overlapping strokes: opaque (`solid`), additive (`density`), or opaque but additive where strokes are finer than pixels (`auto`): one of `auto`, `solid`, `density` */
    ink: 'auto' | 'solid' | 'density';
    /** by how many degrees the palette's hues are turned: a number from -360 to 360 */
    hue: number;
    /** brightness of additive blending, in stops: each doubles it: a number from -10 to 10 */
    exposure: number;
    /** whether a drawing in space has soft shadows: true or false */
    shadows: boolean;
    /** whether the drawing has the outlines of the shapes in the rules, in a faint colour: true or false */
    shapes: boolean;
    /** whether widths, and what the colour follows, are chosen after the system in place of the values given: true or false */
    auto: boolean;
    /** a short name, unique within its folder: a text of at most 200 characters */
    name: string;
    /** where the system was published: a text of at most 1,000 characters */
    source: string;
    /** what a reader should know: a text of at most 10,000 characters */
    notes: string;
}

/** Formats of files. */
export type FileFormat =
    /** SVG: Picture of strokes */
    | 'svg'
    /** Compact SVG: Picture of strokes with each reusable part written once: a small file at any number of iterations */
    | 'svg-compact'
    /** Plotter SVG: Lines for a pen plotter, in millimetres: a layer for each colour, drawn once, with little travel */
    | 'plotter'
    /** PNG: Picture of pixels */
    | 'png'
    /** PDF: Page of strokes */
    | 'pdf'
    /** TikZ: Picture of strokes for LaTeX */
    | 'tikz'
    /** TikZ L-system: System for TikZ's library lindenmayersystems, which draws simple systems while LaTeX runs */
    | 'tikz-library'
    /** LaTeX: System typeset as in books: axiom, productions, constants and angles */
    | 'latex'
    /** Markdown: System as a list: axiom, productions, constants and angles */
    | 'markdown'
    /** BibTeX: Entries of the system's source and of its picture */
    | 'bibtex'
    /** MIDI: Walk of the turtle as notes: lines are notes, branches are voices */
    | 'midi'
    /** JSON: System, to open again */
    | 'json'
    /** Text: Derived string */
    | 'txt'
    /** CSV: Segments as a table: x0,y0,x1,y1,level,colour; in space x0,y0,z0,x1,y1,z1,level,colour */
    | 'csv'
    /** OBJ: Mesh of coloured tubes, as text */
    | 'obj'
    /** glTF: Tubes and leaves with materials, as binary glTF: each reusable part is written once, for viewers and game engines */
    | 'glb'
    /** STL: Closed tubes and slabs for printers, in millimetres, on a foot */
    | 'stl'
    /** OpenSCAD: Union of convex bodies for OpenSCAD, in millimetres, to cut and to join with other solids */
    | 'scad'
    ;

/** Formats that are no texts. */
export type BinaryFormat = 'png' | 'pdf' | 'midi' | 'glb' | 'stl';

/** Options of files; each format has some of them. */
export interface FileOptions {
    /** Width and height of a picture: a width and a height such as 1600x1200, with 1 to 32,768 pixels each way. For png. */
    size?: `${number}x${number}` | readonly [number, number];
    /** Pixels of an inch on paper, told in the file; 0 for none: a number from 0 to 100000. For png. */
    dpi?: number;
    /** Leave the background out: true or false. For svg, svg-compact, png. */
    transparent?: boolean;
    /** Size of the paper: `a5`, `a4`, `a3`, `a2`, `a1`, `letter`, `legal`, `tabloid`, or a width and a height such as 300x400, with 10 to 10,000 mm each way. For plotter, pdf. */
    sheet?: 'a5' | 'a4' | 'a3' | 'a2' | 'a1' | 'letter' | 'legal' | 'tabloid' | `${number}x${number}`;
    /** Keep a plot's sheet upright, even if the drawing is larger on its side: true or false. For plotter. */
    portrait?: boolean;
    /** Turn the sheet, so that it is wider than tall: true or false. For plotter, pdf. */
    landscape?: boolean;
    /** Margin on every side of the sheet: a number from 0 to 100. For plotter, pdf. */
    margin?: number;
    /** Width of the pen's line; smaller parts of the drawing become one stroke: a number from 0.05 to 20. For plotter. */
    pen?: number;
    /** Fill polygons and broad strokes with lines: true or false. For plotter. */
    hatch?: boolean;
    /** Leave out lines behind polygons and broad strokes, and draw broad strokes as outlines: true or false. For plotter. */
    hide?: boolean;
    /** Corner where each pen starts and ends: one of `top-left`, `top-right`, `bottom-left`, `bottom-right`. For plotter. */
    start?: 'top-left' | 'top-right' | 'bottom-left' | 'bottom-right';
    /** Length under which lines are left out: a number from 0 to 1000. For plotter. */
    'min-length'?: number;
    /** Speed of the lowered pen, for the estimate of time: a number from 0.1 to 10000. For plotter. */
    speed?: number;
    /** Speed of the raised pen, for the estimate of time: a number from 0.1 to 10000. For plotter. */
    'travel-speed'?: number;
    /** Seconds to raise and lower the pen, for the estimate of time: a number from 0 to 60. For plotter. */
    lift?: number;
    /** Fill the sheet, instead of ending the page at the edge of the drawing: true or false. For pdf. */
    'whole-sheet'?: boolean;
    /** Size under which parts become one tube, in percent of the longest side (in STL, 1 % is 1 mm); 0 keeps all: a number from 0 to 20. For obj, glb, stl, scad. */
    finest?: number;
    /** Height of a mesh: mm in STL and OpenSCAD, metres in glTF, units in OBJ; 0 for a longest side of 100 mm, and for steps of 1 m: a number from 0 to 10000. For obj, glb, stl, scad. */
    height?: number;
    /** Least thickness of tubes and leaves of a print: a number from 0 to 20. For stl, scad. */
    thinnest?: number;
    /** Distance by which a foot under a print reaches beyond what stands on it; 0 for none: a number from 0 to 100. For stl, scad. */
    foot?: number;
    /** Pitch of a note, by the height of the line's end or by the letter that draws the line: one of `height`, `letter`. For midi. */
    pitch?: 'height' | 'letter';
    /** Time of a note: line after line in drawing order, or by length with branches together: one of `step`, `length`. For midi. */
    time?: 'step' | 'length';
    /** Tones of an octave, on C: one of `pentatonic`, `major`, `minor`, `chromatic`. For midi. */
    scale?: 'pentatonic' | 'major' | 'minor' | 'chromatic';
    /** Range of the pitches, about middle C: a number from 1 to 6. For midi. */
    octaves?: number;
    /** Quarter notes in a minute; a line lasts a sixteenth: a number from 20 to 400. For midi. */
    tempo?: number;
    /** Number of notes; of longer walks, lines at even distances are heard, or by length an earlier generation: a number from 1 to 100000. For midi. */
    notes?: number;
    /** Leave the system out of the file; the file cannot be opened again as a system: true or false. For svg, svg-compact, png, pdf. */
    bare?: boolean;
}
