//! Files of the course as students have them: with comments, trailing commas, unknown keys and missing keys.

use expect_test::{Expect, expect};
use lsystem::{Definition, Dialect, Style, System, read_json, render_diagnostic};
use std::path::Path;

/// The definition read from a file, and its diagnostics.
fn check(name: &str, expected: &Expect) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/course").join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let (definition, diagnostics) = read_json(&text);
    let definition = definition.unwrap_or_else(|| panic!("{name}: {diagnostics:?}"));
    assert_eq!((definition.dialect, &definition.style), (Dialect::EveryLetter, &Style::course()), "{name}");
    assert_eq!(System::problems(&definition), [], "{name}");
    let Definition { name: title, axiom, rules, iterations, angle, .. } = definition;
    let said: String = diagnostics.iter().map(|d| render_diagnostic(d, name, &text)).collect();
    expected.assert_eq(&format!("{title:?}: {axiom}, {angle} degrees, {iterations} iterations\n{rules}\n{said}"));
}

#[test]
fn files_of_the_course() {
    check(
        "comments_and_commas.json",
        &expect![[r#"
        "plant_01": X, 20 degrees, 4 iterations
        X -> F[+X]F[-X]+X
        F -> FF
    "#]],
    );
    check(
        "rules_old.json",
        &expect![[r#"
        "square_05": F, 90 degrees, 4 iterations
        F -> F+F-F-F-G+F+F+F-F
        G -> GGG
    "#]],
    );
    check(
        "missing_keys.json",
        &expect![[r#"
        "": F-F, 0 degrees, 1 iterations
        F -> F+F
    "#]],
    );
    check(
        "mixed_rules.json",
        &expect![[r#"
        "mixed": FX, 22.5 degrees, 3 iterations
        F -> F+F : 0.5
        F -> F-F : 0.5
        X -> XF
    "#]],
    );
    check(
        "odd_weights.json",
        &expect![[r#"
        "odd weights": F, 30 degrees, 2 iterations
        F -> FF : 2
        F -> F : 1
        warning: The probabilities sum to 3, not to 1
         --> odd_weights.json:8:14
          |
        8 |         "F": [
          |              ^
          = help: They are read as weights: each is divided by the sum.
    "#]],
    );
    check(
        "plain_characters.json",
        &expect![[r#"
        "plain characters": A`(`1`)`` `B, 45 degrees, 2 iterations
        A -> A`(`2`)`
        B -> B` ``:`` `0.5
        `(` -> [
        `)` -> ]
        warning: White space is a symbol here
         --> plain_characters.json:3:16
          |
        3 |     "initial": "A(1) B",
          |                ^^^^^^^^
          = help: In this form of rules each character is a symbol; remove the space if it is not meant.
        warning: White space is a symbol here
         --> plain_characters.json:8:14
          |
        8 |         "B": "B : 0.5",
          |              ^^^^^^^^^
          = help: In this form of rules each character is a symbol; remove the space if it is not meant.
    "#]],
    );
    check(
        "everything_at_once.json",
        &expect![[r#"
            "stochastic_01": F, 12 degrees, 5 iterations
            F -> F[+F]F[-F]F : 0.33
            F -> F[+F]F : 0.33
            F -> F[-F]F : 0.34
            warning: Unknown key `author`
             --> everything_at_once.json:3:5
              |
            3 |     "author": "somebody",
              |     ^^^^^^^^
            warning: Unknown key `comment`
              --> everything_at_once.json:17:5
               |
            17 |     "comment": "unknown keys are not an error",
               |     ^^^^^^^^^
        "#]],
    );
}
