//! Changes after which something is drawn.

use super::{Bench, definition};
use crate::report::Mend;

#[test]
fn one_change_makes_an_empty_picture_draw() {
    for (axiom, rules, n, mend) in [
        ("A", "A -> AB\nB -> A", 4, Some(Mend::Dialect("every-letter"))),
        ("X", "X -> Y\nY -> Z\nZ -> F", 1, Some(Mend::Iterations(3))),
        ("F", "F -> f", 2, Some(Mend::Iterations(0))),
        ("", "F -> FF", 2, None),
        ("X", "X -> F[+X]X", 3, None),
    ] {
        let mut bench = Bench::new();
        let report = bench.session.define(definition(axiom, rules, 25.0, n)).into_owned();
        assert_eq!(report.mend, mend, "{axiom} {rules}");
        // The change does what it promises.
        let mut mended = definition(axiom, rules, 25.0, n);
        match mend {
            Some(Mend::Iterations(n)) => mended.iterations = n,
            Some(Mend::Dialect(_)) => mended.dialect = lsystem::Dialect::EveryLetter,
            None => continue,
        }
        assert!(report.empty.is_some() && bench.session.define(mended).empty.is_none(), "{axiom} {rules}");
    }
}
