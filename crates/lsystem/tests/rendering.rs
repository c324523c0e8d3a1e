//! Diagnostics as text, and spans in UTF-16 units.

use expect_test::{Expect, expect};
use lsystem::syntax::{parse, utf16_span};
use lsystem::{read_json, render_diagnostic};
use proptest::prelude::*;

fn check(rules: &str, expected: &Expect) {
    let (_, diagnostics) = parse("F", rules);
    let shown: Vec<String> = diagnostics.iter().map(|d| render_diagnostic(d, "rules", rules)).collect();
    expected.assert_eq(&shown.join("\n"));
}

#[test]
fn carets_stand_below_the_place() {
    check(
        "F -> FF\nX = F+X\nX -> `ab`",
        &expect![[r#"
        error: `=` gives a constant its value, and `F+X` is not a number
         --> rules:2:3
          |
        2 | X = F+X
          |   ^
          = help: For a rule write `X -> F+X`.

        error: Backquotes hold exactly one character
         --> rules:3:6
          |
        3 | X -> `ab`
          |      ^^^^
          = help: Write each symbol in its own backquotes, or by its number, as in `U+0A`.
    "#]],
    );
}

#[test]
fn carets_count_columns_not_bytes() {
    check(
        "é木 -> F\n\tX\t-> `ab`",
        &expect![[r#"
        error: A rule replaces one symbol, not `é木`
         --> rules:1:1
          |
        1 | é木 -> F
          | ^^^
          = help: Write one rule for each symbol, as in `é -> ...`.

        error: Backquotes hold exactly one character
         --> rules:2:7
          |
        2 |     X    -> `ab`
          |             ^^^^
          = help: Write each symbol in its own backquotes, or by its number, as in `U+0A`.
    "#]],
    );
}

#[test]
fn something_missing_has_one_caret() {
    check(
        "F -> FF :",
        &expect![[r#"
        error: A number is missing here
         --> rules:1:10
          |
        1 | F -> FF :
          |          ^
    "#]],
    );
}

#[test]
fn long_lines_are_cut_around_the_place() {
    check(
        &format!("F -> {}`ab`{}", "F+".repeat(500), "F-".repeat(500)),
        &expect![[r#"
        error: Backquotes hold exactly one character
         --> rules:1:1006
          |
        1 | …F+F+F+F+F+F+F+F+F+F+F+F+F+F+F+F+F+F+F+F+`ab`F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-F-…
          |                                          ^^^^
          = help: Write each symbol in its own backquotes, or by its number, as in `U+0A`.
    "#]],
    );
}

#[test]
fn line_ends_of_all_kinds_count_once() {
    check(
        "F -> F\r\n\r\nX = FF\rY = FF\nZ = FF",
        &expect![[r#"
        error: `=` gives a constant its value, and `FF` is not a number
         --> rules:3:3
          |
        3 | X = FF
          |   ^
          = help: For a rule write `X -> FF`.

        error: `=` gives a constant its value, and `FF` is not a number
         --> rules:4:3
          |
        4 | Y = FF
          |   ^
          = help: For a rule write `Y -> FF`.

        error: `=` gives a constant its value, and `FF` is not a number
         --> rules:5:3
          |
        5 | Z = FF
          |   ^
          = help: For a rule write `Z -> FF`.
    "#]],
    );
}

#[test]
fn nothing_reaches_the_terminal_as_a_command() {
    check(
        "\u{1b}[31mF -> \u{202e}F",
        &expect![[r#"
        warning: An invisible character (U+001B) is read as white space
         --> rules:1:1
          |
        1 | ␛[31mF -> �F
          | ^

        error: A rule replaces one symbol, not `[31mF`
         --> rules:1:2
          |
        1 | ␛[31mF -> �F
          |  ^^^^^
          = help: Write one rule for each symbol, without quotes, bullets or numbers.

        warning: An invisible character (U+202E) is read as white space
         --> rules:1:11
          |
        1 | ␛[31mF -> �F
          |           ^
    "#]],
    );
}

#[test]
fn a_file_as_a_whole_has_no_place() {
    let text = format!("{{\"name\": \"{}\"}}", "x".repeat(4 << 20));
    let (_, diagnostics) = read_json(&text);
    expect![[r#"
        error: The text is longer than 4,194,304 bytes
         --> big.json
    "#]]
    .assert_eq(&render_diagnostic(&diagnostics[0], "big.json", &text));
}

#[test]
fn utf16_spans() {
    let text = "aé木🌱b";
    assert_eq!(utf16_span(text, 0..1), 0..1);
    assert_eq!(utf16_span(text, 1..3), 1..2);
    assert_eq!(utf16_span(text, 3..6), 2..3);
    assert_eq!(utf16_span(text, 6..10), 3..5);
    assert_eq!(utf16_span(text, 10..11), 5..6);
    assert_eq!(utf16_span(text, 2..99), 1..6);
    assert_eq!(utf16_span(text, 99..99), 6..6);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn utf16_spans_name_the_same_text(text in ".*", a in 0..40_usize, b in 0..40_usize) {
        let units: Vec<u16> = text.encode_utf16().collect();
        let bounds: Vec<usize> = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
        let (start, end) = (bounds[a.min(b).min(bounds.len() - 1)], bounds[a.max(b).min(bounds.len() - 1)]);
        let span = utf16_span(&text, start..end);
        prop_assert_eq!(String::from_utf16(&units[span]).unwrap(), &text[start..end]);
    }

    #[test]
    fn rendering_never_panics(rules in "(.{0,200}\n){0,3}|[F\t木é`=> \n\r-]{0,300}") {
        for diagnostic in parse("F", &rules).1 {
            prop_assert!(render_diagnostic(&diagnostic, "rules", &rules).ends_with("\n"));
        }
    }
}
