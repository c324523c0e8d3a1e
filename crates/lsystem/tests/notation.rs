//! The notation: what is printed reads back as the same, and no text panics.

use lsystem::{
    Constant, Definition, Grammar, Module, Production, System, parse, parse_overrides, print_axiom, print_overrides,
    print_rules,
};
use proptest::prelude::*;

fn cases() -> ProptestConfig {
    let cases = std::env::var("LSYSTEM_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(500);
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

/// Letters, everything that the notation gives a meaning, look-alikes, things that cannot be seen, and the rest.
fn symbol() -> impl Strategy<Value = char> {
    prop_oneof![
        4 => prop::sample::select("FGXab01+-[]".chars().collect::<Vec<_>>()),
        4 => prop::sample::select("`:->=#/*()<ε→.,;{}|\\^&$!'\"% \t\n\r_".chars().collect::<Vec<_>>()),
        1 => prop::sample::select("−–—’“ˆ（）＞⇒\u{feff}\u{200b}\u{a0}\u{2028}\u{0}\u{301}é木🌱".chars().collect::<Vec<_>>()),
        1 => any::<char>(),
    ]
}

fn word() -> impl Strategy<Value = Vec<Module>> {
    prop::collection::vec(symbol().prop_map(Module::from), 0..8)
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![(-100..100).prop_map(f64::from), any::<f64>().prop_filter("finite", |v| v.is_finite())]
}

fn grammar() -> impl Strategy<Value = Grammar> {
    let weight = prop_oneof![0.001..10.0, 1e-99..1e-90, 1e90..1e99];
    let production = (symbol(), word(), prop::option::of(weight))
        .prop_map(|(predecessor, successor, weight)| Production { predecessor: predecessor.into(), successor, weight });
    let constants = prop::collection::btree_map("[a-zA-Zα_][a-z0-9_]{0,4}", number(), 0..3)
        .prop_map(|all| all.into_iter().map(|(name, value)| Constant { name, value }).collect());
    (word(), prop::collection::vec(production, 0..5), constants).prop_map(|(axiom, productions, constants)| Grammar {
        axiom,
        productions,
        constants,
    })
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn printed_grammars_read_back(grammar in grammar()) {
        let (axiom, rules) = (print_axiom(&grammar), print_rules(&grammar));
        let (read, diagnostics) = parse(&axiom, &rules);
        prop_assert_eq!(read, grammar, "{}\n{}", axiom, rules);
        prop_assert!(!diagnostics.iter().any(lsystem::Diagnostic::is_error), "{:?}", diagnostics);
    }

    #[test]
    fn no_text_panics(
        axiom in prop::collection::vec(symbol(), 0..40),
        rules in prop::collection::vec(symbol(), 0..120),
        overrides in prop::collection::vec(symbol(), 0..40),
    ) {
        let text = |chars: Vec<char>| chars.into_iter().collect::<String>();
        let definition =
            Definition { axiom: text(axiom), rules: text(rules), overrides: text(overrides), ..Definition::default() };
        let (system, diagnostics) = System::new(&definition);
        prop_assert_eq!(system.is_none(), diagnostics.iter().any(lsystem::Diagnostic::is_error));
        for diagnostic in diagnostics {
            let text = match diagnostic.field {
                lsystem::Field::Axiom => &definition.axiom,
                lsystem::Field::Rules => &definition.rules,
                lsystem::Field::Overrides => &definition.overrides,
                _ => continue,
            };
            prop_assert!(text.get(diagnostic.span.clone()).is_some(), "{:?} in {:?}", diagnostic, text);
            prop_assert!(!diagnostic.message().is_empty());
            let _ = diagnostic.hint();
        }
    }

    #[test]
    fn overrides_read_back(text in "([A-G#:,/]: ?(draw|MOVE|turn left|turn right|width|colour|color|next colour|previous color|thicker|thinner|pop|push|nothing|turn round|width times)( -?[0-9]{1,3}(\\.5)?)?(, draw)?\n){0,5}") {
        let (overrides, _) = parse_overrides(&text);
        let (again, diagnostics) = parse_overrides(&print_overrides(&overrides));
        prop_assert_eq!(again, overrides);
        prop_assert_eq!(diagnostics, vec![]);
    }
}
