//! The number of an answer that is too large or too small, found by changing each a little.

use crate::branches::Branches;
use crate::exercise::Exercise;
use crate::fit::Ends;
use crate::repair::drawn;
use crate::sketch::lists;
use core::fmt;
use core::ops::Range;
use lsystem_base::words::shown;
use lsystem_base::{Meter, say};
use lsystem_syntax::Definition;

/// The most segments of the drawings that are compared.
const MAX_SEGMENTS: u64 = 20_000;
/// The most numbers that are tried.
const MAX_NUMBERS: usize = 40;
/// A number is changed by this part of it.
const STEP: f64 = 0.01;

/// The number whose change makes the branches agree more.
pub(crate) struct Nudge {
    number: String,
    is_larger: bool,
}

impl Nudge {
    /// The number that gains most. All drawings charge one meter; a spent one ends the search.
    pub(crate) fn of(exercise: &Exercise, student: &Definition, target: &[Ends], meter: &mut Meter) -> Option<Self> {
        let mut agreement = |rules: &str| {
            let whole = exercise.complete(&Definition { rules: rules.to_owned(), ..student.clone() });
            let own = lists(&drawn(&whole, MAX_SEGMENTS, meter)?)?.0;
            Some(Branches::of(&own, target)?.agreement())
        };
        let rules = student.rules.as_str();
        let mut best = (agreement(rules)?, None);
        let numbers: Vec<Range<usize>> = numbers(rules).take(MAX_NUMBERS).collect();
        let places: Vec<&Range<usize>> = numbers.iter().collect();
        let alike = |at: &&Range<usize>| {
            places.iter().copied().filter(|other| rules[(*other).clone()] == rules[(*at).clone()]).collect()
        };
        // A number may stand at several places: each is changed alone, and all together.
        let groups = places.iter().map(|at| vec![*at]).chain(places.iter().map(alike));
        for group in groups.collect::<Vec<Vec<_>>>() {
            let Some(number) = group.first().map(|at| &rules[(*at).clone()]) else { continue };
            let Ok(value) = number.parse::<f64>() else { continue };
            for is_larger in [true, false] {
                let other = if is_larger { value * (1.0 + STEP) } else { value * (1.0 - STEP) };
                let gained = agreement(&with(rules, &group, &other.to_string())).unwrap_or_default();
                if gained > best.0 {
                    best = (gained, Some(Self { number: number.to_owned(), is_larger }));
                }
            }
        }
        best.1
    }
}

impl fmt::Display for Nudge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = shown(&self.number);
        f.write_str(&if self.is_larger {
            say!("Try a larger number than {}.", number)
        } else {
            say!("Try a smaller number than {}.", number)
        })
    }
}

/// The text with another one at some places, which are in order.
fn with(text: &str, places: &[&Range<usize>], other: &str) -> String {
    let mut changed = String::new();
    let mut end = 0;
    for at in places {
        changed += &text[end..at.start];
        changed += other;
        end = at.end;
    }
    changed + &text[end..]
}

/// Where the numbers of rules stand.
fn numbers(rules: &str) -> impl Iterator<Item = Range<usize>> {
    let is_part = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let bytes = rules.as_bytes();
    let starts = (0..bytes.len()).filter(move |&at| {
        let is_first =
            at.checked_sub(1).is_none_or(|before| !is_part(&bytes[before]) && !bytes[before].is_ascii_alphanumeric());
        is_part(&bytes[at]) && is_first
    });
    starts.map(move |at| at..at + bytes[at..].iter().take_while(|byte| is_part(byte)).count())
}
