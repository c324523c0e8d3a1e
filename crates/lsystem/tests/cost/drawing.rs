//! The cost of drawing, in steps and synchronous calls.

use super::systems::{LENGTHS, cases, generations};
use lsystem::base::{LimitName, Meter};
use lsystem::drawing::Space;
use lsystem::syntax::Kind;
use lsystem::{Definition, Dialect, Drawer, Drawing, Limits, Plane, Progress, Solid, System, draw};
use test_effort::sampled;

/// The limits of the page, except for memory, which is larger here.
pub(crate) const LIMITS: Limits =
    Limits { symbols: 64 << 20, modules: 16 << 20, segments: u32::MAX as u64, work: 100_000_000, memory: 112 << 20 };
/// The units of work of a step.
const SHARE: u64 = 1 << 16;
/// The most steps tested of each drawing.
const STEPS: usize = 48;

/// The largest of some numbers, with its name.
#[derive(Default)]
pub(crate) struct Largest {
    pub(crate) most: u64,
    pub(crate) name: String,
}

impl Largest {
    pub(crate) fn see(&mut self, value: u64, name: impl FnOnce() -> String) {
        if value > self.most {
            (self.most, self.name) = (value, name());
        }
    }
}

/// Runs steps until the end or the limit of steps. Returns the drawing if it is complete.
fn step<S: Space>(
    mut drawer: Drawer<S>,
    name: &str,
    (largest, fullest): (&mut Largest, &mut Largest),
) -> Option<Drawing<S>> {
    for _ in 0..STEPS {
        let before = drawer.spent();
        let progress = drawer.step(SHARE);
        let spent = drawer.spent() - before;
        largest.see(spent, || name.to_owned());
        fullest.see(drawer.bytes(), || name.to_owned());
        if progress == Progress::Done {
            return drawer.finish().ok();
        }
    }
    None
}

fn each(lengths: &[usize], mut visit: impl FnMut(&str, &System, u32)) {
    for (number, &length) in lengths.iter().enumerate() {
        for case in sampled(cases(length), 3, number) {
            let system = case.system();
            for &n in generations(length) {
                visit(&format!("{}, n = {n}", case.name), &system, n);
            }
        }
    }
}

fn check(lengths: &[usize]) {
    let (mut largest, mut fullest) = (Largest::default(), Largest::default());
    each(lengths, |name, system, n| {
        if system.is_solid() {
            step(Drawer::<Solid>::new(system, n, LIMITS), name, (&mut largest, &mut fullest));
        } else {
            step(Drawer::<Plane>::new(system, n, LIMITS), name, (&mut largest, &mut fullest));
        }
    });
    println!(
        "drawer: {} units beyond a share of {SHARE} at most ({})",
        largest.most.saturating_sub(SHARE),
        largest.name
    );
    println!("drawer: {} bytes at most ({})", fullest.most, fullest.name);
    assert!(largest.most <= SHARE + Meter::PIECE, "{} {}", largest.most, largest.name);
    assert!(fullest.most <= LIMITS.memory, "{} {}", fullest.most, fullest.name);
}

#[test]
fn no_step_of_a_drawing_takes_more_than_its_share_and_a_piece() {
    check(&LENGTHS[..3]);
}

#[test]
fn no_step_of_a_drawing_of_long_texts_takes_more_than_its_share_and_a_piece() {
    check(&LENGTHS[3..]);
}

/// Steps of these drawings once exceeded their share.
#[test]
fn no_step_of_a_drawing_of_many_symbols_with_numbers_or_branches_is_too_large() {
    let twice = format!("r = 0.75\nA -> {}\nF(x) -> F", "FF".repeat(8193));
    let branches = format!("F -> FB[v-XF-+][[XX..]FB-{}]\nr = -1", "XBX".repeat(300));
    for (dialect, axiom, rules, angle, n) in
        [(Dialect::Abop, "FFFAFF", twice, 90.0, 3), (Dialect::Practical, "A-FA-F", branches, 30.0, 5)]
    {
        let definition = Definition { dialect, axiom: axiom.into(), rules, angle, ..Definition::default() };
        let system = System::new(&definition).unwrap();
        let mut drawer = Drawer::<Plane>::new(&system, n, LIMITS);
        while {
            let before = drawer.spent();
            let progress = drawer.step(16_384);
            assert!(drawer.spent() - before <= 16_384 + Meter::PIECE);
            progress == Progress::More
        } {}
        assert!(drawer.finish().is_ok());
    }
}

/// Drawings that once used several times their memory limit before they were refused.
#[test]
fn refused_drawings_stay_within_their_memory() {
    let polygons = format!("F -> {{B{}}}XBF-FXBF-FXBF-F\nB -> FG\nA -> +%X-", "FAFF".repeat(1000));
    let cuts = format!("F -> G[{}F%[FGaFF]FF]F", "FF".repeat(4096));
    let acts = "F: draw unmarked 0.5, move, move 0.5, close branch, thinner, move 0.5";
    for (axiom, rules, overrides, angle, n) in [("FF-", polygons, "", -90.0, 8), ("FG+", cuts, acts, 60.0, 1000)] {
        let definition = Definition {
            axiom: axiom.into(),
            rules,
            overrides: overrides.into(),
            angle,
            length_variation: 50.0,
            ..Definition::default()
        };
        let system = System::new(&definition).unwrap();
        let mut drawer = Drawer::<Solid>::new(&system, n, LIMITS);
        let mut largest = 0;
        while drawer.step(16_384) == Progress::More {
            largest = largest.max(drawer.bytes());
        }
        assert!(drawer.finish().is_err() && largest <= LIMITS.memory, "{largest}");
    }
}

/// During drawing, the derived generation is in memory beside the drawing.
#[test]
fn what_a_drawing_is_derived_from_counts() {
    let rules = "F < F -> FF\nF > F -> FF";
    let definition =
        Definition { axiom: "FF".into(), rules: rules.into(), length_variation: 10.0, ..Definition::default() };
    let system = System::new(&definition).unwrap();
    let n = 16;
    let whole = draw::<Plane>(&system, n, &LIMITS).unwrap();
    // The bytes of a letter and its place in the derivation.
    let word = 10 * (2 << n);
    let mut drawer = Drawer::<Plane>::new(&system, n, LIMITS);
    let mut largest = 0;
    // Small steps, so that one ends when only the last blocks are missing.
    while drawer.step(100) == Progress::More {
        largest = largest.max(drawer.bytes());
    }
    assert!(largest >= whole.bytes() + word && largest <= LIMITS.memory, "{largest}, {} and {word}", whole.bytes());
    for share in [1000, u64::MAX] {
        let mut drawer = Drawer::<Plane>::new(&system, n, Limits { memory: whole.bytes() + word / 2, ..LIMITS });
        while drawer.step(share) == Progress::More {}
        let refused = drawer.finish().expect_err("more than the memory allowed");
        assert!(matches!(refused.kind, Kind::Limit { limit: LimitName::Memory, .. }), "{refused:?}");
    }
}

/// The drawing, if some steps complete it.
pub(crate) fn finished<S: Space>(drawer: Drawer<S>) -> Option<Drawing<S>> {
    step(drawer, "", (&mut Largest::default(), &mut Largest::default()))
}

/// The bytes of a segment in an unfolded drawing, in the plane and in space.
#[test]
fn segments_take_few_bytes() {
    let rules = "F -> F[+F]F[-F]F : 0.33\nF -> F[+F]F : 0.33\nF -> F[&F]F : 0.34";
    let definition = Definition { axiom: "F".into(), rules: rules.into(), angle: 25.7, ..Definition::default() };
    let system = System::new(&definition).unwrap();
    let limits = Limits { segments: 300_000, ..LIMITS };
    let n = (0..20).take_while(|&n| draw::<Plane>(&system, n, &limits).is_ok()).last().unwrap();
    let plane = draw::<Plane>(&system, n, &limits).unwrap();
    let solid = draw::<Solid>(&system, n, &limits).unwrap();
    let each = |bytes: u64, count: u128| bytes as f64 / count as f64;
    let [plane, solid] = [each(plane.bytes(), plane.segment_count()), each(solid.bytes(), solid.segment_count())];
    println!("bytes of a segment: {plane:.1} in the plane, {solid:.1} in space, with what pictures are made from");
    assert!(plane < 50.0 && solid < 340.0, "{plane} {solid}");
}
