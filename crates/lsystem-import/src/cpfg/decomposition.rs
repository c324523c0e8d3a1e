//! The decompositions of cpfg: productions that replace the modules of the axiom and of every successor at once, until
//! none applies or the maximum depth is reached. They are written into the axiom and the successors:
//!
//! ```text
//! A(t) --> A(t+1)                          A(t) : t+1 > 3 --> F A(t+1-3)
//! decomposition                  becomes   A(t) --> A(t+1)
//! A(t) : t > 3 --> F A(t-3)
//! ```
//!
//! A homomorphism that applies to its own results is written into itself in the same way.

use super::expressions::{is_random, size};
use core::cell::Cell;
use lsystem_base::{say, words::said};
use lsystem_syntax::grammar::Values;
use lsystem_syntax::{Expr, Grammar, Module, Operator, Production};

/// Decompositions, with the constants of the system.
pub(super) struct Decomposition<'a> {
    /// What the productions are called.
    /// As in `A decomposition` and `this decomposition`.
    name: [&'static str; 2],
    rules: &'a [Production],
    constants: Values<'a>,
    /// The most replacements inside one another.
    depth: usize,
    /// How many modules and parts of expressions may still be read and written, in all words together.
    work: Cell<usize>,
    /// Whether the depth ended a decomposition.
    stopped: Cell<bool>,
}

/// A condition of parameters, and whether it is true.
type Case = (Expr, bool);

/// A word, and the conditions that decide it.
type Cased = (Vec<Case>, Vec<Module>);

/// The most words that conditions of parameters may make of one word.
const MAX_CASES: usize = 64;
/// The most productions that decompositions are written into.
const MAX_PRODUCTIONS: usize = 2000;
/// The most modules of a word.
const MAX_MODULES: usize = 20_000;
/// The most modules and parts of expressions that are read and written for a system.
const MAX_WORK: usize = 2_000_000;
/// The most parts of an expression, which may be nested in one another.
const LONGEST: usize = 1000;

impl<'a> Decomposition<'a> {
    /// The productions of `grammar` as decompositions.
    pub(super) fn new(name: [&'static str; 2], grammar: &'a Grammar, depth: usize) -> Result<Self, String> {
        let rules = &*grammar.productions;
        if rules.iter().any(|rule| !rule.left.is_empty() || !rule.right.is_empty() || rule.weight.is_some()) {
            return Err(say!("{} with a context or a probability is not possible", said(name[0])));
        }
        let (work, stopped) = (Cell::new(MAX_WORK), Cell::new(false));
        Ok(Self { name, rules, constants: grammar.values(), depth, work, stopped })
    }

    /// Writes the decompositions into the axiom and the successors. Where the depth ends them, they go on in the next
    /// step, for the modules that no production replaces. Returns whether the depth ends them.
    pub(super) fn apply(&self, grammar: &mut Grammar) -> Result<bool, String> {
        grammar.axiom = self.word(&grammar.axiom)?;
        grammar.productions = self.applied(&grammar.productions)?;
        let stopped = self.stopped.get();
        if stopped {
            let own = self.rules.iter().map(|rule| self.of_module(rule)).collect::<Result<Vec<_>, _>>()?;
            let always = |rule: &Production, own: &Production| {
                rule.predecessor.symbol == own.predecessor.symbol
                    && rule.predecessor.parameters.len() == own.predecessor.parameters.len()
                    && rule.left.is_empty()
                    && rule.right.is_empty()
                    && rule.condition.is_none()
            };
            for rule in own.into_iter().flatten() {
                if !grammar.productions.iter().any(|earlier| always(earlier, &rule)) {
                    grammar.productions.push(rule);
                }
            }
        }
        Ok(stopped)
    }

    /// The productions that a decomposition is for the modules that no other production replaces.
    fn of_module(&self, rule: &Production) -> Result<Vec<Production>, String> {
        let names = &rule.predecessor.parameters;
        let arguments = names.iter().map(|name| Expr::Name(name.clone())).collect();
        let module = Module { symbol: rule.predecessor.symbol, arguments };
        let words = self.cases(core::slice::from_ref(&module))?;
        let changed = words.into_iter().filter(|(_, word)| *word != [module.clone()]);
        Ok(changed.map(|(cases, word)| within(rule, None, &cases, word)).collect())
    }

    /// Productions with the decompositions written into their successors. Where parameters decide, a production becomes
    /// several, with the deciding conditions.
    pub(super) fn applied(&self, productions: &[Production]) -> Result<Vec<Production>, String> {
        let mut made = Vec::new();
        for production in productions {
            for (cases, word) in self.cases(&production.successor)? {
                made.push(within(production, production.condition.as_ref(), &cases, word));
            }
            if made.len() > MAX_PRODUCTIONS {
                return Err(self.too_long());
            }
        }
        Ok(made)
    }

    /// A word in which no production applies, or where the depth ends that.
    pub(super) fn word(&self, word: &[Module]) -> Result<Vec<Module>, String> {
        let mut decided = Vec::new();
        let word = self.decomposed(word, &mut decided)?;
        match decided.is_empty() {
            true => Ok(word),
            false => Err(say!("Whether {} applies depends on parameters, which is not possible", said(self.name[1]))),
        }
    }

    /// The words that a word becomes, each with the conditions that decide and their truth. Conditions are true first.
    fn cases(&self, word: &[Module]) -> Result<Vec<Cased>, String> {
        let mut found = Vec::new();
        let mut decided = Vec::new();
        loop {
            let made = self.decomposed(word, &mut decided)?;
            found.push((decided.clone(), made));
            // The last condition that was true is false next.
            while decided.pop_if(|(_, is_true)| !*is_true).is_some() {}
            let Some((_, is_true)) = decided.last_mut() else { return Ok(found) };
            *is_true = false;
            if found.len() >= MAX_CASES {
                return Err(say!(
                    "Whether {} applies depends on parameters in too many cases, which is not possible",
                    said(self.name[1])
                ));
            }
        }
    }

    /// A word in which no production applies, or where the depth ends that. `decided` has the truth of conditions of
    /// parameters; those that are missing are true and are added.
    fn decomposed(&self, word: &[Module], decided: &mut Vec<Case>) -> Result<Vec<Module>, String> {
        let mut made = Vec::new();
        // The modules still to come, the next one last, with the number of replacements that made them.
        let mut rest: Vec<(Module, usize)> = word.iter().rev().map(|module| (module.clone(), 0)).collect();
        while let Some((module, depth)) = rest.pop() {
            if made.len() + rest.len() >= MAX_MODULES {
                return Err(self.too_long());
            }
            if depth >= self.depth {
                self.stopped.set(self.stopped.get() || self.rules.iter().any(|rule| is_of(rule, &module)));
                made.push(module);
                continue;
            }
            let Some(rule) = self.matching(&module, decided)? else {
                made.push(module);
                continue;
            };
            // Used several times, an argument would be a different random number each time.
            if module.arguments.iter().any(is_random) {
                return Err(say!("{} of random arguments is not possible", said(self.name[0])));
            }
            for next in rule.successor.iter().rev() {
                let arguments =
                    next.arguments.iter().map(|own| self.put(own, rule, &module)).collect::<Result<_, _>>()?;
                rest.push((Module { symbol: next.symbol, arguments }, depth + 1));
            }
        }
        Ok(made)
    }

    /// The first decomposition that applies to a module.
    fn matching(&self, module: &Module, decided: &mut Vec<Case>) -> Result<Option<&Production>, String> {
        for rule in self.rules {
            self.spend(1)?;
            if !is_of(rule, module) {
                continue;
            }
            let Some(condition) = &rule.condition else { return Ok(Some(rule)) };
            let condition = self.put(condition, rule, module)?;
            let applies = match (self.constants.value(&condition), decided.iter().find(|case| case.0 == condition)) {
                (Some(value), _) => value != 0.0 && !value.is_nan(),
                (None, Some((_, is_true))) => *is_true,
                (None, None) if is_random(&condition) => {
                    return Err(say!(
                        "Whether {} applies depends on chance, which is not possible",
                        said(self.name[1])
                    ));
                }
                (None, None) => {
                    decided.push((condition, true));
                    true
                }
            };
            if applies {
                return Ok(Some(rule));
            }
        }
        Ok(None)
    }

    /// An expression of a decomposition with the module's arguments in place of parameters. Constants become numbers,
    /// because a parameter of the surrounding production may have the same name.
    fn replaced(&self, expr: &Expr, rule: &Production, module: &Module) -> Result<Expr, String> {
        self.spend(1)?;
        let inner = |expr: &Expr| self.replaced(expr, rule, module);
        let replaced = match expr {
            Expr::Number(_) => expr.clone(),
            Expr::Name(name) => {
                let parameter = rule.predecessor.parameters.iter().position(|own| own == name);
                match (parameter, self.constants.of(name)) {
                    (Some(at), _) => {
                        let argument = &module.arguments[at];
                        self.spend(size(argument))?;
                        argument.clone()
                    }
                    (None, Some(value)) => Expr::Number(value),
                    (None, None) => expr.clone(),
                }
            }
            Expr::Negative(of) => Expr::Negative(Box::new(inner(of)?)),
            Expr::Not(of) => Expr::Not(Box::new(inner(of)?)),
            Expr::Curve(name, of) => Expr::Curve(name.clone(), Box::new(inner(of)?)),
            Expr::Binary(operator, a, b) => Expr::Binary(*operator, Box::new(inner(a)?), Box::new(inner(b)?)),
            Expr::Call(function, arguments) => {
                Expr::Call(*function, arguments.iter().map(inner).collect::<Result<_, _>>()?)
            }
        };
        // Computed at once, so that expressions do not grow with the depth. Constants in it are numbers already.
        Ok(match has_numbers(&replaced).then(|| self.constants.value(&replaced)).flatten() {
            Some(value) if value.is_finite() => Expr::Number(value),
            _ => replaced,
        })
    }

    /// An expression as [`replaced`](Self::replaced) writes it, if it is not too long.
    fn put(&self, expr: &Expr, rule: &Production, module: &Module) -> Result<Expr, String> {
        let put = self.replaced(expr, rule, module)?;
        match size(&put) > LONGEST {
            true => Err(say!("{} with so long arguments is not possible", said(self.name[0]))),
            false => Ok(put),
        }
    }

    /// Counts work; an error when too much is done.
    fn spend(&self, work: usize) -> Result<(), String> {
        self.work.set(self.work.get().checked_sub(work).ok_or_else(|| self.too_long())?);
        Ok(())
    }

    fn too_long(&self) -> String {
        say!("{} into so many modules is not possible", said(self.name[0]))
    }
}

/// Whether a production has the symbol and the number of arguments of a module.
fn is_of(rule: &Production, module: &Module) -> bool {
    rule.predecessor.symbol == module.symbol && rule.predecessor.parameters.len() == module.arguments.len()
}

/// A production for these cases with another successor. The production for the case that its conditions are false stands
/// behind, so only weights need that these are told.
fn within(production: &Production, condition: Option<&Expr>, cases: &[Case], successor: Vec<Module>) -> Production {
    let all = production.weight.is_some();
    let cases = cases.iter().filter(|(_, is_true)| *is_true || all).map(|(condition, is_true)| match is_true {
        true => condition.clone(),
        false => Expr::Not(Box::new(condition.clone())),
    });
    let condition = (condition.cloned().into_iter().chain(cases))
        .reduce(|all, next| Expr::Binary(Operator::And, Box::new(all), Box::new(next)));
    Production { condition, successor, ..production.clone() }
}

/// Whether all operands of an expression are numbers.
fn has_numbers(expr: &Expr) -> bool {
    let is_number = |of: &Expr| matches!(of, Expr::Number(_));
    match expr {
        Expr::Number(_) | Expr::Name(_) => false,
        Expr::Negative(of) | Expr::Not(of) | Expr::Curve(_, of) => is_number(of),
        Expr::Binary(_, a, b) => is_number(a) && is_number(b),
        Expr::Call(_, arguments) => arguments.iter().all(is_number),
    }
}
