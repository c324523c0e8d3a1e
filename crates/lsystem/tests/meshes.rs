//! Meshes as files: the files keep the rules of their formats.

use lsystem::base::LimitName;
use lsystem::syntax::Kind;
use lsystem::{Definition, Limits, Mesh, Solid, System, draw, write_obj};

fn mesh(axiom: &str, n: u32, most: u64) -> Result<Mesh, lsystem::Diagnostic> {
    let definition = Definition {
        axiom: axiom.into(),
        rules: "A -> F[&A]/(120)'[&A]!A\nF -> FF".into(),
        angle: 25.7,
        start: [2.0, -1.0],
        ..Definition::default()
    };
    let system = System::new(&definition).unwrap();
    Mesh::new(&draw::<Solid>(&system, n, &Limits::default()).unwrap(), &system.style, most)
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
    assert!(matches!(error.kind, Kind::Limit { limit: LimitName::Mesh, value: 100, .. }), "{error:?}");
    assert_eq!(mesh("X", 3, 100).unwrap(), Mesh::default());
}
