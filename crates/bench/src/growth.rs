//! The measured systems with contexts, parameters or queries, which are derived by whole generations.

use lsystem::derive::{Rewriter, Rules};
use lsystem::{Definition, Limits, System};
use std::sync::Arc;

/// A system with contexts, parameters or queries.
#[derive(Clone, Copy, Debug)]
pub struct Growth {
    /// The name in the tables.
    pub name: &'static str,
    /// The kind of work, with its unit.
    pub what: &'static str,
    /// The axiom.
    pub axiom: &'static str,
    /// The productions and constants.
    pub rules: &'static str,
    /// The number of derivation steps.
    pub n: u32,
    /// The number of modules in generation `n`.
    pub modules: u64,
}

const CONTEXTS: &str = "contexts, symbol steps/s";
const PARAMETERS: &str = "parameters, module steps/s";
const QUERIES: &str = "queries, module steps/s";

/// ABOP, figure 1.31a (Hogeweg and Hesper).
const SIGNALS: &str = "ignore: +-F\n\
    0 < 0 > 0 -> 0\n0 < 0 > 1 -> 1[+F1F1]\n0 < 1 > 0 -> 1\n0 < 1 > 1 -> 1\n\
    1 < 0 > 0 -> 0\n1 < 0 > 1 -> 1F1\n1 < 1 > 0 -> 0\n1 < 1 > 1 -> 0\n+ -> -\n- -> +";

/// ABOP, figure 2.6a (Honda).
const TREE: &str = "r1 = 0.9\nr2 = 0.6\nwr = 0.707\n\
    A(l,w) -> !(w)F(l)[&(45)B(l*r2,w*wr)]/(137.5)A(l*r1,w*wr)\n\
    B(l,w) -> !(w)F(l)[-(45)$C(l*r2,w*wr)]C(l*r1,w*wr)\n\
    C(l,w) -> !(w)F(l)[+(45)$B(l*r2,w*wr)]B(l*r1,w*wr)";

/// Plants of which each bud asks, at each step, for its place, its neighbours or its light. A bud branches every third
/// step.
macro_rules! asking {
    ($query:literal, $pattern:literal, $condition:literal) => {
        concat!(
            $pattern,
            " < A(k) : ",
            $condition,
            " and k > 0 -> A(k-1)\n",
            $pattern,
            " < A(k) : ",
            $condition,
            " -> F(1)[&(40)/(137.5)",
            $query,
            "A(2)]/(90)[^(30)",
            $query,
            "A(2)]"
        )
    };
}

/// The axiom of plants with queries: sixteen plants beside each other.
macro_rules! meadow {
    ($query:literal) => {
        concat!(meadow!(4, $query), "[+(90)f(90)-(90)", meadow!(4, $query), "]")
    };
    (4, $query:literal) => {
        concat!(meadow!(1, $query), meadow!(1, $query), meadow!(1, $query), meadow!(1, $query))
    };
    (1, $query:literal) => {
        concat!("[", $query, "A(2)]&(90)f(30)^(90)[", $query, "A(2)]+(90)f(9)-(90)")
    };
}

/// Figure 1.31a twice: with many steps, and with as many as a peer can derive. That peer's right contexts leave their
/// branches, so its words differ and are longer.
pub const GROWTHS: [Growth; 6] = [
    Growth { name: "1.31a", what: CONTEXTS, axiom: "F1F1F1", rules: SIGNALS, n: 60, modules: 9_239_061 },
    Growth { name: "1.31a", what: CONTEXTS, axiom: "F1F1F1", rules: SIGNALS, n: 30, modules: 6_910 },
    Growth { name: "2.6a", what: PARAMETERS, axiom: "A(1,10)", rules: TREE, n: 17, modules: 917_498 },
    Growth {
        name: "place",
        what: QUERIES,
        axiom: meadow!("?P(0,0,0)"),
        rules: asking!("?P(0,0,0)", "?P(x,y,z)", "y > -99"),
        n: 30,
        modules: 196_533,
    },
    Growth {
        name: "neighbours",
        what: QUERIES,
        axiom: meadow!("?C(0,1)"),
        rules: asking!("?C(0,1)", "?C(n,r)", "n > -1"),
        n: 30,
        modules: 196_533,
    },
    Growth {
        name: "light",
        what: QUERIES,
        axiom: meadow!("?S(1,0.7)"),
        rules: asking!("?S(1,0.7)", "?S(q,c)", "q > -1"),
        n: 30,
        modules: 196_533,
    },
];

impl Growth {
    /// The compiled rules.
    #[must_use]
    pub fn compile(&self) -> Arc<Rules> {
        let definition = Definition { axiom: self.axiom.into(), rules: self.rules.into(), ..Definition::default() };
        let system = System::new(&definition).0.expect("the measured systems are right");
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
