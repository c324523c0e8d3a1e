//! Meshes of other programs: right ones, and damaged ones.

use crate::pieces::pieces;
use crate::{Gauge, Source, make};
use lsystem::files::mesh_shape;
use lsystem::syntax::MAX_SIDES;

const OBJ: &str =
    "v 0 0 0\nv 2 0 0\nv 2 0 2\nv 0 0 2\nv 1 1 1\nf 1 2 3 4\nf 2 1 5\nf 3/1 2/2 5/3\nf 4 3 5\nf -5 -2 -1\n";
const JSON: &str = r#"{"nodes":[{"children":[1]},{"mesh":0,"scale":[2,2,2],"translation":[5,6,7]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}]}"#;

pub(super) fn meshes(source: &mut Source<'_>, gauge: &mut Gauge) {
    let is_text = source.once_in(2);
    let mut text = if is_text { OBJ.to_owned() } else { JSON.to_owned() };
    if !source.once_in(8) {
        make::damage(source, &mut text, pieces("meshes"), 8);
    }
    let bytes = if is_text { text.into_bytes() } else { glb(&text) };
    match gauge.call("mesh", || mesh_shape(&bytes)) {
        Ok(shape) => {
            gauge.reach("mesh");
            let numbers = shape.matches(',').count() + 1;
            assert!(shape.starts_with("mesh(") && numbers % 9 == 0 && numbers <= 9 * MAX_SIDES);
        }
        Err(why) => assert!(!why.is_empty()),
    }
}

/// A GLB with a tetrahedron in its binary chunk.
fn glb(json: &str) -> Vec<u8> {
    let corners: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut binary: Vec<u8> = corners.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
    binary.extend([0_u16, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3].iter().flat_map(|index| index.to_le_bytes()));
    let mut file = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
    for (kind, chunk) in [(b"JSON", json.as_bytes()), (b"BIN\0", &*binary)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}
