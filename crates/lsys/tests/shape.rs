//! Outlines and meshes as shapes, as a user of `lsys` makes them.

use crate::program;

use program::{command, outputs};

/// Runs `lsys shape` with a file of this content. Returns the exit code, standard output and standard error.
fn shape(name: &str, content: &[u8]) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join(name), content).expect("written");
    outputs(&mut command(folder.path(), ["shape", name]))
}

const PYRAMID: &str = "# a pyramid\nv 0 0 0\nv 2 0 0\nv 2 0 2\nv 0 0 2\nv 1 1 1\nf 1 2 3 4\nf 2 1 5\nf 3/1 2/2 5/3\nf 4 3 5\nf -5 -2 -1\n";

#[test]
fn outlines_and_meshes_are_lines_of_rules() {
    let (code, line, words) = shape("Leaf 1.svg", b"<svg viewBox='0 0 9 9'><path d='M0 0 4 0 4 8 0 8'/></svg>");
    assert_eq!((code, &*line, &*words), (Some(0), "shape leaf1 = outline(-5, 20, 5, 20, 5, 0, -5, 0)\n", ""));
    let (code, line, words) = shape("a.obj", PYRAMID.as_bytes());
    assert_eq!((code, &*words), (Some(0), ""));
    assert!(line.starts_with("shape a = mesh(-10, 0, -10, 10, 0, -10, 10, 0, 10, -10, 0, -10, "), "{line}");
    // The line is read as it is printed, and the mesh is a pyramid.
    let line = line.trim();
    assert_eq!(line.matches(',').count(), 6 * 9 - 1);
    let folder = tempfile::tempdir().expect("a folder");
    let rules = format!("{line}\\nA -> B(inside(a, 0, 4, 0), inside(a, 9, 4, 0), distance(a, 0, 13, 0))");
    let system = format!("{{\"axiom\": \"A\", \"rules\": \"{rules}\", \"iterations\": 1}}");
    std::fs::write(folder.path().join("s.json"), system).expect("written");
    let (code, text, words) = outputs(&mut command(folder.path(), ["expand", "s.json"]));
    assert_eq!((code, &*text), (Some(0), "B(1,0,3)\n"), "{words}");
}

/// A GLB of a tetrahedron in a node that is moved and twice as large.
fn glb() -> Vec<u8> {
    let corners: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut binary: Vec<u8> = corners.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
    binary.extend([0_u16, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3].iter().flat_map(|index| index.to_le_bytes()));
    let mut json = String::from(
        r#"{"nodes":[{"children":[1]},{"mesh":0,"scale":[2,2,2],"translation":[5,6,7]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}]}"#,
    );
    while json.len() % 4 != 0 {
        json.push(' ');
    }
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend(((28 + json.len() + binary.len()) as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json.as_bytes()), (b"BIN\0", &*binary)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

#[test]
fn binary_meshes_are_read() {
    let (code, line, words) = shape("t.glb", &glb());
    assert_eq!((code, &*words), (Some(0), ""));
    assert!(line.starts_with("shape t = mesh(-10, 0, -10, -10, 20, -10, 10, 0, -10, "), "{line}");
    // No damage makes the program panic.
    let whole = glb();
    for at in (0..whole.len()).step_by(23) {
        assert_eq!(shape("t.glb", &whole[..at]).0, Some(1), "{at}");
    }
}

#[test]
fn other_files_are_refused_in_words() {
    let check = |name: &str, content: &str, expected: &str| {
        let (code, line, words) = shape(name, content.as_bytes());
        assert_eq!((code, &*line, words.trim()), (Some(1), "", &*format!("error: {name}: {expected}")));
    };
    let open: String =
        PYRAMID.lines().filter(|line| !line.starts_with("f 2")).map(|line| format!("{line}\n")).collect();
    check("o.obj", &open, "this mesh is not closed: 3 edges have a triangle on one side only, or two that face apart");
    check("o.obj", "v 0 1\n", "line 1: a vertex has three numbers: v 0 1 0.5");
    check("o.obj", "v 0 1 2\nf 1 2 3\n", "line 2: a face has the numbers of three vertices or more: f 1 2 3");
    check("o.obj", "hello", "this is no SVG, OBJ or GLB with a mesh");
    check(
        "o.obj",
        &PYRAMID.replace("f 2 1 5", &"f 2 1 5\n".repeat(2000)),
        "this mesh has more than 2000 triangles; make it simpler first",
    );
    check(
        "s.svg",
        "<svg><path d='M0 0 4 4' fill='none' stroke='red'/></svg>",
        "this SVG has lines that are not filled, so it is no outline",
    );
}
