//! Hints for wrong answers: what is probably wrong, found by trying.

use crate::branches::{Branches, Joined, LengthFault};
use crate::difference::{Difference, Kind};
use crate::exercise::{Exercise, Given};
use crate::mark::{Marker, counted};
use crate::nudge::Nudge;
use crate::repair::{Repair, unmatched};
use crate::sketch::{Sketch, Sketching};
use lsystem_base::words::shown;
use lsystem_base::{MAX_ITERATIONS, Meter, counted, say};
use lsystem_derive::Tally;
use lsystem_drawing::{System, why_empty};
use lsystem_syntax::Definition;

/// Pictures that agree this much look the same.
const LOOKS_THE_SAME: f64 = 0.995;
/// Generations up to this many steps away are tried.
const STEPS: u32 = 2;
/// Angles of turns that are tried, in degrees.
const ANGLES: [f64; 12] = [15.0, 18.0, 20.0, 22.5, 25.0, 30.0, 36.0, 45.0, 60.0, 72.0, 90.0, 120.0];

impl Marker {
    /// The probable mistake in an answer, in words; `None` if no usual mistake explains it.
    #[must_use]
    pub fn hint(&self, student: &Definition) -> Option<String> {
        let exercise = self.exercise();
        let whole = exercise.complete(student);
        let mut meter = Meter::new(MAX_WORK);
        let own = sketch(&whole, &mut meter)?;
        if own.mask.is_empty() && !self.target().mask.is_empty() {
            let system = System::new(&whole).ok()?;
            return Some(why_empty(&system, whole.iterations).unwrap_or_else(|| say!("Nothing is drawn.")));
        }
        if !exercise.asks.is_searched() {
            return None;
        }
        if Exercise::symbols(&whole) == 0 {
            return Some(say!("There is no rule yet. A rule says what becomes of a letter: F -> F+F."));
        }
        self.turned(&own)
            .or_else(|| Some(say!("The brackets in the rule of {} do not match.", unmatched(&student.rules)?)))
            .or_else(|| Some(Repair::of(exercise, student, &mut meter)?.to_string()))
            .or_else(|| self.wrong_number(student, &own, &mut meter))
            .or_else(|| self.other_size(&own, &whole))
            .or_else(|| self.other_heading(&whole, &mut meter))
            .or_else(|| self.other_generation(&whole, &mut meter))
            .or_else(|| self.other_angle(&whole, &mut meter))
            .or_else(|| self.first_difference(&own))
    }

    fn looks_like(&self, own: &Sketch) -> bool {
        own.mask.agreement(&self.target().mask) >= LOOKS_THE_SAME
    }

    fn turned(&self, own: &Sketch) -> Option<String> {
        if self.looks_like(own) {
            return None;
        }
        // Exchanged turns are more usual than a wrong heading at the start.
        let mut turns = (0..4).map(|quarters| (quarters, true)).chain((1..4).map(|quarters| (quarters, false)));
        let (quarters, is_mirrored) = turns.find(|&(quarters, is_mirrored)| {
            own.mask.turned(quarters, is_mirrored).agreement(&self.target().mask) >= LOOKS_THE_SAME
        })?;
        Some(match (quarters, is_mirrored) {
            (0, _) => say!("Your drawing is a mirror image: left and right are exchanged."),
            (2, true) => say!("Your drawing is a mirror image: it is upside down."),
            (_, true) => say!("Your drawing is a mirror image, and turned."),
            (1, false) => say!("The shape is right, but turned by 90 degrees to the right."),
            (2, false) => say!("The shape is right, but upside down."),
            (_, false) => say!("The shape is right, but turned by 90 degrees to the left."),
        })
    }

    /// The same outline with another number of segments.
    fn other_size(&self, own: &Sketch, whole: &Definition) -> Option<String> {
        if !self.looks_like(own) {
            return None;
        }
        Some(match (self.segments(), own.segments(whole)) {
            (Some(expected), Some(found)) if *expected != found => {
                if found > *expected {
                    say!("Right outline, too many segments: {} instead of {}.", counted(&found), counted(expected))
                } else {
                    say!("Right outline, too few segments: {} instead of {}.", counted(&found), counted(expected))
                }
            }
            _ => say!("It looks right, but details differ. Compare the finest parts."),
        })
    }

    /// The same picture turned by a multiple of the system's own angle.
    fn other_heading(&self, whole: &Definition, meter: &mut Meter) -> Option<String> {
        let turns = [30.0, 60.0, 45.0, whole.angle].into_iter().flat_map(|by| [by, -by, 2.0 * by, -2.0 * by]);
        let by = turns.into_iter().find(|by| {
            let turned = Definition { heading: whole.heading + by, ..whole.clone() };
            *by != 0.0 && sketch(&turned, meter).is_some_and(|turned| self.looks_like(&turned))
        })?;
        let degrees = shown(&by.abs().to_string());
        Some(if by > 0.0 {
            say!("The shape is right, but turned by {} degrees to the right.", degrees)
        } else {
            say!("The shape is right, but turned by {} degrees to the left.", degrees)
        })
    }

    fn other_generation(&self, whole: &Definition, meter: &mut Meter) -> Option<String> {
        let near = (1..=STEPS).flat_map(|steps| [(true, steps), (false, steps)]);
        let (is_more, steps) = near.into_iter().find(|&(is_more, steps)| {
            let n = if is_more { whole.iterations + steps } else { whole.iterations.wrapping_sub(steps) };
            n <= MAX_ITERATIONS
                && sketch(&Definition { iterations: n, ..whole.clone() }, meter)
                    .is_some_and(|other| self.looks_like(&other))
        })?;
        let is_free = self.exercise().n == Given::Free;
        Some(match (is_free, is_more) {
            (true, true) => {
                counted!(steps, "The same after one more iteration.", "The same after two more iterations.")
            }
            (true, false) => {
                counted!(steps, "The same after one less iteration.", "The same after two less iterations.")
            }
            (false, true) => counted!(
                steps,
                "It would be the same after one more iteration: in each step your rules do too little.",
                "It would be the same after two more iterations: in each step your rules do too little."
            ),
            (false, false) => counted!(
                steps,
                "It would be the same after one less iteration: in each step your rules do too much.",
                "It would be the same after two less iterations: in each step your rules do too much."
            ),
        })
    }

    fn other_angle(&self, whole: &Definition, meter: &mut Meter) -> Option<String> {
        if self.exercise().angle != Given::Free {
            return None;
        }
        let own = self.exercise().target.angle;
        let found = ANGLES.into_iter().chain([own]).any(|angle| {
            sketch(&Definition { angle, ..whole.clone() }, meter).is_some_and(|other| self.looks_like(&other))
        });
        found.then(|| say!("The rules are right, but the angle is not."))
    }

    /// The number that is too large or too small, and what it does to the branches.
    fn wrong_number(&self, student: &Definition, own: &Sketch, meter: &mut Meter) -> Option<String> {
        let exercise = self.exercise();
        let whole = exercise.complete(student);
        let is_other = whole.angle != exercise.target.angle || whole.iterations != exercise.target.iterations;
        if is_other || !self.has_numbers() {
            return None;
        }
        let target = self.target().lists()?.0;
        let Joined { right, length, is_every } = Branches::of(&own.lists()?.0, &target)?.first_difference()?;
        let is_plane = target.iter().flatten().all(|point| point[2] == 0.0);
        // In space one turn makes good for another.
        let is_sure = length.is_some() || is_plane;
        let nudge = is_sure.then(|| Nudge::of(exercise, student, &target, meter)).flatten();
        let nudge = nudge.map(|nudge| nudge.to_string()).unwrap_or_default();
        let subject = match (is_every, right) {
            (true, _) => say!("Each branch"),
            (_, 1) => say!("The first segment is right. The second"),
            _ => say!("The first {} segments are right. The next", counted(&Tally::from(right as u128))),
        };
        let fault = match length {
            Some(LengthFault::TooShort) => say!("{} is too short beside the one that carries it.", subject),
            Some(LengthFault::TooLong) => say!("{} is too long beside the one that carries it.", subject),
            None => say!("{} turns by another angle.", subject),
        };
        Some(format!("{fault} {nudge}").trim_end().to_owned())
    }

    /// The first segment that differs.
    fn first_difference(&self, own: &Sketch) -> Option<String> {
        let [(own, _), (target, _)] = [own.lists()?, self.target().lists()?];
        let Difference { right, kind } = Difference::of(&own, &target)?;
        let many = |count: usize| counted(&Tally::from(count as u128));
        let subject = match right {
            0 => say!("The first segment"),
            1 => say!("The first segment is right. The second"),
            right => say!("The first {} segments are right. The next", many(right)),
        };
        Some(match kind {
            Kind::TooShort => say!("{} has the right direction, but is too short.", subject),
            Kind::TooLong => say!("{} has the right direction, but is too long.", subject),
            Kind::Turned(Some(by)) => {
                if by > 0.0 {
                    say!("{} has the right length, but points too far to the right.", subject)
                } else {
                    say!("{} has the right length, but points too far to the left.", subject)
                }
            }
            Kind::Turned(None) => say!("{} has the right length, but another direction.", subject),
            Kind::Other => say!("{} has another direction and another length.", subject),
            Kind::Elsewhere => say!("{} begins where the target has none: look at what comes before it.", subject),
            Kind::Missing(count) => counted!(
                count,
                "All that you draw is right, but one segment is missing.",
                "All that you draw is right, but {} segments are missing."
            ),
            Kind::TooMany(count) => counted!(
                count,
                "Nothing is missing, but one segment is too many.",
                "Nothing is missing, but {} segments are too many."
            ),
        })
    }
}

/// The units of work of one step of a drawing.
const WORK: u64 = 1 << 15;
/// The work of all drawings that are tried: less than a second, also where a unit takes 100 nanoseconds.
const MAX_WORK: u64 = 1 << 23;

/// A drawing that is tried. `None` as well if the meter is spent.
fn sketch(definition: &Definition, meter: &mut Meter) -> Option<Sketch> {
    let mut sketching = Sketching::new(definition).ok()?;
    while !meter.is_spent() {
        meter.charge(WORK);
        match sketching.step(WORK).ok()? {
            Ok(sketch) => return Some(sketch),
            Err(more) => sketching = more,
        }
    }
    None
}
