#!/usr/bin/env bash
# The union of a plant's strokes, as for a cutter: 125 rectangles of the book's first weed, F -> F[+F]F[-F]F at 25.7 degrees, each
# as wide as a tenth of its length.
# Seen: polygon-clipping 0.15.7, which many packages of maps and drawings use, raises an error; its fork polyclip-ts 0.16.8 and clipper2-ts
# 2.0.1 agree on an area of 11.785 squares of a step.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --prefix . polygon-clipping@0.15.7 polyclip-ts@0.16.8 clipper2-ts@2.0.1

cat >unite.mjs <<'END'
import { areaPathsD, FillRule, unionD } from 'clipper2-ts';
import { union } from 'polyclip-ts';
import clipping from 'polygon-clipping';

let word = 'F';
for (let n = 0; n < 3; n++) word = word.replaceAll('F', 'F[+F]F[-F]F');
const [turn, half] = [(25.7 * Math.PI) / 180, 0.05];
let [x, y, heading] = [0, 0, Math.PI / 2];
const [stack, strokes] = [[], []];
for (const symbol of word)
    if (symbol === 'F') {
        const [dx, dy] = [Math.cos(heading), Math.sin(heading)];
        const [nx, ny] = [-dy * half, dx * half];
        strokes.push([[x + nx, y + ny], [x - nx, y - ny], [x + dx - nx, y + dy - ny], [x + dx + nx, y + dy + ny]]);
        [x, y] = [x + dx, y + dy];
    } else if (symbol === '+') heading += turn;
    else if (symbol === '-') heading -= turn;
    else if (symbol === '[') stack.push([x, y, heading]);
    else [x, y, heading] = stack.pop();

const areaOf = (ring) =>
    ring.reduce((sum, [x1, y1], at) => {
        const [x2, y2] = ring[(at + 1) % ring.length];
        return sum + (x1 * y2 - x2 * y1) / 2;
    }, 0);
const tell = (name, unite) => {
    try {
        console.log(name, unite().toFixed(3));
    } catch (error) {
        console.log(name, error.message.split(' at ')[0]);
    }
};
const rings = strokes.map((stroke) => [stroke]);
const sum = (polygons) => polygons.flat().reduce((total, ring) => total + areaOf(ring), 0);
console.log('strokes', strokes.length);
tell('polygon-clipping', () => sum(clipping.union(...rings)));
tell('polyclip-ts', () => sum(union(...rings)));
const paths = strokes.map((stroke) => stroke.map(([x, y]) => ({ x, y })));
tell('clipper2-ts', () => Math.abs(areaPathsD(unionD(paths, [], FillRule.NonZero, 6))));
END

{
    node unite.mjs
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
strokes 125
polygon-clipping Unable to complete output ring starting
polyclip-ts 11.785
clipper2-ts 11.785
END
