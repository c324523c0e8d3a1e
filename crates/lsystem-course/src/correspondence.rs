//! Systems that draw the same after any number of steps, because their letters correspond.

use crate::actions::Actions;
use lsystem_syntax::{Action, Definition, FIELDS, Grammar, Module, Pattern, Production, Seen, parse};

/// The fields that may differ: names, the letters themselves, and what has no part in where the ink is.
const LETTERS: [&str; 10] =
    ["axiom", "rules", "iterations", "dialect", "overrides", "title", "name", "source", "notes", "seed"];
/// The most letters of one system that are compared with one of the other.
const MAX_PAIRS: usize = 1_000;

/// Whether a correspondence of letters proves that two systems draw the same after any number of steps: corresponding
/// letters have the same actions, and successors of corresponding letters. One letter may correspond to several.
pub(crate) fn draw_alike(a: &Definition, b: &Definition) -> bool {
    let is_counted = |name: &str| !LETTERS.contains(&name);
    // The style has no part in where the ink is.
    let styled = Definition { style: a.style.clone(), ..b.clone() };
    let is_equal = FIELDS.iter().filter(|spec| is_counted(spec.name)).all(|spec| spec.get(a) == spec.get(&styled));
    let [own, other] = [a, b].map(|definition| System {
        grammar: parse(&definition.axiom, &definition.rules).0,
        actions: Actions::new(definition),
    });
    if !is_equal || !own.is_simple() || !other.is_simple() || own.grammar.constants != other.grammar.constants {
        return false;
    }
    let mut pairs: Vec<[(char, usize); 2]> = Vec::new();
    let mut words = vec![(own.grammar.axiom.as_slice(), other.grammar.axiom.as_slice())];
    while let Some((a, b)) = words.pop() {
        let [a, b]: [Vec<&Module>; 2] = [own.with_effect(a).collect(), other.with_effect(b).collect()];
        if a.len() != b.len() {
            return false;
        }
        for (a, b) in a.into_iter().zip(b) {
            let pair = [a, b].map(|module| (module.symbol, module.arguments.len()));
            if a.arguments != b.arguments {
                return false;
            }
            if pairs.contains(&pair) {
                continue;
            }
            pairs.push(pair);
            let is_alike = pairs.len() <= MAX_PAIRS && own.actions.of(a.symbol) == other.actions.of(b.symbol);
            match (own.rule(a), other.rule(b)) {
                _ if !is_alike => return false,
                (None, None) => {}
                (Some(a), Some(b)) if a.predecessor.parameters == b.predecessor.parameters => {
                    words.push((&a.successor, &b.successor));
                }
                _ => return false,
            }
        }
    }
    true
}

struct System {
    grammar: Grammar,
    actions: Actions,
}

impl System {
    /// Whether each module has at most one production, without contexts, conditions, weights and homomorphisms.
    fn is_simple(&self) -> bool {
        let Grammar { productions, images, seen, .. } = &self.grammar;
        let is_plain = |rule: &Production| {
            rule.left.is_empty() && rule.right.is_empty() && rule.condition.is_none() && rule.weight.is_none()
        };
        let key = |rule: &Production| (rule.predecessor.symbol, rule.predecessor.parameters.len());
        let is_single = |rule: &Production| productions.iter().filter(|other| key(other) == key(rule)).count() == 1;
        images.is_empty() && *seen == Seen::All && productions.iter().all(|rule| is_plain(rule) && is_single(rule))
    }

    fn rule(&self, module: &Module) -> Option<&Production> {
        let is_of = |Pattern { symbol, parameters }: &Pattern| {
            *symbol == module.symbol && parameters.len() == module.arguments.len()
        };
        self.grammar.productions.iter().find(|rule| is_of(&rule.predecessor))
    }

    /// The modules that are rewritten or mean something to the turtle.
    fn with_effect<'a>(&'a self, word: &'a [Module]) -> impl Iterator<Item = &'a Module> {
        let means = |actions: &[Action]| !actions.is_empty();
        word.iter().filter(move |module| means(self.actions.of(module.symbol)) || self.rule(module).is_some())
    }
}
