//! Output of programs, right and wrong in the usual ways. The programs are written out here: a naive derivation and a
//! naive turtle.

use expect_test::{Expect, expect};
use lsystem_course::{Check, Output, Verdict, check};
use lsystem_syntax::{Definition, Dialect};
use std::fmt::Write;

fn plant(n: u32) -> Definition {
    Definition {
        axiom: "X".into(),
        rules: "X -> F[+X]F[-X]+X\nF -> FF".into(),
        angle: 20.0,
        iterations: n,
        ..Definition::default()
    }
}

/// Replaces every symbol in each step.
fn derive(axiom: &str, rules: &[(char, &str)], n: u32) -> String {
    (0..n).fold(axiom.to_owned(), |word, _| {
        let successor =
            |c: char| rules.iter().find(|rule| rule.0 == c).map_or_else(|| c.to_string(), |rule| rule.1.into());
        word.chars().map(successor).collect()
    })
}

fn plant_string(n: u32) -> String {
    derive("X", &[('X', "F[+X]F[-X]+X"), ('F', "FF")], n)
}

/// The segments that a turtle draws: `F` and `G` draw, `+` turns left, from a heading in degrees.
fn walk(word: &str, angle: f64, heading: f64) -> Vec<[f64; 4]> {
    let (mut at, mut stack, mut found) = ((0.0, 0.0, heading), vec![], vec![]);
    for c in word.chars() {
        let (x, y, degrees) = at;
        match c {
            'F' | 'G' => {
                let to = (x + libm::cos(degrees.to_radians()), y + libm::sin(degrees.to_radians()));
                found.push([x, y, to.0, to.1]);
                at = (to.0, to.1, degrees);
            }
            '+' => at.2 += angle,
            '-' => at.2 -= angle,
            '[' => stack.push(at),
            ']' => at = stack.pop().unwrap(),
            _ => {}
        }
    }
    found
}

/// An SVG of lines in pixels, with `decimals`, y down.
fn svg(segments: &[[f64; 4]], scale: f64, decimals: usize) -> String {
    let mut text = String::from("<?xml version='1.0'?>\n<svg xmlns='http://www.w3.org/2000/svg'>\n");
    for segment in segments {
        let [a, b, c, d] = segment.map(|value| value * scale);
        let _ = writeln!(
            text,
            "<line x1='{:.d$}' y1='{:.d$}' x2='{:.d$}' y2='{:.d$}' stroke='green'/>",
            a + 500.0,
            900.0 - b,
            c + 500.0,
            900.0 - d,
            d = decimals
        );
    }
    text + "</svg>\n"
}

fn csv(segments: &[[f64; 4]]) -> String {
    segments.iter().map(|[a, b, c, d]| format!("{a},{b},{c},{d}\n")).collect()
}

fn told(definition: &Definition, output: &str, expected: &Expect) {
    expected.assert_eq(&check(definition, output).words());
}

#[test]
fn strings() {
    let right = plant_string(4);
    told(&plant(4), &right, &expect!["The string is that of generation 4: 491 symbols."]);
    let wrapped: String =
        right.chars().enumerate().map(|(at, c)| if at % 70 == 69 { format!("{c}\r\n") } else { c.into() }).collect();
    assert_eq!(check(&plant(4), &wrapped).verdict, Verdict::Same);
    told(
        &plant(4),
        &plant_string(3),
        &expect!["The output is generation 3, not generation 4. The output has 156 symbols; generation 4 has 491."],
    );
    let mut wrong = right.clone();
    wrong.replace_range(300..301, if &right[300..301] == "F" { "+" } else { "F" });
    told(
        &plant(4),
        &wrong,
        &expect![[r#"
            Symbol 301 is the first that differs from generation 4.
              expected: …]F[-X]+X]+FF[+F[+X]F[-X]+X]FF[-F[+X]F[-X]+X]+F[+
              found:    …]F[-X]+X]+FF[+F[+X]F[-X]FX]FF[-F[+X]F[-X]+X]+F[+
                                                 ^
            Step 4 makes the expected symbol by X -> F[+X]F[-X]+X
            Both have 491 symbols."#]],
    );
    told(
        &plant(4),
        &right[..480],
        &expect![[r#"
        Symbol 481 is the first that differs from generation 4.
          expected: …X]+X]FF[-F[+X]F[-X]+X]+F[+X]F[-X]+X
          found:    …X]+X]FF[-F[+X]F[-X]+X]+F(end)
                                             ^
        Step 4 makes the expected symbol by X -> F[+X]F[-X]+X
        The output has 480 symbols; generation 4 has 491."#]],
    );
    told(
        &plant(4),
        &(right + "F"),
        &expect![[r#"
        Symbol 492 is the first that differs from generation 4.
          expected: …+X]F[-X]+X]+F[+X]F[-X]+X(end)
          found:    …+X]F[-X]+X]+F[+X]F[-X]+XF
                                             ^
        The output has 492 symbols; generation 4 has 491."#]],
    );
    told(
        &plant(4),
        "",
        &expect![[r#"
        Symbol 1 is the first that differs from generation 4.
          expected: FFFFFFFF[+FFFF[+FF[+F[+X
          found:    (end)
                    ^
        Step 4 makes the expected symbol by F -> FF
        The output has 0 symbols; generation 4 has 491."#]],
    );
    told(
        &Definition { rules: "F - F".into(), ..plant(1) },
        "F",
        &expect!["The system cannot be compared. This line is neither a rule nor a constant"],
    );
}

/// Long strings are compared in pages; the first difference is found wherever it is.
#[test]
fn long_strings() {
    let right = plant_string(10);
    assert!(right.len() > 3 << 16);
    assert!(check(&plant(10), &right).is_right());
    for at in [0, 65_535, 65_536, 65_537, 131_072, right.len() - 1] {
        let mut wrong = right.clone();
        let other = if wrong.as_bytes()[at] == b'F' { "-" } else { "F" };
        wrong.replace_range(at..=at, other);
        let Verdict::Symbol(found) = check(&plant(10), &wrong).verdict else { panic!("{at}") };
        assert_eq!(found.index, at as u64);
        assert!(wrong[at..].starts_with(&found.found) && right[at..].starts_with(&found.expected));
        assert!(wrong[..at].ends_with(&found.before));
        // Cut off at the same place.
        let Verdict::Symbol(cut) = check(&plant(10), &right[..at]).verdict else { panic!("{at}") };
        assert_eq!((cut.index, cut.found.as_str()), (at as u64, ""));
    }
}

#[test]
fn rules_one_after_another() {
    let definition = Definition { axiom: "A".into(), rules: "A -> AB\nB -> A".into(), iterations: 5, ..plant(5) };
    let mut word = "A".to_owned();
    for _ in 0..5 {
        word = word.replace('A', "AB").replace('B', "A");
    }
    assert_eq!(check(&definition, &word).verdict, Verdict::OneAfterAnother);
    assert_eq!(check(&definition, &derive("A", &[('A', "AB"), ('B', "A")], 5)).verdict, Verdict::Same);
}

#[test]
fn modules_have_numbers_as_programs_print_them() {
    let definition =
        Definition { axiom: "A(1)".into(), rules: "A(l) -> F(l)[+A(l/3)]".into(), iterations: 2, ..plant(2) };
    for (output, is_right) in [
        ("F(1)[+F(0.3333333333333333)[+A(0.1111111111111111)]]", true),
        ("F(1.0) [+ F(0.333333) [+ A(1.11111e-1)]]\n", true),
        ("F(1)[+F(0.334)[+A(0.111111)]]", false),
        ("F[+F[+A]]", false),
        ("F(1,1)[+F(0.333333)[+A(0.111111)]]", false),
    ] {
        assert_eq!(check(&definition, output).is_right(), is_right, "{output}");
    }
    let random = Definition { rules: "X -> F[+X] : 1\nX -> F[-X] : 1".into(), seed: 7, ..plant(6) };
    let system = lsystem_drawing::System::new(&random).unwrap();
    let string = lsystem_drawing::expand(&system, 6, &lsystem_base::Limits::default()).unwrap();
    assert!(check(&random, &string).is_right());
    let other = string.replacen('+', "-", 1).replacen("[-X]", "[+X]", 1);
    assert_eq!(check(&random, &other).is_right(), other == string);
}

#[test]
fn pictures() {
    for n in 1..=5 {
        let segments = walk(&plant_string(n), 20.0, 90.0);
        for (scale, decimals) in [(1.0, 6), (7.3, 3), (10.0, 1), (9.0, 0)] {
            let found = check(&plant(n), &svg(&segments, scale, decimals));
            assert_eq!((found.output, found.found), (Output::Svg, segments.len() as u64));
            assert_eq!(found.verdict, Verdict::Same, "{n} {scale} {decimals}");
        }
        let mut reversed = segments.clone();
        reversed.reverse();
        assert_eq!(check(&plant(n), &csv(&segments)).verdict, Verdict::Same);
        reversed.push(reversed[0]);
        assert_eq!(check(&plant(n), &csv(&reversed)).verdict, Verdict::Reordered);
    }
    let four = walk(&plant_string(4), 20.0, 90.0);
    told(
        &plant(5),
        &csv(&four),
        &expect!["The output is generation 4, not generation 5. The output has 130 segments; generation 5 has 422."],
    );
    told(
        &plant(4),
        &csv(&walk(&plant_string(4), 20.0, 0.0)),
        &expect!["The picture is that of generation 4, but turned by 270 degrees."],
    );
    told(
        &plant(4),
        &csv(&walk(&plant_string(4), -20.0, 90.0)),
        &expect!["The picture is that of generation 4, but mirrored left to right."],
    );
    told(
        &plant(4),
        &csv(&walk(&plant_string(4), 22.0, 90.0)),
        &expect![[r#"
        Segment 10 is the first that differs from generation 4.
          expected: (-0.34202, 8.939693) to (-0.68404, 9.879385)
          found:    (-0.374607, 8.927184) to (-0.749213, 9.854368)
        Both have 130 segments."#]],
    );
    let mut bent = four.clone();
    bent[100][2] += 0.5;
    told(
        &plant(4),
        &csv(&bent),
        &expect![[r#"
        Segment 101 is the first that differs from generation 4.
          expected: (-2.653656, 21.290859) to (-3.296443, 22.056904)
          found:    (-2.653656, 21.290859) to (-2.796443, 22.056904)
        Both have 130 segments."#]],
    );
    told(
        &plant(4),
        &csv(&four[..50]),
        &expect![[r#"
        Segment 51 is the first that differs from generation 4.
          expected: (0, 12) to (0, 13)
          found:    (no more segments)
        The output has 50 segments; generation 4 has 130."#]],
    );
    // The picture is upside down if the program forgets that y points down.
    let upside_down: Vec<[f64; 4]> = four.iter().map(|&[a, b, c, d]| [a, -b, c, -d]).collect();
    told(
        &plant(4),
        &svg(&upside_down, 10.0, 2),
        &expect!["The picture is that of generation 4, but upside down. In SVG, y points down."],
    );
}

#[test]
fn space_and_polygons() {
    let cube = Definition {
        axiom: "F&F+F^F\\F&F".into(),
        rules: String::new(),
        angle: 90.0,
        iterations: 0,
        ..Definition::default()
    };
    let system = lsystem_drawing::System::new(&cube).unwrap();
    let drawing =
        lsystem_drawing::draw::<lsystem_drawing::Solid>(&system, 0, &lsystem_base::Limits::default()).unwrap();
    let table = lsystem_files::write_csv(&drawing, 100).unwrap();
    assert!(check(&cube, &table).is_right());
    assert!(!check(&cube, &table.replacen(",1,", ",2,", 1)).is_right(), "{table}");
    let Check { verdict, .. } = check(&cube, "0,0,1,1\n");
    assert!(matches!(verdict, Verdict::Unreadable(_)), "{verdict:?}");
}

/// The files that this library writes are right.
#[test]
fn own_files() {
    for (dialect, n) in [(Dialect::Abop, 3), (Dialect::EveryLetter, 2)] {
        let definition = Definition { dialect, heading: 30.0, start: [5.0, -3.0], step: 0.1, ..plant(n) };
        let system = lsystem_drawing::System::new(&definition).unwrap();
        let drawing = lsystem_drawing::draw(&system, n, &lsystem_base::Limits::default()).unwrap();
        let svg = lsystem_files::write_svg(&drawing, &system.style, &lsystem_files::SvgOptions::default()).unwrap();
        assert_eq!(check(&definition, &svg.text).verdict, Verdict::Same);
        assert_eq!(check(&definition, &lsystem_files::write_csv(&drawing, 1 << 20).unwrap()).verdict, Verdict::Same);
    }
}

#[test]
fn damaged_output_is_told() {
    let huge = "1,2,3,4\n".repeat(250_001);
    for output in ["<svg><path d='M0 0C1 1 1 1 1 1'/></svg>", "0,0,1,1\n0,0,1", "<svg><line", &huge] {
        let found = check(&plant(2), output);
        assert!(matches!(found.verdict, Verdict::Unreadable(_)), "{:?}", found.verdict);
    }
    let too_many = Definition { iterations: 30, ..plant(30) };
    let found = check(&too_many, "0,0,1,1");
    assert!(matches!(found.verdict, Verdict::Failed(_)), "{:?}", found.verdict);
    // A string of 10^14 symbols is still compared.
    assert!(matches!(check(&too_many, &"F".repeat(1000)).verdict, Verdict::Symbol(_)));
}
