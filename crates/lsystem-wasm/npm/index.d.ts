/** An L-system. Fields that are left out have their defaults, which `docs/notation.md` and the README of the project list. */
export interface Definition {
    /** The axiom, in the notation. */
    axiom: string;
    /** Productions and constants, one on each line, such as `F -> F+F--F+F`. */
    rules: string;
    /** The angle of a left turn, in degrees, counter-clockwise; also of a right turn unless `rightAngle` is given. */
    angle?: number;
    /** The angle of a right turn, in degrees, clockwise. */
    rightAngle?: number | null;
    /** The heading at the start: degrees counter-clockwise from +x. */
    heading?: number;
    /** The step length, in model units. */
    step?: number;
    /** Where the turtle starts, in model units, y up. */
    start?: [number, number];
    /** The table of the symbols' actions. */
    dialect?: 'abop' | 'practical' | 'every-letter' | 'lowercase' | 'axes';
    /** Custom symbols, one on each line, such as `G: move`. They replace the dialect's actions. */
    overrides?: string;
    /** The factor of all lengths for each branch level. */
    lengthFactor?: number;
    /** The largest random change of an angle, in percent, 0 to 100. */
    angleVariation?: number;
    /** The largest random change of a length, in percent, 0 to 100. */
    lengthVariation?: number;
    /** The seed of all random choices: a whole number below 2^32. */
    seed?: number;
    /** Any other field of a system. */
    [field: string]: unknown;
}

/** The segments of a drawing, in drawing order. */
export interface Segments {
    /** x0 y0 x1 y1 of each segment, in model units, y up. */
    readonly segments: Float32Array;
    /** The colour index of each segment, not yet wrapped to a palette. */
    readonly colours: Int32Array;
    /** The branch level of each segment. */
    readonly levels: Uint16Array;
}

/** A problem of a definition. The functions throw `{ diagnostics: Problem[] }`. */
export interface Problem {
    field: 'axiom' | 'rules' | 'overrides' | 'file' | 'numbers';
    severity: 'error' | 'warning';
    /** The problem, in a sentence. */
    message: string;
    /** A possible remedy. */
    hint: string | null;
    /** The text that is probably meant in place of the problem's. */
    fix: string | null;
    /** The start of the place in the field, in UTF-16 units. */
    start: number;
    /** The end of the place in the field. */
    end: number;
}

/**
 * The string of generation `n` of a definition.
 * @throws `{ diagnostics }` if the definition has errors or the string is too long.
 */
export function expand(definition: Definition, n: number): string;

/**
 * The segments of generation `n` of a definition: at most 16,777,216. A drawing in space is not drawn.
 * @throws `{ diagnostics }` if the definition has errors or the drawing is too large.
 */
export function draw(definition: Definition, n: number): Segments;
