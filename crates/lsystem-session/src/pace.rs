//! Time: how long steps and pictures may take, and the quality at which moving pictures are in time.
//!
//! All times are in milliseconds and come from the time between two frames of a screen at 60 Hz.

use lsystem::render::Quality;

/// The time between two frames of the screen.
const FRAME: f64 = 1000.0 / 60.0;
/// A step: half a frame, so that each frame finds a worker that has received the newest input, and the page has the other
/// half to show the picture.
pub const STEP: f64 = 8.0;
/// A step while a picture is refined. Nobody waits for the finer picture, but new input waits for the end of the step: a
/// fifth of a frame is not noticed.
pub(crate) const REFINING: f64 = 3.0;
const _: () = assert!(2.0 * STEP < FRAME && 5.0 * REFINING < FRAME);

/// The units of work between two looks at the clock. A unit is the visit of a node or some pixels: some ten nanoseconds,
/// so that a step exceeds its time by a twentieth at most.
pub(crate) const WORK: usize = 16_384;
/// The units of work between two looks at the clock for a moving picture, whose effort is reduced in time only if the
/// clock is read often: a quarter of the usual.
pub(crate) const MOVING_WORK: usize = WORK / 4;
/// The units of work for each count before the first report. Two counts take less than a step, and finish for all systems
/// but those with huge numbers.
pub(crate) const COUNTING: u64 = 8 * WORK as u64;

/// The wanted time of a moving picture: a step, less half a millisecond to put the picture on the canvas.
const TARGET: f64 = STEP - 0.5;
/// A moving picture of more than this part of [`TARGET`] over its time keeps its quality.
const STEADY: f64 = 0.85;
/// A moving picture that takes longer than this is finished with less effort: the longest time that keeps the quality.
const HURRY: f64 = TARGET / STEADY;
/// The part of the remaining effort with which a late picture is finished. Two reductions leave less than a tenth.
pub(crate) const HURRIED_EFFORT: f32 = 0.3;
/// After two moving pictures in a row that take longer than this, with the time to show them, the next ones have half the
/// width and height: fewer pixels leave time for more detail. A guess between the first reduction of the effort and the
/// second one: less effort alone does not help such pictures.
const HALVE: f64 = 1.4 * TARGET;
const _: () = assert!(HURRY < HALVE && HALVE < 1.5 * HURRY);
/// One late picture may be an accident; two in a row are not.
const LATE_PICTURES: u8 = 2;
/// The number of steps by which the quality of such half-size pictures rises. A quarter of the pixels would pay for four
/// steps, since two steps double the effort; one is kept back for work that does not depend on pixels.
const FINER: i32 = 3;
/// If a half-size picture with all detail takes no longer than this, the next picture has full size: four times the pixels
/// take at most four times as long.
pub(crate) const WHOLE: f64 = TARGET / 4.0;
/// The quality of the first picture of a drawing whose cost is unknown: ten steps below [`Quality::MOVING`], a 32nd of its
/// effort.
const UNKNOWN: Quality = Quality(4);

/// The time after which the effort of a moving picture is reduced, for the first time and again.
pub(crate) struct Deadline(f64);

impl Deadline {
    pub(crate) fn new() -> Self {
        Self(HURRY)
    }

    /// Whether the effort of a picture that has taken `spent` is to be reduced now.
    pub(crate) fn has_passed(&mut self, spent: f64) -> bool {
        let passed = spent > self.0;
        if passed {
            self.0 += 0.5 * HURRY;
        }
        passed
    }
}

/// Whether a picture at rest takes so long that others should help: longer than a moving picture may take.
pub(crate) fn is_long(spent: f64) -> bool {
    spent > HURRY
}

/// The quality and size at which moving pictures are in time.
pub(crate) struct Pace {
    pub(crate) quality: Quality,
    /// Whether moving pictures have half the width and height.
    pub(crate) is_half: bool,
    /// The number of moving pictures in a row that were too slow.
    late: u8,
}

impl Default for Pace {
    fn default() -> Self {
        Self { quality: UNKNOWN, is_half: false, late: 0 }
    }
}

impl Pace {
    /// Prepares for a drawing whose cost is unknown.
    pub(crate) fn be_careful(&mut self) {
        self.quality = self.quality.min(UNKNOWN);
    }

    /// Chooses the quality and size of the next moving picture, after one that took `spent` to make and `shown` to put on
    /// the canvas.
    pub(crate) fn learn(&mut self, spent: f64, shown: f64) {
        let finest = self.quality == Quality::MOVING;
        self.quality = self.quality.paced(quality_steps(spent));
        if self.is_half {
            self.is_half = !finest || spent > WHOLE;
            return;
        }
        self.late = if spent + shown > HALVE { self.late + 1 } else { 0 };
        if self.late == LATE_PICTURES {
            (self.is_half, self.late) = (true, 0);
            self.quality = self.quality.paced(FINER);
        }
    }
}

/// The number of quality steps from a picture that took `spent` to the next one. Two steps double the effort, so the
/// bounds are powers of the square root of 2: a finer picture is in time if time grows as effort does (3 steps: 2.83 times
/// the effort at 2.5 times the time). Four steps at most, because a single very late picture may be an accident.
fn quality_steps(spent: f64) -> i32 {
    let ratio = TARGET / spent.max(0.01);
    match ratio {
        ..0.25 => -4,
        ..0.5 => -2,
        ..STEADY => -1,
        ..1.5 => 0,
        ..2.5 => 1,
        _ => 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The time of a picture, if time grows as effort and the number of pixels do.
    fn time(cost: f64, pace: &Pace) -> f64 {
        let effort = libm::exp2(f64::from(pace.quality.0) / 2.0);
        cost * effort * if pace.is_half { 0.25 } else { 1.0 }
    }

    #[test]
    fn moving_pictures_come_to_rest_at_the_finest_quality_in_time() {
        // From pictures that are free to those that no quality makes in time.
        for exponent in -20..8 {
            let cost = libm::exp2(f64::from(exponent) / 2.0);
            let mut pace = Pace::default();
            for _ in 0..12 {
                let spent = time(cost, &pace);
                pace.learn(spent, 0.0);
            }
            let spent = time(cost, &pace);
            assert!(spent <= HURRY || pace.quality == Quality(0), "{cost}: {spent} ms");
            // A finer one would not be: three steps are the most that one picture rises.
            assert!(pace.quality == Quality::MOVING || 2.0 * spent > TARGET, "{cost}: {spent} ms is too careful");
        }
    }

    #[test]
    fn a_finer_picture_is_in_time() {
        for hundredths in 1..2000 {
            let spent = f64::from(hundredths) / 100.0;
            let steps = quality_steps(spent);
            let next = spent * libm::exp2(f64::from(steps) / 2.0);
            assert!(steps <= 0 || next <= HURRY, "{spent} ms, then {next} ms");
            assert!(steps >= 0 || spent > HURRY, "{spent} ms is in time");
        }
    }

    #[test]
    fn two_late_pictures_in_a_row_halve_the_next_one() {
        let mut pace = Pace { quality: Quality::MOVING, ..Pace::default() };
        pace.learn(HALVE + 1.0, 0.0);
        pace.learn(TARGET, 0.0);
        pace.learn(TARGET, HALVE);
        assert!(!pace.is_half, "not in a row");
        pace.learn(TARGET, HALVE);
        assert!(pace.is_half);
        pace.quality = Quality::MOVING;
        pace.learn(WHOLE + 0.1, 0.0);
        assert!(pace.is_half, "a whole picture would be late");
        pace.learn(WHOLE, 0.0);
        assert!(!pace.is_half);
        pace.be_careful();
        assert_eq!(pace.quality, UNKNOWN);
    }

    #[test]
    fn the_effort_is_reduced_again_and_again() {
        let mut deadline = Deadline::new();
        let reduced: Vec<u32> = (0..20).filter(|&ms| deadline.has_passed(f64::from(ms))).collect();
        assert_eq!(reduced, [9, 14, 18]);
    }
}
