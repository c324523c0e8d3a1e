// Checked, not run, by `cargo xtask test`: every line after `@ts-expect-error` must be an error of types.
import { check, count, draw, expand, file, type LSystemError, png, read, segments, svg, symbols } from 'lsystem';

const plant = { axiom: 'X', rules: { X: 'F-[[X]+X]+F[+FX]-X', F: 'FF' }, angle: 22.5 };
const text: string = expand(plant);
const { dimension, segments: numbers } = draw(plant, 3);
const plane: 2 | 3 = dimension;
const array: Float32Array = numbers;
const counted: bigint = count(plant, 100).segments;
for (const symbol of symbols(plant)) symbol.charAt(0);
for (const { from, to, level } of segments(plant)) Math.hypot(...from, ...to, level);
const picture: string = svg(plant, { n: 3, transparent: true });
const pixels: Uint8Array = png(plant, { size: [800, 600], dpi: 300 });
const sized: Uint8Array = png(plant, { size: '800x600' });
const mesh: Uint8Array = file(plant, 'glb', { finest: 1 });
const table: string = file(plant, 'csv');
const again: string = expand(read(pixels));
const lines: string[] = check(plant).map((problem) => problem.text);
const places = (error: LSystemError): number[] => error.diagnostics.map((problem) => problem.start);

expand({
    axiom: 'F',
    rules: ['F -> FF'],
    overrides: { G: 'move' },
    dialect: 'lowercase',
    start: [0, 1],
    rightAngle: null,
});
expand({
    axiom: 'F',
    rules: {
        F: [
            { p: 0.5, e: 'FF' },
            { p: 0.5, e: 'F' },
        ],
    },
});
expand({ initial: 'F', rules: { F: 'FF' }, num_iters: 3, turtle: { dialect: 'abop' }, author: 'somebody' });

// @ts-expect-error a mistyped field
expand({ axiom: 'F', angel: 60 });
// @ts-expect-error a name of other programs
expand({ axiom: 'F', productions: { F: 'FF' } });
// @ts-expect-error no axiom
expand({ rules: 'F -> FF' });
// @ts-expect-error a number for rules
expand({ axiom: 'F', rules: 7 });
// @ts-expect-error an unknown dialect
draw({ axiom: 'F', dialect: 'klingon' });
// @ts-expect-error one coordinate
draw({ axiom: 'F', start: [1] });
// @ts-expect-error a text for a number
draw(plant, '3');
// @ts-expect-error an outcome without a successor
expand({ axiom: 'F', rules: { F: [{ p: 1 }] } });
// @ts-expect-error a mistyped option
png(plant, { dip: 300 });
// @ts-expect-error a size of one side
png(plant, { size: [800] });
// @ts-expect-error an unknown format
file(plant, 'jpeg');
// @ts-expect-error bytes
const wrong: string = file(plant, 'png');
// @ts-expect-error a big integer
const few: number = count(plant).symbols;

export { again, array, counted, few, lines, mesh, picture, places, plane, sized, table, text, wrong };
