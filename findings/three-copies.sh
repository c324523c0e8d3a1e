#!/usr/bin/env bash
# A tree of three.js has its leaves as one InstancedMesh or BatchedMesh. Here are five boxes of twelve triangles: 60.
# Seen with three.js 0.187.0: the exporters of STL, OBJ and PLY write one box of an InstancedMesh; of a BatchedMesh STL and OBJ write its
# whole buffer, unused places as triangles without area, and GLTFExporter one mesh of that buffer: its copies are gone. GLTFExporter alone keeps
# the InstancedMesh. None says so.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --prefix . three@0.187.0

cat >write.mjs <<'END'
import { BatchedMesh, BoxGeometry, InstancedMesh, Matrix4, MeshStandardMaterial, Scene } from 'three';
import { GLTFExporter } from 'three/examples/jsm/exporters/GLTFExporter.js';
import { OBJExporter } from 'three/examples/jsm/exporters/OBJExporter.js';
import { PLYExporter } from 'three/examples/jsm/exporters/PLYExporter.js';
import { STLExporter } from 'three/examples/jsm/exporters/STLExporter.js';

// What the exporters ask of a browser.
globalThis.requestAnimationFrame = setImmediate;
globalThis.FileReader = class {
    async readAsDataURL(blob) {
        this.result = `data:;base64,${Buffer.from(await blob.arrayBuffer()).toString('base64')}`;
        this.onloadend();
    }
};
console.warn = () => {};

const [box, paint] = [new BoxGeometry(), new MeshStandardMaterial()];
const place = (copy) => new Matrix4().makeTranslation(3 * copy, 0, 0);
const instanced = new InstancedMesh(box, paint, 5);
const batched = new BatchedMesh(5, 100, 200, paint);
const geometry = batched.addGeometry(box);
for (let copy = 0; copy < 5; copy++) {
    instanced.setMatrixAt(copy, place(copy));
    batched.setMatrixAt(batched.addInstance(geometry), place(copy));
}
const count = (text, what) => text.match(what)?.length ?? 0;
for (const mesh of [instanced, batched]) {
    const scene = new Scene().add(mesh);
    scene.updateMatrixWorld(true);
    console.log(mesh.constructor.name, 'STL', count(new STLExporter().parse(scene), /facet normal/g));
    console.log(mesh.constructor.name, 'OBJ', count(new OBJExporter().parse(scene), /^f /gm));
    if (mesh === instanced) console.log(mesh.constructor.name, 'PLY', /face (\d+)/.exec(new PLYExporter().parse(scene, () => {}))[1]);
    const { nodes, accessors, extensionsUsed } = await new GLTFExporter().parseAsync(scene, {});
    console.log(mesh.constructor.name, 'glTF', nodes.length, accessors[0].count, extensionsUsed?.join() ?? 'no extension');
}
END

{
    node write.mjs
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
InstancedMesh STL 12
InstancedMesh OBJ 12
InstancedMesh PLY 12
InstancedMesh glTF 1 24 EXT_mesh_gpu_instancing
BatchedMesh STL 67
BatchedMesh OBJ 67
BatchedMesh glTF 1 100 no extension
END
