//! Rules of strings, as `lsys find` finds them.

use expect_test::{Expect, expect};
use std::process::Command;

fn told(words: &[&str], expected: &Expect) {
    let output = Command::new(env!("CARGO_BIN_EXE_lsys")).args(words).output().expect("lsys runs");
    let text = String::from_utf8([output.stdout, output.stderr].concat()).expect("UTF-8");
    expected.assert_eq(&format!("{:?}\n{text}", output.status.code()));
}

#[test]
fn rules_are_found() {
    told(
        &["find", "ABAABABA", "--axiom", "A", "-n", "4"],
        &expect![[r#"
        Some(0)
        A -> AB
        B -> A
          after 4 steps from A; 5 symbols

        Searched: n = 4: one rule with up to 60 symbols, 2 rules with up to 38 symbols.
    "#]],
    );
    told(
        &["find", "F[+F]F[+F[+F]F]F[+F]F", "--axiom", "F", "--json"],
        &expect![[r#"
        Some(0)
        {
          "candidates": [
            {
              "axiom": "F",
              "n": 2,
              "rules": [
                "F -> F[+F]F"
              ],
              "symbols": 7
            },
            {
              "axiom": "F",
              "n": 1,
              "rules": [
                "F -> F[+F]F[+F[+F]F]F[+F]F"
              ],
              "symbols": 22
            }
          ],
          "searched": "n = 1: one rule with up to 60 symbols; n = 2: one rule with up to 60 symbols; n = 3: one rule with up to 60 symbols; n = 4: one rule with up to 60 symbols; n = 5: one rule with up to 60 symbols; n = 6: one rule with up to 60 symbols; n = 7: one rule with up to 60 symbols; n = 8: one rule with up to 60 symbols"
        }
    "#]],
    );
    told(
        &["find", "+", "--axiom", "F", "-n", "1", "--constants", "F"],
        &expect![[r#"
        Some(1)
        Nothing found. Searched: n = 1: one rule with up to 60 symbols.
    "#]],
    );
    told(
        &["find", "", "--axiom", "F", "-n", "2"],
        &expect![[r#"
        Some(1)
        error: The string must have 1 to 65,536 symbols.
    "#]],
    );
}
