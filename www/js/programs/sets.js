/** The ready-made functions: what they are called with, what they do, and calls to try them, the smallest first. */

import { say } from '../base/words.js';

/** @typedef {{axiom: string, rules: Record<string, string>, n: number, angle: number, right?: number, heading?: number, angles?: Record<string, number>}} Plant */
/** @typedef {{params: string, says: string, calls: unknown[][]}} Known */
/** What draws a plant: the function of the word, and that of the lines with its further values. @typedef {{word: string, lines: string, values: (plant: Plant) => unknown[], dialect: import('../state/state.js').Definition['dialect']}} Drawing */
/** @typedef {{title: string, functions: string[], plants: string[], drawing: Drawing}} Set */

/** @type {Readonly<Record<string, Plant>>} */
export const PLANTS = {
    tree0: { axiom: 'F', rules: { F: 'F[+F]F[-F]F' }, n: 4, angle: 20 },
    tree1: { axiom: 'F', rules: { F: 'F[+F]F[-F][F]' }, n: 4, angle: 30, right: 25.7 },
    tree2: { axiom: 'F', rules: { F: 'FF-[-F+F+F]+[+F-F-F]' }, n: 3, angle: 22.5 },
    tree3: { axiom: 'X', rules: { X: 'F[+X]F[-X]+X', F: 'FF' }, n: 5, angle: 20, right: 30 },
    tree4: { axiom: 'X', rules: { X: 'F[+X][-X]FX', F: 'FF' }, n: 5, angle: 25.7 },
    tree5: { axiom: 'X', rules: { X: 'F-[[X]+X]+F[+FX]-X', F: 'FF' }, n: 4, angle: 25, heading: 110 },
    koch: { axiom: 'F', rules: { F: 'F+F--F+F' }, n: 4, angle: 60, heading: 0 },
    koch90: { axiom: 'F', rules: { F: 'F+F-F-F+F' }, n: 4, angle: 90, heading: 0 },
    sierpinski: { axiom: 'F-G-G', rules: { F: 'F-G+F+G-F', G: 'GG' }, n: 5, angle: 120, heading: 30 },
    tree3d0: {
        axiom: 'T',
        rules: { T: 'TF', F: 'F[+F][-FF][<F][>FF][&F]' },
        n: 4,
        angle: 45,
        angles: { l: 45, r: 45, u: 50, d: 40, t: 30, v: 30 },
    },
    tree3d1: {
        axiom: 'F',
        rules: { F: 'IFF[Y-FF][Y+FF][Y<FF][Y>FF]' },
        n: 3,
        angle: 40,
        angles: { l: 40, r: 40, u: 40, d: 40, t: 20, v: 20 },
    },
    plant_01: { axiom: 'X', rules: { X: 'F[+X]F[-X]+X', F: 'FF' }, n: 4, angle: 20 },
    plant_03: { axiom: 'F', rules: { F: 'FF-[-F+F+F]+[+F-F-F]' }, n: 3, angle: 22.5 },
    plant_05: { axiom: 'X', rules: { X: 'F[+X][-X]FX', F: 'FF' }, n: 5, angle: 25.7 },
    sierpinski_triangle: { axiom: 'R', rules: { R: 'L-R-L', L: 'R+L+R' }, n: 6, angle: 60 },
    square_04: { axiom: 'F-F-F-F', rules: { F: 'F-F+F-F-F' }, n: 3, angle: 90 },
    hexerode: { axiom: '-F+F+F+F+F+F', rules: { F: 'F-F++F-F' }, n: 3, angle: 60 },
};

const BUSH = { F: 'FF', X: 'F[+X][-X]FX' };
const SWAP = { A: 'B', B: 'A' };
const GROWTH = { A: 'AB', B: 'A' };
const TURNS = [[0], [90], [30], [-45], [180], [400]];
const ANGLES = { l: 90, r: 45, u: 50, d: 40, t: 30, v: 20 };

const rewritten = [
    ['F', {}],
    ['X', BUSH],
    ['AB', SWAP],
    ['F[+X]', BUSH],
    ['ABA+B', GROWTH],
    ['XFX-[X]', BUSH],
];
const grown = [
    ['X', BUSH, 0],
    ['X', BUSH, 1],
    ['AB', SWAP, 1],
    ['X', BUSH, 2],
    ['FA', { A: '[>FA][^FA]' }, 2],
    ['g', { g: 'g[+g][-g]' }, 2],
    ['A', { A: 'ALRI' }, 3],
    ['A', GROWTH, 5],
    ['F', { F: 'F+F--F+F' }, 3],
];
const WALKS = ['F', 'FF', 'F+F', 'F-F', 'FXF', 'F[+F]F', 'F[+F][-F]F', 'F[+F[-F]F]-F', '[[F]+F]F', 'F+G-G', 'F[F+]F'];

/** @type {Readonly<Record<string, Known>>} */
export const KNOWN = {
    derivation: {
        params: 'word, rules',
        says: say`One step: the word in which each symbol that has a rule is replaced by what its rule says, all at once.`,
        calls: rewritten,
    },
    generation: {
        params: 'axiom, rules, n',
        says: say`The word after n steps from the axiom; after no step it is the axiom.`,
        calls: grown,
    },
    degreetorad: {
        params: 'angle',
        says: say`An angle in degrees as radians.`,
        calls: [[0], [180], [90], [-30], [720]],
    },
    multmatvector: {
        params: 'matrix, vector',
        says: say`The product of a matrix and a vector. A matrix is the list of its columns.`,
        calls: [
            [
                [
                    [1, 0],
                    [0, 1],
                ],
                [3, 4],
            ],
            [
                [
                    [1, 2],
                    [3, 4],
                ],
                [1, 0],
            ],
            [
                [
                    [1, 2],
                    [3, 4],
                ],
                [5, 6],
            ],
            [
                [
                    [1, 2, 3],
                    [-1, 0, 2],
                ],
                [-1, 1],
            ],
            [
                [
                    [1, 2, 3],
                    [4, 5, 6],
                    [7, 8, 10],
                ],
                [1, -1, 2],
            ],
        ],
    },
    multmat: {
        params: 'a, b',
        says: say`The product a b of two matrices. A matrix is the list of its columns.`,
        calls: [
            [
                [
                    [1, 0],
                    [0, 1],
                ],
                [
                    [1, 2],
                    [3, 4],
                ],
            ],
            [
                [
                    [1, 2],
                    [3, 4],
                ],
                [
                    [0, 1],
                    [1, 0],
                ],
            ],
            [
                [
                    [1, 2, 3],
                    [-1, 0, 2],
                ],
                [
                    [-1, 1],
                    [0, 1],
                ],
            ],
            [
                [
                    [1, 2],
                    [3, 4],
                ],
                [
                    [5, 6],
                    [7, 8],
                ],
            ],
            [
                [
                    [0, 1, 0],
                    [-1, 0, 0],
                    [0, 0, 1],
                ],
                [
                    [1, 0, 0],
                    [0, 0, 1],
                    [0, -1, 0],
                ],
            ],
        ],
    },
    r2d: {
        params: 'angle',
        says: say`The matrix that turns by an angle in degrees counter-clockwise, as the list of its columns.`,
        calls: TURNS,
    },
    move2d: {
        params: 'position, angle, distance',
        says: say`The position after a move by a distance in the direction of an angle: 0 degrees are to the right, 90 up.`,
        calls: [
            [[0, 0], 0, 1],
            [[0, 0], 90, 2],
            [[0, 5], 30, 3],
            [[-2, 1], 200, 4],
        ],
    },
    axiomtoline2d: {
        params: 'word, position, angle, left, right, step',
        says: say`The lines that the turtle draws, each as its two ends. F and G draw a line of the length step, + turns left, - turns right, [ keeps position and angle, ] goes back to them; other symbols do nothing.`,
        calls: WALKS.map((word) => [word, [0, 0], 90, 30, 45, 2]),
    },
    ru: {
        params: 'angle',
        says: say`The matrix that turns about the z axis, as the list of its columns.`,
        calls: TURNS,
    },
    rl: {
        params: 'angle',
        says: say`The matrix that turns about the x axis, as the list of its columns.`,
        calls: TURNS,
    },
    rh: {
        params: 'angle',
        says: say`The matrix that turns about the y axis, as the list of its columns: the first is (cos, 0, -sin).`,
        calls: TURNS,
    },
    move3d: {
        params: 'position, matrix, distance',
        says: say`The position after a move by a distance along the first column of the turtle's matrix.`,
        calls: [
            [
                [0, 0, 0],
                [
                    [1, 0, 0],
                    [0, 1, 0],
                    [0, 0, 1],
                ],
                1,
            ],
            [
                [1, 2, 3],
                [
                    [0, 1, 0],
                    [-1, 0, 0],
                    [0, 0, 1],
                ],
                2,
            ],
            [
                [0, 0, 1],
                [
                    [0, 0.6, 0.8],
                    [1, 0, 0],
                    [0, 0.8, -0.6],
                ],
                5,
            ],
        ],
    },
    axiomtoline3d: {
        params: 'word, position, angle, angles, step',
        says: say`The lines in space, each as its two ends. The turtle's matrix begins as ru(angle); a turn multiplies it on the right: + by ru(l), - by ru(-r), & by rl(d), ^ by rl(-u), > by rh(t), < by rh(-v). [ keeps position and matrix, ] goes back to them.`,
        calls: ['F', 'F+F', 'F-F', 'F&F', 'F^F', 'F>&F', 'F<&F', 'F[+F]F', 'F[+&F[>^F]]-F'].map((word) => [
            word,
            [0, 0, 0],
            90,
            ANGLES,
            2,
        ]),
    },
    expandSymbol: {
        params: 'symbol, rules',
        says: say`What a symbol becomes: what its rule says, or else the symbol itself.`,
        calls: [
            ['F', { F: 'FF' }],
            ['+', { F: 'FF' }],
            ['X', BUSH],
            ['A', {}],
        ],
    },
    expandOnce: {
        params: 'word, rules',
        says: say`The word after one step: all of its symbols expanded at once.`,
        calls: rewritten,
    },
    expand: {
        params: 'axiom, rules, n',
        says: say`The word after n steps from the axiom; after no step it is the axiom.`,
        calls: grown,
    },
    draw: {
        params: 'word, angle',
        says: say`The lines that a word draws, each as its two ends. The pen starts at (0, 0) and looks up. + turns left and - turns right by the angle, [ keeps position and direction, ] goes back to them; any other symbol draws a line of length 1.`,
        calls: WALKS.map((word) => [word, 30]),
    },
};

/** @type {(lines: string) => Drawing} */
const practical = (lines) => ({
    word: 'generation',
    lines,
    values: ({ angle, right = angle, heading = 90, angles }) =>
        angles ? [[0, 0, 0], heading, angles, 1] : [[0, 0], heading, angle, right, 1],
    dialect: 'practical',
});

/** @type {Readonly<Record<string, Set>>} */
export const SETS = {
    'practical-1': {
        title: say`Write the engine: rules and turtle`,
        functions: [
            'derivation',
            'generation',
            'degreetorad',
            'multmatvector',
            'multmat',
            'r2d',
            'move2d',
            'axiomtoline2d',
        ],
        plants: ['tree4', 'tree0', 'tree1', 'tree2', 'tree3', 'tree5', 'koch', 'koch90', 'sierpinski'],
        drawing: practical('axiomtoline2d'),
    },
    'practical-1-space': {
        title: say`Write the engine: the turtle in space`,
        functions: ['ru', 'rl', 'rh', 'move3d', 'axiomtoline3d'],
        plants: ['tree3d0', 'tree3d1'],
        drawing: practical('axiomtoline3d'),
    },
    'assignment-8': {
        title: say`Write the engine: four functions`,
        functions: ['expandSymbol', 'expandOnce', 'expand', 'draw'],
        plants: ['plant_05', 'plant_01', 'plant_03', 'sierpinski_triangle', 'square_04', 'hexerode'],
        drawing: { word: 'expand', lines: 'draw', values: ({ angle }) => [angle], dialect: 'every-letter' },
    },
};

/** A plant as a definition of the engine. @param {Plant} plant @param {Drawing} drawing @param {number} n */
export function definitionOf({ axiom, rules, angle, right, heading = 90, angles }, { dialect }, n) {
    const lines = Object.entries(rules).map(([symbol, successor]) => `${symbol} -> ${successor}`);
    const { l = angle, r = right ?? null, u = null, d = null, t = null, v = null } = angles ?? {};
    const space = angles ? { pitchDown: t, pitchUp: v, rollLeft: d, rollRight: u } : {};
    return { axiom, rules: lines.join('\n'), iterations: n, angle: l, rightAngle: r, ...space, heading, dialect };
}
