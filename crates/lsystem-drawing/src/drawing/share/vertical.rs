//! Sharing of pieces with `$`: such a piece depends on the direction of the vertical in its frame, but on nothing else
//! of its orientation in the model.

use crate::drawing::block::Space;
use crate::turtle::{Score, TurtleOp};
use lsystem_derive::{LetterId, Rules, Template};

/// A rounded vertical, so that frames with the same vertical by different rotations have equal tilts.
pub(super) type Tilt = [i64; 3];

/// A [`Tilt`] counts in units of `1 / STEPS`: coarser than the rounding errors of rotations, finer than a visible
/// difference.
const STEPS: f64 = (1_u64 << 44) as f64;

/// The tilt of a vertical.
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

/// Whether the vertical is known at every letter that uses it: on the same branch, no such letter follows a rewritten
/// letter that turns the heading. The turn of a rewritten letter is not known during planning.
pub(super) fn is_known<S: Space>(rules: &Rules, score: &Score<S>) -> bool {
    if S::LEVEL {
        return true;
    }
    let uses = uses_vertical(rules, score);
    if !uses.contains(&true) {
        return true;
    }
    // Whether left and right turns are exchanged is not known during planning.
    if score.swaps() {
        return false;
    }
    let turns = spread(rules, score, &|op| matches!(op, TurtleOp::Turn(_) | TurtleOp::Upright), true);
    let known = |word: &Template| {
        let (mut lost, mut saved) = (false, vec![]);
        word.letters.iter().all(|&letter| {
            let letter = usize::from(letter);
            let is_fine = !(lost && uses[letter]);
            if !rules.by_letter[letter].is_empty() {
                lost |= turns[letter];
                return is_fine;
            }
            for op in &score.ops[letter] {
                match op {
                    TurtleOp::Push(_) => saved.push(lost),
                    TurtleOp::Pop => lost = saved.pop().unwrap_or(lost),
                    _ => {}
                }
            }
            is_fine
        })
    };
    known(&rules.axiom) && rules.by_letter.iter().flatten().all(|rule| known(&rule.successor))
}

/// By letter: whether the letter, or any letter derived from it, uses the vertical. Empty if the left is always level.
pub(super) fn uses_vertical<S: Space>(rules: &Rules, score: &Score<S>) -> Vec<bool> {
    if S::LEVEL { vec![] } else { spread(rules, score, &|op| matches!(op, TurtleOp::Upright), false) }
}

/// By letter: whether `is` holds for an operation of the letter or of any letter derived from it. If `outside`, letters
/// inside the branches of a successor do not count.
fn spread<S: Space>(rules: &Rules, score: &Score<S>, is: &dyn Fn(&TurtleOp<S>) -> bool, outside: bool) -> Vec<bool> {
    let acts = |letter: LetterId| score.ops[usize::from(letter)].iter().any(is);
    let mut holds: Vec<bool> = (rules.images.iter().enumerate())
        .map(|(letter, images)| {
            acts(letter as LetterId) || images.iter().flat_map(|image| &image.successor.letters).any(|&made| acts(made))
        })
        .collect();
    // Pairs of a letter in a successor and its predecessor, later grouped by the first.
    let mut makers = vec![];
    for (letter, productions) in rules.by_letter.iter().enumerate() {
        for rule in productions {
            let mut level = 0_i64;
            for &made in &rule.successor.letters {
                if level == 0 || !outside {
                    makers.push((made, letter as LetterId));
                }
                for op in &score.ops[usize::from(made)] {
                    level += i64::from(matches!(op, TurtleOp::Push(_))) - i64::from(matches!(op, TurtleOp::Pop));
                }
            }
        }
    }
    let mut starts = vec![0; holds.len() + 1];
    makers.iter().for_each(|&(made, _)| starts[usize::from(made) + 1] += 1);
    (1..starts.len()).for_each(|at| starts[at] += starts[at - 1]);
    let (mut sorted, mut ends) = (vec![0; makers.len()], starts.clone());
    for (made, letter) in makers {
        sorted[ends[usize::from(made)]] = letter;
        ends[usize::from(made)] += 1;
    }
    let mut open: Vec<usize> = (0..holds.len()).filter(|&letter| holds[letter]).collect();
    while let Some(made) = open.pop() {
        for &letter in &sorted[starts[made]..starts[made + 1]] {
            if !core::mem::replace(&mut holds[usize::from(letter)], true) {
                open.push(usize::from(letter));
            }
        }
    }
    holds
}

/// The turtle's orientation along a word, with the vertical in the frame of the word.
#[derive(Clone, Debug)]
pub(super) struct Orientation<S: Space> {
    heading: S::Turn,
    vertical: S::Point,
    saved: Vec<S::Turn>,
}

impl<S: Space> Orientation<S> {
    pub(super) fn new(heading: S::Turn, vertical: S::Point) -> Self {
        Self { heading, vertical, saved: vec![] }
    }

    /// Applies an operation.
    pub(super) fn follow(&mut self, op: &TurtleOp<S>) {
        match op {
            TurtleOp::Turn(by) => self.heading = S::then(self.heading, by.turn),
            TurtleOp::Upright => self.heading = S::upright(self.heading, &self.vertical),
            TurtleOp::Push(_) => self.saved.push(self.heading),
            TurtleOp::Pop => self.heading = self.saved.pop().unwrap_or(self.heading),
            // A sway turns the heading and the vertical alike.
            _ => {}
        }
    }

    /// The vertical in the turtle's present frame.
    pub(super) fn tilt(&self) -> Tilt {
        tilt_of(&S::seen(self.heading, self.vertical))
    }
}
