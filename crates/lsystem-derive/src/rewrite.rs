//! The possible successors of a letter, without regard to contexts.

use crate::rules::{LetterId, Rule, Rules};

/// The rewriting of a letter in one derivation step. It is exact if the rules are [plain](Rules::is_plain). Otherwise
/// it lists the possible successors with equal chances, without regard to contexts, conditions and weights.
#[derive(Clone, Debug, PartialEq)]
pub enum Rewrite {
    /// The letter has no production. The letter and its key stay.
    Keep,
    /// Always the same successor.
    Always(Vec<LetterId>),
    /// One of several successors, by weight.
    Choose(Vec<Alternative>),
}

/// One possible successor of a letter.
#[derive(Clone, Debug, PartialEq)]
pub struct Alternative {
    /// The cumulative normalised weight, including this alternative; 1.0 for the last.
    pub until: f64,
    /// The successor.
    pub successor: Vec<LetterId>,
}

impl Alternative {
    /// The index of the alternative that `roll` (uniform in `0.0..1.0`) selects, by binary search.
    #[must_use]
    pub fn of(alternatives: &[Self], roll: f64) -> usize {
        alternatives.partition_point(|alternative| alternative.until <= roll).min(alternatives.len().saturating_sub(1))
    }
}

impl Rewrite {
    /// The successor that `roll` (uniform in `0.0..1.0`) selects; `None` if the letter stays.
    #[must_use]
    pub fn successor(&self, roll: impl FnOnce() -> f64) -> Option<&[LetterId]> {
        match self {
            Self::Keep => None,
            Self::Always(successor) => Some(successor),
            Self::Choose(alternatives) => alternatives
                .get(Alternative::of(alternatives, roll()))
                .map(|alternative| alternative.successor.as_slice()),
        }
    }

    /// The only successor; `None` if the letter stays or has several possible successors.
    #[must_use]
    pub fn always(&self) -> Option<&[LetterId]> {
        if let Self::Always(word) = self { Some(word) } else { None }
    }

    /// The rewriting of a letter with these plain productions, whose weights are constant. If the first production is
    /// unweighted, it always applies; otherwise the choice is among all weighted productions.
    pub(crate) fn plain(rules: &[Rule]) -> Self {
        let weight = |rule: &Rule| rule.weight.as_ref().map(|weight| weight.value(&[], &|_| 0.0));
        let Some(first) = rules.first() else { return Self::Keep };
        let mut until = 0.0;
        let weighted = rules.iter().filter_map(|rule| {
            until += weight(rule)?;
            Some(Alternative { until, successor: rule.successor.letters.clone() })
        });
        let mut alternatives: Vec<Alternative> = if first.weight.is_some() { weighted.collect() } else { vec![] };
        if alternatives.len() < 2 {
            return Self::Always(first.successor.letters.clone());
        }
        let total = alternatives.last().map_or(1.0, |alternative| alternative.until);
        alternatives.iter_mut().for_each(|alternative| alternative.until /= total);
        Self::Choose(alternatives)
    }

    /// The possible rewritings of a letter with these productions, without regard to contexts and conditions.
    pub(crate) fn outline(letter: LetterId, rules: &[Rule]) -> Self {
        let always = |rule: &Rule| !rule.is_context_sensitive() && rule.condition.is_none();
        let last = rules.iter().position(|rule| always(rule) && rule.weight.is_none());
        // A computed weight may be 0, so only an unweighted production always ends the list.
        let possible = last.map_or(rules, |at| &rules[..=at]);
        let mut words: Vec<Vec<LetterId>> = possible.iter().map(|rule| rule.successor.letters.clone()).collect();
        match words.as_mut_slice() {
            [] => return Self::Keep,
            [only] if last.is_some() => return Self::Always(core::mem::take(only)),
            _ => {}
        }
        if last.is_none() {
            words.push(vec![letter]);
        }
        let parts = words.len() as f64;
        let alternative = |(at, successor)| Alternative { until: (at + 1) as f64 / parts, successor };
        Self::Choose(words.into_iter().enumerate().map(alternative).collect())
    }
}

impl Rules {
    /// Whether no reachable letter has a choice of successors.
    #[must_use]
    pub fn is_deterministic(&self) -> bool {
        let reachable = self.reachable();
        self.rewrites.iter().zip(reachable).all(|(r, reached)| !reached || !matches!(r, Rewrite::Choose(_)))
    }

    /// By letter: whether it may occur in a generation.
    #[must_use]
    pub fn reachable(&self) -> Vec<bool> {
        let mut seen = vec![false; self.letters.len()];
        let mut open: Vec<LetterId> = self.axiom.letters.clone();
        while let Some(letter) = open.pop() {
            if core::mem::replace(&mut seen[usize::from(letter)], true) {
                continue;
            }
            match &self.rewrites[usize::from(letter)] {
                Rewrite::Keep => {}
                Rewrite::Always(successor) => open.extend(successor),
                Rewrite::Choose(alternatives) => alternatives.iter().for_each(|c| open.extend(&c.successor)),
            }
        }
        seen
    }

    /// By letter: whether the turtle may meet it. Of rules that are not [plain](Rules::is_plain) it may meet all letters:
    /// those of images occur in no generation.
    #[must_use]
    pub fn drawn(&self) -> Vec<bool> {
        if self.is_plain() { self.reachable() } else { vec![true; self.letters.len()] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_roll_chooses_by_weight() {
        let alternatives = [0.25, 0.25, 0.75, 1.0].map(|until| Alternative { until, successor: vec![] });
        let chosen = [0.0, 0.2, 0.25, 0.7, 0.75, 0.99, 1.0].map(|roll| Alternative::of(&alternatives, roll));
        assert_eq!(chosen, [0, 0, 2, 2, 3, 3, 3]);
    }
}
