//! Meshes as files: the files keep the rules of their formats.

use lsystem::syntax::{Kind, LimitName};
use lsystem::{Definition, Limits, Mesh, System, draw_solid, write_glb, write_obj};
use serde_json::Value;

fn mesh(axiom: &str, n: u32, most: u64) -> Result<Mesh, lsystem::Diagnostic> {
    let definition = Definition {
        axiom: axiom.into(),
        rules: "A -> F[&A]/(120)'[&A]!A\nF -> FF".into(),
        angle: 25.7,
        start: [2.0, -1.0],
        ..Definition::default()
    };
    let system = System::new(&definition).0.unwrap();
    Mesh::new(&draw_solid(&system, n, &Limits::default()).unwrap(), &system.style, most)
}

fn number(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
}

/// The JSON of a file, and the binary chunk.
fn chunks(file: &[u8]) -> (Value, &[u8]) {
    assert_eq!(&file[..4], b"glTF");
    assert_eq!((number(file, 4), number(file, 8)), (2, file.len()));
    let json = &file[20..20 + number(file, 12)];
    assert_eq!((&file[16..20], json.len() % 4), (&b"JSON"[..], 0));
    let rest = &file[20 + json.len()..];
    let binary = if rest.is_empty() { rest } else { &rest[8..8 + number(rest, 0)] };
    assert!(rest.is_empty() || (&rest[4..8] == b"BIN\0" && rest.len() == 8 + binary.len()));
    (serde_json::from_slice(json).unwrap(), binary)
}

#[test]
fn binary_gltf_is_consistent() {
    let mesh = mesh("A", 5, 100_000).unwrap();
    let file = write_glb(&mesh, "a \"name\"\n");
    let (json, binary) = chunks(&file);
    assert_eq!(json["nodes"][0]["name"], "a \"name\" ");
    assert_eq!(json["buffers"][0]["byteLength"], binary.len());
    let mut end = 0;
    for (view, accessor) in json["bufferViews"].as_array().unwrap().iter().zip(json["accessors"].as_array().unwrap()) {
        assert_eq!(view["byteOffset"], end);
        let size = match (accessor["componentType"].as_u64().unwrap(), accessor["type"].as_str().unwrap()) {
            (5126, "VEC3") => 12,
            (5123, "VEC4") => 8,
            (5125, "SCALAR") => 4,
            other => panic!("{other:?}"),
        };
        assert_eq!(view["byteLength"], size * accessor["count"].as_u64().unwrap());
        end += view["byteLength"].as_u64().unwrap();
    }
    assert_eq!(end, binary.len() as u64);
    let positions = &json["accessors"][0];
    for axis in 0..3 {
        let all = || mesh.positions.iter().map(|p| f64::from(p[axis]));
        assert_eq!(positions["min"][axis].as_f64(), Some(all().fold(f64::INFINITY, f64::min)));
        assert_eq!(positions["max"][axis].as_f64(), Some(all().fold(f64::NEG_INFINITY, f64::max)));
    }
    assert!(mesh.triangles.iter().flatten().all(|&corner| (corner as usize) < mesh.positions.len()));
    let empty = write_glb(&Mesh::default(), "");
    let (json, binary) = chunks(&empty);
    assert!(binary.is_empty() && json.get("meshes").is_none());
}

#[test]
fn obj_has_a_line_for_each_corner_and_triangle() {
    let mesh = mesh("A", 4, 100_000).unwrap();
    let text = write_obj(&mesh, "two words");
    let count = |start: &str| text.lines().filter(|line| line.starts_with(start)).count();
    assert_eq!(
        (count("v "), count("vn "), count("f ")),
        (mesh.positions.len(), mesh.normals.len(), mesh.triangles.len())
    );
    assert!(text.contains("\no two_words\n"));
    for line in text.lines().filter(|line| line.starts_with("v ")) {
        let values: Vec<f64> = line[2..].split(' ').map(|value| value.parse().unwrap()).collect();
        assert!(values.len() == 6 && values[3..].iter().all(|c| (0.0..=1.0).contains(c)), "{line}");
    }
    // The mesh lies at the drawing's coordinates: the trunk starts at the turtle's start.
    let first = text.lines().find(|line| line.starts_with("v ")).unwrap();
    let at: Vec<f64> = first[2..].split(' ').take(3).map(|value| value.parse().unwrap()).collect();
    assert!((at[0] - 2.0).abs() < 0.1 && (at[1] + 1.0).abs() < 0.1 && at[2].abs() < 0.1, "{first}");
}

#[test]
fn meshes_have_limits() {
    let error = mesh("A", 6, 100).unwrap_err();
    assert!(matches!(error.kind, Kind::Limit { limit: LimitName::Segments, value: 100, .. }), "{error:?}");
    assert_eq!(mesh("X", 3, 100).unwrap(), Mesh::default());
}
