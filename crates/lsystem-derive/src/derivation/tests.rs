use super::*;
use crate::testing::{TestRule, TestSystem, count_symbols, expand, system};
use proptest::prelude::*;

fn rules<'a>(text: &[(char, &'a str)]) -> Vec<TestRule<'a>> {
    text.iter().map(|&(p, s)| (p, s, None)).collect()
}

/// The definition, literally: one generation after another, every letter with its key.
fn naive(system: &TestSystem, n: u32) -> String {
    let rules = &system.rules;
    let mut word: Vec<(LetterId, Key)> =
        rules.axiom.letters.iter().enumerate().map(|(i, &s)| (s, Key::root(i as u64))).collect();
    for step in 1..=n {
        let mut next = vec![];
        for (symbol, key) in word {
            match rules.rewrites[usize::from(symbol)].successor(|| key.choice(system.seed, step)) {
                None => next.push((symbol, key)),
                Some(successor) => {
                    next.extend(successor.iter().enumerate().map(|(i, &s)| (s, key.child(step, i as u64))));
                }
            }
        }
        word = next;
    }
    word.iter().map(|&(symbol, _)| rules.letters[usize::from(symbol)].symbol).collect()
}

#[test]
fn published_strings() {
    let check = |axiom: &str, text: &[(char, &str)], n, expected: &str| {
        let system = system(axiom, &rules(text), 0);
        assert_eq!(expand(&system, n, &Limits::default()).unwrap(), expected);
    };
    check("X", &[('F', "FF"), ('X', "F[+X][-X]FX")], 1, "F[+X][-X]FX");
    check("X", &[('F', "FF"), ('X', "F[+X][-X]FX")], 2, "FF[+F[+X][-X]FX][-F[+X][-X]FX]FFF[+X][-X]FX");
    check("FA", &[('A', "[>FA][^FA]")], 2, "F[>F[>FA][^FA]][^F[>FA][^FA]]");
    check("g", &[('g', "g[+g][-g]")], 2, "g[+g][-g][+g[+g][-g]][-g[+g][-g]]");
    check("A", &[('A', "ALRI")], 3, "ALRILRILRI");
    check("A", &[('A', "é→"), ('é', "")], 2, "→");
}

#[test]
fn counts_need_no_string() {
    let algae = system("A", &rules(&[('A', "AB"), ('B', "A")]), 0);
    let fibonacci = count_symbols(&algae, 1000).unwrap().to_string();
    assert!(fibonacci.starts_with("113796925398360272257523782552224175572745930353730513145"));
    assert_eq!(fibonacci.len(), 210);
    let even = [('F', "F+F", Some(0.5)), ('F', "F-F", Some(0.5))];
    assert_eq!(count_symbols(&system("F", &even, 0), 5).unwrap(), 63_u64.into());
    let uneven = [('F', "F+F", Some(0.5)), ('F', "F", Some(0.5))];
    assert_eq!(count_symbols(&system("F", &uneven, 0), 5), None);
}

#[test]
fn limits_name_the_largest_generation() {
    let limits = Limits { symbols: 1000, ..Limits::default() };
    let doubling = system("F", &rules(&[('F', "FF")]), 0);
    let error = expand(&doubling, 1000, &limits).unwrap_err();
    assert_eq!(error.kind, Kind::Limit { limit: LimitName::Symbols, value: 1000, largest: Some(9) });
    assert_eq!(expand(&doubling, 9, &limits).unwrap().len(), 512);

    let uneven = [('F', "FFF", Some(0.5)), ('F', "FF", Some(0.5))];
    let random = system("F", &uneven, 3);
    let Kind::Limit { largest: Some(n), .. } = expand(&random, 60, &limits).unwrap_err().kind else {
        panic!("the largest generation is known")
    };
    assert!(expand(&random, n, &limits).is_ok() && expand(&random, n + 1, &limits).is_err());
}

#[test]
fn work_is_bounded_where_nothing_is_left() {
    // Each letter makes two or three of the next letter, and the last letter deletes itself.
    let letters: Vec<char> = ('A'..='Z').chain('a'..='z').collect();
    let repeated: Vec<[String; 2]> = letters.iter().map(|c| [2, 3].map(|times| c.to_string().repeat(times))).collect();
    let mut text: Vec<TestRule> = vec![('z', "", None)];
    for (letter, next) in letters.iter().zip(&repeated[1..]) {
        text.extend(next.iter().map(|successor| (*letter, successor.as_str(), Some(1.0))));
    }
    let limits = Limits { work: 10_000, ..Limits::default() };
    let error = expand(&system("A", &text, 0), 60, &limits).unwrap_err();
    assert!(matches!(error.kind, Kind::Limit { limit: LimitName::Work, largest: Some(1..), .. }));
}

proptest! {
    #![proptest_config(test_effort::config())]
    #[test]
    fn copies_equal_the_definition(
        axiom in "[ABCF+]{1,6}",
        successors in prop::collection::vec(("[ABC]", "[ABCFé+]{0,5}", prop::option::of(0.1..2.0)), 1..6),
        n in 0_u32..7,
        seed: u32,
    ) {
        let rules: Vec<TestRule> =
            successors.iter().map(|(p, s, w)| (p.chars().next().unwrap(), s.as_str(), *w)).collect();
        let system = system(&axiom, &rules, seed);
        let expected = naive(&system, n);
        prop_assert_eq!(&expand(&system, n, &Limits::default()).unwrap(), &expected);
        if let Some(count) = count_symbols(&system, n) {
            prop_assert_eq!(count, (expected.chars().count() as u64).into());
        }
        if n == 1 {
            prop_assert_eq!(derive_once(&system.grammar, &system.rules, seed, &axiom, 1), expected);
        }
    }
}
