#!/usr/bin/env bash
# Some programs write colours into OBJ behind the coordinates (`v x y z r g b`). A grey of 0.5 in three readers, and what becomes
# of it in GLB.
# Seen: OBJLoader of three.js 0.187.0 takes the number for sRGB and makes 0.214 of it; trimesh 5.2.0 keeps 128 of 255 and writes it into GLB
# as it is, where numbers are linear, so that viewers show 0.735; meshio 5.3.5 makes points with six coordinates.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check trimesh==5.2.0 meshio==5.3.5 numpy==2.3.5
npm install --silent --no-audit --no-fund --prefix . three@0.187.0

cat >grey.obj <<'END'
v 0 0 0 0.5 0.5 0.5
v 1 0 0 0.5 0.5 0.5
v 1 1 0 0.5 0.5 0.5
f 1 2 3
END

cat >read.py <<'END'
import json, struct
import meshio, trimesh

mesh = trimesh.load("grey.obj")
print("trimesh", mesh.visual.vertex_colors[0].tolist())
glb = mesh.export(file_type="glb")
length = struct.unpack_from("<I", glb, 12)[0]
tree, data = json.loads(glb[20 : 20 + length]), glb[20 + length + 8 :]
accessor = tree["accessors"][tree["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"]]
start = tree["bufferViews"][accessor["bufferView"]].get("byteOffset", 0)
print("GLB of trimesh", list(data[start : start + 4]), "normalized:", accessor.get("normalized"))
print("meshio", meshio.read("grey.obj").points.shape)
END

cat >read.mjs <<'END'
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
import { readFileSync } from 'node:fs';

const [mesh] = new OBJLoader().parse(readFileSync('grey.obj', 'utf8')).children;
console.log('OBJLoader', mesh.geometry.attributes.color.array[0].toFixed(3));
END

{
    python/bin/python read.py
    node read.mjs
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
trimesh [128, 128, 128, 255]
GLB of trimesh [128, 128, 128, 255] normalized: True
meshio (3, 6)
OBJLoader 0.214
END
