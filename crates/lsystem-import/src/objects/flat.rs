//! Axioms and rules that stand apart in a program.

use super::rules::Rules;
use super::{Flat, Reader};
use crate::assembly::{Rule, Said, Statements, Symbols};
use crate::prose_words::is_prose;
use core::ops::Range;

impl Reader<'_> {
    pub(super) fn flat_mut(&mut self, start: usize) -> &mut Statements {
        self.flat.said.get_or_insert_with(|| Statements::new("", start, Symbols::Program))
    }

    pub(super) fn extend(&mut self, span: Range<usize>) {
        self.flat_mut(span.start).extents.push(span);
    }

    pub(super) fn flat_axiom(&mut self, word: &str, span: Range<usize>, is_sure: bool) {
        if is_prose(word) {
            return;
        }
        let known = self.flat.said.as_ref().and_then(|said| said.axiom.clone());
        match known {
            Some(known) if known.value == word && self.flat_mut(span.start).rules.is_empty() => return,
            // What is called an axiom counts more than a start or a seed.
            Some(_) if self.flat.is_sure && !is_sure => return,
            Some(_) => self.next_flat(),
            None => {}
        }
        self.flat.is_sure = is_sure;
        self.flat_mut(span.start).axiom = Some(Said::new(word.to_owned(), span.clone()));
        self.extend(span);
    }

    pub(super) fn flat_rules(&mut self, rules: Rules, span: Range<usize>, whole: bool, replaces: bool) {
        // What stands before the rules themselves: `rules = {`, `rules.push(`.
        let first = rules.found.iter().map(|rule| rule.span.start).min().unwrap_or(span.end);
        if whole && self.flat.has_all_rules {
            self.next_flat();
        }
        self.flat.has_all_rules |= whole;
        self.extend(span.clone());
        self.flat_mut(span.start).comments.push(span.start..first.max(span.start));
        rules.into(self.flat_mut(span.start), replaces);
    }

    /// Ends the system of assignments, if it is one.
    pub(super) fn next_flat(&mut self) {
        let Flat { said, is_sure, .. } = core::mem::take(&mut self.flat);
        let Some(mut said) = said else { return };
        if said.rules.is_empty() && said.axiom.is_some() && (is_sure || self.of_field) {
            for (symbol, word, span) in &self.branches.rules {
                said.rules.push(Rule { from: symbol.to_string(), to: word.clone(), weight: None, span: span.clone() });
                said.extents.push(span.clone());
            }
        }
        let strict = |rule: &Rule| rule.from.trim().chars().count() == 1;
        let Some(axiom) = &said.axiom else {
            // What stands beside complete systems belongs to them, and contradicts the last one if it says something else.
            if !said.rules.is_empty() {
                return;
            }
            if let (Some(last), Some(angle)) = (self.systems.last_mut(), &said.angle)
                && let Some(first) = last.angle.clone()
                && first.value != angle.value
            {
                last.contradict(first.span, angle.span.clone());
            }
            for system in &mut self.systems {
                if system.angle.is_none() && system.left.is_none() && system.right.is_none() {
                    (system.angle, system.left, system.right) =
                        (said.angle.clone(), said.left.clone(), said.right.clone());
                }
                system.iterations = system.iterations.take().or_else(|| said.iterations.clone());
            }
            return;
        };
        let occurs = |rule: &Rule| rule.from.trim().chars().next().is_some_and(|symbol| axiom.value.contains(symbol));
        let plausible = is_sure || !said.lines.is_empty() || self.of_field && said.rules.iter().any(occurs);
        if said.rules.is_empty() && said.lines.is_empty()
            || !(plausible || said.rules.iter().all(strict) && said.rules.iter().any(occurs))
        {
            return;
        }
        self.systems.push(said);
    }
}
