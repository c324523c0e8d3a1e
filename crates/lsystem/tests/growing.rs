//! Growth between generations of systems with numbers: a drawing changes without jumps.

use lsystem::base::Limits;
use lsystem::syntax::Definition;
use lsystem::{Figure, System, read_file};
use std::path::{Path, PathBuf};

fn files() -> Vec<PathBuf> {
    let list = |path: &Path| -> Vec<PathBuf> {
        let mut found: Vec<_> = std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()).collect();
        found.sort();
        found
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in");
    list(&root).iter().flat_map(|folder| list(folder)).collect()
}

/// The drawing at a time as some numbers: the sum of all lengths, and the sums of the places and of the squares of the
/// places along each axis, each as often as its stroke is long.
fn measured(definition: &Definition, time: f64) -> Option<[f64; 7]> {
    let mut at = definition.clone();
    // As films and the page do.
    at.iterations = time.ceil() as u32;
    at.growth = 1.0 - (time.ceil() - time);
    let figure = Figure::draw(&System::new(&at).ok()?, at.iterations, &Limits::default()).ok()?;
    if figure.segment_count() > 20_000 {
        return None;
    }
    let mut all = [0.0_f64; 7];
    for segment in figure.segments_from(0) {
        let along = [0, 1, 2].map(|axis| segment.to[axis] - segment.from[axis]);
        let length = along.iter().map(|part| part * part).sum::<f64>().sqrt();
        all[0] += length;
        for axis in 0..3 {
            let middle = segment.from[axis] + along[axis] / 2.0;
            all[1 + axis] += length * middle;
            all[4 + axis] += length * middle * middle;
        }
    }
    Some(all)
}

/// The largest change of a number, as a part of the number.
fn change(a: [f64; 7], b: [f64; 7]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / a.abs().max(b.abs()).max(1.0)).fold(0.0, f64::max)
}

/// Checks that the drawing changes less and less in shorter and shorter times after each generation, and in the middle
/// of each step. Returns the number of generations; an error tells where the drawing jumps.
fn check(name: &str, definition: &Definition, most: u32) -> Result<u32, String> {
    for n in 0..=most.min(definition.iterations) {
        for time in [f64::from(n), f64::from(n) + 0.5] {
            let Some(still) = measured(definition, time) else { return Ok(n) };
            let moved = [1e-4, 1e-7].map(|late| measured(definition, time + late).map(|later| change(still, later)));
            let [Some(long), Some(short)] = moved else { return Ok(n) };
            if short > long / 300.0 + 1e-9 {
                return Err(format!("{name} jumps after {time}: {long} {short}"));
            }
        }
    }
    Ok(most)
}

#[test]
fn systems_of_the_gallery_with_numbers_grow_without_jumps() {
    let (mut checked, mut jumps) = (vec![], vec![]);
    for path in files() {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let definition = read_file(&std::fs::read(&path).unwrap()).definition.unwrap();
        let Ok(system) = System::new(&definition) else { continue };
        if system.rules.is_parametric() {
            match check(&name, &definition, 5) {
                Ok(2..) => checked.push(name),
                Ok(_) => {}
                Err(jump) => jumps.push(jump),
            }
        }
    }
    // In the first, a letter that only moves becomes another letter, whose way begins at zero; in the second, the letter G
    // draws a line and becomes blades of grass; in the third, twigs without light fall.
    let expected = ["ice-shield jumps after 0", "meadow jumps after 1", "two-trees jumps after 5"];
    let is_expected = jumps.len() == 3 && jumps.iter().zip(expected).all(|(jump, words)| jump.starts_with(words));
    assert!(is_expected, "{jumps:?}");
    assert!(checked.len() >= 25, "{checked:?}");
}

/// Systems whose modules have ages or lengths that their rules change, after The Algorithmic Beauty of Plants.
const TIMED: [(&str, &str, &str); 6] = [
    ("one line", "F(1)", "F(l) -> F(l*1.5)"),
    ("cells of Anabaena, section 6.2", "F(1)", "F(s) : s < 2 -> F(s*1.26)\nF(s) -> F(1)F(1)"),
    (
        "crocus, figure 3.8",
        "a(1)",
        "a(t) : t < 4 -> F(1)[&(30)L(0)]/(137.5)a(t + 1)\na(t) : t = 4 -> F(20)A\nA -> K(0)\nL(t) : t < 6 -> L(t + 1)\n\
         K(t) : t < 5 -> K(t + 1)\nF(l) : l < 2 -> F(l + 0.2)\ndraw:\nL(t) -> !(t/9)F(t)\nK(t) -> F(t/2)[+(20)F(t)][-(20)F(t)]",
    ),
    (
        "compound leaf, figure 5.11",
        "A(0)",
        "A(d) : d > 0 -> A(d - 1)\nA(d) -> F(1)[+A(1)][-A(1)]F(1)A(0)\nF(a) -> F(a*1.5)",
    ),
    (
        "branching angles",
        "A(1)",
        "A(s) -> F(s)[+(30)A(s*0.7)]-(10)A(s*0.8)\nF(s) -> F(s*1.2)\n+(a) -> +(a*1.1)\n!(w) -> !(w*2)",
    ),
    ("context", "F(1)F(2)X", "F(a) < F(b) -> F((a + b)/2)\nX -> F(1)X"),
];

#[test]
fn modules_with_ages_grow_without_jumps_between_steps() {
    for (name, axiom, rules) in TIMED {
        let definition = Definition {
            axiom: axiom.into(),
            rules: rules.into(),
            angle: 45.0,
            iterations: 9,
            ..Definition::default()
        };
        assert_eq!(check(name, &definition, 9), Ok(9));
    }
}

#[test]
fn the_numbers_of_a_step_go_evenly_from_those_before() {
    let length = |time: f64, axiom: &str, rules: &str| {
        let definition = Definition { axiom: axiom.into(), rules: rules.into(), ..Definition::default() };
        measured(&definition, time).unwrap()[0]
    };
    for part in [0.125, 0.5, 0.75] {
        // From 1 to 3, and what is new from 0 to 2.
        let grown = length(1.0 + part, "F(1)", "F(a) : a < 2 -> F(a)\nF(a) -> F(a)");
        assert!((grown - 1.0).abs() < 1e-12);
        let grown = length(part, "F(1)", "F(a) -> F(3*a)[+F(2*a)]");
        assert!((grown - (1.0 + 2.0 * part + 2.0 * part)).abs() < 1e-12, "{part}: {grown}");
        // Only the first module of the letter continues it.
        let grown = length(part, "F(1)", "F(a) -> F(3)F(5)");
        assert!((grown - (1.0 + 2.0 * part + 5.0 * part)).abs() < 1e-12, "{part}: {grown}");
        // The image follows the number, also where chance keeps the drawing from sharing.
        for weight in ["", " : 1\nA(t) -> A(t + 4) : 2"] {
            let rules = format!("A(t) -> A(t + 4){weight}\ndraw:\nA(t) -> F(t^2)");
            let grown = length(1.0 + part, "A(1)", &rules);
            assert!((grown - (5.0 + 4.0 * part) * (5.0 + 4.0 * part)).abs() < 1e-9, "{part}: {grown}");
        }
    }
}
