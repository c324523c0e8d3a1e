//! A grammar made ready for derivation: letters become small integers, productions a table over them.

use crate::rewriting::{Rule, Rules};
use lsystem_syntax::Grammar;
use lsystem_syntax::sorted::set;

/// A letter's place in [`Program::alphabet`].
pub type SymbolId = u16;

/// A compiled grammar.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Every letter of the axiom and the productions, sorted. In an [outline](Program::outline) a symbol stands there
    /// once for each number of parameters.
    pub alphabet: Vec<char>,
    /// The axiom.
    pub axiom: Vec<SymbolId>,
    /// By letter: what one derivation step does with it.
    pub rewrites: Vec<Rewrite>,
}

/// What one derivation step does with a letter.
#[derive(Clone, Debug, PartialEq)]
pub enum Rewrite {
    /// No production: the letter stays, and so does its key.
    Keep,
    /// One successor, always.
    Always(Vec<SymbolId>),
    /// One of several, by weight.
    Choose(Vec<Choice>),
}

/// One of the successors of a stochastic production.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The sum of the normalised weights up to and with this one; 1.0 for the last.
    pub until: f64,
    /// The production's index in [`Grammar::productions`].
    pub production: usize,
    /// What replaces the letter.
    pub successor: Vec<SymbolId>,
}

impl Choice {
    /// Which of `choices` a `roll` (uniform in `0.0..1.0`) selects; there may be very many.
    pub fn of(choices: &[Self], roll: f64) -> usize {
        choices.partition_point(|choice| choice.until <= roll).min(choices.len().saturating_sub(1))
    }
}

impl Rewrite {
    /// The successor that `roll` (uniform in `0.0..1.0`) selects, or `None` where the letter stays.
    #[must_use]
    pub fn successor(&self, roll: impl FnOnce() -> f64) -> Option<&[SymbolId]> {
        match self {
            Self::Keep => None,
            Self::Always(successor) => Some(successor),
            Self::Choose(choices) => choices.get(Choice::of(choices, roll())).map(|choice| choice.successor.as_slice()),
        }
    }
}

impl Program {
    /// Compiles a grammar that is [plain](Grammar::is_plain). Among productions of one predecessor the first decides: unweighted, it always applies;
    /// weighted, the choice is among all weighted ones of that predecessor.
    #[must_use]
    pub fn new(grammar: &Grammar) -> Self {
        let matched = grammar.productions.iter().map(|p| p.predecessor.symbol);
        let mut alphabet = set(grammar.made().map(|module| module.symbol).chain(matched));
        // Text is bounded far below 65,536 distinct letters times productions; the cap only guards the cast.
        alphabet.truncate(usize::from(SymbolId::MAX) + 1);
        let id = |symbol: char| alphabet.binary_search(&symbol).unwrap_or(0) as SymbolId;
        let ids = |modules: &[lsystem_syntax::Module]| modules.iter().map(|m| id(m.symbol)).collect::<Vec<_>>();

        let values = grammar.values();
        let mut rewrites = vec![Rewrite::Keep; alphabet.len()];
        for (index, production) in grammar.productions.iter().enumerate() {
            let rewrite = &mut rewrites[usize::from(id(production.predecessor.symbol))];
            let successor = ids(&production.successor);
            let weight = production.weight.as_ref().map(|weight| values.value(weight).unwrap_or(0.0));
            match (&mut *rewrite, weight) {
                (Rewrite::Keep, None) => *rewrite = Rewrite::Always(successor),
                (Rewrite::Keep, Some(until)) => {
                    *rewrite = Rewrite::Choose(vec![Choice { until, production: index, successor }]);
                }
                (Rewrite::Choose(choices), Some(weight)) => {
                    let until = choices.last().map_or(0.0, |c| c.until) + weight;
                    choices.push(Choice { until, production: index, successor });
                }
                (Rewrite::Always(_), _) | (Rewrite::Choose(_), None) => {}
            }
        }
        for rewrite in &mut rewrites {
            if let Rewrite::Choose(choices) = rewrite {
                let total = choices.last().map_or(1.0, |c| c.until);
                choices.iter_mut().for_each(|c| c.until /= total);
                if let [only] = choices.as_mut_slice() {
                    *rewrite = Rewrite::Always(core::mem::take(&mut only.successor));
                }
            }
        }
        Self { axiom: ids(&grammar.axiom), rewrites, alphabet }
    }

    /// What is known of `rules` without deriving: by letter, all that may replace it. Letters that have more than one
    /// possible successor choose among them with equal chances here, whatever decides between them.
    #[must_use]
    pub fn outline(rules: &Rules) -> Self {
        let word = |rule: &Rule| rule.successor.letters.clone();
        let rewrite = |(letter, rules): (usize, &Vec<Rule>)| {
            let always = |rule: &Rule| !rule.is_context_sensitive() && rule.condition.is_none();
            let last = rules.iter().position(|rule| always(rule) && rule.weight.is_none());
            // Weights may come out as 0.
            let mut words: Vec<(usize, Vec<SymbolId>)> =
                rules.iter().take(last.map_or(rules.len(), |at| at + 1)).map(|r| (r.production, word(r))).collect();
            match words.as_mut_slice() {
                [] => Rewrite::Keep,
                [(_, only)] if last.is_some() => Rewrite::Always(core::mem::take(only)),
                _ => {
                    if last.is_none() {
                        words.push((usize::MAX, vec![letter as SymbolId]));
                    }
                    let parts = words.len() as f64;
                    let choice = |(at, (production, successor)): (usize, (usize, Vec<SymbolId>))| Choice {
                        until: (at + 1) as f64 / parts,
                        production,
                        successor,
                    };
                    Rewrite::Choose(words.into_iter().enumerate().map(choice).collect())
                }
            }
        };
        Self {
            alphabet: rules.letters.iter().map(|letter| letter.symbol).collect(),
            axiom: rules.axiom.letters.clone(),
            rewrites: rules.by_letter.iter().enumerate().map(rewrite).collect(),
        }
    }

    /// Whether no choice is ever made.
    #[must_use]
    pub fn is_deterministic(&self) -> bool {
        let reachable = self.reachable();
        self.rewrites.iter().zip(reachable).all(|(r, reached)| !reached || !matches!(r, Rewrite::Choose(_)))
    }

    /// By letter: whether it occurs in any generation.
    #[must_use]
    pub fn reachable(&self) -> Vec<bool> {
        let mut seen = vec![false; self.alphabet.len()];
        let mut open: Vec<SymbolId> = self.axiom.clone();
        while let Some(symbol) = open.pop() {
            if core::mem::replace(&mut seen[usize::from(symbol)], true) {
                continue;
            }
            match &self.rewrites[usize::from(symbol)] {
                Rewrite::Keep => {}
                Rewrite::Always(successor) => open.extend(successor),
                Rewrite::Choose(choices) => choices.iter().for_each(|c| open.extend(&c.successor)),
            }
        }
        seen
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_roll_chooses_by_weight() {
        let choices = [0.25, 0.25, 0.75, 1.0].map(|until| Choice { until, production: 0, successor: vec![] });
        let chosen = [0.0, 0.2, 0.25, 0.7, 0.75, 0.99, 1.0].map(|roll| Choice::of(&choices, roll));
        assert_eq!(chosen, [0, 0, 2, 2, 3, 3, 3]);
    }
}
