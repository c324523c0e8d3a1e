//! The possible successors of a letter, without regard to contexts.

use crate::rules::{Alternative, LetterId, Rewrite, Rule, Rules};

impl Rewrite {
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
