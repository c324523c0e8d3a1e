//! What a derivation step does with a letter, as far as that is known without looking around.

use crate::rules::{LetterId, Rule, Rules};

/// What one derivation step does with a letter: exactly where the rules are [plain](Rules::is_plain). Otherwise only what
/// it may do: a letter that may become several things chooses among them with equal chances here, whatever decides.
#[derive(Clone, Debug, PartialEq)]
pub enum Rewrite {
    /// No production: the letter stays, and so does its key.
    Keep,
    /// One successor, always.
    Always(Vec<LetterId>),
    /// One of several, by weight.
    Choose(Vec<Choice>),
}

/// One of the successors that a letter may have.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The sum of the normalised weights up to and with this one; 1.0 for the last.
    pub until: f64,
    /// What replaces the letter.
    pub successor: Vec<LetterId>,
}

impl Choice {
    /// Which of `choices` a `roll` (uniform in `0.0..1.0`) selects; there may be very many.
    #[must_use]
    pub fn of(choices: &[Self], roll: f64) -> usize {
        choices.partition_point(|choice| choice.until <= roll).min(choices.len().saturating_sub(1))
    }
}

impl Rewrite {
    /// The successor that `roll` (uniform in `0.0..1.0`) selects, or `None` where the letter stays.
    #[must_use]
    pub fn successor(&self, roll: impl FnOnce() -> f64) -> Option<&[LetterId]> {
        match self {
            Self::Keep => None,
            Self::Always(successor) => Some(successor),
            Self::Choose(choices) => choices.get(Choice::of(choices, roll())).map(|choice| choice.successor.as_slice()),
        }
    }

    /// What it always becomes; nothing where it stays, or chance decides.
    #[must_use]
    pub fn always(&self) -> Option<&[LetterId]> {
        if let Self::Always(word) = self { Some(word) } else { None }
    }

    /// Of a letter with these productions, weights being numbers. The first decides: unweighted, it always applies;
    /// weighted, the choice is among all that are.
    pub(crate) fn plain(rules: &[Rule]) -> Self {
        let weight = |rule: &Rule| rule.weight.as_ref().map(|weight| weight.value(&[], &|_| 0.0));
        let Some(first) = rules.first() else { return Self::Keep };
        let mut until = 0.0;
        let weighted = rules.iter().filter_map(|rule| {
            until += weight(rule)?;
            Some(Choice { until, successor: rule.successor.letters.clone() })
        });
        let mut choices: Vec<Choice> = if first.weight.is_some() { weighted.collect() } else { vec![] };
        if choices.len() < 2 {
            return Self::Always(first.successor.letters.clone());
        }
        let total = choices.last().map_or(1.0, |choice| choice.until);
        choices.iter_mut().for_each(|choice| choice.until /= total);
        Self::Choose(choices)
    }

    /// Of a letter with these productions, whatever they look at.
    pub(crate) fn outline(letter: LetterId, rules: &[Rule]) -> Self {
        let always = |rule: &Rule| !rule.is_context_sensitive() && rule.condition.is_none();
        let last = rules.iter().position(|rule| always(rule) && rule.weight.is_none());
        // Weights may come out as 0.
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
        let choice = |(at, successor)| Choice { until: (at + 1) as f64 / parts, successor };
        Self::Choose(words.into_iter().enumerate().map(choice).collect())
    }
}

impl Rules {
    /// Whether no choice is ever made.
    #[must_use]
    pub fn is_deterministic(&self) -> bool {
        let reachable = self.reachable();
        self.rewrites.iter().zip(reachable).all(|(r, reached)| !reached || !matches!(r, Rewrite::Choose(_)))
    }

    /// By letter: whether it occurs in any generation.
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
        let choices = [0.25, 0.25, 0.75, 1.0].map(|until| Choice { until, successor: vec![] });
        let chosen = [0.0, 0.2, 0.25, 0.7, 0.75, 0.99, 1.0].map(|roll| Choice::of(&choices, roll));
        assert_eq!(chosen, [0, 0, 2, 2, 3, 3, 3]);
    }
}
