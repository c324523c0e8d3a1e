import type { BinaryFormat, Fields, FileFormat, FileOptions } from './fields.js';

export type { BinaryFormat, Fields, FileFormat, FileOptions } from './fields.js';

/** An outcome of a stochastic rule: its probability, and its successor as plain characters. */
export interface Outcome {
    p: number;
    e: string;
}

/**
 * Productions and constants in the notation, such as `F -> F+F--F+F`: one on each line of a text, or a list of lines.
 * Or an object of plain characters, as in files: each key is a symbol and its value the successor; then the axiom is
 * plain characters, too.
 */
export type Rules = string | readonly string[] | { readonly [symbol: string]: string | readonly Outcome[] };

/** A system. Fields that are left out have their defaults. Unknown fields throw. */
export interface Definition extends Partial<Omit<Fields, 'axiom' | 'rules' | 'overrides'>> {
    /** The axiom, in the notation. */
    axiom: string;
    rules?: Rules;
    /** Custom symbols, such as `G: move`: lines, or an object such as `{ G: 'move' }`. */
    overrides?: string | readonly string[] | { readonly [symbol: string]: string };
}

/** A system with the keys of a JSON file, such as `import system from './plant.json'`. */
export interface SystemFile {
    axiom?: undefined;
    initial: string;
    [key: string]: unknown;
}

export type System = Definition | SystemFile;

/** A drawing, in drawing order. */
export interface Drawing {
    /** 2 in the plane; 3 in space, with z towards the viewer. */
    dimension: 2 | 3;
    /** The coordinates of both ends of each segment, in model units, y up: x0 y0 x1 y1, or x0 y0 z0 x1 y1 z1. */
    segments: Float32Array;
    /** The colour index of each segment, not yet wrapped to a palette. */
    colours: Int32Array;
    /** The branch level of each segment. */
    levels: Uint16Array;
}

/** A former name. */
export type Segments = Drawing;

/** A segment of a drawing; two or three coordinates at each end. */
export interface Segment {
    from: number[];
    to: number[];
    colour: number;
    level: number;
}

/** A problem of a system. */
export interface Problem {
    field: 'axiom' | 'rules' | 'overrides' | 'file' | 'numbers';
    severity: 'error' | 'warning';
    /** The problem, in a sentence. */
    message: string;
    /** A possible remedy. */
    hint: string | null;
    /** The text that is probably meant in place of the problem's. */
    fix: string | null;
    /** The start of the place in the field, in UTF-16 units; in `file`, of the file or of `JSON.stringify(system, null, 2)`. */
    start: number;
    /** The end of the place in the field. */
    end: number;
    /** All of this with the line and marks below the place, for a terminal. */
    text: string;
}

/** What all functions throw where a system has errors or a limit is passed. */
export class LSystemError extends Error {
    readonly name: 'LSystemError';
    /** Errors and warnings; empty where an option is wrong. */
    readonly diagnostics: Problem[];
}

/** Options of pictures in the plane and in space. */
export interface Options extends FileOptions {
    /** The generation; the system's own `iterations` if it is left out. */
    n?: number;
    /** Where a PNG in the plane looks: offsets from the centre in longer sides of the drawing, and a magnification. */
    view?: { x?: number; y?: number; zoom?: number };
    /** From where a drawing in space is seen: degrees, a magnification and the centre. */
    camera?: {
        azimuth?: number;
        elevation?: number;
        zoom?: number;
        x?: number;
        y?: number;
        z?: number;
        perspective?: boolean;
        fade?: number;
    };
    /** Device pixels in a CSS pixel of a PNG, 0.01 to 100, which scale its least width of strokes. */
    ratio?: number;
}

/** The string of a generation, of at most 67,108,864 symbols. `n` is the system's own `iterations` if it is left out. */
export function expand(system: System, n?: number): string;

/** The segments of a generation, at most 16,777,216 in the plane. */
export function draw(system: System, n?: number): Drawing;

/** The numbers of symbols and of segments of a generation, also of those that are far too long to derive. */
export function count(system: System, n?: number): { symbols: bigint; segments: bigint };

/** The symbols of a generation one by one, with arguments as in `F(2)`. Long strings are read as the loop goes on. */
export function symbols(system: System, n?: number): IterableIterator<string>;

/** The segments of a generation one by one. Large drawings are read as the loop goes on. */
export function segments(system: System, n?: number): IterableIterator<Segment>;

/** A picture of strokes. A drawing in space is projected. */
export function svg(system: System, options?: Options): string;

/** A picture of pixels; its size is as in `[800, 600]` or `'800x600'`. */
export function png(system: System, options?: Options): Uint8Array;

/** A file of any format: a text, or bytes. */
export function file(system: System, format: BinaryFormat, options?: Options): Uint8Array;
export function file(system: System, format: Exclude<FileFormat, BinaryFormat>, options?: Options): string;

/** Reads a JSON file, or a PNG, SVG or PDF picture that carries its system. */
export function read(file: string | ArrayBuffer | ArrayBufferView): Definition;

/** The errors and warnings of a system or a file. */
export function check(system: System | string | ArrayBuffer | ArrayBufferView): Problem[];
