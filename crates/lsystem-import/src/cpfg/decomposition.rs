//! The decompositions of cpfg: productions that replace the modules of the axiom and of every successor at once, until
//! none applies. Where that ends, they are written into the axiom and the successors. A homomorphism that applies to
//! its own results is written into itself in the same way.

use core::cell::Cell;
use lsystem_syntax::grammar::Values;
use lsystem_syntax::{Expr, Function, Grammar, Module, Production};

/// Decompositions, with the constants of the system.
pub(super) struct Decomposition<'a> {
    /// What the productions are called.
    name: &'static str,
    rules: &'a [Production],
    constants: Values<'a>,
    /// The most replacements inside one another.
    depth: usize,
    /// How many modules and parts of expressions may still be read and written, in all words together.
    work: Cell<usize>,
}

/// The name of a homomorphism, which may end at its depth. A decomposition must end before.
pub(super) const HOMOMORPHISM: &str = "homomorphism";
/// The most modules of a word.
const MOST_MODULES: usize = 20_000;
/// The most modules and parts of expressions that are read and written for a system.
const MOST_WORK: usize = 2_000_000;
/// The most parts of an expression, which may be nested in one another.
const LONGEST: usize = 1000;

impl<'a> Decomposition<'a> {
    /// The productions of `grammar` as decompositions.
    pub(super) fn new(name: &'static str, grammar: &'a Grammar, depth: usize) -> Result<Self, String> {
        let rules = &*grammar.productions;
        if rules.iter().any(|rule| !rule.left.is_empty() || !rule.right.is_empty() || rule.weight.is_some()) {
            return Err(format!("A {name} with a context or a probability is not possible"));
        }
        Ok(Self { name, rules, constants: grammar.values(), depth, work: Cell::new(MOST_WORK) })
    }

    /// Writes the decompositions into the axiom and the successors.
    pub(super) fn apply(&self, grammar: &mut Grammar) -> Result<(), String> {
        grammar.axiom = self.word(&grammar.axiom)?;
        for production in &mut grammar.productions {
            production.successor = self.word(&production.successor)?;
        }
        Ok(())
    }

    /// A word in which no production applies, or where the depth ends a homomorphism.
    pub(super) fn word(&self, word: &[Module]) -> Result<Vec<Module>, String> {
        let mut made = Vec::new();
        // The modules still to come, the next one last, with the number of replacements that made them.
        let mut rest: Vec<(Module, usize)> = word.iter().rev().map(|module| (module.clone(), 0)).collect();
        while let Some((module, depth)) = rest.pop() {
            if made.len() + rest.len() >= MOST_MODULES {
                return Err(self.too_long());
            }
            let ends = depth >= self.depth;
            let rule = if ends && self.name == HOMOMORPHISM { None } else { self.matching(&module)? };
            let Some(rule) = rule else {
                made.push(module);
                continue;
            };
            if ends {
                return Err(format!("The {} does not end within its maximum depth", self.name));
            }
            // Used several times, an argument would be a different random number each time.
            if module.arguments.iter().any(is_random) {
                return Err(format!("A {} of random arguments is not possible", self.name));
            }
            for next in rule.successor.iter().rev() {
                let arguments =
                    next.arguments.iter().map(|own| self.replaced(own, rule, &module)).collect::<Result<_, _>>()?;
                rest.push((Module { symbol: next.symbol, arguments }, depth + 1));
            }
        }
        Ok(made)
    }

    /// The first decomposition that applies to a module.
    fn matching(&self, module: &Module) -> Result<Option<&Production>, String> {
        for rule in self.rules {
            self.spend(1)?;
            let own = &rule.predecessor;
            if own.symbol != module.symbol || own.parameters.len() != module.arguments.len() {
                continue;
            }
            let Some(condition) = &rule.condition else { return Ok(Some(rule)) };
            match self.constants.value(&self.replaced(condition, rule, module)?) {
                Some(value) if value != 0.0 && !value.is_nan() => return Ok(Some(rule)),
                Some(_) => {}
                None => {
                    let name = self.name;
                    return Err(format!("Whether this {name} applies depends on parameters, which is not possible"));
                }
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
        // Computed at once, so that expressions do not grow with the depth.
        let size = size(&replaced);
        self.spend(size)?;
        if size > LONGEST {
            return Err(format!("A {} with so long arguments is not possible", self.name));
        }
        Ok(match self.constants.value(&replaced) {
            Some(value) if value.is_finite() => Expr::Number(value),
            _ => replaced,
        })
    }

    /// Counts work; an error when too much is done.
    fn spend(&self, work: usize) -> Result<(), String> {
        self.work.set(self.work.get().checked_sub(work).ok_or_else(|| self.too_long())?);
        Ok(())
    }

    fn too_long(&self) -> String {
        format!("A {} into so many modules is not possible", self.name)
    }
}

/// The number of parts of an expression.
fn size(expr: &Expr) -> usize {
    1 + match expr {
        Expr::Number(_) | Expr::Name(_) => 0,
        Expr::Negative(of) | Expr::Not(of) | Expr::Curve(_, of) => size(of),
        Expr::Binary(_, a, b) => size(a) + size(b),
        Expr::Call(_, arguments) => arguments.iter().map(size).sum(),
    }
}

/// Whether an expression has random numbers.
fn is_random(expr: &Expr) -> bool {
    match expr {
        Expr::Number(_) | Expr::Name(_) => false,
        Expr::Negative(of) | Expr::Not(of) | Expr::Curve(_, of) => is_random(of),
        Expr::Binary(_, a, b) => is_random(a) || is_random(b),
        Expr::Call(function, arguments) => {
            matches!(function, Function::Random | Function::NormalRandom) || arguments.iter().any(is_random)
        }
    }
}
