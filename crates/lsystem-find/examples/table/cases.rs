//! The systems whose pictures are searched.

use lsystem_base::Limits;
use lsystem_drawing::{Plane, System, draw};
use lsystem_syntax::Definition;

pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) definition: Definition,
    /// Whether no system that is searched draws the picture, and its lines, if it is no system's.
    pub(crate) lines: Option<Vec<[f64; 4]>>,
}

const NAMED: [(&str, &[&str]); 4] = [
    (
        "assignment",
        &["assignment-8/left_plant", "assignment-8/crossout", "assignment-8/hexerode", "assignment-8/flower_plant"],
    ),
    ("plants", &["abop/1.24a", "abop/1.24b", "abop/1.24c", "abop/1.24d", "abop/1.24e", "abop/1.24f"]),
    (
        "koch",
        &[
            "abop/1.7a",
            "abop/1.7b",
            "abop/1.9a",
            "abop/1.9b",
            "abop/1.9c",
            "abop/1.9e",
            "abop/1.9f",
            "curves/koch-snowflake",
            "curves/koch-island",
        ],
    ),
    (
        "curves",
        &[
            "curves/heighway-dragon",
            "curves/sierpinski-arrowhead",
            "curves/hilbert",
            "curves/gosper",
            "curves/levy-c",
            "curves/terdragon",
        ],
    ),
];
/// The angles of random systems, in degrees.
const ANGLES: [f64; 9] = [90.0, 60.0, 45.0, 30.0, 25.0, 20.0, 22.5, 36.0, 120.0];
/// The fewest and the most segments of random systems.
const SEGMENTS: [u128; 2] = [60, 12_000];

/// The systems of a family; `count` where they are random.
pub(crate) fn family(name: &str, count: usize) -> Vec<Case> {
    match name {
        "one-rule" => random(count, 1, 11),
        "two-rules" => random(count, 2, 22),
        "nothing" => nothing(count),
        _ => {
            let names = NAMED.iter().find(|(family, _)| *family == name).map_or(&[][..], |(_, names)| names);
            names.iter().map(|name| named(name)).collect()
        }
    }
}

/// The names of all families.
pub(crate) const FAMILIES: [&str; 7] = ["assignment", "plants", "koch", "curves", "one-rule", "two-rules", "nothing"];

fn named(name: &str) -> Case {
    let file = format!("{}/../../data_in/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(file).expect("a system");
    let mut definition = lsystem_files::read_json(&text).0.expect("a system");
    if definition.rules == "F -> F+F-F" {
        // The file has six terdragons in six colours.
        definition.axiom = "F".to_owned();
    }
    Case { name: name.to_owned(), definition, lines: None }
}

/// Deterministic random numbers.
struct Random(u64);

impl Random {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % most
    }

    /// A successor with exactly so many symbols.
    fn word(&mut self, letters: &[char], length: usize) -> String {
        loop {
            let (mut word, mut open) = (String::new(), 0);
            while word.len() + open < length {
                match self.below(8) {
                    0 if word.len() + open + 2 < length => {
                        word.push('[');
                        open += 1;
                    }
                    1 if open > 0 && !word.ends_with(['[', '+', '-']) => {
                        word.push(']');
                        open -= 1;
                    }
                    2 => word.push('+'),
                    3 => word.push('-'),
                    _ => word.push(letters[self.below(letters.len())]),
                }
            }
            word.push_str(&"]".repeat(open));
            if !["+-", "-+", "+]", "-]", "[]"].iter().any(|idle| word.contains(idle)) {
                return word;
            }
        }
    }
}

/// Random systems whose successors together have 5 to 10 symbols.
fn random(count: usize, rules: usize, seed: u64) -> Vec<Case> {
    let mut random = Random(seed);
    let mut cases = Vec::new();
    while cases.len() < count {
        let length = 5 + random.below(6);
        let letters = ['X', 'F'];
        let rules = match rules {
            1 => format!("F -> {}", random.word(&['F'], length)),
            2 => {
                let first = 3 + random.below(length - 4);
                format!("X -> {}\nF -> {}", random.word(&letters, first), random.word(&['F'], length - first))
            }
            _ => ["F", "G", "H"]
                .map(|letter| {
                    let length = 5 + random.below(5);
                    format!("{letter} -> {}", random.word(&['F', 'G', 'H'], length))
                })
                .join("\n"),
        };
        let axiom = if rules.starts_with('X') { "X" } else { "F" };
        let angle = ANGLES[random.below(ANGLES.len())];
        let overrides = if rules.contains('H') { "H: draw" } else { "" };
        let definition =
            Definition { axiom: axiom.into(), rules, angle, overrides: overrides.into(), ..Definition::default() };
        // A straight line is no picture of lines.
        let is_shown = |n| crate::inputs::clean(&Definition { iterations: n, ..definition.clone() }, 256).is_ok();
        if let Some(iterations) = iterations(&definition).filter(|&n| is_shown(n)) {
            let name = format!("{axiom} {} {angle}° n={iterations}", definition.rules.replace('\n', "; "));
            cases.push(Case { name, definition: Definition { iterations, ..definition }, lines: None });
        }
    }
    cases
}

/// As many derivation steps as a picture shows, if there are at least three.
fn iterations(definition: &Definition) -> Option<u32> {
    let is_idle = |line: &str| line.split(" -> ").nth(1).is_some_and(|word| !word.contains(&line[..1]));
    if definition.rules.lines().any(is_idle) {
        return None;
    }
    let system = System::new(definition).ok()?;
    let count = |n: u32| draw::<Plane>(&system, n, &Limits::default()).map(|drawing| drawing.segment_count()).ok();
    let n = (3..=8).take_while(|&n| count(n).is_some_and(|count| count <= SEGMENTS[1])).last()?;
    (count(n)? >= SEGMENTS[0]).then_some(n)
}

/// Pictures that no system draws which is searched: scribbles of one hand, crossing lines, and systems with three rules.
fn nothing(count: usize) -> Vec<Case> {
    let mut number = Random(33);
    let of_three = random(count.div_ceil(3), 3, 44);
    let mut cases: Vec<Case> = of_three
        .into_iter()
        // Whatever is found is false, unless it draws the same.
        .map(|case| Case { lines: Some(Vec::new()), ..case })
        .collect();
    while cases.len() < count {
        let mut place = || number.below(3000) as f64 / 100.0;
        let lines: Vec<[f64; 4]> = match cases.len() % 2 {
            0 => (0..40).map(|_| [place(), place(), place(), place()]).collect(),
            _ => {
                let (mut x, mut y) = (0.0, 0.0);
                (0..200)
                    .map(|_| {
                        let from = (x, y);
                        (x, y) = (x + place() - 15.0, y + place() - 15.0);
                        [from.0, from.1, x, y]
                    })
                    .collect()
            }
        };
        let angle = ANGLES[number.below(ANGLES.len())];
        let definition = Definition { axiom: "F".into(), angle, iterations: 4, ..Definition::default() };
        cases.push(Case { name: format!("scribble {}", cases.len()), definition, lines: Some(lines) });
    }
    cases
}
