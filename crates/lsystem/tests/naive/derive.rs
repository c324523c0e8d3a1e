//! Derivation as ABOP defines it: a word is a tree of branches, and expressions are evaluated from their syntax trees.

use lsystem::derive::Key;
use lsystem::syntax::{Expr, Function, Grammar, Heading, Operator, Pattern, Production};

/// A module of a word.
#[derive(Clone, Debug, PartialEq)]
pub struct Module {
    pub symbol: char,
    pub arguments: Vec<f64>,
    pub key: Key,
    /// The step that made the module, or the oldest ancestor in an unbroken line of the same letter.
    pub since: u32,
    /// The step that made the module, or the oldest ancestor that it continues.
    pub made: u32,
    /// The step that made the module, or the last one for a module of a letter with productions.
    pub step: u32,
    /// The index in the word.
    pub index: usize,
    /// The index of the parent in the word of the previous generation.
    pub parent: usize,
    /// The production that made the module; `None` for a module that stays or is in the axiom.
    pub production: Option<usize>,
    /// The index in the successor or in the axiom; 0 for a module that stays.
    pub position: usize,
}

impl Module {
    /// A module of the axiom or of a successor. `place` is its parent, production and position.
    fn new(symbol: char, arguments: Vec<f64>, key: Key, place: (usize, Option<usize>, usize)) -> Self {
        let (parent, production, position) = place;
        Self { symbol, arguments, key, since: 0, made: 0, step: 0, index: position, parent, production, position }
    }
}

/// The modules of generation `n`; `None` if a number is not finite. Time and memory grow with the length of the word.
pub fn modules(grammar: &Grammar, seed: u32, n: u32) -> Option<Vec<Module>> {
    aged_modules(grammar, seed, n, &|_| false)
}

/// As [`modules`], with [`Module::made`]; `draws` says whether a module draws.
pub fn aged_modules(grammar: &Grammar, seed: u32, n: u32, draws: &dyn Fn(&Module) -> bool) -> Option<Vec<Module>> {
    let axiom = grammar.axiom.iter().enumerate();
    let mut drawn = 0;
    let mut word = axiom
        .map(|(index, module)| {
            let key = Key::root(index as u64);
            let mut scope = Scope { grammar, names: vec![], key, seed, step: 0, drawn };
            let arguments = module.arguments.iter().map(|expr| scope.value(expr)).collect();
            drawn = scope.drawn;
            let place = (index, None, index);
            Module::new(module.symbol, arguments, key, place)
        })
        .collect::<Vec<_>>();
    for step in 1..=n {
        if !is_finite(&word) {
            return None;
        }
        word = uncut(&word);
        let tree = Tree::new(grammar, &word);
        let mut next = Vec::new();
        for (place, module) in word.iter().enumerate() {
            match tree.successor(&grammar.productions, seed, step, place) {
                None => next.push(Module { parent: module.index, production: None, position: 0, ..module.clone() }),
                Some(mut successor) => {
                    let like = |m: &Module| m.symbol == module.symbol && m.arguments.len() == module.arguments.len();
                    let continuation = successor.iter().position(like);
                    let continuation =
                        continuation.or_else(|| successor.iter().position(draws).filter(|_| draws(module)));
                    for (index, child) in successor.iter_mut().enumerate() {
                        child.since = if like(child) { module.since } else { step };
                        child.made = if continuation == Some(index) { module.made } else { step };
                    }
                    next.extend(successor);
                }
            }
        }
        next.iter_mut().enumerate().for_each(|(index, module)| module.index = index);
        word = next;
    }
    for module in &mut word {
        let mut predecessors = grammar.productions.iter().map(|production| &production.predecessor);
        let is_replaced =
            predecessors.any(|own| own.symbol == module.symbol && own.parameters.len() == module.arguments.len());
        module.step = if is_replaced { n } else { module.since };
    }
    is_finite(&word).then_some(word)
}

/// The modules that draw a word: images replace their modules. `None` if a number is not finite.
pub fn images(grammar: &Grammar, seed: u32, word: &[Module]) -> Option<Vec<Module>> {
    Some(image_of_each(grammar, seed, word).concat()).filter(|word| is_finite(word))
}

/// By module of a word: the modules that draw it, with the index of that module.
pub fn image_of_each(grammar: &Grammar, seed: u32, word: &[Module]) -> Vec<Vec<Module>> {
    let tree = Tree::new(grammar, word);
    let image = |place: usize| {
        let mut modules = tree.successor(&grammar.images, seed, u32::MAX, place)?;
        modules.iter_mut().for_each(|module| module.index = place);
        Some(modules)
    };
    (0..word.len()).map(|place| image(place).unwrap_or_else(|| vec![word[place].clone()])).collect()
}

/// The word without each `%` and the rest of the branch after it.
fn uncut(word: &[Module]) -> Vec<Module> {
    let mut kept = Vec::new();
    let mut rest = word;
    while let Some((module, after)) = rest.split_first() {
        rest = after;
        if module.symbol != '%' {
            kept.push(module.clone());
            continue;
        }
        let mut level = 0;
        let closing = rest.iter().position(|module| {
            level += match module.symbol {
                '[' => 1,
                ']' => -1,
                _ => 0,
            };
            level < 0
        });
        rest = &rest[closing.unwrap_or(rest.len())..];
    }
    kept
}

fn is_finite(word: &[Module]) -> bool {
    word.iter().flat_map(|m| &m.arguments).all(|number| number.is_finite())
}

/// A word with its branches.
struct Tree<'a> {
    grammar: &'a Grammar,
    word: &'a [Module],
    /// The word itself and all branches. An unmatched `]` starts another root.
    axes: Vec<Axis>,
    /// By module: the axis before the module, and the number of parts there.
    before: Vec<(usize, usize)>,
    /// By module: the axis after the module, and the index of the next part.
    after: Vec<(usize, usize)>,
}

#[derive(Default)]
struct Axis {
    parts: Vec<Part>,
    /// The axis from which this one branches off, and its index there.
    parent: Option<(usize, usize)>,
}

#[derive(Clone, Copy)]
enum Part {
    Module(usize),
    Branch(usize),
}

/// A right context with its branches.
enum Wanted<'a> {
    Module(&'a Pattern),
    Branch(Vec<Self>),
}

impl<'a> Tree<'a> {
    fn new(grammar: &'a Grammar, word: &'a [Module]) -> Self {
        let mut axes = vec![Axis::default()];
        let (mut before, mut after) = (Vec::new(), Vec::new());
        let mut at = 0;
        for (index, module) in word.iter().enumerate() {
            let end = axes[at].parts.len();
            before.push((at, end));
            match module.symbol {
                '[' => {
                    let branch = axes.len();
                    axes[at].parts.push(Part::Branch(branch));
                    axes.push(Axis { parts: vec![], parent: Some((at, end)) });
                    at = branch;
                }
                ']' => {
                    at = axes[at].parent.map_or(axes.len(), |(parent, _)| parent);
                    if at == axes.len() {
                        axes.push(Axis::default());
                    }
                }
                _ => axes[at].parts.push(Part::Module(index)),
            }
            after.push((at, axes[at].parts.len()));
        }
        Self { grammar, word, axes, before, after }
    }

    fn is_seen(&self, module: usize) -> bool {
        self.grammar.seen.contains(self.word[module].symbol)
    }

    /// The modules on the path to the root that contexts see, nearest first.
    fn ancestors(&self, place: usize) -> Vec<usize> {
        let mut found = Vec::new();
        let mut here = Some(self.before[place]);
        while let Some((axis, end)) = here {
            for part in self.axes[axis].parts[..end].iter().rev() {
                if let Part::Module(module) = *part
                    && self.is_seen(module)
                {
                    found.push(module);
                }
            }
            here = self.axes[axis].parent;
        }
        found
    }

    fn fits(&self, module: usize, pattern: &Pattern) -> bool {
        let module = &self.word[module];
        module.symbol == pattern.symbol && module.arguments.len() == pattern.parameters.len()
    }

    /// The modules that match `wanted` from part `from` of an axis on.
    fn follow(&self, axis: usize, from: usize, wanted: &[Wanted]) -> Option<Vec<usize>> {
        let Some((first, rest)) = wanted.split_first() else { return Some(vec![]) };
        let parts = self.axes[axis].parts.get(from..).unwrap_or_default();
        let seen = |part: &Part| matches!(part, Part::Module(module) if self.is_seen(*module));
        let next = parts.iter().position(seen);
        match first {
            Wanted::Module(pattern) => {
                let Part::Module(module) = parts[next?] else { return None };
                let found = self.fits(module, pattern).then(|| self.follow(axis, from + next? + 1, rest))??;
                Some([vec![module], found].concat())
            }
            Wanted::Branch(inside) => {
                let near = &parts[..next.unwrap_or(parts.len())];
                near.iter().enumerate().find_map(|(at, part)| {
                    let Part::Branch(branch) = part else { return None };
                    let found = self.follow(*branch, 0, inside)?;
                    Some([found, self.follow(axis, from + at + 1, rest)?].concat())
                })
            }
        }
    }

    /// The modules that match left context, predecessor and right context.
    fn surroundings(&self, production: &Production, place: usize) -> Option<Vec<usize>> {
        if !self.fits(place, &production.predecessor) {
            return None;
        }
        let ancestors = if production.left.is_empty() { vec![] } else { self.ancestors(place) };
        let near = ancestors.get(..production.left.len())?;
        let mut found: Vec<usize> = near.iter().rev().copied().collect();
        if !found.iter().zip(&production.left).all(|(&module, pattern)| self.fits(module, pattern)) {
            return None;
        }
        found.push(place);
        if !production.right.is_empty() {
            let mut patterns = production.right.iter();
            let (axis, from) = self.after[place];
            found.extend(self.follow(axis, from, &wanted(&mut patterns))?);
        }
        Some(found)
    }

    fn scope(&self, production: &Production, place: usize, seed: u32, step: u32) -> Option<Scope<'a>> {
        let found = self.surroundings(production, place)?;
        let right = production.right.iter().filter(|p| !matches!(p.symbol, '[' | ']'));
        let patterns = production.left.iter().chain([&production.predecessor]).chain(right);
        let names = patterns.zip(&found).flat_map(|(pattern, &module)| {
            pattern.parameters.iter().cloned().zip(self.word[module].arguments.iter().copied())
        });
        let (grammar, key) = (self.grammar, self.word[place].key);
        let mut scope = Scope { grammar, names: names.collect(), key, seed, step, drawn: 0 };
        let holds = production.condition.as_ref().is_none_or(|condition| {
            let value = scope.value(condition);
            value != 0.0 && !value.is_nan()
        });
        holds.then_some(scope)
    }

    /// The successor of a module; `None` if no production applies.
    fn successor(&self, productions: &[Production], seed: u32, step: u32, place: usize) -> Option<Vec<Module>> {
        let key = self.word[place].key;
        let mut applying: Vec<(&Production, Scope<'_>)> =
            productions.iter().filter_map(|p| Some((p, self.scope(p, place, seed, step)?))).collect();
        // Context-sensitive productions come first, then text order.
        applying.sort_by_key(|(production, _)| !production.is_context_sensitive());
        let (first, _) = applying.first()?;
        let (weighted, sensitive) = (first.weight.is_some(), first.is_context_sensitive());
        let (production, mut scope) = if weighted {
            applying.retain(|(p, _)| p.weight.is_some() && p.is_context_sensitive() == sensitive);
            let mut weights: Vec<f64> = Vec::new();
            for (production, scope) in &mut applying {
                let weight = production.weight.as_ref().map_or(0.0, |weight| scope.value(weight));
                weights.push(if weight > 0.0 && weight.is_finite() { weight } else { 0.0 });
            }
            let mut roll = key.choice(seed, step) * weights.iter().sum::<f64>();
            let chosen = weights.iter().position(|&weight| {
                let here = roll < weight;
                roll -= weight;
                here && weight > 0.0
            });
            applying.swap_remove(chosen.or(weights.iter().rposition(|&weight| weight > 0.0))?)
        } else {
            applying.swap_remove(0)
        };
        let number = productions.iter().position(|other| core::ptr::eq(other, production));
        let made = production.successor.iter().enumerate().map(|(index, module)| {
            let arguments = module.arguments.iter().map(|expr| scope.value(expr)).collect();
            let key = key.child(step, index as u64);
            let made = Module::new(module.symbol, arguments, key, (self.word[place].index, number, index));
            let &Module { since, made: before, step, .. } = &self.word[place];
            Module { since, made: before, step, ..made }
        });
        Some(made.collect())
    }
}

fn degrees(radians: f64) -> f64 {
    radians * (180.0 / core::f64::consts::PI)
}

/// The patterns up to a `]` or the end.
fn wanted<'p>(patterns: &mut core::slice::Iter<'p, Pattern>) -> Vec<Wanted<'p>> {
    let mut all = Vec::new();
    while let Some(pattern) = patterns.next() {
        match pattern.symbol {
            '[' => all.push(Wanted::Branch(wanted(patterns))),
            ']' => break,
            _ => all.push(Wanted::Module(pattern)),
        }
    }
    all
}

/// The values of names in a production, and its random numbers.
struct Scope<'a> {
    grammar: &'a Grammar,
    names: Vec<(String, f64)>,
    key: Key,
    seed: u32,
    step: u32,
    /// The number of random numbers used so far, in text order.
    drawn: u16,
}

impl Scope<'_> {
    fn value(&mut self, expr: &Expr) -> f64 {
        let truth = |holds: bool| if holds { 1.0 } else { 0.0 };
        match expr {
            Expr::Number(value) => *value,
            Expr::Name(name) => {
                let own = self.names.iter().find(|(n, _)| n == name).map(|(_, value)| *value);
                own.or_else(|| self.grammar.constant(name)).unwrap_or(f64::NAN)
            }
            Expr::Negative(a) => -self.value(a),
            Expr::Not(a) => truth(self.value(a) == 0.0),
            Expr::Binary(operator, a, b) => {
                let (a, b) = (self.value(a), self.value(b));
                match operator {
                    Operator::Or => truth(a != 0.0 || b != 0.0),
                    Operator::And => truth(a != 0.0 && b != 0.0),
                    Operator::Equal => truth(a == b),
                    Operator::NotEqual => truth(a != b),
                    Operator::Less => truth(a < b),
                    Operator::LessOrEqual => truth(a <= b),
                    Operator::Greater => truth(a > b),
                    Operator::GreaterOrEqual => truth(a >= b),
                    Operator::Add => a + b,
                    Operator::Subtract => a - b,
                    Operator::Multiply => a * b,
                    Operator::Divide => a / b,
                    Operator::Remainder => a - b * (a / b).floor(),
                    Operator::Power => libm::pow(a, b),
                }
            }
            // The core's function; its own test compares it with cpfg's recursion.
            Expr::Curve(name, argument) => {
                let found = self.grammar.curves.iter().find(|curve| curve.name == *name);
                let argument = self.value(argument);
                found.map_or(f64::NAN, |found| found.curve.value(argument))
            }
            Expr::Call(function, arguments) => {
                let values: Vec<f64> = arguments.iter().map(|a| self.value(a)).collect();
                match (function, values.as_slice()) {
                    (Function::Random, [a, b]) => {
                        let number = self.key.number(self.seed, self.step, self.drawn);
                        self.drawn += 1;
                        a + (b - a) * number
                    }
                    (Function::NormalRandom, [mean, deviation]) => {
                        let [u, v] = [0, 1].map(|next| self.key.number(self.seed, self.step, self.drawn + next));
                        self.drawn += 2;
                        mean + deviation * ((-2.0 * libm::log(1.0 - u)).sqrt() * libm::cos(core::f64::consts::TAU * v))
                    }
                    (Function::Min, [a, b]) => a.min(*b),
                    (Function::Max, [a, b]) => a.max(*b),
                    (Function::Abs, [a]) => a.abs(),
                    (Function::Floor, [a]) => a.floor(),
                    (Function::Ceil, [a]) => a.ceil(),
                    (Function::Sqrt, [a]) => a.sqrt(),
                    (Function::Exp, [a]) => libm::exp(*a),
                    (Function::Ln, [a]) => libm::log(*a),
                    (Function::Asin, [a]) => degrees(libm::asin(*a)),
                    (Function::Acos, [a]) => degrees(libm::acos(*a)),
                    (Function::Atan, [a]) => degrees(libm::atan(*a)),
                    (Function::Atan2, [a, b]) => degrees(libm::atan2(*a, *b)),
                    // The core's function, because it is exact for round angles. Other arguments give NaN.
                    (Function::Sin, [a]) if a.is_finite() => Heading::from_degrees(*a).cos_sin().1 + 0.0 * a,
                    (Function::Cos, [a]) if a.is_finite() => Heading::from_degrees(*a).cos_sin().0 + 0.0 * a,
                    (Function::Tan, [a]) if a.is_finite() => {
                        let (c, s) = Heading::from_degrees(*a).cos_sin();
                        s / c
                    }
                    _ => f64::NAN,
                }
            }
        }
    }
}
