//! New values in files of every kind: what was not changed stays, byte for byte.

use expect_test::{Expect, expect};
use jsonc_parser::ast::Value as Json;
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};
use lsystem_files::{edit_file, read_file};
use lsystem_syntax::{Definition, FIELDS, Value};
use std::ops::Range;

type Change = fn(&mut Definition);

fn set(definition: &mut Definition, field: &str, value: &Value) {
    let spec = FIELDS.iter().find(|spec| spec.name == field).unwrap();
    assert!(spec.set(definition, value), "{field}");
}

/// The changes of a reader in the page.
const CHANGES: [(&str, Change); 14] = [
    ("title", |plant| plant.title = "A \"plant\" ü".into()),
    ("initial", |plant| plant.axiom = "F+F".into()),
    ("rules", |plant| plant.rules = "F -> FFG".into()),
    ("num_iters", |plant| plant.iterations += 1),
    ("angle_deg", |plant| plant.angle = 22.5),
    ("seed", |plant| plant.seed = 7),
    ("heading_deg", |plant| plant.heading = 12.0),
    ("step", |plant| plant.step = 2.0),
    ("tropism", |plant| plant.tropism = [0.0, -1.0, 0.5]),
    ("width", |plant| plant.style.width = 0.3),
    ("palette", |plant| {
        let colours = ["#123456", "#00ff00"].map(|colour| Value::Text(colour.into()));
        set(plant, "palette", &Value::List(colours.to_vec()));
    }),
    ("background", |plant| set(plant, "background", &Value::Text("#fedcba".into()))),
    ("colour_by", |plant| set(plant, "colourBy", &Value::Text("level".into()))),
    ("ink", |plant| set(plant, "ink", &Value::Text("density".into()))),
];

const COURSE: &str = r#"{"initial":"F","angle_deg":60,"num_iters":4,"rules":{"F":"F+F--F+F"},"author":"Ada"}"#;
const OURS: &str = r##"{
    // my first plant: ü
    "name": "p", "initial": "X", "angle_deg": 20.0, /* degrees */
    "rules": [
        "X -> F[+X]", // left
        "F -> FF"
    ],
    "num_iters": 4, // more is too much
    "author": {"name": "Ada", "step": 3, "ink": ["x"]},
    "turtle": {
        "step": 1.5, // long
        "heading_deg": 90
    },
    "style": {"palette": ["#FF0000" /* red */, "#0000ff"], "ink": "solid"}
    /* the end */
}
"##;
const COMMENTS: &str = "// Ada's\n{ // all\n  \"initial\": \"F\", // axiom\n  /* before */ \"angle_deg\": 60 /* 60 */,\n  \
                        \"num_iters\": 4,\n  // rules\n  \"rules\": { // of Koch\n    \"F\": \"F+F--F+F\" // one\n  }, // done\n  \
                        \"moon\": null // full\n  // nothing more\n}\n// bye";
const DOUBLED: &str = "{\n  \"initial\": \"G\",\n  \"turtle\": {\"step\": 5},\n  \"num_iters\": 2,\n  \"initial\": \"F\",\n  \
                       \"rules\": [\"F -> F\"],\n  \"rules\": [\"F -> F+F\"],\n  \"num_iters\": 3,\n  \"turtle\": {\"step\": 6, \"step\": 7}\n}\n";
const LOOSE: &str = "{initial: 'F', num_iters: +4, angle_deg: 60., rules: {F: 'F+F',}, author: 'Ada',}";
const TABS: &str = "{\n\t\"initial\" : \"F\",\n\t\"rules\" : {\n\t\t\"F\" : \"F+F\",\n\t\t\"G\" : \"GG\",\n\t},\n\t\"num_iters\" : 4,\n}";

fn kinds() -> Vec<(&'static str, Vec<u8>)> {
    let utf16 = |text: &str, write: fn(u16) -> [u8; 2]| {
        "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(write).collect()
    };
    let mixed = OURS
        .split_inclusive('\n')
        .enumerate()
        .map(|(at, line)| if at % 2 == 0 { line.replace('\n', "\r\n") } else { line.to_owned() });
    let mut unpaired: Vec<u8> = utf16(&OURS.replace('ü', "x"), u16::to_le_bytes);
    let x = unpaired.windows(2).position(|pair| pair == b"x\0").unwrap();
    unpaired.splice(x..x + 2, [0x00, 0xd8]);
    unpaired.push(7);
    let mut kinds: Vec<(&str, Vec<u8>)> = vec![
        ("course", COURSE.into()),
        ("ours", OURS.into()),
        ("comments", COMMENTS.into()),
        ("doubled", DOUBLED.into()),
        ("loose", LOOSE.into()),
        ("tabs", TABS.into()),
        ("mark", format!("\u{feff}{OURS}").into()),
        ("two marks", format!("\u{feff}\u{feff}{COURSE}").into()),
        ("windows", OURS.replace('\n', "\r\n").into()),
        ("old mac", COMMENTS.replace('\n', "\r").into()),
        ("mixed", mixed.collect::<String>().into()),
        ("no turtle", r#"{"initial": "F", "rules": ["F -> FF"], "style": {}}"#.into()),
        ("no rules", "{\n \"initial\": \"F\", \"turtle\": {}\n}".into()),
        ("unpaired", unpaired),
    ];
    for (name, text) in [("16 course", COURSE), ("16 ours", OURS), ("16 comments", COMMENTS)] {
        kinds.push((name, utf16(text, u16::to_le_bytes)));
        kinds.push((name, utf16(&text.replace('\n', "\r\n"), u16::to_be_bytes)));
    }
    kinds
}

/// The text in a file, each unit of UTF-16 and each byte order mark as a character.
fn text_in(bytes: &[u8]) -> String {
    let units =
        |read: fn([u8; 2]) -> u16| bytes.chunks_exact(2).map(|pair| read([pair[0], pair[1]])).collect::<Vec<_>>();
    match bytes {
        [0xff, 0xfe, ..] => String::from_utf16_lossy(&units(u16::from_le_bytes)),
        [0xfe, 0xff, ..] => String::from_utf16_lossy(&units(u16::from_be_bytes)),
        _ => String::from_utf8(bytes.to_vec()).unwrap(),
    }
}

/// The place of the value of the last key with this name, as the reader finds it.
fn place_of(text: &str, key: &str) -> Option<Range<usize>> {
    let plain = text.trim_start_matches('\u{feff}');
    let mark = text.len() - plain.len();
    let parsed = parse_to_ast(plain, &CollectOptions::default(), &ParseOptions::default()).unwrap();
    let Some(Json::Object(file)) = parsed.value else { panic!("{text}") };
    let last = |object: &jsonc_parser::ast::Object<'_>| {
        object
            .properties
            .iter()
            .rev()
            .find(|property| property.name.as_str() == key)
            .map(Ranged::range)
            .map(|range| range.start..range.end)
    };
    let inside = |name: &str| match &file.properties.iter().rev().find(|property| property.name.as_str() == name)?.value
    {
        Json::Object(object) => last(object),
        _ => None,
    };
    let found =
        if key == "author" { None } else { last(&file).or_else(|| inside("turtle")).or_else(|| inside("style")) };
    found.map(|range| range.start + mark..range.end + mark)
}

/// Whether `after` is `before` with another value at `place`, and with insertions at two places elsewhere at most.
fn is_only_changed(before: &str, after: &str, place: Option<&Range<usize>>) -> bool {
    // Bytes outside the place, in order; what is inserted stands between them.
    let (before, place) = (before.as_bytes(), place.cloned().unwrap_or(0..0));
    let kept = |text: &[u8], other: &[u8]| text.iter().zip(other).take_while(|(a, b)| a == b).count();
    let start = kept(before, after.as_bytes());
    let back = |bytes: &[u8]| bytes.iter().rev().copied().collect::<Vec<_>>();
    let end = before.len() - kept(&back(before), &back(after.as_bytes()));
    // One insertion, one replacement, or a comma and an insertion behind comments.
    let middle = before.get(start..end).unwrap_or_default();
    end <= start || (place.start <= start && end <= place.end) || {
        let added = &after.as_bytes()[start..after.len() - (before.len() - end)];
        added.strip_prefix(b",").is_some_and(|rest| rest.starts_with(middle))
    }
}

#[test]
fn changes_touch_nothing_else_in_files_of_all_kinds() {
    for (kind, bytes) in kinds() {
        let former =
            read_file(&bytes).definition.unwrap_or_else(|| panic!("{kind}: {:?}", read_file(&bytes).diagnostics));
        assert_eq!(edit_file(&bytes, &former).as_ref(), Some(&bytes), "{kind}: nothing is new");
        for (key, change) in CHANGES {
            let mut definition = former.clone();
            change(&mut definition);
            assert_ne!(definition, former, "{kind}, {key}");
            let edited = edit_file(&bytes, &definition).unwrap_or_else(|| panic!("{kind}, {key}: not edited"));
            assert_eq!(read_file(&edited).definition, Some(definition), "{kind}, {key}");
            let (before, after) = (text_in(&bytes), text_in(&edited));
            let place = place_of(&before, key);
            assert!(is_only_changed(&before, &after, place.as_ref()), "{kind}, {key}:\n{before}\n{after}");
            assert_eq!(&edited[..2], &bytes[..2], "{kind}: the encoding stays");
        }
    }
}

fn check(text: &str, change: impl Fn(&mut Definition), expected: &Expect) {
    let mut definition = read_file(text.as_bytes()).definition.unwrap();
    change(&mut definition);
    let edited = edit_file(text.as_bytes(), &definition).map(|bytes| String::from_utf8(bytes).unwrap());
    expected.assert_eq(&edited.unwrap_or_else(|| "not edited".into()));
}

#[test]
fn new_keys_have_the_layout_of_those_beside_them() {
    let all = |plant: &mut Definition| CHANGES.iter().for_each(|(_, change)| change(plant));
    check(
        COURSE,
        all,
        &expect![[
            r##"{"initial":"F+F","angle_deg":22.5,"num_iters":5,"rules":{"F":"FFG"},"author":"Ada","title":"A \"plant\" ü","seed":7,"turtle":{"dialect":"every-letter","heading_deg":12,"step":2,"tropism":[0, -1, 0.5]},"style":{"palette":["#123456", "#00ff00"],"colour_by":"level","background":"#fedcba","width":0.3,"tapers":false,"min_width":0,"max_width":0,"ink":"density"}}"##
        ]],
    );
    check(
        OURS,
        all,
        &expect![[r##"
        {
            // my first plant: ü
            "name": "p", "initial": "F+F", "angle_deg": 22.5, /* degrees */
            "rules": [
                "F -> FFG" // left
            ],
            "num_iters": 5, // more is too much
            "author": {"name": "Ada", "step": 3, "ink": ["x"]},
            "turtle": {
                "step": 2, // long
                "heading_deg": 12,
                "tropism": [0, -1, 0.5]
            },
            "style": {"palette": ["#123456" /* red */, "#00ff00"], "ink": "density", "colour_by": "level", "background": "#fedcba", "width": 0.3},
            "title": "A \"plant\" ü",
            "seed": 7
            /* the end */
        }
    "##]],
    );
    check(
        COMMENTS,
        all,
        &expect![[r##"
        // Ada's
        { // all
          "initial": "F+F", // axiom
          /* before */ "angle_deg": 22.5 /* 60 */,
          "num_iters": 5,
          // rules
          "rules": { // of Koch
            "F": "FFG" // one
          }, // done
          "moon": null, // full
          "title": "A \"plant\" ü",
          "seed": 7,
          "turtle": {
            "dialect": "every-letter",
            "heading_deg": 12,
            "step": 2,
            "tropism": [0, -1, 0.5]
          },
          "style": {
            "palette": ["#123456", "#00ff00"],
            "colour_by": "level",
            "background": "#fedcba",
            "width": 0.3,
            "tapers": false,
            "min_width": 0,
            "max_width": 0,
            "ink": "density"
          }
          // nothing more
        }
        // bye"##]],
    );
    check(
        TABS,
        all,
        &expect![[r##"
        {
        	"initial" : "F+F",
        	"rules" : {
        		"F" : "FFG",
        	},
        	"num_iters" : 5,
        	"title": "A \"plant\" ü",
        	"angle_deg": 22.5,
        	"seed": 7,
        	"turtle": {
        		"dialect": "every-letter",
        		"heading_deg": 12,
        		"step": 2,
        		"tropism": [0, -1, 0.5]
        	},
        	"style": {
        		"palette": ["#123456", "#00ff00"],
        		"colour_by": "level",
        		"background": "#fedcba",
        		"width": 0.3,
        		"tapers": false,
        		"min_width": 0,
        		"max_width": 0,
        		"ink": "density"
        	},
        }"##]],
    );
    check(
        LOOSE,
        all,
        &expect![[
            r##"{initial: "F+F", num_iters: 5, angle_deg: 22.5, rules: {F: "FFG",}, author: 'Ada', "title": "A \"plant\" ü", "seed": 7, "turtle": {"dialect": "every-letter", "heading_deg": 12, "step": 2, "tropism": [0, -1, 0.5]}, "style": {"palette": ["#123456", "#00ff00"], "colour_by": "level", "background": "#fedcba", "width": 0.3, "tapers": false, "min_width": 0, "max_width": 0, "ink": "density"},}"##
        ]],
    );
    check(
        DOUBLED,
        all,
        &expect![[r##"
        {
          "initial": "G",
          "turtle": {"step": 5},
          "num_iters": 2,
          "initial": "F+F",
          "rules": ["F -> F"],
          "rules": ["F -> FFG"],
          "num_iters": 4,
          "turtle": {"step": 6, "step": 2, "heading_deg": 12, "tropism": [0, -1, 0.5]},
          "title": "A \"plant\" ü",
          "angle_deg": 22.5,
          "seed": 7,
          "style": {
            "palette": ["#123456", "#00ff00"],
            "colour_by": "level",
            "background": "#fedcba",
            "width": 0.3,
            "ink": "density"
          }
        }
    "##]],
    );
}

#[test]
fn only_those_rules_are_edited_that_differ() {
    let lines = r#"{"initial": "A", "turtle": {},
  "rules": [
    "A -> B", // first

    "B -> C", /* second */ "C -> D",
    // the last two
    "D -> E\nE -> F"
  ]
}"#;
    let rules = |rules: &'static str| move |plant: &mut Definition| plant.rules = rules.into();
    check(
        lines,
        rules("A -> B\nB -> C\nC -> DD\nD -> E\nE -> F"),
        &expect![[r#"
        {"initial": "A", "turtle": {},
          "rules": [
            "A -> B", // first

            "B -> C", /* second */ "C -> DD",
            // the last two
            "D -> E\nE -> F"
          ]
        }"#]],
    );
    check(
        lines,
        rules("X -> Y\nA -> B\nB -> C\nN -> M\nC -> D\nD -> E\nE -> F\nF -> G"),
        &expect![[r#"
        {"initial": "A", "turtle": {},
          "rules": [
            "X -> Y",
            "A -> B", // first

            "B -> C",
            "N -> M", /* second */ "C -> D",
            // the last two
            "D -> E\nE -> F",
            "F -> G"
          ]
        }"#]],
    );
    check(
        lines,
        rules("B -> C\nD -> E\nE -> F"),
        &expect![[r#"
        {"initial": "A", "turtle": {},
          "rules": [
            // first

            "B -> C", /* second */ 
            // the last two
            "D -> E\nE -> F"
          ]
        }"#]],
    );
    check(
        lines,
        rules("A -> B\nB -> C"),
        &expect![[r#"
        {"initial": "A", "turtle": {},
          "rules": [
            "A -> B", // first

            "B -> C" /* second */ 
            // the last two
          ]
        }"#]],
    );
    check(
        lines,
        rules(""),
        &expect![[r#"
        {"initial": "A", "turtle": {},
          "rules": [
            // first

            /* second */ 
            // the last two
          ]
        }"#]],
    );
    let one = r#"{"initial":"A","rules":["A -> B","B -> C", "C -> D"]}"#;
    check(one, rules("A -> B\nC -> D"), &expect![[r#"{"initial":"A","rules":["A -> B","C -> D"]}"#]]);
    check(one, rules("B -> C"), &expect![[r#"{"initial":"A","rules":["B -> C"]}"#]]);
    check(
        one,
        rules("A -> B\nB -> C\nC -> D\nD -> E"),
        &expect![[r#"{"initial":"A","rules":["A -> B","B -> C", "C -> D", "D -> E"]}"#]],
    );
    check(
        "{\n  \"initial\": \"A\",\n  \"rules\": []\n}",
        rules("A -> B\nB -> C"),
        &expect![[r#"
        {
          "initial": "A",
          "rules": [
            "A -> B",
            "B -> C"
          ]
        }"#]],
    );
    check(
        "{'initial': 'A', 'rules': 'A -> B', turtle: {}}",
        rules("A -> B\nB -> C"),
        &expect![[r#"{'initial': 'A', 'rules': "A -> B\nB -> C", turtle: {}}"#]],
    );
}

#[test]
fn the_rules_of_the_course_keep_their_form_where_they_can() {
    let course = r#"{
  "initial": "F-", "num_iters": 2, // of the course
  "rules": {
    "F": "F+F", // first
    "X": [
      {"p": 0.5, "e": "XF"}, // half
      {"p": 0.5, "e": "X"}
    ],
    "Y": "Y(" // plain
  }
}"#;
    check(
        course,
        |plant| plant.rules = plant.rules.replace("F+F", "F"),
        &expect![[r#"
        {
          "initial": "F-", "num_iters": 2, // of the course
          "rules": {
            "F": "F", // first
            "X": [
              {"p": 0.5, "e": "XF"}, // half
              {"p": 0.5, "e": "X"}
            ],
            "Y": "Y(" // plain
          }
        }"#]],
    );
    check(
        course,
        |plant| plant.rules = plant.rules.replace("XF : 0.5", "XG : 0.25"),
        &expect![[r#"
        {
          "initial": "F-", "num_iters": 2, // of the course
          "rules": {
            "F": "F+F", // first
            "X": [
              {"p": 0.25, "e": "XG"}, // half
              {"p": 0.5, "e": "X"}
            ],
            "Y": "Y(" // plain
          }
        }"#]],
    );
    check(
        course,
        |plant| plant.rules += "\nZ -> ZZ",
        &expect![[r#"
        {
          "initial": "F-", "num_iters": 2, // of the course
          "rules": {
            "F": "F+F", // first
            "X": [
              {"p": 0.5, "e": "XF"}, // half
              {"p": 0.5, "e": "X"}
            ],
            "Y": "Y(", // plain
            "Z": "ZZ"
          }
        }"#]],
    );
    check(
        course,
        |plant| plant.rules = plant.rules.replace("F -> F+F\n", ""),
        &expect![[r#"
        {
          "initial": "F-", "num_iters": 2, // of the course
          "rules": {
            // first
            "X": [
              {"p": 0.5, "e": "XF"}, // half
              {"p": 0.5, "e": "X"}
            ],
            "Y": "Y(" // plain
          }
        }"#]],
    );
    check(
        course,
        |plant| plant.axiom = "G-".into(),
        &expect![[r#"
        {
          "initial": "G-", "num_iters": 2, // of the course
          "rules": {
            "F": "F+F", // first
            "X": [
              {"p": 0.5, "e": "XF"}, // half
              {"p": 0.5, "e": "X"}
            ],
            "Y": "Y(" // plain
          }
        }"#]],
    );
    // Parameters need lines, in which the comment among the outcomes has no place.
    check(course, |plant| plant.rules += "\nZ(x) -> Z(x + 1)", &expect!["not edited"]);
    check(
        course,
        |plant| plant.rules = plant.rules.replace("X -> X : 0.5\n", ""),
        &expect![[r#"
        {
          "initial": "F-", "num_iters": 2, // of the course
          "rules": {
            "F": "F+F", // first
            "X": [
              {"p": 0.5, "e": "XF"} // half
            ],
            "Y": "Y(" // plain
          }
        }"#]],
    );
    check(course, |plant| plant.rules = "F -> F(2)".into(), &expect!["not edited"]);
}

#[test]
fn keys_of_others_are_never_dropped_unasked() {
    let noted = r#"{"initial": "X", "rules": {"X": [{"p": 1, "e": "XF", "note": "all"}]}}"#;
    check(
        noted,
        |plant| plant.rules = "X -> XG : 1".into(),
        &expect![[r#"{"initial": "X", "rules": {"X": [{"p": 1, "e": "XG", "note": "all"}]}}"#]],
    );
    check(noted, |plant| plant.rules = "X -> XG".into(), &expect!["not edited"]);
}

#[test]
fn values_that_may_be_missing_are_removed() {
    let text = "{\n \"initial\": \"F\",\n \"rules\": [],\n \"turtle\": {\n  \"right_angle_deg\": 3, \"pitch_up_deg\": 4,\n  \
                \"roll_left_deg\": 5, // no\n  \"overrides\": {\"G\": \"move\", /* one */ \"A\": \"draw 10\"},\n  \"roll_right_deg\": 6\n }\n}\n";
    let none = |plant: &mut Definition| {
        (plant.right_angle, plant.pitch_up, plant.roll_left, plant.roll_right) = (None, None, None, None);
    };
    check(
        text,
        none,
        &expect![[r#"
            {
             "initial": "F",
             "rules": [],
             "turtle": {
              // no
              "overrides": {"G": "move", /* one */ "A": "draw 10"}
             }
            }
        "#]],
    );
    check(
        text,
        |plant| (plant.roll_right, plant.step) = (None, 2.0),
        &expect![[r#"
            {
             "initial": "F",
             "rules": [],
             "turtle": {
              "right_angle_deg": 3, "pitch_up_deg": 4,
              "roll_left_deg": 5, // no
              "overrides": {"G": "move", /* one */ "A": "draw 10"},
              "step": 2
             }
            }
        "#]],
    );
    check(
        text,
        |plant| plant.overrides = "G: move\nB: draw\nA: draw 5".into(),
        &expect![[r#"
        {
         "initial": "F",
         "rules": [],
         "turtle": {
          "right_angle_deg": 3, "pitch_up_deg": 4,
          "roll_left_deg": 5, // no
          "overrides": {"G": "move", "B": "draw", /* one */ "A": "draw 5"},
          "roll_right_deg": 6
         }
        }
    "#]],
    );
    check(
        text,
        |plant| plant.overrides = "A: draw 10".into(),
        &expect![[r#"
        {
         "initial": "F",
         "rules": [],
         "turtle": {
          "right_angle_deg": 3, "pitch_up_deg": 4,
          "roll_left_deg": 5, // no
          "overrides": {/* one */ "A": "draw 10"},
          "roll_right_deg": 6
         }
        }
    "#]],
    );
    check(
        text,
        |plant| plant.overrides = String::new(),
        &expect![[r#"
        {
         "initial": "F",
         "rules": [],
         "turtle": {
          "right_angle_deg": 3, "pitch_up_deg": 4,
          "roll_left_deg": 5, // no
          "overrides": {/* one */},
          "roll_right_deg": 6
         }
        }
    "#]],
    );
    check(
        text,
        |plant| plant.overrides = "G: move\nno override".into(),
        &expect![[r#"
        {
         "initial": "F",
         "rules": [],
         "turtle": {
          "right_angle_deg": 3, "pitch_up_deg": 4,
          "roll_left_deg": 5, // no
          "overrides": ["G: move", /* one */ "no override"],
          "roll_right_deg": 6
         }
        }
    "#]],
    );
    // A new line directly before the bracket.
    check(
        "{\"initial\": \"F\", \"turtle\": {\"overrides\":{\"A\":\"draw\"}}}",
        |plant| plant.overrides = "B: draw\nB: move".into(),
        &expect![[r#"{"initial": "F", "turtle": {"overrides":["B: draw", "B: move"]}}"#]],
    );
    check(
        "{\"initial\": \"F\", \"turtle\": {\"roll_right_deg\": 6}}",
        none,
        &expect![[r#"{"initial": "F", "turtle": {}}"#]],
    );
    check(
        "{\"initial\": \"F\", \"turtle\": {\"step\": 6, \"roll_right_deg\": 6}}",
        none,
        &expect![[r#"{"initial": "F", "turtle": {"step": 6}}"#]],
    );
    check(
        "{\"initial\": \"F\", \"turtle\": {\"roll_right_deg\": 6, \"step\": 6}}",
        none,
        &expect![[r#"{"initial": "F", "turtle": {"step": 6}}"#]],
    );
}

#[test]
fn what_has_no_system_is_not_edited() {
    let plant = read_file(COURSE.as_bytes()).definition.unwrap();
    for broken in
        ["", "[]", "{", "{\"rules\": 3}", "Koch {\n angle 6\n axiom F\n}", "<svg/>", "{\"a\": 1}", "\u{feff}", "{}"]
    {
        assert_eq!(edit_file(broken.as_bytes(), &plant), None, "{broken}");
    }
    assert_eq!(edit_file(b"\xff\xfe{\0", &plant), None);
    assert_eq!(edit_file(b"{\"initial\": \"\xff\"}", &plant), None);
}

#[test]
fn a_file_of_comments_is_read_once() {
    let file = format!("{{{}\"initial\":\"F\"}}", "/**/".repeat(200_000));
    let mut plant = read_file(file.as_bytes()).definition.unwrap();
    plant.axiom = "FF".into();
    let edited = edit_file(file.as_bytes(), &plant).unwrap();
    assert_eq!(String::from_utf8(edited).unwrap(), file.replace("\"F\"", "\"FF\""));
}
