/** What the core knows and late parts of the page show: written by `cargo xtask tables`, not by hand. */

/**
 * What an exercise can ask for, by name: what must be the same, the task where none is given, whether
 * other answers can be searched, and whether the string counts.
 */
export const ASKS = /* @__PURE__ */ Object.freeze({
    'picture': { label: 'the picture', task: 'Find rules that draw the target.', isSearched: true, isText: false },
    'text': { label: 'the string', task: 'Find rules that derive the same string.', isSearched: false, isText: true },
    'segments': { label: 'the number of segments', task: 'Find rules that draw as many segments as the target.', isSearched: false, isText: false },
    'statistics': { label: 'the statistics over many seeds', task: 'Find rules of chance whose drawings have the same statistics.', isSearched: false, isText: false },
    'program': { label: 'the results of a program', task: 'Write the functions, and see what they draw.', isSearched: false, isText: false },
});

/** Formats of exported files by name: ending and media type of the file, what the page calls it, and what it is. */
export const FORMATS = /* @__PURE__ */ Object.freeze({
    'svg': { ending: 'svg', mime: 'image/svg+xml', label: 'SVG', help: 'Picture of strokes', picture: true, purposes: ['screen'], content: 'strokes', options: ['transparent', 'bare'] },
    'svg-compact': { ending: 'svg', mime: 'image/svg+xml', label: 'Compact SVG', help: 'Picture of strokes with each reusable part written once: a small file at any number of iterations', picture: true, purposes: ['screen'], content: 'strokes', options: ['transparent', 'bare'] },
    'plotter': { ending: 'svg', mime: 'image/svg+xml', label: 'Plotter SVG', help: 'Lines for a pen plotter, in millimetres: a layer for each colour, drawn once, with little travel', picture: true, purposes: ['plotter'], content: 'strokes', options: ['sheet', 'portrait', 'landscape', 'margin', 'pen', 'hatch', 'hide', 'start', 'min-length', 'speed', 'travel-speed', 'lift'] },
    'png': { ending: 'png', mime: 'image/png', label: 'PNG', help: 'Picture of pixels', picture: true, purposes: ['screen', 'print'], content: 'pixels', options: ['size', 'dpi', 'transparent', 'bare'] },
    'pdf': { ending: 'pdf', mime: 'application/pdf', label: 'PDF', help: 'Page of strokes', picture: true, purposes: ['paper'], content: 'strokes', options: ['sheet', 'landscape', 'margin', 'whole-sheet', 'bare'] },
    'tikz': { ending: 'tikz', mime: 'text/x-tex', label: 'TikZ', help: 'Picture of strokes for LaTeX', picture: true, purposes: ['paper'], content: 'strokes', options: [] },
    'tikz-library': { ending: 'tikz', mime: 'text/x-tex', label: 'TikZ L-system', help: 'System for TikZ\'s library lindenmayersystems, which draws simple systems while LaTeX runs', picture: false, purposes: ['paper'], content: 'words', options: [] },
    'latex': { ending: 'tex', mime: 'text/x-tex', label: 'LaTeX', help: 'System typeset as in books: axiom, productions, constants and angles', picture: false, purposes: ['paper'], content: 'words', options: [] },
    'markdown': { ending: 'md', mime: 'text/markdown', label: 'Markdown', help: 'System as a list: axiom, productions, constants and angles', picture: false, purposes: ['paper'], content: 'words', options: [] },
    'bibtex': { ending: 'bib', mime: 'text/x-bibtex', label: 'BibTeX', help: 'Entries of the system\'s source and of its picture', picture: false, purposes: ['paper'], content: 'words', options: [] },
    'midi': { ending: 'mid', mime: 'audio/midi', label: 'MIDI', help: 'Walk of the turtle as notes: lines are notes, branches are voices', picture: false, purposes: ['sound'], content: 'sound', options: ['pitch', 'time', 'scale', 'octaves', 'tempo', 'notes'] },
    'json': { ending: 'json', mime: 'application/json', label: 'JSON', help: 'System, to open again', picture: false, purposes: ['data'], content: 'system', options: [] },
    'txt': { ending: 'txt', mime: 'text/plain', label: 'Text', help: 'Derived string', picture: false, purposes: ['data'], content: 'string', options: [] },
    'csv': { ending: 'csv', mime: 'text/csv', label: 'CSV', help: 'Segments as a table: x0,y0,x1,y1,level,colour; in space x0,y0,z0,x1,y1,z1,level,colour', picture: false, purposes: ['data'], content: 'segments', options: [] },
    'obj': { ending: 'obj', mime: 'model/obj', label: 'OBJ', help: 'Mesh of coloured tubes, as text', picture: false, purposes: ['mesh'], content: 'mesh', options: ['finest', 'height'] },
    'glb': { ending: 'glb', mime: 'model/gltf-binary', label: 'glTF', help: 'Tubes and leaves with materials, as binary glTF: each reusable part is written once, for viewers and game engines', picture: false, purposes: ['mesh'], content: 'mesh', options: ['finest', 'height'] },
    'stl': { ending: 'stl', mime: 'model/stl', label: 'STL', help: 'Closed tubes and slabs for printers, in millimetres, on a foot', picture: false, purposes: ['mesh'], content: 'mesh', options: ['finest', 'height', 'thinnest', 'foot'] },
    'scad': { ending: 'scad', mime: 'application/x-openscad', label: 'OpenSCAD', help: 'Union of convex bodies for OpenSCAD, in millimetres, to cut and to join with other solids', picture: false, purposes: ['mesh'], content: 'mesh', options: ['finest', 'height', 'thinnest', 'foot'] },
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
    'lpy': { label: 'L-Py', help: 'Arrow rules, and rules of Python with conditions; arithmetic with the functions of Python', ending: 'lpy' },
    'anvaka': { label: 'anvaka’s page', help: 'Text for anvaka’s page, with one action for each symbol', ending: 'txt' },
});

/** The letters of ASCII that draw, by dialect. */
export const DRAWS = /* @__PURE__ */ Object.freeze({
    'abop': 'FG',
    'every-letter': 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz',
    'practical': 'FG',
    'lowercase': 'abcdefghijklmnopqrstuvwxyz',
    'axes': 'F',
});

/** What files are for, in the order of the page's dialog, with labels. */
export const PURPOSES = /* @__PURE__ */ Object.freeze({
    screen: 'Screen',
    film: 'Film',
    plotter: 'Plotter',
    paper: 'Article',
    print: 'Poster',
    mesh: '3D',
    sound: 'Sound',
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
    'hide': { kind: 'flag', label: 'Hide what is behind', help: 'Leave out lines behind polygons and broad strokes, and draw broad strokes as outlines', unit: '' },
    'start': { kind: 'word', words: { 'top-left': 'Top left', 'top-right': 'Top right', 'bottom-left': 'Bottom left', 'bottom-right': 'Bottom right' }, default: 'top-left', label: 'Start corner', help: 'Corner where each pen starts and ends', unit: '' },
    'min-length': { kind: 'number', low: 0, high: 1000, step: 0.1, default: 0, label: 'Shortest line', help: 'Length under which lines are left out', unit: 'mm' },
    'speed': { kind: 'number', low: 0.1, high: 10000, step: 1, default: 50, label: 'Drawing speed', help: 'Speed of the lowered pen, for the estimate of time', unit: 'mm/s' },
    'travel-speed': { kind: 'number', low: 0.1, high: 10000, step: 1, default: 150, label: 'Travel speed', help: 'Speed of the raised pen, for the estimate of time', unit: 'mm/s' },
    'lift': { kind: 'number', low: 0, high: 60, step: 0.1, default: 0.2, label: 'Lift time', help: 'Seconds to raise and lower the pen, for the estimate of time', unit: 's' },
    'whole-sheet': { kind: 'flag', label: 'Whole sheet', help: 'Fill the sheet, instead of ending the page at the edge of the drawing', unit: '' },
    'finest': { kind: 'number', low: 0, high: 20, step: 0.1, default: 0, label: 'Finest part', help: 'Size under which parts become one tube, in percent of the longest side (in STL, 1 % is 1 mm); 0 keeps all', unit: '%' },
    'height': { kind: 'number', low: 0, high: 10000, step: 0.1, default: 0, label: 'Height', help: 'Height of a mesh: mm in STL and OpenSCAD, metres in glTF, units in OBJ; 0 for a longest side of 100 mm, and for steps of 1 m', unit: '' },
    'thinnest': { kind: 'number', low: 0, high: 20, step: 0.1, default: 0.8, label: 'Thinnest wall', help: 'Least thickness of tubes and leaves of a print', unit: 'mm' },
    'foot': { kind: 'number', low: 0, high: 100, step: 1, default: 5, label: 'Foot', help: 'Distance by which a foot under a print reaches beyond what stands on it; 0 for none', unit: 'mm' },
    'pitch': { kind: 'word', words: { 'height': 'By height', 'letter': 'By letter' }, default: 'height', label: 'Pitch', help: 'Pitch of a note, by the height of the line\'s end or by the letter that draws the line', unit: '' },
    'time': { kind: 'word', words: { 'step': 'Line after line', 'length': 'By length, branches together' }, default: 'step', label: 'Time', help: 'Time of a note: line after line in drawing order, or by length with branches together', unit: '' },
    'scale': { kind: 'word', words: { 'pentatonic': 'Pentatonic', 'major': 'Major', 'minor': 'Minor', 'chromatic': 'Chromatic' }, default: 'pentatonic', label: 'Scale', help: 'Tones of an octave, on C', unit: '' },
    'octaves': { kind: 'number', low: 1, high: 6, step: 1, default: 3, label: 'Range', help: 'Range of the pitches, about middle C', unit: 'octaves' },
    'tempo': { kind: 'number', low: 20, high: 400, step: 1, default: 120, label: 'Tempo', help: 'Quarter notes in a minute; a line lasts a sixteenth', unit: 'per minute' },
    'notes': { kind: 'number', low: 1, high: 100000, step: 1, default: 2000, label: 'Most notes', help: 'Number of notes; of longer walks, lines at even distances are heard, or by length an earlier generation', unit: '' },
    'bare': { kind: 'flag', label: 'Without the rules inside', help: 'Leave the system out of the file; the file cannot be opened again as a system', unit: '' },
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
