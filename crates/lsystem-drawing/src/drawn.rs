//! The number of segments that each letter draws.

use crate::System;
use lsystem_derive::LetterId;

/// By letter: the number of segments that the letter, or its image, draws; 0 for a letter that never occurs. `None` if
/// the number varies for a letter that may occur.
pub(crate) fn drawn_by_letter(system: &System) -> Option<Vec<u64>> {
    let drawn = |(id, reached): (usize, &bool)| if *reached { drawn_as(system, id as LetterId) } else { Some(0) };
    system.rules.reachable().iter().enumerate().map(drawn).collect()
}

/// The number of segments that a letter is drawn as; `None` if its images draw different numbers.
fn drawn_as(system: &System, letter: LetterId) -> Option<u64> {
    let images = &system.rules.images[usize::from(letter)];
    let mut all =
        images.iter().map(|image| image.successor.letters.iter().map(|&letter| segments_of(system, letter)).sum());
    let always = images.iter().any(|image| image.condition.is_none() && image.weight.is_none());
    let own = (!always).then(|| segments_of(system, letter));
    let first: u64 = own.or_else(|| all.next())?;
    all.all(|other| other == first).then_some(first)
}

/// The number of segments that a letter draws by its own actions, without images.
fn segments_of(system: &System, symbol: LetterId) -> u64 {
    let actions = &system.turtle.actions[usize::from(symbol)];
    actions.iter().map(|action| action.segments()).sum()
}

/// By letter: the number of segments that the letter draws by its own actions, without images.
pub(crate) fn drawn_alone(system: &System) -> Vec<u64> {
    (0..system.rules.letters.len()).map(|letter| segments_of(system, letter as LetterId)).collect()
}
