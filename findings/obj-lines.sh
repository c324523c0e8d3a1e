#!/usr/bin/env bash
# OBJ has lines (`l 1 2 3`) beside faces; skeletons of plants are written so.
# Seen: trimesh 5.2.0 keeps the points of a file of lines alone, and of lines with a face only the face; meshio 5.3.5 reads the points and no
# lines; OBJLoader of three.js 0.187.0 makes one LineSegments of lines and face together: nine ends where the file has three segments, the last
# three of them the corners of the face, which is not drawn.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check trimesh==5.2.0 meshio==5.3.5 numpy==2.3.5
npm install --silent --no-audit --no-fund --prefix . three@0.187.0

cat >lines.obj <<'END'
v 0 0 0
v 1 0 0
v 1 1 0
v 2 2 0
l 1 2 3
l 3 4
END

cat >both.obj <<'END'
v 0 0 0
v 1 0 0
v 1 1 0
v 2 2 0
l 1 2 3
l 3 4
f 1 2 3
END

cat >read.py <<'END'
import meshio, trimesh

for name in ("lines", "both"):
    read = trimesh.load(name + ".obj")
    print("trimesh", name, type(read).__name__, len(read.vertices))
    read = meshio.read(name + ".obj")
    print("meshio", name, {cells.type: len(cells.data) for cells in read.cells}, len(read.points))
END

cat >read.mjs <<'END'
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
import { readFileSync } from 'node:fs';

for (const name of ['lines', 'both'])
    for (const { type, geometry } of new OBJLoader().parse(readFileSync(`${name}.obj`, 'utf8')).children)
        console.log('OBJLoader', name, type, geometry.attributes.position.count);
END

{
    python/bin/python read.py
    node read.mjs
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
trimesh lines PointCloud 4
meshio lines {} 4
trimesh both Trimesh 3
meshio both {'triangle': 1} 4
OBJLoader lines LineSegments 6
OBJLoader both LineSegments 9
END
