//! Hints for wrong answers: what is probably wrong, found by trying.

use crate::difference::{Difference, Kind};
use crate::exercise::{Exercise, Given};
use crate::mark::{Marker, counted};
use crate::repair::{Repair, unmatched};
use crate::sketch::{Sketch, Sketching};
use core::cell::Cell;
use lsystem_base::MAX_ITERATIONS;
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
        let tries = Tries { left: Cell::new(MAX_STEPS) };
        let own = tries.sketch(&whole)?;
        if own.mask.is_empty() && !self.target().mask.is_empty() {
            let system = System::new(&whole).0?;
            return Some(why_empty(&system, whole.iterations).unwrap_or_else(|| "Nothing is drawn.".to_owned()));
        }
        if !exercise.asks.is_searched() {
            return None;
        }
        if Exercise::symbols(&whole) == 0 {
            return Some("There is no rule yet. A rule says what becomes of a letter: F -> F+F.".to_owned());
        }
        self.turned(&own)
            .or_else(|| Some(format!("The brackets in the rule of {} do not match.", unmatched(&student.rules)?)))
            .or_else(|| Some(Repair::of(exercise, student)?.to_string()))
            .or_else(|| self.other_size(&own, &whole))
            .or_else(|| self.other_heading(&whole, &tries))
            .or_else(|| self.other_generation(&whole, &tries))
            .or_else(|| self.other_angle(&whole, &tries))
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
            (0, _) => "Your drawing is a mirror image: left and right are exchanged.".to_owned(),
            (2, true) => "Your drawing is a mirror image: it is upside down.".to_owned(),
            (_, true) => "Your drawing is a mirror image, and turned.".to_owned(),
            (1, false) => "The shape is right, but turned by 90 degrees to the right.".to_owned(),
            (2, false) => "The shape is right, but upside down.".to_owned(),
            (_, false) => "The shape is right, but turned by 90 degrees to the left.".to_owned(),
        })
    }

    /// The same outline with another number of segments.
    fn other_size(&self, own: &Sketch, whole: &Definition) -> Option<String> {
        if !self.looks_like(own) {
            return None;
        }
        Some(match (self.segments(), own.segments(whole)) {
            (Some(expected), Some(found)) if *expected != found => {
                let much = if found > *expected { "too many" } else { "too few" };
                format!("Right outline, {much} segments: {} instead of {}.", counted(&found), counted(expected))
            }
            _ => "It looks right, but details differ. Compare the finest parts.".to_owned(),
        })
    }

    /// The same picture turned by a multiple of the system's own angle.
    fn other_heading(&self, whole: &Definition, tries: &Tries) -> Option<String> {
        let turns = [30.0, 60.0, 45.0, whole.angle].into_iter().flat_map(|by| [by, -by, 2.0 * by, -2.0 * by]);
        let by = turns.into_iter().find(|by| {
            let turned = Definition { heading: whole.heading + by, ..whole.clone() };
            *by != 0.0 && tries.sketch(&turned).is_some_and(|turned| self.looks_like(&turned))
        })?;
        let way = if by > 0.0 { "right" } else { "left" };
        Some(format!("The shape is right, but turned by {} degrees to the {way}.", by.abs()))
    }

    fn other_generation(&self, whole: &Definition, tries: &Tries) -> Option<String> {
        let near = (1..=STEPS).flat_map(|steps| [(true, steps), (false, steps)]);
        let (is_more, steps) = near.into_iter().find(|&(is_more, steps)| {
            let n = if is_more { whole.iterations + steps } else { whole.iterations.wrapping_sub(steps) };
            n <= MAX_ITERATIONS
                && tries
                    .sketch(&Definition { iterations: n, ..whole.clone() })
                    .is_some_and(|other| self.looks_like(&other))
        })?;
        let (way, count) = (if is_more { "more" } else { "less" }, ["one", "two"][steps as usize - 1]);
        let s = if steps == 1 { "" } else { "s" };
        Some(match self.exercise().n {
            Given::Free => format!("The same after {count} {way} iteration{s}."),
            _ => format!("It would be the same after {count} {way} iteration{s}: in each step your rules do {}.", {
                if is_more { "too little" } else { "too much" }
            }),
        })
    }

    fn other_angle(&self, whole: &Definition, tries: &Tries) -> Option<String> {
        if self.exercise().angle != Given::Free {
            return None;
        }
        let own = self.exercise().target.angle;
        let found = ANGLES.into_iter().chain([own]).any(|angle| {
            tries.sketch(&Definition { angle, ..whole.clone() }).is_some_and(|other| self.looks_like(&other))
        });
        found.then(|| "The rules are right, but the angle is not.".to_owned())
    }

    /// The first segment that differs.
    fn first_difference(&self, own: &Sketch) -> Option<String> {
        let [(own, _), (target, _)] = [own.lists()?, self.target().lists()?];
        let Difference { right, kind } = Difference::of(&own, &target)?;
        let many = |count: usize| counted(&Tally::from(count as u128));
        let subject = match right {
            0 => "The first segment".to_owned(),
            1 => "The first segment is right. The second".to_owned(),
            right => format!("The first {} segments are right. The next", many(right)),
        };
        Some(match kind {
            Kind::TooShort => format!("{subject} has the right direction, but is too short."),
            Kind::TooLong => format!("{subject} has the right direction, but is too long."),
            Kind::Turned(Some(by)) => {
                let way = if by > 0.0 { "right" } else { "left" };
                format!("{subject} has the right length, but points too far to the {way}.")
            }
            Kind::Turned(None) => format!("{subject} has the right length, but another direction."),
            Kind::Other => format!("{subject} has another direction and another length."),
            Kind::Elsewhere => format!("{subject} begins where the target has none: look at what comes before it."),
            Kind::Missing(count) => format!(
                "All that you draw is right, but {} segment{} missing.",
                if count == 1 { "one".to_owned() } else { many(count) },
                if count == 1 { " is" } else { "s are" },
            ),
            Kind::TooMany(count) => format!(
                "Nothing is missing, but {} segment{} too many.",
                if count == 1 { "one".to_owned() } else { many(count) },
                if count == 1 { " is" } else { "s are" },
            ),
        })
    }
}

/// The units of work of one step.
const WORK: u64 = 1 << 18;
/// The steps of all tries together: about a second.
const MAX_STEPS: u32 = 160;

/// Drawings that are tried, with bounded work for all of them.
struct Tries {
    left: Cell<u32>,
}

impl Tries {
    fn sketch(&self, definition: &Definition) -> Option<Sketch> {
        let mut sketching = Sketching::new(definition).ok()?;
        loop {
            self.left.set(self.left.get().checked_sub(1)?);
            match sketching.step(WORK).ok()? {
                Ok(sketch) => return Some(sketch),
                Err(more) => sketching = more,
            }
        }
    }
}
