//! What `$` has to do with sharing: a piece with it depends on where the vertical is in its frame, and on nothing else
//! of how it stands in the model.

use crate::space::Space;
use crate::turtle::{Op, Score};
use crate::{LetterId, Rules, Template};

/// A vertical rounded, so that frames that came by different ways to the same tilt have equal ones.
pub(super) type Tilt = [i64; 3];

/// Steps of a [`Tilt`] in 1: coarser than what composing rotations rounds, finer than what shows.
const STEPS: f64 = (1_u64 << 44) as f64;

pub(super) fn tilt_of<P: AsRef<[f64]>>(vertical: &P) -> Tilt {
    let mut tilt = [0; 3];
    for (steps, c) in tilt.iter_mut().zip(vertical.as_ref()) {
        *steps = libm::round(c * STEPS) as i64;
    }
    tilt
}

/// The vertical that a tilt stands for.
pub(super) fn vertical_of<P: Default + AsMut<[f64]>>(tilt: &Tilt) -> P {
    let mut vertical = P::default();
    for (c, steps) in vertical.as_mut().iter_mut().zip(tilt) {
        *c = *steps as f64 / STEPS;
    }
    vertical
}

/// Whether wherever something looks to the vertical it is known: nothing that does follows, on the same branch, a module
/// that turns the heading by what will have become of it.
pub(super) fn is_known<S: Space>(rules: &Rules, score: &Score<S>) -> bool {
    if S::LEVEL {
        return true;
    }
    let looks = lookers(rules, score);
    if !looks.contains(&true) {
        return true;
    }
    let turns = spread(rules, score, &|op| matches!(op, Op::Turn(_) | Op::Upright), true);
    let known = |word: &Template| {
        let (mut lost, mut saved) = (false, vec![]);
        word.letters.iter().all(|&letter| {
            let letter = usize::from(letter);
            let fine = !(lost && looks[letter]);
            if !rules.by_letter[letter].is_empty() {
                lost |= turns[letter];
                return fine;
            }
            for op in &score.ops[letter] {
                match op {
                    Op::Push(_) => saved.push(lost),
                    Op::Pop => lost = saved.pop().unwrap_or(lost),
                    _ => {}
                }
            }
            fine
        })
    };
    known(&rules.axiom) && rules.by_letter.iter().flatten().all(|rule| known(&rule.successor))
}

/// By letter: whether it, or anything that it may become, looks to the vertical. Where the left is always level nothing
/// does, and there is nothing here.
pub(super) fn lookers<S: Space>(rules: &Rules, score: &Score<S>) -> Vec<bool> {
    if S::LEVEL { vec![] } else { spread(rules, score, &|op| matches!(op, Op::Upright), false) }
}

/// By letter: whether `is` holds of what it does, or of what anything does that it may become; of what stands in
/// branches only unless `outside`.
fn spread<S: Space>(rules: &Rules, score: &Score<S>, is: &dyn Fn(&Op<S>) -> bool, outside: bool) -> Vec<bool> {
    let acts = |letter: LetterId| score.ops[usize::from(letter)].iter().any(is);
    let mut holds: Vec<bool> = (rules.images.iter().enumerate())
        .map(|(letter, images)| {
            acts(letter as LetterId) || images.iter().flat_map(|image| &image.successor.letters).any(|&made| acts(made))
        })
        .collect();
    loop {
        let mut grew = false;
        for (letter, productions) in rules.by_letter.iter().enumerate() {
            let reaches = productions.iter().any(|rule| {
                let mut level = 0_i64;
                rule.successor.letters.iter().any(|&made| {
                    let made = usize::from(made);
                    let reached = holds[made] && (level == 0 || !outside);
                    for op in &score.ops[made] {
                        level += i64::from(matches!(op, Op::Push(_))) - i64::from(matches!(op, Op::Pop));
                    }
                    reached
                })
            });
            if reaches && !holds[letter] {
                (holds[letter], grew) = (true, true);
            }
        }
        if !grew {
            return holds;
        }
    }
}

/// How the turtle is turned on its way, against the frame in which the vertical is this one.
pub(super) struct Course<S: Space> {
    heading: S::Turn,
    vertical: S::Point,
    saved: Vec<S::Turn>,
}

impl<S: Space> Course<S> {
    pub(super) fn new(heading: S::Turn, vertical: S::Point) -> Self {
        Self { heading, vertical, saved: vec![] }
    }

    pub(super) fn follow(&mut self, op: &Op<S>) {
        match op {
            Op::Turn(by) => self.heading = S::then(self.heading, by.turn),
            Op::Upright => self.heading = S::upright(self.heading, &self.vertical),
            Op::Push(_) => self.saved.push(self.heading),
            Op::Pop => self.heading = self.saved.pop().unwrap_or(self.heading),
            _ => {}
        }
    }

    /// The vertical as the turtle has it now.
    pub(super) fn tilt(&self) -> Tilt {
        tilt_of(&S::seen(self.heading, self.vertical))
    }
}
