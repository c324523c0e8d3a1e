//! The module at a place in the texts.

use super::read;
use crate::Field;
use core::ops::Range;

/// The place of a module in the axiom or in a successor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Site {
    /// The number of the production (0-based) and its strict predecessor; `None` for a module of the axiom.
    pub production: Option<(usize, char)>,
    /// The number of the module in the axiom or in the successor (0-based).
    pub position: usize,
}

/// The module whose text contains the byte `at` of `field`. `None` in other parts of the text, below `draw:`, and in
/// fields other than the axiom and the rules.
///
/// ```
/// use lsystem_syntax::{Field, Site, site};
/// let found = site("X", "F -> FF\nX -> F[+X]", Field::Rules, 15);
/// assert_eq!(found, Some(Site { production: Some((1, 'X')), position: 2 }));
/// ```
#[must_use]
pub fn site(axiom: &str, rules: &str, field: Field, at: usize) -> Option<Site> {
    let position = |spans: &[Range<usize>]| spans.iter().position(|span| span.contains(&at));
    let reading = read(axiom, rules);
    match field {
        Field::Axiom => Some(Site { production: None, position: position(&reading.axiom)? }),
        Field::Rules => {
            let mut productions = reading.productions.iter().zip(&reading.grammar.productions).enumerate();
            productions.find_map(|(number, (places, production))| {
                let position = position(&places.successor)?;
                Some(Site { production: Some((number, production.predecessor.symbol)), position })
            })
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_module_has_its_place() {
        let (axiom, rules) = ("A(1)+", "# F\nA(x) : x > 1 -> F(x)[+`-`] : 0.5\ndraw:\nF -> G");
        let found = |field, text: &str, what: &str| site(axiom, rules, field, text.find(what).unwrap());
        let axiom_site = |position| Some(Site { production: None, position });
        assert_eq!(found(Field::Axiom, axiom, "A"), axiom_site(0));
        assert_eq!(found(Field::Axiom, axiom, "1"), axiom_site(0));
        assert_eq!(found(Field::Axiom, axiom, "+"), axiom_site(1));
        let rule_site = |position| Some(Site { production: Some((0, 'A')), position });
        assert_eq!(found(Field::Rules, rules, "F(x)"), rule_site(0));
        assert_eq!(found(Field::Rules, rules, "`-`"), rule_site(3));
        for nothing in ["F\nA", "A(x)", "x > 1", "->", "0.5", "draw", "G"] {
            assert_eq!(found(Field::Rules, rules, nothing), None, "{nothing}");
        }
        assert_eq!(site("", "F -> FF", Field::Rules, 99), None);
    }
}
