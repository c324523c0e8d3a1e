//! Classes of a definition's texts, for syntax colours.

use crate::notation::constants::{ConstantPlace, Constants};
use crate::notation::read_with;
use crate::notes::DiagnosticList;
use crate::overrides;
use crate::{Class, Definition, Field};

/// The classes of a definition's texts, with or without errors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Classes {
    /// The class of each byte of the axiom.
    pub axiom: Vec<Class>,
    /// The class of each byte of the rules.
    pub rules: Vec<Class>,
    /// The class of each byte of the overrides.
    pub overrides: Vec<Class>,
    /// The constants in text order, each name once.
    pub constants: Vec<ConstantPlace>,
}

/// Classifies each byte of a definition's texts.
///
/// ```
/// let definition = lsystem_syntax::Definition { rules: "r = 0.9".into(), ..Default::default() };
/// let classes = lsystem_syntax::classify(&definition);
/// let letters: String = classes.rules.iter().map(|class| class.letter()).collect();
/// assert_eq!(letters, "k_m_nnn");
/// assert_eq!(classes.constants[0].span, 4..7);
/// ```
#[must_use]
pub fn classify(definition: &Definition) -> Classes {
    let Definition { axiom, rules, overrides, .. } = definition;
    let mut constants = Constants::default();
    let mut notes = [DiagnosticList::classing(Field::Axiom, axiom), DiagnosticList::classing(Field::Rules, rules)];
    read_with(axiom, rules, &mut constants, &mut notes);
    let [axiom, rules] = notes.map(DiagnosticList::into_classes);
    let mut notes = DiagnosticList::classing(Field::Overrides, overrides);
    overrides::read(overrides, &mut notes);
    Classes { axiom, rules, overrides: notes.into_classes(), constants: constants.into_places() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs of lines: a line of rules, and the letters of its classes.
    #[track_caller]
    fn check(axiom: [&str; 2], rules: &[[&str; 2]]) {
        let text: Vec<&str> = rules.iter().map(|[line, _]| *line).collect();
        let classes =
            classify(&Definition { axiom: axiom[0].to_owned(), rules: text.join("\n"), ..Definition::default() });
        assert_eq!(crate::utf16_letters(axiom[0], &classes.axiom), axiom[1]);
        let letters = crate::utf16_letters(&text.join("\n"), &classes.rules);
        let mut from = 0;
        for [line, expected] in rules {
            let to = from + line.encode_utf16().count();
            assert_eq!(letters[from..to], **expected, "{line}");
            from = to + 1;
        }
    }

    #[test]
    fn classes_of_the_notation() {
        check(
            ["A(r, 2)[-F]", "__k__n_bt_b"],
            &[
                ["# ABOP", "cccccc"],
                ["  // two", "cccccccc"],
                ["r = 0.9", "k_m_nnn"],
                ["#define q 2*r", "hhhhhhh_k_n_k"],
                ["ignore: +-F", "hhhhhhh____"],
                [
                    "A < B(x) > C[D] : x >= r -> +F(x^2, sin(q)) : 0.5",
                    "x_m_ppap_m_xxxx_m_aiiiik_mm_t__a_n__fff_k___m_www",
                ],
                ["F(l) -> F(l)F(1)", "ppap_mm___a___n_"],
                ["draw: A -> {[F]}`[`", "hhhhh_p_mm_bb_bb___"],
                ["ψ -> 𝛼+", "p_mm___t"],
            ],
        );
    }

    #[test]
    fn what_is_wrong_is_plain_and_the_rest_has_its_class() {
        check(["(", "_"], &[["F = FF", "______"], ["G -> F(", "p_mm___"], ["H -> F : x", "p_mm___m_w"], ["->", "mm"]]);
    }

    #[test]
    fn overrides_have_their_symbols() {
        let classes = classify(&Definition { overrides: "# so\nG: move".to_owned(), ..Definition::default() });
        let letters: String = classes.overrides.iter().map(|class| class.letter()).collect();
        assert_eq!(letters, "cccc_pm_____");
    }

    #[test]
    fn constants_have_places() {
        let rules = "a = −2.5\nb = 2*a\nc = (3)\nd = \na = 1\n#define e 1e-3\nf=.5";
        let places = classify(&Definition { rules: rules.to_owned(), ..Definition::default() }).constants;
        let found: Vec<_> =
            places.iter().map(|c| (c.name.as_str(), c.value, &rules[c.span.clone()], c.is_number)).collect();
        let expected = [
            ("a", Some(-2.5), "−2.5", true),
            ("b", Some(-5.0), "2*a", false),
            ("c", Some(3.0), "(3)", false),
            ("d", None, "", false),
            ("e", Some(1e-3), "1e-3", true),
            ("f", Some(0.5), ".5", true),
        ];
        assert_eq!(found, expected);
    }
}
