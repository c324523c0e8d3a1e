#!/usr/bin/env bash
# Two closed cubes of 1 mm³ in one mesh, as the tubes of a branch and its stem: apart, overlapping by 9/32 of a cube, and with one edge in
# common.
# Seen: trimesh 5.2.0, numpy-stl 4.1.1 and manifold3d 3.5.4 call the overlapping ones valid and count the overlap twice, manifold3d also
# after a union with something else: only the union of the parts of decompose() is right. Of cubes with one edge in common trimesh and
# numpy-stl say that they are not closed, manifold3d takes them.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check trimesh==5.2.0 numpy-stl==4.1.1 manifold3d==3.5.4

cat >volumes.py <<'END'
import logging

import manifold3d
import numpy as np
import trimesh
from stl import mesh as numpy_stl

logging.disable(logging.CRITICAL)


def cube(at):
    box = trimesh.creation.box((1, 1, 1))
    box.apply_translation(np.array(at) + 0.5)
    return box


for name, at in [('apart', (3, 0, 0)), ('overlapping', (0.25, 0.25, 0.5)), ('one edge', (1, 1, 0))]:
    both = trimesh.util.concatenate([cube((0, 0, 0)), cube(at)])
    facets = np.zeros(len(both.faces), dtype=numpy_stl.Mesh.dtype)
    facets['vectors'] = both.triangles
    stl = numpy_stl.Mesh(facets)
    both.merge_vertices()
    solid = manifold3d.Manifold(manifold3d.Mesh(both.vertices.astype(np.float32), both.faces.astype(np.uint32)))
    more = solid + manifold3d.Manifold.cube((1, 1, 1)).translate((9, 0, 0))
    parts = manifold3d.Manifold.batch_boolean(solid.decompose(), manifold3d.OpType.Add)
    print(f'{name}: trimesh {both.is_volume} {both.volume:.3f}, numpy-stl {bool(stl.is_closed(exact=True))}', end=', ')
    print(f'manifold3d {solid.status().name} {solid.volume():.3f}, with a cube {more.volume():.3f}, of parts {parts.volume():.3f}')
END

venv/bin/python volumes.py | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
apart: trimesh True 2.000, numpy-stl True, manifold3d NoError 2.000, with a cube 3.000, of parts 2.000
overlapping: trimesh True 2.000, numpy-stl True, manifold3d NoError 2.000, with a cube 3.000, of parts 1.719
one edge: trimesh False 2.000, numpy-stl False, manifold3d NoError 2.000, with a cube 3.000, of parts 2.000
END
