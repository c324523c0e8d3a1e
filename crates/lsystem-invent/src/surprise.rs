//! The best of some systems made by chance.

use crate::Family;
use crate::dice::Dice;
use crate::judge::{Merit, Rejection, judge_counted};
use lsystem_syntax::Definition;

/// Families, as often as they are chosen: a third is trees in space.
const FAMILIES: [Family; 12] = {
    use Family::{Chance, Curve, Head, Island, Plant, Star, Tree};
    [Curve, Island, Plant, Chance, Tree, Tree, Tree, Tree, Star, Star, Head, Head]
};
/// Systems that pass the judge before the best is chosen.
const CHOICE: usize = 4;
/// Units of work after which one that has passed will do: some hundred milliseconds in a browser.
const WORK: u64 = 600_000;
/// The most systems that are made for a surprise.
const MAX: usize = 100;

/// Seeds whose systems were looked at and kept: the page has them ready.
pub const READY: [u32; 48] = [
    1, 2, 3, 6, 7, 8, 9, 10, 11, 13, 14, 15, 16, 17, 20, 22, 23, 24, 25, 26, 27, 30, 32, 37, 38, 39, 40, 42, 43, 44,
    45, 46, 49, 51, 52, 54, 56, 57, 58, 61, 63, 64, 66, 70, 71, 73, 77, 79,
];

/// The surprise with this seed: always the same system.
#[must_use]
pub fn surprise(seed: u32) -> (Definition, Merit) {
    surprise_counted(seed, &mut 0)
}

/// As [`surprise`]; adds the units of work that it took.
fn surprise_counted(seed: u32, work: &mut u64) -> (Definition, Merit) {
    let family = Dice::new(u64::from(seed)).one(FAMILIES);
    let mut passed: Vec<(Definition, Merit)> = vec![];
    for turn in 0..MAX {
        // Hardly any plant is refused.
        let family = if *work < WORK { family } else { Family::Plant };
        if let Ok(made) = trial_counted(family, seed, turn as u32, work) {
            passed.push(made);
        }
        if passed.len() == CHOICE || *work >= WORK && !passed.is_empty() {
            break;
        }
    }
    let best = passed.into_iter().max_by(|(_, a), (_, b)| a.score.total_cmp(&b.score));
    // A family that fails so often would be a fault; its like of the next seed stands in for it.
    let (mut best, merit) = best.unwrap_or_else(|| surprise_counted(seed.wrapping_add(1), work));
    best.name = format!("surprise-{seed}");
    (best, merit)
}

/// One system of a family, judged.
///
/// # Errors
/// Why nobody would keep it.
pub fn trial(family: Family, seed: u32, turn: u32) -> Result<(Definition, Merit), Rejection> {
    trial_counted(family, seed, turn, &mut 0)
}

/// As [`trial`]; adds the units of work that its drawings took.
fn trial_counted(family: Family, seed: u32, turn: u32, work: &mut u64) -> Result<(Definition, Merit), Rejection> {
    let mut dice = Dice::new(u64::from(seed) << 32 | u64::from(turn) << 3 | family as u64);
    let mut made = family.make(&mut dice);
    let merit = judge_counted(&mut made, family, work)?;
    Ok((made, merit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surprise_takes_bounded_work() {
        for seed in 300..360 {
            let mut work = 0;
            surprise_counted(seed, &mut work);
            assert!(work < 3 * WORK, "{seed}: {work}");
        }
    }
}
