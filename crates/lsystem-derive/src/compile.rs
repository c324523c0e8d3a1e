//! Compiling a grammar: letters become small integers, names become slots.

use crate::rules::{ContextPattern, Letter, LetterId, Rewrite, Rule, Rules, Template};
use core::ops::Range;
use lsystem_base::sorted::{set, sort};
use lsystem_syntax::Expr;
use lsystem_syntax::grammar::Values;
use lsystem_syntax::{Code, Meaning, Unusable};
use lsystem_syntax::{Grammar, Module, Pattern, Production};

impl Rules {
    /// Compiles `grammar`. `spans` are the spans of its productions in the text, followed by the spans of its
    /// productions for drawing. `cuts` marks the symbols that cut off the rest of their branch. If the grammar is
    /// plain, productions for drawing are left out, because the drawing gives their actions to the letters; `apart`
    /// compiles them nevertheless.
    ///
    /// # Errors
    /// If an expression has an unknown name or is nested too deeply.
    pub fn new(
        grammar: &Grammar,
        spans: Vec<Range<usize>>,
        cuts: impl Fn(char) -> bool,
        apart: bool,
    ) -> Result<Self, Unusable> {
        Self::compiled(grammar, spans, &cuts, apart)
    }

    fn compiled(
        grammar: &Grammar,
        spans: Vec<Range<usize>>,
        cuts: &dyn Fn(char) -> bool,
        apart: bool,
    ) -> Result<Self, Unusable> {
        let plain = !apart && grammar.is_plain() && !grammar.made().any(|module| cuts(module.symbol));
        let drawn = if plain { &[][..] } else { &grammar.images };
        let productions = || grammar.productions.iter().chain(drawn);
        let matched = productions().flat_map(Production::patterns).map(letter_of_pattern);
        let made = grammar.axiom.iter().chain(productions().flat_map(|p| &p.successor)).map(letter_of_module);
        let letters: Vec<Letter> = set(matched.chain(made));
        let seen = grammar.seen.ready();
        let considered = letters.iter().map(|letter| seen.contains(letter.symbol)).collect();
        let cuts = letters.iter().map(|letter| cuts(letter.symbol)).collect();
        let (mut by_letter, mut images) = (vec![Vec::new(); letters.len()], vec![Vec::new(); letters.len()]);
        let compiler = Compiler { constants: grammar.values(), letters: &letters };
        for (index, production) in productions().enumerate() {
            let letter = compiler.id(letter_of_pattern(&production.predecessor));
            let list = if index < grammar.productions.len() { &mut by_letter } else { &mut images };
            list[usize::from(letter)].push(compiler.rule(production, index)?);
        }
        for rules in &mut by_letter {
            let (first, rest): (Vec<_>, Vec<_>) = rules.drain(..).partition(Rule::is_context_sensitive);
            rules.extend(first.into_iter().chain(rest));
        }
        let axiom = compiler.word(&grammar.axiom, &[], &mut 0)?;
        let rewrite = |(letter, rules): (usize, &Vec<Rule>)| match plain {
            true => Rewrite::plain(rules),
            false => Rewrite::outline(letter as LetterId, rules),
        };
        let rewrites = by_letter.iter().enumerate().map(rewrite).collect();
        Ok(Self { letters, considered, cuts, by_letter, images, rewrites, axiom, spans, plain, interpreter: None })
    }
}

fn letter_of_pattern(pattern: &Pattern) -> Letter {
    Letter { symbol: pattern.symbol, arity: pattern.parameters.len() as u8 }
}

fn letter_of_module(module: &Module) -> Letter {
    Letter { symbol: module.symbol, arity: module.arguments.len() as u8 }
}

struct Compiler<'a> {
    constants: Values<'a>,
    /// All letters, sorted. A letter's ID is its index.
    letters: &'a [Letter],
}

impl Compiler<'_> {
    fn id(&self, letter: Letter) -> LetterId {
        self.letters.binary_search(&letter).unwrap_or(0) as LetterId
    }

    fn rule(&self, production: &Production, index: usize) -> Result<Rule, Unusable> {
        let parameters = production.patterns().flat_map(|p| &p.parameters);
        let mut names: Vec<(&str, usize)> = parameters.enumerate().map(|(slot, name)| (name.as_str(), slot)).collect();
        sort(&mut names);
        let mut randoms = 0;
        let mut code = |expr: &Expr| self.code(expr, &names, &mut randoms);
        let condition = production.condition.as_ref().map(&mut code).transpose()?;
        let weight = production.weight.as_ref().map(&mut code).transpose()?;
        Ok(Rule {
            production: index,
            left: production.left.iter().map(|pattern| self.id(letter_of_pattern(pattern))).collect(),
            right: (production.right.iter())
                .map(|pattern| match pattern.symbol {
                    '[' => ContextPattern::Open,
                    ']' => ContextPattern::Close,
                    _ => ContextPattern::Letter(self.id(letter_of_pattern(pattern))),
                })
                .collect(),
            condition,
            weight,
            successor: self.word(&production.successor, &names, &mut randoms)?,
        })
    }

    fn word(&self, modules: &[Module], names: &[(&str, usize)], randoms: &mut u16) -> Result<Template, Unusable> {
        let arguments = modules.iter().flat_map(|module| &module.arguments);
        Ok(Template {
            letters: modules.iter().map(|module| self.id(letter_of_module(module))).collect(),
            arguments: arguments.map(|expr| self.code(expr, names, randoms)).collect::<Result<_, _>>()?,
        })
    }

    fn code(&self, expr: &Expr, names: &[(&str, usize)], randoms: &mut u16) -> Result<Code, Unusable> {
        let meaning = |name: &str| {
            let at = names.partition_point(|&(own, _)| own < name);
            match names.get(at).filter(|(own, _)| *own == name) {
                Some(&(_, slot)) => Some(Meaning::Slot(slot as u16)),
                None => self.constants.meaning(name),
            }
        };
        Code::new(expr, &meaning, randoms)
    }
}
