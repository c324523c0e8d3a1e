//! Notes, beside a turtle that reads the whole string.

use lsystem_base::{Limits, Meter};
use lsystem_drawing::{Figure, System, expand};
use lsystem_sound::{Heard, Note, Pitch, SoundOptions, Time, Tune, Walk, listen, marked};
use lsystem_syntax::{Definition, Halt, Work};
use proptest::prelude::*;

fn heard(definition: &Definition, options: &SoundOptions) -> Tune {
    let draw =
        &mut |system: &System, n, _: &mut dyn Work| Figure::draw(system, n, &Limits::default()).map_err(Halt::from);
    listen(&system(definition), definition.iterations, options, draw, &mut Meter::new(u64::MAX)).unwrap()
}

fn system(definition: &Definition) -> System {
    System::new(definition).unwrap_or_else(|diagnostics| panic!("{diagnostics:?}"))
}

/// A line as a turtle draws it: its ends, letter, branch level, branch (the number of its `[`; 0 for the stem), and its
/// times by step and by length.
#[derive(Debug)]
struct Drawn {
    ends: [[f64; 2]; 2],
    letter: char,
    level: u32,
    branch: usize,
    times: [f64; 2],
}

#[derive(Clone)]
struct Turtle {
    at: [f64; 2],
    degrees: f64,
    branch: usize,
    /// Where and when the branch's last line ended.
    end: Option<[f64; 2]>,
    time: f64,
}

fn far(from: [f64; 2], to: [f64; 2]) -> f64 {
    libm::hypot(to[0] - from[0], to[1] - from[1])
}

/// All lines, the least and greatest y of lines and branches, and the mean length.
fn naive(definition: &Definition) -> (Vec<Drawn>, [f64; 2], f64) {
    let text: Vec<char> =
        expand(&system(definition), definition.iterations, &Limits::default()).unwrap().chars().collect();
    // The first pass finds the mean length.
    let mut mean = f64::NAN;
    let (mut lines, mut heights) = (vec![], vec![]);
    for _ in 0..2 {
        (lines, heights) = (vec![], vec![]);
        let start = Turtle { at: [0.0; 2], degrees: definition.heading, branch: 0, end: None, time: 0.0 };
        let (mut turtle, mut stack, mut branches, mut clock) = (start, vec![], 0, 0.0);
        for (place, &symbol) in text.iter().enumerate() {
            let number = (text.get(place + 1) == Some(&'(')).then(|| {
                let digits: String = text[place + 2..].iter().take_while(|&&digit| digit != ')').collect();
                digits.parse::<f64>().unwrap()
            });
            let arrive = |turtle: &mut Turtle, clock: &mut f64| {
                let jump = turtle.end.map_or(0.0, |end| far(end, turtle.at));
                if jump > 1e-7 {
                    turtle.time += (jump / mean).min(64.0);
                    *clock += 1.0;
                }
                turtle.end = Some(turtle.at);
            };
            match symbol {
                'F' | 'G' | 'f' => {
                    let from = turtle.at;
                    if symbol != 'f' {
                        arrive(&mut turtle, &mut clock);
                    }
                    let length = number.unwrap_or(1.0);
                    let angle = turtle.degrees.to_radians();
                    turtle.at = [from[0] + length * libm::cos(angle), from[1] + length * libm::sin(angle)];
                    if symbol != 'f' {
                        let (level, branch) = (stack.len() as u32, turtle.branch);
                        let times = [clock, turtle.time];
                        lines.push(Drawn { ends: [from, turtle.at], letter: symbol, level, branch, times });
                        heights.extend([from[1], turtle.at[1]]);
                        clock += 1.0;
                        turtle.time += length.abs() / mean;
                        turtle.end = Some(turtle.at);
                    }
                }
                '+' => turtle.degrees += definition.angle,
                '-' => turtle.degrees -= definition.angle,
                '[' => {
                    arrive(&mut turtle, &mut clock);
                    heights.push(turtle.at[1]);
                    stack.push(turtle.clone());
                    branches += 1;
                    turtle.branch = branches;
                }
                ']' => turtle = stack.pop().unwrap_or(turtle),
                _ => {}
            }
        }
        let sum: f64 = lines.iter().map(|line: &Drawn| far(line.ends[0], line.ends[1])).sum();
        mean = sum / lines.len() as f64;
    }
    let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (lines, [low, high], mean)
}

fn compare(definition: &Definition) {
    let (lines, [low, high], mean) = naive(definition);
    let drawing: Vec<char> = system(definition)
        .rules
        .letters
        .iter()
        .map(|letter| letter.symbol)
        .filter(|symbol| "FG".contains(*symbol))
        .collect();
    for (time, own) in [(Time::Step, 0), (Time::Length, 1)] {
        let tune = heard(definition, &SoundOptions { time, notes: 100_000, ..SoundOptions::default() });
        let letters = heard(
            definition,
            &SoundOptions { time, pitch: Pitch::Letter, octaves: 1, notes: 100_000, ..SoundOptions::default() },
        );
        assert_eq!((tune.notes.len(), tune.heard), (lines.len(), Heard::All));
        let mut branches: Vec<usize> = vec![];
        let mut end = 0.0_f64;
        for (number, (note, line)) in tune.notes.iter().zip(&lines).enumerate() {
            assert!(far([note.at[0], note.at[1]], line.ends[1]) < 1e-6, "{note:?} {line:?}");
            if !branches.contains(&line.branch) {
                branches.push(line.branch);
            }
            assert_eq!(branches[note.voice as usize], line.branch, "line {number}");
            assert_eq!(note.segment, number as u128);
            let length = [1.0, far(line.ends[0], line.ends[1]) / mean][own];
            assert!((note.start - line.times[own]).abs() < 1e-6, "{note:?} {line:?}");
            assert!((note.length - length).abs() < 1e-6, "{note:?} {line:?}");
            assert_eq!(u32::from(note.velocity), (100_u32.saturating_sub(9 * line.level)).max(48));
            end = end.max(note.start + note.length);
            // Pentatonic on C, 16 pitches from 48 on.
            let place = if high - low > 1e-9 { (line.ends[1][1] - low) / (high - low) * 15.0 } else { 7.5 };
            let degree = [0, 2, 4, 7, 9].map(|tone| tone + 48).repeat(4);
            let octave = |at: usize| degree[at] + 12 * (at / 5) as u8;
            let near = [place - 1e-4, place + 1e-4].map(|place| octave(place.clamp(0.0, 15.0).round() as usize));
            assert!(near.contains(&note.key), "{note:?} {place}");
            let rank = drawing.iter().position(|&letter| letter == line.letter).unwrap();
            assert_eq!(letters.notes[number].key, 60 + [0, 2, 4][rank]);
        }
        assert_eq!((tune.voices as usize, tune.length), (branches.len(), end));
    }
}

fn word() -> impl Strategy<Value = String> {
    let part = prop_oneof![
        4 => Just("F".to_owned()),
        2 => Just("G".to_owned()),
        2 => Just("A".to_owned()),
        1 => Just("f".to_owned()),
        2 => Just("+".to_owned()),
        2 => Just("-".to_owned()),
    ];
    part.prop_recursive(3, 12, 4, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..4).prop_map(|parts| parts.concat()),
            prop::collection::vec(inner, 0..4).prop_map(|parts| format!("[{}]", parts.concat())),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn notes_are_the_lines_of_a_turtle_that_reads_the_string(
        axiom in prop::collection::vec(word(), 1..4),
        (f, g, a) in (word(), word(), word()),
        n in 0_u32..4,
        angle in prop_oneof![Just(60.0), Just(90.0), 1.0..120.0],
        seed: u32,
    ) {
        let rules = format!("F -> F{f} : 2\nF -> {f}F : 1\nG -> {g}\nA -> {a}");
        let rules = if seed % 2 == 0 { rules } else { format!("F -> F{f}\nG -> {g}\nA -> {a}") };
        compare(&Definition { axiom: axiom.concat(), rules, angle, seed, iterations: n, ..Definition::default() });
    }
}

#[test]
fn notes_of_published_systems_are_the_lines_of_a_turtle() {
    let own = |axiom: &str, rules: &str, angle: f64, iterations: u32| Definition {
        axiom: axiom.into(),
        rules: rules.into(),
        angle,
        iterations,
        ..Definition::default()
    };
    // A Hilbert curve, a bush, Cantor's set, a tree with parameters, one with contexts.
    compare(&own("A", "A -> +BF-AFA-FB+\nB -> -AF+BFB+FA-", 90.0, 4));
    compare(&own("X", "X -> F[+X][-X]FX\nF -> FF", 25.7, 4));
    compare(&own("F", "F -> FfF\nf -> fff", 90.0, 5));
    compare(&own("A(1)", "A(s) -> F(s)[+A(s/2)][-A(s*0.7)]F(s/3)", 40.0, 5));
    compare(&own("GF[+F]F[-F]F", "G < F -> G\nG -> F[+G]F", 30.0, 4));
}

#[test]
fn colours_widths_and_leaves_change_no_note() {
    let plain = Definition {
        axiom: "F[+FF]F[-F]F".into(),
        rules: "F -> FF[+F]".into(),
        angle: 30.0,
        iterations: 2,
        ..Definition::default()
    };
    let shown =
        Definition { axiom: "!F[+'F{.F.}●(3)]F,(3)[-;F]F".into(), rules: "F -> F#F[!(2)+F]".into(), ..plain.clone() };
    let [plain, shown] = [plain, shown].map(|definition| heard(&definition, &SoundOptions::default()));
    assert_eq!((plain.notes.len(), plain.voices), (shown.notes.len(), shown.voices));
    for (one, other) in plain.notes.iter().zip(&shown.notes) {
        // A leaf may be the highest place.
        let Note { key, side, at, .. } = *one;
        assert_eq!(*one, Note { key, side, at, ..*other });
        assert!(far([at[0], at[1]], [other.at[0], other.at[1]]) < 1e-9);
    }
}

#[test]
fn long_walks_are_heard_at_even_distances_or_as_an_earlier_generation() {
    let hilbert = Definition {
        axiom: "A".into(),
        rules: "A -> +BF-AFA-FB+\nB -> -AF+BFB+FA-".into(),
        angle: 90.0,
        iterations: 40,
        ..Definition::default()
    };
    let options = SoundOptions { notes: 1_000, ..SoundOptions::default() };
    let all = (1_u128 << 80) - 1;
    let tune = heard(&hilbert, &options);
    assert_eq!((tune.notes.len(), tune.length, tune.heard), (1_000, 1_000.0, Heard::Some(all)));
    for (number, note) in (0_u128..).zip(&tune.notes) {
        assert_eq!(note.segment, all / 1_000 * number + all % 1_000 * number / 1_000);
    }
    // The same lines, one by one.
    let system = marked(&system(&hilbert));
    let walk = Walk::new(Figure::draw(&system, 40, &Limits::default()).unwrap(), &system);
    let note = walk.part(tune.notes[700].segment, 1, 3, &options, &mut Meter::new(u64::MAX)).unwrap().notes;
    assert_eq!((note.len(), note[0].key, note[0].at), (3, tune.notes[700].key, tune.notes[700].at));
    assert_eq!(walk.part(all, 1, 3, &options, &mut Meter::new(u64::MAX)).unwrap().notes, vec![]);
    // 4^5 - 1 lines are too many, 4^4 - 1 are not.
    let together = heard(&hilbert, &SoundOptions { time: Time::Length, ..options });
    assert_eq!((together.notes.len(), together.heard), (255, Heard::Earlier(4)));
    assert_eq!(together.length, 255.0);
}

#[test]
fn the_parts_of_a_walk_are_its_lines() {
    let bush = Definition {
        axiom: "X".into(),
        rules: "X -> F[+X][-X]FX\nF -> FF".into(),
        angle: 25.7,
        iterations: 6,
        ..Definition::default()
    };
    let system = marked(&system(&bush));
    let walk = Walk::new(Figure::draw(&system, 6, &Limits::default()).unwrap(), &system);
    let options = SoundOptions { notes: 100_000, ..SoundOptions::default() };
    let meter = &mut Meter::new(u64::MAX);
    let all = walk.tune(&options, meter).unwrap().notes;
    for (from, stride) in [(0, 1), (0, 7), (123, 50), (all.len() - 2, 1)] {
        let part = walk.part(from as u128, stride as u128, 40, &options, meter).unwrap().notes;
        let expected = all[from..].iter().step_by(stride).take(40);
        assert!(part.len() == expected.len() && !part.is_empty());
        for (note, own) in part.iter().zip(expected) {
            assert_eq!((note.segment, note.key, note.velocity), (own.segment, own.key, own.velocity));
            assert_eq!((note.at, note.side), (own.at, own.side));
        }
    }
}

#[test]
fn choices_out_of_range_and_drawings_without_lines_are_ordinary() {
    let nothing = Definition { axiom: "f[+f]".into(), ..Definition::default() };
    let tune = heard(&nothing, &SoundOptions::default());
    assert_eq!((tune.notes.len(), tune.voices, tune.length), (0, 0, 0.0));
    for (step, jump) in [(1e-9, 1.0), (1e6, 1e12), (1e-6, 1e-12)] {
        let axiom = format!("F(0)FF[+F]f({jump})F");
        let wild = Definition { axiom, step, ..Definition::default() };
        for time in [Time::Step, Time::Length] {
            let options = SoundOptions { time, octaves: 0, tempo: f64::NAN, ..SoundOptions::default() };
            let tune = heard(&wild, &options);
            assert_eq!(tune.notes.len(), 5);
            assert!(tune.notes.iter().all(|note| note.start.is_finite() && note.length.is_finite()));
            assert!(tune.length.is_finite() && options.step_seconds() == 0.125);
        }
    }
}
