//! A system of plain symbols while a reader translates it.

use crate::draft::Draft;
use crate::source::Source;
use lsystem_base::MAX_ITERATIONS;
use lsystem_syntax::{Definition, Grammar, Module, Production, look_alike};

/// A system of plain symbols: no contexts, no parameters.
pub(super) struct Plain<'a> {
    pub(super) draft: Draft<'a>,
    pub(super) grammar: Grammar,
}

impl<'a> Plain<'a> {
    /// An empty system that begins in this line of the text.
    pub(super) fn new(source: Source<'a>, name: &str, line: usize) -> Self {
        Self { draft: Draft::new(source, name, line), grammar: Grammar::default() }
    }

    pub(super) fn definition(&mut self) -> &mut Definition {
        &mut self.draft.definition
    }

    /// Sets the number of iterations, at most [`MAX_ITERATIONS`].
    pub(super) fn iterate(&mut self, iterations: f64) {
        // The cast takes the nearest number for values out of range.
        self.draft.definition.iterations = (iterations.max(0.0) as u32).min(MAX_ITERATIONS);
        self.draft.has_iterations = true;
    }

    /// Adds a production.
    pub(super) fn produce(&mut self, predecessor: char, successor: &str, weight: Option<f64>) {
        let production = Production::new(look_alike(predecessor).unwrap_or(predecessor), word(successor));
        self.grammar.productions.push(match weight {
            Some(weight) => production.weighted(weight),
            None => production,
        });
    }

    /// Sets the axiom.
    pub(super) fn start(&mut self, axiom: &str) {
        self.grammar.axiom = word(axiom);
    }

    /// The symbols of the axiom and of all successors, each once.
    pub(super) fn symbols(&self) -> Vec<char> {
        let mut symbols: Vec<char> = self.grammar.made().map(|module| module.symbol).collect();
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }

    /// Lets every letter draw if no symbol is said to, with a remark: other programs leave the meaning of letters to the
    /// reader.
    pub(super) fn draw_something(&mut self) {
        let symbols = self.symbols();
        if symbols.iter().any(|symbol| matches!(symbol, 'F' | 'G')) || !self.draft.meanings.is_empty() {
            return;
        }
        let mut letters = symbols.into_iter().filter(|symbol| symbol.is_alphabetic()).peekable();
        if letters.peek().is_some() {
            self.draft.note(self.draft.line, "", "No symbol is said to draw, so every letter draws");
        }
        letters.for_each(|letter| self.draft.meaning(letter, "draw"));
    }

    /// The draft with the axiom and the rules.
    pub(super) fn into_draft(mut self) -> Draft<'a> {
        if self.draft.definition.rules.is_empty() {
            self.draft.grammar(&self.grammar);
        }
        self.draft
    }
}

/// A word of plain symbols. White space is left out, and typographic look-alikes are read as what they look like.
pub(super) fn word(text: &str) -> Vec<Module> {
    let plain = text.chars().map(|ch| look_alike(ch).unwrap_or(ch));
    plain.filter(|ch| !ch.is_whitespace()).map(Module::from).collect()
}
