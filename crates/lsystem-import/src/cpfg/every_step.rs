//! Code of cpfg that runs at every step: `StartEach: {n = n + 1;}` before its productions, `EndEach` behind them.
//!
//! The numbers that the code changes become parameters of the modules whose productions use them, and of the modules
//! that these come from:
//!
//! ```text
//! Start: {n = 0;}                          A(0)
//! StartEach: {n = n + 1;}       becomes    A(n) : n+1 > 3 --> F
//! A : n > 3 --> F                          A(n) --> A(n+1)
//! ```

use super::expressions::{each_part, size};
use core::ops::Range;
use lsystem_base::{number::number, word};
use lsystem_syntax::{Expr, Grammar, Module, Operator, Pattern, Production, Seen, parse};
use std::collections::{BTreeMap, BTreeSet};

/// The most parts of a number that the code computes.
const LONGEST: usize = 300;

/// The reason for decompositions with numbers of every step.
const DECOMPOSED: &str = word!("Numbers that code of every step changes are not read in decompositions");

/// The code that runs at every step, in our notation.
#[derive(Debug, Default)]
pub(super) struct EveryStep {
    /// The place of the first block.
    pub(super) place: Option<Range<usize>>,
    /// The assignments before the productions, and those behind them.
    pub(super) before: Vec<(String, String)>,
    pub(super) after: Vec<(String, String)>,
}

/// The letter of a module: its symbol and the number of its arguments.
type Letter = (char, usize);

/// The numbers by name, as expressions of the parameters that modules carry.
type Numbers = BTreeMap<String, Expr>;

impl EveryStep {
    /// The names of the numbers that change.
    pub(super) fn names(&self) -> BTreeSet<&str> {
        self.before.iter().chain(&self.after).map(|(name, _)| name.as_str()).collect()
    }

    /// Writes the numbers into the modules of a grammar, whose decompositions must not use them. `initial` gives their
    /// values before the first step, and `free` a symbol that nothing else has. An error if that is not possible.
    pub(super) fn write(
        &self,
        grammar: &mut Grammar,
        decompositions: &[Production],
        initial: &dyn Fn(&str) -> f64,
        free: &mut dyn FnMut(char) -> char,
    ) -> Result<(), &'static str> {
        let names = self.names();
        let Some(letters) = carriers(grammar, &names) else {
            return match decompositions.iter().any(|rule| mentions(rule, &names)) {
                true => Err(DECOMPOSED),
                false => Ok(()),
            };
        };
        let is_carrier = |letter: Letter| letters.contains(&letter);
        let touches = |rule: &Production| {
            is_carrier(letter(&rule.predecessor))
                || rule.successor.iter().any(|module| is_carrier((module.symbol, module.arguments.len())))
                || mentions(rule, &names)
        };
        if decompositions.iter().any(touches) {
            return Err(DECOMPOSED);
        }
        let carried = self.carried(grammar, &names);
        let parameters: Vec<String> = carried.iter().map(|name| unique(grammar, name)).collect();
        let own: Numbers = (carried.iter().zip(&parameters))
            .map(|(name, parameter)| ((*name).to_owned(), Expr::Name(parameter.clone())))
            .collect();
        let constants: String = (grammar.constants.iter())
            .filter(|constant| !names.contains(constant.name.as_str()))
            .map(|constant| format!("{} = {}\n", constant.name, number(constant.value)))
            .collect();
        let now = run(&self.before, own.clone(), &names, &constants)?;
        let next = run(&self.after, now.clone(), &names, &constants)?;
        let following: Vec<Expr> = carried.iter().map(|name| next[*name].clone()).collect();
        let symbols: BTreeMap<Letter, char> =
            letters.iter().map(|&letter| (letter, if letter.1 == 0 { free(letter.0) } else { letter.0 })).collect();
        let carry = Carry { symbols, parameters };

        let start: Vec<Expr> = carried.iter().map(|name| Expr::Number(initial(name))).collect();
        carry.word(&mut grammar.axiom, &start);
        for rule in &mut grammar.productions {
            let numbers = visible(rule, &now);
            put_all(rule, &numbers);
            carry.word(&mut rule.successor, &following);
            carry.heads(rule);
        }
        for &letter in &letters {
            let onward = carry.onward(letter, &following, &grammar.productions)?;
            grammar.productions.extend(onward);
        }
        let mut bare: BTreeSet<char> = letters.iter().filter(|letter| letter.1 == 0).map(|letter| letter.0).collect();
        for rule in &mut grammar.images {
            let numbers = visible(rule, &own);
            put_all(rule, &numbers);
            if rule.predecessor.parameters.is_empty() {
                bare.remove(&rule.predecessor.symbol);
            }
            carry.heads(rule);
        }
        // The symbols that were renamed are drawn as before.
        for symbol in bare {
            let predecessor = Pattern { symbol: carry.symbols[&(symbol, 0)], parameters: carry.parameters.clone() };
            let image = Production { predecessor, ..Production::new(symbol, vec![Module::from(symbol)]) };
            grammar.images.push(image);
        }
        if let Seen::Except(list) | Seen::Only(list) = &mut grammar.seen {
            let more = carry.symbols.iter().filter(|((symbol, count), _)| *count == 0 && list.contains(symbol));
            let more: Vec<char> = more.map(|(_, own)| *own).collect();
            list.extend(more);
        }
        grammar.constants.retain(|constant| !names.contains(constant.name.as_str()));
        Ok(())
    }

    /// The numbers that one step takes over from the last: those that are read before they are assigned.
    fn carried<'n>(&'n self, grammar: &Grammar, names: &BTreeSet<&'n str>) -> Vec<&'n str> {
        let mut assigned: BTreeSet<&str> = BTreeSet::new();
        let mut carried: BTreeSet<&str> = BTreeSet::new();
        let read = |text: &str, assigned: &BTreeSet<&str>, carried: &mut BTreeSet<&'n str>| {
            let words = text.split(|c: char| !super::macros::is_part(c));
            carried.extend(words.filter(|word| !assigned.contains(word)).filter_map(|word| names.get(word)));
        };
        for (name, value) in &self.before {
            read(value, &assigned, &mut carried);
            assigned.insert(name);
        }
        let of_rules = |rules: &[Production], assigned: &BTreeSet<&str>| -> Vec<&'n str> {
            let unassigned = names.iter().filter(|name| !assigned.contains(*name));
            unassigned
                .copied()
                .filter(|name| rules.iter().any(|rule| mentions(rule, &BTreeSet::from([*name]))))
                .collect()
        };
        carried.extend(of_rules(&grammar.productions, &assigned));
        for (name, value) in &self.after {
            read(value, &assigned, &mut carried);
            assigned.insert(name);
        }
        carried.extend(of_rules(&grammar.images, &BTreeSet::new()));
        carried.into_iter().collect()
    }
}

/// The modules that carry numbers.
struct Carry {
    /// By letter of the text: the symbol here.
    symbols: BTreeMap<Letter, char>,
    parameters: Vec<String>,
}

impl Carry {
    /// Adds arguments to the modules of a word.
    fn word(&self, word: &mut [Module], arguments: &[Expr]) {
        for module in word {
            if let Some(&symbol) = self.symbols.get(&(module.symbol, module.arguments.len())) {
                module.symbol = symbol;
                module.arguments.extend_from_slice(arguments);
            }
        }
    }

    /// Adds parameters to the predecessor and to the contexts, which are not read there.
    fn heads(&self, rule: &mut Production) {
        if let Some(&symbol) = self.symbols.get(&letter(&rule.predecessor)) {
            rule.predecessor.symbol = symbol;
            rule.predecessor.parameters.extend_from_slice(&self.parameters);
        }
        let contexts = rule.left.iter_mut().chain(&mut rule.right);
        for (at, pattern) in contexts.enumerate() {
            if let Some(&symbol) = self.symbols.get(&letter(pattern)) {
                pattern.symbol = symbol;
                pattern.parameters.extend(self.parameters.iter().map(|name| format!("{name}{at}")));
            }
        }
    }

    /// The production of a module that only carries its numbers on, where no other applies. `None` if another always
    /// does.
    fn onward(
        &self,
        letter: Letter,
        following: &[Expr],
        others: &[Production],
    ) -> Result<Option<Production>, &'static str> {
        let symbol = self.symbols[&letter];
        let own: Vec<String> = (0..letter.1).map(|at| format!("{}_{at}", self.parameters[0])).collect();
        let parameters = [&own[..], &self.parameters].concat();
        let same = |rule: &&Production| {
            rule.predecessor.symbol == symbol && rule.predecessor.parameters.len() == parameters.len()
        };
        let has_context = |rule: &Production| !rule.left.is_empty() || !rule.right.is_empty();
        if others.iter().filter(same).any(|rule| !has_context(rule) && rule.condition.is_none()) {
            return Ok(None);
        }
        let arguments = own.iter().cloned().map(Expr::Name).chain(following.iter().cloned()).collect();
        let predecessor = Pattern { symbol, parameters: parameters.clone() };
        let mut onward = Production { predecessor, ..Production::new(symbol, vec![Module { symbol, arguments }]) };
        // Among productions with probabilities, it is chosen only if no other can be.
        if others.iter().filter(same).any(|rule| rule.weight.is_some()) {
            if others.iter().filter(same).any(has_context) {
                return Err(word!(
                    "Numbers that code of every step changes are not possible with contexts and probabilities"
                ));
            }
            let denied = others.iter().filter(same).filter_map(|rule| {
                let names = rule.predecessor.parameters.iter().cloned();
                let names: Numbers = names.zip(parameters.iter().cloned().map(Expr::Name)).collect();
                Some(Expr::Not(Box::new(put(rule.condition.as_ref()?, &names))))
            });
            onward.condition = denied.reduce(|a, b| Expr::Binary(Operator::And, Box::new(a), Box::new(b)));
            onward.weight = Some(Expr::Number(1.0));
        }
        Ok(Some(onward))
    }
}

fn letter(pattern: &Pattern) -> Letter {
    (pattern.symbol, pattern.parameters.len())
}

/// The modules that need the numbers: those whose productions use them, and those that these come from. `None` if there
/// are none.
fn carriers(grammar: &Grammar, names: &BTreeSet<&str>) -> Option<BTreeSet<Letter>> {
    let rules = grammar.productions.iter().chain(&grammar.images);
    let mut found: BTreeSet<Letter> =
        rules.filter(|rule| mentions(rule, names)).map(|rule| letter(&rule.predecessor)).collect();
    loop {
        let makes = |rule: &&Production| {
            rule.successor.iter().any(|module| found.contains(&(module.symbol, module.arguments.len())))
        };
        let more: Vec<Letter> =
            grammar.productions.iter().filter(makes).map(|rule| letter(&rule.predecessor)).collect();
        let before = found.len();
        found.extend(more);
        if found.len() == before {
            return (!found.is_empty()).then_some(found);
        }
    }
}

/// Whether a production uses one of the numbers. Its parameters hide numbers of the same names.
fn mentions(rule: &Production, names: &BTreeSet<&str>) -> bool {
    let own: BTreeSet<&str> = parameters(rule).collect();
    let uses = |expr: &Expr| {
        let mut found = false;
        each_name(expr, &mut |name| found |= names.contains(name) && !own.contains(name));
        found
    };
    rule.condition.iter().chain(&rule.weight).any(uses)
        || rule.successor.iter().flat_map(|module| &module.arguments).any(uses)
}

fn parameters(rule: &Production) -> impl Iterator<Item = &str> {
    let patterns = rule.left.iter().chain(&rule.right).chain([&rule.predecessor]);
    patterns.flat_map(|pattern| &pattern.parameters).map(String::as_str)
}

/// The numbers that a production can use.
fn visible(rule: &Production, numbers: &Numbers) -> Numbers {
    let own: BTreeSet<&str> = parameters(rule).collect();
    numbers.iter().filter(|(name, _)| !own.contains(name.as_str())).map(|(a, b)| (a.clone(), b.clone())).collect()
}

/// Writes numbers in place of their names.
fn put_all(rule: &mut Production, numbers: &Numbers) {
    let arguments = rule.successor.iter_mut().flat_map(|module| &mut module.arguments);
    arguments.chain(&mut rule.condition).chain(&mut rule.weight).for_each(|expr| *expr = put(expr, numbers));
}

/// The numbers after these assignments. An error if one of them cannot be computed.
fn run(
    code: &[(String, String)],
    mut numbers: Numbers,
    names: &BTreeSet<&str>,
    constants: &str,
) -> Result<Numbers, &'static str> {
    for (name, value) in code {
        let known: Vec<&str> = names.iter().copied().collect();
        let (grammar, wrong) = parse("", &format!("{constants}A({}) -> B({value})", known.join(",")));
        let argument = grammar.productions.first().and_then(|rule| rule.successor.first()?.arguments.first());
        let argument = argument.filter(|_| !wrong.iter().any(lsystem_syntax::Diagnostic::is_error));
        let value = put(argument.ok_or(word!("The code of every step is not read"))?, &numbers);
        if size(&value) > LONGEST {
            return Err(word!("The code of every step is too long"));
        }
        numbers.insert(name.clone(), value);
    }
    Ok(numbers)
}

/// A name that no production has.
fn unique(grammar: &Grammar, name: &str) -> String {
    let rules = || grammar.productions.iter().chain(&grammar.images);
    let mut own = format!("{name}_");
    while rules().flat_map(parameters).any(|known| known.starts_with(&own)) {
        own.push('_');
    }
    own
}

fn put(expr: &Expr, numbers: &Numbers) -> Expr {
    let inner = |expr: &Expr| Box::new(put(expr, numbers));
    match expr {
        Expr::Number(_) => expr.clone(),
        Expr::Name(name) => numbers.get(name).unwrap_or(expr).clone(),
        Expr::Negative(of) => Expr::Negative(inner(of)),
        Expr::Not(of) => Expr::Not(inner(of)),
        Expr::Curve(name, of) => Expr::Curve(name.clone(), inner(of)),
        Expr::Binary(operator, a, b) => Expr::Binary(*operator, inner(a), inner(b)),
        Expr::Call(function, all) => Expr::Call(*function, all.iter().map(|expr| put(expr, numbers)).collect()),
    }
}

fn each_name(expr: &Expr, visit: &mut dyn FnMut(&str)) {
    each_part(expr, &mut |part| {
        if let Expr::Name(name) = part {
            visit(name);
        }
    });
}
