#!/usr/bin/env bash
# Two triangles that share a side, as of a flat leaf: six corners, of which two pairs are at the same places. In the second mesh the z of
# three corners is -0, as sines and products give it.
# Seen: weld() of gltf-transform 4.5.1 compares bits, so that 0 and -0 are different places and nothing is joined; three.js 0.187.0 and
# meshoptimizer 1.3.0 join them.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --prefix . @gltf-transform/core@4.5.1 @gltf-transform/functions@4.5.1 three@0.187.0 meshoptimizer@1.3.0

cat >weld.mjs <<'END'
import { Document } from '@gltf-transform/core';
import { weld } from '@gltf-transform/functions';
import { MeshoptSimplifier } from 'meshoptimizer';
import { BufferAttribute, BufferGeometry } from 'three';
import { mergeVertices } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

await MeshoptSimplifier.ready;
for (const [name, zero] of [['0', 0], ['-0', -0]]) {
    const places = new Float32Array([0, 0, zero, 1, 0, zero, 1, 1, zero, 0, 0, 0, 1, 1, 0, 0, 1, 0]);
    const file = new Document();
    const positions = file.createAccessor().setType('VEC3').setArray(places).setBuffer(file.createBuffer());
    const triangles = file.createPrimitive().setAttribute('POSITION', positions);
    file.createMesh().addPrimitive(triangles);
    await file.transform(weld());
    const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(places, 3));
    console.log(
        `z ${name}: gltf-transform`, triangles.getAttribute('POSITION').getCount(),
        'three.js', mergeVertices(geometry).getAttribute('position').count,
        'meshoptimizer', new Set(MeshoptSimplifier.generatePositionRemap(places, 3)).size,
    );
}
END

node weld.mjs | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
z 0: gltf-transform 4 three.js 4 meshoptimizer 4
z -0: gltf-transform 6 three.js 4 meshoptimizer 4
END
