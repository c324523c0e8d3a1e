//! JSON files: written files read back as the same, and no text causes a panic.

use expect_test::expect;
use lsystem::files::read_fields;
use lsystem::syntax::{Colour, ColourBy, FIELDS, Ink};
use lsystem::{Definition, Diagnostic, Dialect, Style, System, read_json, render_diagnostic, write_json};
use proptest::prelude::*;
use std::path::Path;

fn style() -> impl Strategy<Value = Style> {
    let colour = || any::<[u8; 3]>().prop_map(|rgb| Colour { rgb });
    let any_style = (
        prop::collection::vec(colour(), 1..4),
        prop::sample::select(ColourBy::ALL.to_vec()),
        colour(),
        0.0..1e9,
        0.0..1e4,
        (
            prop::array::uniform2(any::<bool>()),
            prop::array::uniform2(0..i32::MAX),
            0.0..10.0,
            prop::sample::select(Ink::ALL.to_vec()),
            -10.0..10.0,
        ),
    )
        .prop_map(|(palette, colour_by, background, width, min_width, more)| {
            let mut style = Style { palette, colour_by, background, width, min_width, ..Style::default() };
            ([style.palette_holds, style.shadows], style.turn_colours, style.width_factor, style.ink, style.exposure) =
                more;
            style
        });
    prop_oneof![2 => Just(Style::course()), 1 => Just(Style::default()), 1 => any_style]
}

/// Texts with a meaning in some field, and other texts.
fn rules() -> impl Strategy<Value = String> {
    prop_oneof!["([FGX] -> [FGX+\\-\\[\\]]{0,6}( : 0\\.[1-9])?\n){0,4}[FX] -> F", "\\PC*", ".*"]
}

fn definition() -> impl Strategy<Value = Definition> {
    let words = || prop_oneof![Just(String::new()), ".{0,12}"];
    let number = || prop_oneof![(-360..360).prop_map(f64::from), any::<f64>().prop_filter("finite", |v| v.is_finite())];
    let overrides = prop_oneof![2 => Just(String::new()), 1 => Just("G: move\n`#`: draw 10".to_owned()), 1 => ".*"];
    (
        (words(), words(), words(), words()),
        (prop_oneof!["[FGX+-]{0,5}", ".*"], rules(), overrides, prop_oneof![2 => Just(String::new()), 1 => ".*"]),
        (0..=1000_u32, any::<u32>(), prop_oneof![Just(0), any::<u32>()]),
        (number(), prop::option::of(number()), prop_oneof![Just(90.0), number()]),
        (prop_oneof![Just(1.0), 1e-9..1e9], prop_oneof![Just([0.0, 0.0]), prop::array::uniform2(-1e9..1e9)]),
        (
            prop::array::uniform4(prop::option::of(number())),
            prop_oneof![Just([0.0, -1.0, 0.0]), prop::array::uniform3(-1e3..1e3)],
            prop_oneof![Just(0.0), -1e3..1e3],
            prop_oneof![
                1 => (0.0..10.0, 0.0..100.0, 0.0..100.0, 0.0..1.0),
                1 => Just((1.0, 0.0, 0.0, 1.0)),
            ],
            prop_oneof![Just([0.0, 0.0]), prop::array::uniform2(-3600.0..3600.0)],
        ),
        prop_oneof![Just(Dialect::EveryLetter), prop::sample::select(Dialect::ALL.to_vec())],
        style(),
    )
        .prop_map(|(words, texts, whole, angles, lengths, space, dialect, style)| Definition {
            name: words.0,
            title: words.1,
            source: words.2,
            notes: words.3,
            axiom: texts.0,
            rules: texts.1,
            overrides: texts.2,
            surfaces: texts.3,
            iterations: whole.0,
            seed: whole.2,
            angle: angles.0,
            right_angle: angles.1,
            heading: angles.2,
            step: lengths.0,
            start: lengths.1,
            pitch_down: space.0[0],
            pitch_up: space.0[1],
            roll_left: space.0[2],
            roll_right: space.0[3],
            tropism: space.1,
            elasticity: space.2,
            length_factor: space.3.0,
            angle_variation: space.3.1,
            length_variation: space.3.2,
            growth: space.3.3,
            wind: space.4,
            dialect,
            style,
        })
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn written_definitions_read_back(definition in definition()) {
        let text = write_json(&definition);
        let (read, diagnostics) = read_json(&text);
        prop_assert_eq!(read, Some(definition), "{}\n{:?}", text, diagnostics);
        prop_assert!(text.ends_with('\n'));
    }

    #[test]
    fn objects_of_fields_and_of_files_are_read_as_scripts_hold_them(definition in definition()) {
        for text in [serde_json::to_string_pretty(&definition).unwrap(), write_json(&definition)] {
            let (read, diagnostics) = read_fields(&text);
            prop_assert_eq!(read.as_ref(), Some(&definition), "{}\n{:?}", text, diagnostics);
        }
    }

    #[test]
    fn files_are_json_for_others_too(definition in definition()) {
        prop_assert!(serde_json::from_str::<serde_json::Value>(&write_json(&definition)).is_ok());
    }

    #[test]
    fn no_file_panics(text in prop_oneof![
        ".*",
        "[{}\\[\\]\":,0-9a-z \n/*'\\\\-]{0,60}",
        "\\{(\"(rules|turtle|style|initial|num_iters|overrides|palette|F)\" ?: ?(\"[F+ ]{0,3}\"|[0-9.e-]{1,4}|\\{|\\[|\\]|\\}|null),? ?){0,8}\\}{0,3}",
    ]) {
        let (definition, diagnostics) = read_json(&text);
        prop_assert_eq!(definition.is_none(), diagnostics.iter().any(Diagnostic::is_error));
        for diagnostic in diagnostics.into_iter().chain(read_fields(&text).1) {
            prop_assert!(text.get(diagnostic.span.clone()).is_some(), "{:?}", diagnostic);
        }
    }
}

#[test]
fn rules_of_scripts_have_the_forms_of_files() {
    let read = |text: &str| {
        let (definition, diagnostics) = read_fields(text);
        assert_eq!(diagnostics, [], "{text}");
        let Definition { axiom, rules, overrides, dialect, .. } = definition.unwrap();
        (axiom, rules, overrides, dialect)
    };
    let texts =
        |axiom: &str, rules: &str, overrides: &str| (axiom.into(), rules.into(), overrides.into(), Dialect::Abop);
    let plain = r#"{"axiom": "F(2)", "rules": {"F": [{"p": 0.5, "e": "FF"}, {"p": 0.5, "e": "F"}]}}"#;
    assert_eq!(read(plain), texts("F`(`2`)`", "F -> FF : 0.5\nF -> F : 0.5", ""));
    let lines = r#"{"axiom": "F(2)", "rules": ["F -> FF", "G -> F"], "overrides": {"G": "move"}, "rightAngle": null}"#;
    assert_eq!(read(lines), texts("F(2)", "F -> FF\nG -> F", "G: move"));
    assert_eq!(read(r#"{"axiom": "F(2)"}"#), texts("F(2)", "", ""));
    assert_eq!(read(r#"{"initial": "F", "rules": {"F": "FF"}}"#).3, Dialect::EveryLetter);
}

#[test]
fn wrong_names_and_values_of_scripts_are_told() {
    let said = |text: &str| -> String {
        let shown = |d: &Diagnostic| format!("{} | {}\n", d.message, d.hint.as_deref().unwrap_or_default());
        read_fields(text).1.iter().map(shown).collect()
    };
    for (key, meant) in [
        ("angel", "angle"),
        ("productions", "rules"),
        ("initial", "axiom"),
        ("n", "iterations"),
        ("num_iters", "iterations"),
        ("right_angle_deg", "rightAngle"),
        ("right_angle", "rightAngle"),
        ("delta", "angle"),
        ("bg", "background"),
        ("lengthfactor", "lengthFactor"),
    ] {
        let text = format!(r#"{{"axiom": "F", "{key}": 1}}"#);
        assert_eq!(said(&text), format!("Unknown key `{key}` | Did you mean `{meant}`?\n"));
        assert_eq!(read_fields(&text).0, None, "{key}");
    }
    let of_others = |key: &str| read_fields(&format!(r#"{{"initial": "F", "{key}": 1}}"#)).0.is_some();
    assert!(of_others("author") && !of_others("angel_deg") && !of_others("angle"));
    assert_eq!(said(r#"{"axiom": "F", "moon": 1, "$schema": "", "rules_old": 1}"#), "Unknown key `moon` | \n");
    expect![[r#"
        `iterations` must be a whole number from 0 to 1,000 | 
        `angle` must be a number, not null | 
        `rules` must be an object or a list of lines, not a number | 
        `start` must be a list of 2 values, each a number from -1,000,000,000 to 1,000,000,000, not a list | 
        `ink` must be one of `auto`, `solid`, `density` | 
    "#]]
    .assert_eq(&said(r#"{"axiom": "F", "iterations": 2.5, "angle": null, "rules": 3, "start": [1], "ink": "blue"}"#));
    assert!(FIELDS.iter().all(|spec| !said(&format!(r#"{{"axiom": "F", "{}": [[]]}}"#, spec.name)).is_empty()));
    assert!(["[]", "null"].iter().all(|text| said(text).contains("must hold an object")));
}

#[test]
fn deep_nesting_is_an_error() {
    for nest in ["[", "{\"a\":", "{\"rules\":[", "{\"rules\":{\"F\":"] {
        let (definition, diagnostics) = read_json(&nest.repeat(100_000));
        assert!(definition.is_none() && diagnostics.len() == 1);
    }
}

#[test]
fn the_course_form_says_what_it_can() {
    let text = r#"{"name": "path", "initial": "F F", "angle_deg": 22.5, "num_iters": 5, "seed": 7,
        "rules": {"F": [{"p": 0.5, "e": "F+F"}, {"p": 0.5, "e": "F-F"}], "(": ")"}}"#;
    let (definition, _) = read_json(text);
    expect![[r#"
        {
          "name": "path",
          "stochastic": true,
          "initial": "F F",
          "angle_deg": 22.5,
          "num_iters": 5,
          "rules": {
            "F": [
              {"p": 0.5, "e": "F+F"},
              {"p": 0.5, "e": "F-F"}
            ],
            "(": ")"
          },
          "seed": 7
        }
    "#]]
    .assert_eq(&write_json(&definition.unwrap()));
}

#[test]
fn our_form_says_the_rest() {
    let definition = Definition {
        name: "tree1".into(),
        axiom: "F".into(),
        rules: "// branching\nF -> F[+F]F[-F][F]".into(),
        angle: 30.0,
        right_angle: Some(25.7),
        pitch_down: Some(40.0),
        roll_right: Some(20.5),
        tropism: [0.0, 1.0, -0.5],
        elasticity: 0.22,
        step: 15.0,
        start: [700.0, 50.0],
        dialect: Dialect::Practical,
        overrides: "G: move".into(),
        iterations: 5,
        style: Style { colour_by: ColourBy::Level, ..Style::default() },
        ..Definition::default()
    };
    expect![[r#"
        {
          "name": "tree1",
          "initial": "F",
          "angle_deg": 30,
          "num_iters": 5,
          "rules": [
            "// branching",
            "F -> F[+F]F[-F][F]"
          ],
          "turtle": {
            "dialect": "practical",
            "right_angle_deg": 25.7,
            "pitch_down_deg": 40,
            "roll_right_deg": 20.5,
            "step": 15,
            "start": [700, 50],
            "tropism": [0, 1, -0.5],
            "elasticity": 0.22,
            "overrides": {
              "G": "move"
            }
          },
          "style": {
            "colour_by": "level"
          }
        }
    "#]]
    .assert_eq(&write_json(&definition));
}

#[test]
fn a_file_of_the_course_has_its_defaults() {
    let (definition, diagnostics) = read_json(r#"{"initial": ""}"#);
    assert_eq!(diagnostics, []);
    let expected = Definition { dialect: Dialect::EveryLetter, style: Style::course(), ..Definition::default() };
    assert_eq!(definition, Some(expected));
}

#[test]
fn every_file_of_the_gallery_is_clean() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in");
    let mut open = vec![root];
    let mut files = 0;
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
            continue;
        }
        if path.extension().is_none_or(|e| e != "json") {
            continue;
        }
        files += 1;
        let text = std::fs::read_to_string(&path).unwrap();
        let (definition, diagnostics) = read_json(&text);
        let more = System::problems(&definition.unwrap());
        let shown: Vec<_> = (diagnostics.iter().chain(&more)).map(|d| render_diagnostic(d, "", &text)).collect();
        assert_eq!(shown, Vec::<String>::new(), "{}", path.display());
    }
    assert!(files > 40);
}
