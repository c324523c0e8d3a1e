//! Rules found from strings, checked by derivation.

use lsystem_base::Limits;
use lsystem_drawing::{System, expand};
use lsystem_find::{Found, Search, Searched};
use lsystem_syntax::Definition;

fn derived(axiom: &str, rules: &str, n: u32) -> String {
    let definition = Definition { axiom: axiom.into(), rules: rules.into(), ..Definition::default() };
    expand(&System::new(&definition).expect("rules"), n, &Limits { symbols: 60_000, ..Limits::default() })
        .unwrap_or_default()
}

/// The first rules found, or none within the work.
fn first(axiom: &str, text: &str, n: u32, most: usize, work: usize) -> Option<Found> {
    let mut search = Search::new(axiom, text, n, "+-[]", most).unwrap();
    for _ in 0..work / 10_000 {
        let searched = search.step(10_000);
        if let Some(found) = search.found().first() {
            return Some(found.clone());
        }
        if searched == Searched::All {
            return None;
        }
    }
    None
}

#[test]
fn named_systems_are_found() {
    for (axiom, rules, n, most) in [
        ("F", "F -> F[+F]F", 3, 20),
        ("F+F+F+F", "F -> F-FF+F+FF-F", 2, 20),
        ("-F+F+F+F+F+F", "F -> F-F++F-F", 3, 20),
        ("T", "T -> F[+T][-T]\nF -> FF", 5, 20),
        ("F", "F -> F+F--F+F", 3, 20),
        ("A", "A -> AB\nB -> A", 8, 20),
        ("X", "X -> X+YF\nY -> FX-Y", 6, 20),
        ("X", "X -> F[+X]F[-X]+X\nF -> FF", 4, 20),
        ("X", "X -> F-[[X]+X]+F[+FX]-X\nF -> FF", 4, 30),
        ("L", "L -> +RF-LFL-FR+\nR -> -LF+RFR+FL-", 3, 30),
        ("F", "F -> F+G++G-F--FF-G+\nG -> -F+GG++G+F--F-G", 2, 30),
    ] {
        let text = derived(axiom, rules, n);
        let found = first(axiom, &text, n, most, 40_000_000).unwrap_or_else(|| panic!("{rules}"));
        assert_eq!(derived(axiom, &found.text(), n), text, "{rules}: {}", found.text());
        let own: usize =
            rules.lines().map(|line| line.chars().filter(|c| !" ->".contains(*c) || *c == '-').count() - 1).sum();
        assert!(found.symbols() <= own, "{rules}: {}", found.text());
    }
}

/// Deterministic random numbers.
struct Random(u64);

impl Random {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % most
    }

    fn word(&mut self, letters: &[char]) -> String {
        let mut word = String::new();
        let mut open = 0;
        for _ in 0..5 + self.below(8) {
            match self.below(8) {
                0 => {
                    word.push('[');
                    open += 1;
                }
                1 if open > 0 => {
                    word.push(']');
                    open -= 1;
                }
                2 => word.push('+'),
                3 => word.push('-'),
                _ => word.push(letters[self.below(letters.len())]),
            }
        }
        word.push_str(&"]".repeat(open));
        word
    }
}

#[test]
fn random_systems_are_found() {
    let mut random = Random(3);
    let (mut tried, mut found) = (0, 0);
    while tried < 100 {
        let is_double = tried % 2 == 1;
        let letters: &[char] = if is_double { &['F', 'X'] } else { &['F'] };
        let rules: Vec<String> = letters.iter().map(|letter| format!("{letter} -> {}", random.word(letters))).collect();
        let axiom = if is_double { "X" } else { "F" };
        let text = derived(axiom, &rules.join("\n"), 3);
        if text.len() < 30 || text.len() > 50_000 {
            continue;
        }
        tried += 1;
        if let Some(rules) = first(axiom, &text, 3, 40, 3_000_000) {
            assert_eq!(derived(axiom, &rules.text(), 3), text, "{}", rules.text());
            found += 1;
        }
    }
    assert!(found >= 94, "{found} of {tried}");
}

/// Several systems with the same string are found, each once.
#[test]
fn all_shortest_systems_are_found() {
    let mut search = Search::new("A", "BB", 1, "", 4).unwrap();
    while search.step(10_000) == Searched::More {}
    let texts: Vec<String> = search.found().iter().map(Found::text).collect();
    assert_eq!(texts, ["A -> BB"]);
    let mut search = Search::new("AB", "CC", 1, "C", 4).unwrap();
    while search.step(10_000) == Searched::More {}
    let mut texts: Vec<String> = search.found().iter().map(|found| found.text().replace('\n', "; ")).collect();
    texts.sort();
    assert_eq!(texts, ["A -> ; B -> CC", "A -> C; B -> C", "A -> CC; B -> "]);
}

#[test]
fn what_no_rules_derive_is_not_found() {
    let mut search = Search::new("F", "F+F+F-F-FF", 2, "+-[]", 8).unwrap();
    while search.step(10_000) == Searched::More {}
    assert!(search.found().is_empty());
    assert_eq!(search.searched(), [8]);
    for (axiom, text, n) in [("F", "", 1), ("F", "F", 0), ("F", "F", 99)] {
        assert!(Search::new(axiom, text, n, "+-[]", 8).is_err());
    }
}

/// Rules would read these symbols in another way than they stand in the string.
#[test]
fn strings_of_other_than_plain_symbols_are_refused() {
    for text in ["F%A[B(3)P(-1)]X", "F(1)", "F)", "`F`F", "F:F", "A,(B", "*FA"] {
        assert!(Search::new("F", text, 1, "+-[]", 8).is_err(), "{text}");
    }
    assert!(Search::new("F(1/0)", "ABAABABA", 1, "+-[]", 8).is_err());
    for text in ["F|F", "F!F&F^F", "A{.}B", "F~F", "λ🌿3", "F[+F]'F"] {
        assert!(Search::new("F", text, 1, "+-[]|!&^{}.~'", 8).is_ok(), "{text}");
    }
}
