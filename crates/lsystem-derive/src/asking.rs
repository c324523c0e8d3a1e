//! Queries: modules that ask about their place. An interpreter walks the word after each derivation step, and its
//! answers replace the arguments of the query modules.

use crate::rewriting::{Fault, Rewriter};
use core::fmt;
use lsystem_base::Meter;
use std::sync::Arc;

/// Starts interpretations of the words of one system.
pub trait Interpret: Send + Sync {
    /// Starts the interpretation of the rewriter's word.
    fn start(&self, rewriter: &Rewriter) -> Box<dyn Interpretation>;

    /// Whether an interpretation needs the random keys of all modules.
    fn needs_keys(&self) -> bool;
}

/// The interpretation of one word.
pub trait Interpretation: Send + Sync {
    /// Goes on until the meter is spent. Returns whether the word is at its end. Adds the answers in the order of the
    /// word's query modules.
    ///
    /// # Errors
    /// As [`Rewriter::image`].
    fn step(&mut self, rewriter: &Rewriter, answers: &mut Vec<QueryAnswer>, meter: &mut Meter) -> Result<bool, Fault>;

    /// The work beyond the walk so far, in modules: it counts towards the limit of the derivation.
    fn work(&self) -> u64;

    /// The bytes of its memory.
    fn bytes(&self) -> u64;
}

/// The answer to one query module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QueryAnswer {
    /// The index of the module's first argument in the word.
    pub argument: usize,
    /// The number of arguments that are answered.
    pub count: u8,
    /// The answers.
    pub values: [f64; 3],
}

/// The interpreter of a system that has query modules. It follows from the system's turtle, so two interpreters of equal
/// rules count as equal.
#[derive(Clone)]
pub struct Interpreter(pub Arc<dyn Interpret>);

impl fmt::Debug for Interpreter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Interpreter")
    }
}

impl PartialEq for Interpreter {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// An interpretation under way, with its answers so far.
pub(crate) struct Asking {
    interpretation: Box<dyn Interpretation>,
    answers: Vec<QueryAnswer>,
}

impl fmt::Debug for Asking {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Asking")
    }
}

/// The interpretation of a rewriter's word, while there is one. A copy of the rewriter begins it again.
#[derive(Debug, Default)]
pub(crate) struct AskingSlot(pub(crate) Option<Box<Asking>>);

impl Clone for AskingSlot {
    fn clone(&self) -> Self {
        Self(None)
    }
}

impl Asking {
    pub(crate) fn new(interpreter: &Interpreter, rewriter: &Rewriter) -> Self {
        Self { interpretation: interpreter.0.start(rewriter), answers: vec![] }
    }

    /// Goes on with the interpretation. Returns whether it is done.
    pub(crate) fn step(&mut self, rewriter: &Rewriter, meter: &mut Meter) -> Result<bool, Fault> {
        self.interpretation.step(rewriter, &mut self.answers, meter)
    }

    /// Puts the answers into the arguments of a word. An answer that is not finite leaves an argument as it is.
    pub(crate) fn fill(&self, arguments: &mut [f64]) {
        for QueryAnswer { argument, count, values } in &self.answers {
            let places = arguments.iter_mut().skip(*argument).take(usize::from(*count));
            for (place, value) in places.zip(values).filter(|(_, value)| value.is_finite()) {
                *place = *value;
            }
        }
    }

    /// As [`Interpretation::work`].
    pub(crate) fn work(&self) -> u64 {
        self.interpretation.work()
    }

    /// The bytes of its memory.
    pub(crate) fn bytes(&self) -> u64 {
        self.interpretation.bytes() + (self.answers.capacity() * size_of::<QueryAnswer>()) as u64
    }
}
