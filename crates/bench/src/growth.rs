//! The measured systems with contexts, parameters or queries, which are derived by whole generations.

use lsystem::derive::{Rewriter, Rules};
use lsystem::{Definition, Limits, System};
use serde::Deserialize;
use std::sync::{Arc, LazyLock};

/// A system with contexts, parameters or queries.
#[derive(Clone, Debug, Deserialize)]
pub struct Growth {
    /// The name in the tables.
    pub name: String,
    /// The kind of work, with its unit.
    pub what: String,
    /// The axiom.
    pub axiom: String,
    /// The productions and constants.
    pub rules: String,
    /// The number of derivation steps.
    pub n: u32,
    /// The number of modules in generation `n`.
    pub modules: u64,
}

/// ABOP, figure 1.31a (Hogeweg and Hesper), twice: with many steps, and with as many as a peer can derive, whose right
/// contexts leave their branches, so that its words differ and are longer. ABOP, figure 2.6a (Honda). Meadows of sixteen
/// plants of which each bud asks, at each step, for its place, its neighbours or its light, and branches every third step.
pub static GROWTHS: LazyLock<Vec<Growth>> =
    LazyLock::new(|| serde_json::from_str(include_str!("../growths.json")).expect("measured systems"));

impl Growth {
    /// The compiled rules.
    #[must_use]
    pub fn compile(&self) -> Arc<Rules> {
        let definition = Definition { axiom: self.axiom.clone(), rules: self.rules.clone(), ..Definition::default() };
        let system = System::new(&definition).expect("the measured systems are right");
        system.rules
    }

    /// Derives generation `n`. Returns the number of modules read: those of all generations before `n`.
    #[must_use]
    pub fn derive(&self, rules: &Arc<Rules>) -> u64 {
        let mut rewriter = Rewriter::new(rules.clone(), 0, Limits::default()).expect("finite numbers");
        let mut read = 0;
        while rewriter.generation() < self.n {
            read += rewriter.word().letters.len() as u64;
            rewriter.step(usize::MAX).expect("within the limits");
        }
        assert_eq!(rewriter.word().letters.len() as u64, self.modules);
        read
    }
}
