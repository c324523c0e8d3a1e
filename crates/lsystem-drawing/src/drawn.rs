//! The number of segments that each letter draws, and whether it draws at all.

use crate::System;
use lsystem_derive::LetterId;
use lsystem_syntax::Action;

/// By letter: the number of segments that the letter, or its image, draws; 0 for a letter that never occurs. `None` if
/// the number varies for a letter that may occur.
pub fn drawn_by_letter(system: &System) -> Option<Vec<u64>> {
    marks_by_letter(system, Action::segments)
}

/// As [`drawn_by_letter`], for segments and filled areas.
pub(crate) fn shown_by_letter(system: &System) -> Option<Vec<u64>> {
    marks_by_letter(system, Action::marks)
}

/// By letter: the sum of `marks` over the actions of the letter or its image.
fn marks_by_letter(system: &System, marks: fn(Action) -> u64) -> Option<Vec<u64>> {
    let of = |(id, reached): (usize, &bool)| if *reached { marks_of(system, id as LetterId, marks) } else { Some(0) };
    system.rules.reachable().iter().enumerate().map(of).collect()
}

/// The sum of `marks` over the actions that a letter is drawn as; `None` if its images have different sums.
fn marks_of(system: &System, letter: LetterId, marks: fn(Action) -> u64) -> Option<u64> {
    let alone = |letter: LetterId| marks_alone(system, letter, marks);
    let images = &system.rules.images[usize::from(letter)];
    let mut all = images.iter().map(|image| image.successor.letters.iter().map(|&letter| alone(letter)).sum());
    let always = images.iter().any(|image| image.condition.is_none() && image.weight.is_none());
    let own = (!always).then(|| alone(letter));
    let first: u64 = own.or_else(|| all.next())?;
    all.all(|other| other == first).then_some(first)
}

/// The sum of `marks` over a letter's own actions, without images.
fn marks_alone(system: &System, letter: LetterId, marks: fn(Action) -> u64) -> u64 {
    system.turtle.actions[usize::from(letter)].iter().map(|&action| marks(action)).sum()
}

/// By letter: the number of segments that the letter draws by its own actions, without images.
pub(crate) fn drawn_alone(system: &System) -> Vec<u64> {
    (0..system.rules.letters.len()).map(|letter| marks_alone(system, letter as LetterId, Action::segments)).collect()
}
