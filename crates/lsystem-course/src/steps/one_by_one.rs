//! Rewriting one symbol at a time, as in a grammar of Chomsky, beside the rewriting of all symbols at once.

use crate::steps::Why;
use lsystem_base::word;
use lsystem_derive::Rewrite;
use lsystem_drawing::System;
use serde::Serialize;

/// The most steps.
const MAX_STEPS: u32 = 200;
/// The most symbols of a string; longer ones end the list.
const MAX_SYMBOLS: usize = 5_000;
/// The most symbols of a string that are listed.
const MAX_LISTED: usize = 400;

/// A string, and the place where the step to it replaced a symbol.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Single {
    /// The beginning of the string.
    pub text: String,
    /// The number of symbols.
    pub length: usize,
    /// Where the symbols are that replaced one: the place of the first, and their number. `None` for the axiom.
    pub made: Option<[usize; 2]>,
}

/// The choice of the symbol that is replaced, among those with a production.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The first one.
    Leftmost,
    /// The last one.
    Rightmost,
}

/// The strings of `steps` steps that replace one symbol each. The list ends where no symbol has a production. Where chance chooses, the first production applies.
///
/// # Errors
/// A sentence that says why the symbols cannot be replaced alone.
pub fn one_by_one(system: &System, steps: u32, order: Order) -> Result<Vec<Single>, Why> {
    let rules = &system.rules;
    if !rules.is_plain() || rules.is_cutting() {
        return Err(word!("Rules with neighbours, conditions, parameters or cut branches need all symbols at once."));
    }
    let listed = |word: &[u16], made| Single {
        text: word.iter().take(MAX_LISTED).map(|&letter| rules.symbol(letter)).collect(),
        length: word.len(),
        made,
    };
    let mut word = rules.axiom.letters.clone();
    let mut strings = vec![listed(&word, None)];
    for _ in 0..steps.min(MAX_STEPS) {
        let successor = |letter: u16| match &rules.rewrites[usize::from(letter)] {
            Rewrite::Keep => None,
            Rewrite::Always(successor) => Some(successor.as_slice()),
            Rewrite::Choose(alternatives) => alternatives.first().map(|first| first.successor.as_slice()),
        };
        let mut found = word.iter().enumerate().filter_map(|(at, &letter)| Some((at, successor(letter)?)));
        let found = match order {
            Order::Leftmost => found.next(),
            Order::Rightmost => found.next_back(),
        };
        let Some((at, successor)) = found else { break };
        let made = [at, successor.len()];
        if word.len() + successor.len() > MAX_SYMBOLS {
            break;
        }
        word.splice(at..=at, successor.iter().copied());
        strings.push(listed(&word, Some(made)));
    }
    Ok(strings)
}
