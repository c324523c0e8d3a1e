//! The systems of the course documents and of The Algorithmic Beauty of Plants. Their files in `data_in` equal the
//! published definitions (repeated in `data/seed.json`), give the published counts, and draw as the naive reference
//! does.

use crate::naive;
use lsystem::drawing::{Segment, Space};
use lsystem::{Definition, Dialect, Limits, Plane, Solid, System, count_segments, count_symbols, draw, expand};
use serde::Deserialize;
use std::collections::BTreeMap;

/// `data/seed.json`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Seed {
    systems: Vec<Published>,
    derivations: Vec<Derivation>,
    #[serde(rename = "move")]
    step: Step,
}

/// A system as its source defines it, and the expected results after `n` steps.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Published {
    /// The path in `data_in`, without `.json`.
    file: String,
    axiom: String,
    rules: Vec<Rule>,
    dialect: String,
    /// The angle of both turns in degrees, or of left turns if `right_angle` is given.
    angle: f64,
    right_angle: Option<f64>,
    /// The angles of pitching down and up, in degrees.
    pitch: Option<[f64; 2]>,
    /// The angles of rolling left and right, in degrees.
    roll: Option<[f64; 2]>,
    heading: f64,
    #[serde(default = "one")]
    step: f64,
    #[serde(default)]
    start: [f64; 2],
    #[serde(default)]
    overrides: BTreeMap<String, String>,
    n: u32,
    symbols: Option<u64>,
    segments: Option<u64>,
    /// The mean over all seeds; its error is half a unit of the last digit.
    mean_segments: Option<f64>,
    /// The least number over all seeds.
    min_segments: Option<u128>,
    /// The greatest number over all seeds.
    max_segments: Option<u128>,
    #[allow(dead_code, reason = "for the reader")]
    note: Option<String>,
}

fn one() -> f64 {
    1.0
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Rule {
    Always(char, String),
    Weighted(char, String, f64),
}

#[derive(Deserialize)]
struct Derivation {
    axiom: String,
    rules: BTreeMap<char, String>,
    n: u32,
    string: String,
}

/// One step forward.
#[derive(Deserialize)]
struct Step {
    from: [f64; 2],
    heading_deg: f64,
    distance: f64,
    to: [f64; 2],
}

fn seed() -> Seed {
    serde_json::from_str(include_str!("data/seed.json")).expect("seed.json is well-formed")
}

fn folder() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in")
}

impl Published {
    /// The definition of the source, without the file.
    fn definition(&self) -> Definition {
        let line = |rule: &Rule| match rule {
            Rule::Always(predecessor, successor) => format!("{predecessor} -> {successor}\n"),
            Rule::Weighted(predecessor, successor, weight) => format!("{predecessor} -> {successor} : {weight}\n"),
        };
        Definition {
            axiom: self.axiom.clone(),
            rules: self.rules.iter().map(line).collect(),
            iterations: self.n,
            angle: self.angle,
            right_angle: self.right_angle,
            pitch_down: self.pitch.map(|[down, _]| down),
            pitch_up: self.pitch.map(|[_, up]| up),
            roll_left: self.roll.map(|[left, _]| left),
            roll_right: self.roll.map(|[_, right]| right),
            heading: self.heading,
            step: self.step,
            start: self.start,
            dialect: *Dialect::ALL.iter().find(|dialect| dialect.name() == self.dialect).expect("a dialect"),
            overrides: self.overrides.iter().map(|(symbol, actions)| format!("{symbol}: {actions}\n")).collect(),
            ..Definition::default()
        }
    }

    fn system(&self, seed: u32) -> System {
        system(&Definition { seed, ..self.definition() })
    }

    fn is_stochastic(&self) -> bool {
        self.rules.iter().any(|rule| matches!(rule, Rule::Weighted(..)))
    }
}

fn system(definition: &Definition) -> System {
    System::new(definition).unwrap_or_else(|diagnostics| panic!("{definition:?}: {diagnostics:?}"))
}

fn text(system: &System, n: u32) -> String {
    expand(system, n, &Limits::default()).unwrap_or_else(|limit| panic!("{limit:?}"))
}

fn segments(system: &System, n: u32) -> Vec<Segment> {
    draw::<Plane>(system, n, &Limits::default()).unwrap_or_else(|limit| panic!("{limit:?}")).segments().collect()
}

#[test]
fn files_say_what_was_published() {
    for published in seed().systems {
        let file = folder().join(&published.file).with_added_extension("json");
        let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let (definition, diagnostics) = lsystem::read_json(&text);
        assert_eq!(diagnostics, [], "{}", published.file);
        let read = definition.unwrap_or_else(|| panic!("{}", published.file));
        let expected = published.definition();
        assert_eq!(
            (read.iterations, read.angle, read.right_angle, read.heading, read.step, read.start, read.dialect),
            (
                expected.iterations,
                expected.angle,
                expected.right_angle,
                expected.heading,
                expected.step,
                expected.start,
                expected.dialect
            ),
            "{}",
            published.file
        );
        let (read, expected) = (system(&read), system(&expected));
        assert_eq!(read.grammar, expected.grammar, "{}", published.file);
        let angles = |system: &System| {
            let turtle = &system.turtle;
            [turtle.pitch_down, turtle.pitch_up, turtle.roll_left, turtle.roll_right]
        };
        assert_eq!(angles(&read), angles(&expected), "{}", published.file);
        assert_eq!(read.turtle.actions, expected.turtle.actions, "{}", published.file);
    }
}

#[test]
fn counts_are_as_published() {
    let mut exact = 0;
    for published in seed().systems {
        let (Some(symbols), Some(segment_count)) = (published.symbols, published.segments) else { continue };
        let (n, file) = (published.n, &published.file);
        for seed in 0..if published.is_stochastic() { 20 } else { 1 } {
            let system = published.system(seed);
            assert_eq!(text(&system, n).chars().count() as u64, symbols, "{file}");
            assert_eq!(segments(&system, n).len() as u64, segment_count, "{file}");
            if !published.is_stochastic() {
                assert_eq!(count_symbols(&system, n), Some(symbols.into()), "{file}");
                assert_eq!(count_segments(&system, n), Some(segment_count.into()), "{file}");
            }
        }
        exact += 1;
    }
    assert_eq!(exact, 55, "systems with exact counts");
}

#[test]
fn strings_and_segments_equal_the_reference() {
    for published in seed().systems {
        for n in 0..=published.n {
            let system = published.system(n + 1);
            let file = &published.file;
            assert_eq!(text(&system, n), naive::expand(&system.grammar, system.seed, n), "{file} at {n}");
            let what = format!("{file} at {n}");
            if system.is_solid() {
                let drawing = draw::<Solid>(&system, n, &Limits::default()).unwrap_or_else(|limit| panic!("{limit:?}"));
                let fast: Vec<_> = drawing.segments().collect();
                same_segments(&fast, &naive::solid_segments(&system, n), &what);
            } else {
                let bounds =
                    draw::<Plane>(&system, n, &Limits::default()).unwrap_or_else(|limit| panic!("{limit:?}")).bounds();
                same_segments(&segments(&system, n), &naive::limited_segments(&system, n, bounds), &what);
            }
        }
    }
}

/// Checks that segments are equal; coordinates to 1e-9 of the drawing's extent.
fn same_segments<S: Space>(fast: &[Segment<S>], slow: &[Segment<S>], what: &str) {
    assert_eq!(fast.len(), slow.len(), "{what}");
    let ends = || slow.iter().flat_map(|segment| [segment.from, segment.to]);
    let side = |axis: usize| {
        let places = || ends().filter_map(|end| end.as_ref().get(axis).copied());
        places().fold(f64::NEG_INFINITY, f64::max) - places().fold(f64::INFINITY, f64::min)
    };
    let extent = (0..3).map(side).fold(0.0, f64::max);
    for (i, (a, b)) in fast.iter().zip(slow).enumerate() {
        assert_eq!(
            (a.colour, a.level, a.width, a.end_width),
            (b.colour, b.level, b.width, b.end_width),
            "{what}, segment {i}"
        );
        let ends = |s: &Segment<S>| [s.from, s.to].map(|end| end.as_ref().to_vec()).concat();
        for (a, b) in ends(a).iter().zip(&ends(b)) {
            assert!((a - b).abs() <= 1e-9 * extent, "{what}, segment {i}: {a} and {b}");
        }
    }
}

/// For a thousand seeds, the sample mean is nearly normally distributed about the true mean. It deviates by more than
/// four standard errors once in 16,000 tries, and the seeds are fixed.
#[test]
fn means_over_seeds_are_as_published() {
    const SEEDS: u32 = 1000;
    let mut random = 0;
    for published in seed().systems {
        let Some(expected) = published.mean_segments else { continue };
        let file = &published.file;
        let counts: Vec<u128> = (0..SEEDS)
            .map(|seed| {
                draw::<Plane>(&published.system(seed), published.n, &Limits::default()).expect("fits").segment_count()
            })
            .collect();
        let mean = counts.iter().sum::<u128>() as f64 / f64::from(SEEDS);
        let variance =
            counts.iter().map(|&c| (c as f64 - mean) * (c as f64 - mean)).sum::<f64>() / f64::from(SEEDS - 1);
        let error = (variance / f64::from(SEEDS)).sqrt();
        assert!((mean - expected).abs() < 4.0 * error + 0.5, "{file}: {mean} +- {error}, not {expected}");
        assert!(error < 0.02 * expected, "{file}: {error} leaves too much room");
        let (least, most) = (counts.iter().min().copied(), counts.iter().max().copied());
        assert!(published.min_segments.is_none_or(|min| least >= Some(min)), "{file}: {least:?}");
        assert!(published.max_segments.is_none_or(|max| most <= Some(max)), "{file}: {most:?}");
        assert!(least < most, "{file}: every seed gives the same count");
        random += 1;
    }
    assert_eq!(random, 4, "systems with random counts");
}

#[test]
fn derivations_are_as_published() {
    for Derivation { axiom, rules, n, string } in seed().derivations {
        let rules = rules.iter().map(|(symbol, successor)| format!("{symbol} -> {successor}\n")).collect();
        let system = system(&Definition { axiom, rules, ..Definition::default() });
        assert_eq!(text(&system, n), string);
    }
}

#[test]
fn a_step_goes_where_it_should() {
    let Step { from, heading_deg, distance, to } = seed().step;
    let definition =
        Definition { axiom: "F".into(), start: from, heading: heading_deg, step: distance, ..Definition::default() };
    let segments = segments(&system(&definition), 0);
    let [segment] = segments.as_slice() else { panic!("{segments:?}") };
    assert_eq!(segment.from, from);
    assert!((segment.to[0] - to[0]).abs() < 1e-15 && (segment.to[1] - to[1]).abs() < 1e-15, "{segment:?}");
}
