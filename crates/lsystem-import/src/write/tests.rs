//! What is written reads back as a system that draws the same, or is refused with a reason.

use super::compare::{choices, difference, placed, shape};
use super::{NOTATIONS, Notation, Refusal, Written, export};
use crate::import;
use lsystem_base::Limits;
use lsystem_drawing::{Figure, System};
use lsystem_files::read_json;
use lsystem_syntax::{Definition, Dialect, Grammar, Production, parse, print_rules};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

/// The notations that the readers of this library read. TikZ's reader leaves out the rotation of the picture.
const READ_BACK: [&str; 9] = ["text", "tikz", "js", "fractint", "inkscape", "houdini", "cpfg", "lpy", "anvaka"];

/// All systems of the gallery.
pub(super) fn gallery() -> Vec<(String, Definition)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in");
    let list = |path: &Path| {
        let entries = std::fs::read_dir(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let mut paths: Vec<_> = entries.map(|entry| entry.expect("readable").path()).collect();
        paths.sort();
        paths
    };
    let files = list(&root).into_iter().flat_map(|folder| list(&folder));
    let read = |path: std::path::PathBuf| {
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        (path.display().to_string(), read_json(&text).0.unwrap_or_else(|| panic!("{}", path.display())))
    };
    files.map(read).collect()
}

/// The difference between a definition and its text that is read back, if there is one.
fn read_back_difference(definition: &Definition, notation: &Notation, text: &str) -> Option<String> {
    let Some(imported) = import(text) else { return Some("not recognised".to_owned()) };
    let entry = &imported.entries[0];
    let Some(read) = &entry.definition else { return Some(format!("refused: {:?}", entry.remarks)) };
    let mut definition = definition.clone();
    if notation.name == "tikz" && read.heading == 0.0 {
        definition.heading = 0.0;
    }
    difference(&definition, read, notation.name != "fractint")
}

#[test]
fn the_gallery_reads_back() {
    let gallery = gallery();
    assert!(gallery.len() >= 100, "{}", gallery.len());
    let (mut wrong, mut reasons) = (Vec::new(), BTreeMap::new());
    for notation in &NOTATIONS {
        let mut equal = 0;
        for (name, definition) in &gallery {
            match export(definition, notation) {
                Ok(written) => {
                    equal += 1;
                    let reads = |text: &str| {
                        import(text).is_some_and(|all| all.entries.iter().any(|own| own.definition.is_some()))
                    };
                    if ["python", "p5", "latex"].contains(&notation.name) && reads(&written.text) {
                        wrong.push(format!("{name} as {} is read, but not for what it is", notation.name));
                    }
                    if READ_BACK.contains(&notation.name)
                        && let Some(difference) = read_back_difference(definition, notation, &written.text)
                    {
                        wrong.push(format!("{name} as {}: {difference}\n{}", notation.name, written.text));
                    }
                }
                Err(Refusal(reason)) => *reasons.entry((notation.name, reason)).or_insert(0) += 1,
            }
        }
        println!("{} {equal} written, {} refused", notation.name, gallery.len() - equal);
        // More refusals than these are a fault of a writer, or of a reader for texts.
        let least = match notation.name {
            "latex" => gallery.len(),
            "cpfg" | "lpy" | "python" | "p5" | "houdini" => 100,
            "fractint" | "anvaka" => 85,
            "js" | "inkscape" => 70,
            _ => 50,
        };
        assert!(equal >= least, "{}: {equal}", notation.name);
    }
    for ((notation, reason), count) in reasons {
        println!("{notation}: {count} x {reason}");
    }
    assert!(wrong.is_empty(), "{} differ\n{}", wrong.len(), wrong.join("\n"));
}

/// A definition with few derivation steps, and with the productions that random choices take at this share of the
/// weights.
fn decided(definition: &Definition, roll: f64) -> Definition {
    let grammar = parse(&definition.axiom, &definition.rules).0;
    let productions = choices(&grammar).into_iter().map(|group| {
        let weight = |rule: &&Production| rule.weight.as_ref().map_or(1.0, |weight| grammar.value(weight).unwrap());
        let mut left = roll * group.iter().map(weight).sum::<f64>();
        let taken = group.iter().find(|rule| {
            left -= weight(rule);
            left < 0.0
        });
        Production { weight: None, ..(*taken.unwrap()).clone() }
    });
    let rules = print_rules(&Grammar { productions: productions.collect(), ..grammar.clone() });
    Definition { rules, ..definition.clone() }
}

/// Compares points with the drawing of a definition.
fn check_drawing(what: &str, definition: &Definition, points: &[[f64; 3]]) {
    let system = System::new(definition).unwrap_or_else(|_| panic!("{what}"));
    let told = shape(&Figure::draw(&system, definition.iterations, &Limits::default()).unwrap());
    let found = placed(points);
    assert_eq!(found.len(), told.len(), "{what}");
    let far = found.iter().zip(&told).position(|(a, b)| (a - b).abs() > 1e-6);
    assert_eq!(far, None, "{what}");
}

/// Runs the gallery's programs in one notation by an interpreter, and compares what they draw.
fn check_programs(name: &str, interpreter: &str, driver: &str) {
    let notation = Notation::named(name).unwrap();
    let folder = std::env::temp_dir().join(format!("lsystem-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let driver = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/programs").join(driver);
    for roll in [0.1, 0.5, 0.95] {
        let (mut cases, mut paths) = (Vec::new(), Vec::new());
        for (what, definition) in test_effort::sampled(gallery(), 3, 0) {
            // Signals in contexts take many steps to reach branches.
            let productions = parse(&definition.axiom, &definition.rules).0.productions;
            let most = if productions.iter().any(Production::is_context_sensitive) { 20 } else { 4 };
            let definition = Definition { iterations: definition.iterations.min(most), ..definition };
            let Ok(written) = export(&definition, notation) else { continue };
            let is_random = System::new(&definition).is_ok_and(|system| system.has_choices());
            if roll != 0.5 && !is_random {
                continue;
            }
            let path = folder.join(format!("{}.{}", cases.len(), notation.ending));
            std::fs::write(&path, written.text).unwrap();
            cases.push((what, decided(&definition, roll)));
            paths.push(path);
        }
        let output = std::process::Command::new(interpreter).arg(&driver).arg(roll.to_string()).args(&paths).output();
        let Ok(output) = output else {
            println!("{interpreter} is missing: programs for {name} are not run");
            break;
        };
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let found = String::from_utf8(output.stdout).unwrap();
        assert_eq!(found.lines().count(), cases.len());
        for ((what, definition), line) in cases.iter().zip(found.lines()) {
            let numbers: Vec<f64> = line.split_whitespace().map(|number| number.parse().unwrap()).collect();
            let points: Vec<[f64; 3]> = numbers.chunks(2).map(|point| [point[0], point[1], 0.0]).collect();
            check_drawing(&format!("{what} as {name}"), definition, &points);
        }
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn programs_for_python_draw_the_same() {
    check_programs("python", "python3", "drive.py");
}

#[test]
fn sketches_draw_the_same() {
    check_programs("p5", "node", "drive.mjs");
}

/// The ends of the lines that Inkscape draws, as its extension `lindenmayer.py` does: the page's y points down, and
/// the first heading is -90 degrees. Since version 1.2, `+` turns left on the page.
fn inkscape(text: &str) -> Vec<[f64; 3]> {
    let value = |label: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(label)).unwrap_or_else(|| panic!("{label}"));
        line.trim().to_uppercase()
    };
    let rules = value("Rules:");
    let rules: Vec<(&str, &str)> = rules.split(';').filter_map(|rule| rule.split_once('=')).collect();
    let mut word = value("Axiom:");
    for _ in 0..value("Order:").parse().unwrap() {
        let successor = |symbol: char| {
            let own = symbol.to_string();
            rules.iter().find(|(from, _)| *from == own).map_or(own, |(_, to)| (*to).to_owned())
        };
        word = word.chars().map(successor).collect();
    }
    let [left, right] = ["Left angle:", "Right angle:"].map(|label| value(label).parse::<f64>().unwrap());
    let (mut at, mut heading, mut saved, mut points) = ([0.0_f64, 0.0], -90.0_f64, Vec::new(), Vec::new());
    for symbol in word.chars() {
        match symbol {
            'A'..='L' => {
                let from = at;
                let radians = heading.to_radians();
                at = [at[0] + libm::cos(radians), at[1] + libm::sin(radians)];
                if symbol <= 'F' {
                    points.extend([from, at].map(|[x, y]| [x, -y, 0.0]));
                }
            }
            '+' => heading -= left,
            '-' => heading += right,
            '|' => heading += 180.0,
            '[' => saved.push((at, heading)),
            ']' => (at, heading) = saved.pop().unwrap(),
            _ => {}
        }
    }
    points
}

fn check_inkscape(what: &str, definition: &Definition) {
    if let Ok(written) = export(definition, Notation::named("inkscape").unwrap()) {
        check_drawing(what, definition, &inkscape(&written.text));
    }
}

#[test]
fn inkscape_draws_the_same() {
    for (what, definition) in gallery() {
        check_inkscape(&what, &Definition { iterations: definition.iterations.min(4), ..definition });
    }
}

#[test]
fn inkscape_turns_left_and_has_limits_of_its_own() {
    let notation = Notation::named("inkscape").unwrap();
    let (axiom, rules) = ("F+F".to_owned(), "F -> F".to_owned());
    let turns = Definition { axiom, rules, angle: 90.0, iterations: 0, ..Definition::default() };
    let written = export(&turns, notation).unwrap();
    assert!(written.text.starts_with("Axiom: F+F\n") && written.left_out.is_empty(), "{written:?}");
    for angle in [137.508, 360.0 / 7.0, 0.05] {
        let fine = Definition { angle, ..turns.clone() };
        assert_eq!(export(&fine, notation).unwrap().left_out, ["The dialog of Inkscape rounds angles to one decimal."]);
    }
    for angle in [25.7, 114.1, 0.3, 330.0] {
        assert_eq!(export(&Definition { angle, ..turns.clone() }, notation).unwrap().left_out, [""; 0], "{angle}");
    }
    let deep = |iterations| export(&Definition { iterations, ..turns.clone() }, notation).map(|_| ());
    assert_eq!((deep(100), deep(101)), (Ok(()), Err(Refusal("Inkscape takes at most 100 iterations".to_owned()))));
}

#[test]
fn objects_have_no_empty_successor() {
    let notation = Notation::named("js").unwrap();
    let (mut written, mut stood_in) = (0, 0);
    for (what, definition) in gallery() {
        let Ok(Written { text, .. }) = export(&definition, notation) else { continue };
        assert!(!text.contains(": \"\""), "{what}: {text}");
        let vanishes =
            parse(&definition.axiom, &definition.rules).0.productions.iter().any(|one| one.successor.is_empty());
        (written, stood_in) = (written + 1, stood_in + u32::from(vanishes));
    }
    assert!(written > 50 && stood_in > 0, "{written}, {stood_in}");
    let chance = Definition {
        axiom: "FXYZ".into(),
        rules: "F -> F+F : 1\nF -> * : 2\nX -> *".into(),
        angle: 90.0,
        ..Definition::default()
    };
    let text = export(&chance, notation).unwrap().text;
    assert!(text.contains("successor: \"A\"") && text.contains("\"X\": \"A\""), "{text}");
}

/// Systems with queries: in the plane and in space, with conditions, with another start and heading.
fn asking() -> Vec<Definition> {
    let system = |axiom: &str, rules: &str| Definition {
        axiom: axiom.into(),
        rules: rules.into(),
        iterations: 5,
        ..Definition::default()
    };
    let pruned = "?P(x,y) < A : y < 3 && !(x > 2 || x < -2) -> F(1)[+(40)?P(0,0)A][-(25)?P(0,0)A]\n?P(x,y) -> *";
    let steered = "?H(a,b,c)?P(x,y,z) < A(w) : z >= 0 and b > 0.2 -> F(w)[&(50)?H(0,0,0)?P(0,0,0)A(w*0.8)]\\
        /(137.5)?H(0,0,0)?P(0,0,0)A(w*0.9)\n?H(a,b,c)?P(x,y,z) < A(w) : y > 1 -> F(w/2+x/10)";
    let steered = steered.replace("\\\n        ", "");
    let sides = "?L(a,b,c)?U(d,e,f) < A : not (a > 0.5) and f - 1 < 0.1 -> F(1+abs_a)+(30)^(20)?L(0,0,0)?U(0,0,0)A";
    let sides = sides.replace("abs_a", "a*a+c*c");
    vec![
        system("?P(0,0)A", pruned),
        Definition { start: [1.5, -0.25], heading: 60.0, step: 0.5, ..system("F?P(0,0)A", pruned) },
        system("?H(0,0,0)?P(0,0,0)A(1)", &steered),
        Definition { heading: 0.0, ..system("?L(0,0,0)?U(0,0,0)A", &sides) },
        system("FF?P(0,0,0)B", "ignore: ?H\n?P(x,y,z) < B -> ?H(0,0,0)[F(y)]+(x+1)B\nshape wall = box(-1,-1,-1,1,1,1)"),
    ]
}

#[test]
fn queries_read_back() {
    for (at, definition) in asking().iter().enumerate() {
        assert!(System::new(definition).is_ok_and(|own| own.rules.interpreter.is_some()), "{at}");
        for name in ["cpfg", "lpy"] {
            let notation = Notation::named(name).unwrap();
            let written = match export(definition, notation) {
                Ok(written) => written,
                // L-Py has no word for another start.
                Err(Refusal(why)) => {
                    assert!(at == 1 && name == "lpy" && why.contains("another start"), "{at} {name}: {why}");
                    continue;
                }
            };
            let difference = read_back_difference(definition, notation, &written.text);
            assert_eq!(difference, None, "{at} {name}: {}", written.text);
        }
    }
    let told = export(&asking()[4], Notation::named("cpfg").unwrap()).unwrap().left_out;
    assert_eq!(told, ["The outlines of shapes are left out."]);
}

#[test]
fn places_in_lpy_have_its_axes() {
    let definition = &asking()[2];
    let text = export(definition, Notation::named("lpy").unwrap()).unwrap().text;
    // L-Py's z is upwards: it is our y, and its y is our x.
    assert!(text.contains("?H(c,a,b)?P(z,x,y) < A(w):"), "{text}");
    let flat = export(&asking()[0], Notation::named("lpy").unwrap()).unwrap().text;
    assert!(
        flat.contains("?P(x_y,x,y) < A:\n  if y<3 and (not (x>2 or x<-2)): produce F(1)[+(40)?P(0,0,0)A]"),
        "{flat}"
    );
}

#[test]
fn questions_that_others_lack_are_refused() {
    let rules = [
        "?C(n,r) < A : n < 2 -> FA",
        "?S(q,c) < A : q > 0.5 -> FA",
        "shape s = ball(0,0,0,9)\n?P(x,y,z) < A : inside(s,x,y,z) -> FA",
    ];
    for (rules, query) in rules.into_iter().zip(["?C(0,1)", "?S(1,1)", "?P(0,0,0)"]) {
        let definition = Definition { axiom: format!("{query}A"), rules: rules.into(), ..Definition::default() };
        for (name, label) in [("cpfg", "cpfg"), ("lpy", "L-Py"), ("houdini", "Houdini")] {
            let Err(Refusal(why)) = export(&definition, Notation::named(name).unwrap()) else {
                panic!("{name} {rules}")
            };
            assert!(
                why.starts_with(label) && (why.contains("queries") || why.ends_with("the function inside")),
                "{why}"
            );
        }
    }
}

/// Random systems of plain symbols.
fn systems() -> impl Strategy<Value = Definition> {
    let word = |most| proptest::collection::vec(proptest::sample::select(b"FFGfXYAbn+-|[]!#;&>".to_vec()), 1..most);
    let balanced = |word: Vec<u8>| {
        let mut depth = 0;
        let mut text = String::new();
        for symbol in word.into_iter().map(char::from) {
            match symbol {
                ']' if depth == 0 => continue,
                '[' => depth += 1,
                ']' => depth -= 1,
                _ => {}
            }
            text.push(symbol);
        }
        text + &"]".repeat(depth)
    };
    let word = move |most| word(most).prop_map(balanced);
    let rule = (proptest::sample::select(vec!['F', 'G', 'X', 'A', 'b', 'f', '+']), word(8), 0_u32..4);
    let angle = proptest::sample::select(vec![90.0, 60.0, 45.0, 72.0, 25.7, 137.5, 5.5, 22.5, -30.0, 120.0]);
    let overrides = proptest::sample::select(vec![
        "",
        "A: draw",
        "G: move",
        "X: draw 0.5\nA: turn left 30",
        "b: draw, turn left",
        "b: swap turns\nX: length times 0.5",
    ]);
    let dialect = proptest::sample::select(Dialect::ALL.to_vec());
    let more = (proptest::sample::select(vec![90.0, 0.0, 45.0, 30.0]), proptest::option::weighted(0.2, angle.clone()));
    let more = (more, proptest::sample::select(vec![1.0, 10.0, 0.3]), dialect);
    let rules = proptest::collection::vec(rule, 1..4);
    (word(8), rules, angle, overrides, more).prop_map(|(axiom, rules, angle, overrides, more)| {
        let ((heading, right_angle), step, dialect) = more;
        let line = |(symbol, word, weight): (char, String, u32)| match weight {
            0 => format!("{symbol} -> {word} : 1"),
            1 => format!("{symbol} -> {word} : 0.5"),
            _ => format!("{symbol} -> {word}"),
        };
        let rules = rules.into_iter().map(line).collect::<Vec<_>>().join("\n");
        let (axiom, overrides) = (axiom + "F", overrides.to_owned());
        let usual = Definition::default();
        Definition { axiom, rules, angle, overrides, heading, right_angle, step, dialect, iterations: 2, ..usual }
    })
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn random_systems_read_back(definition in systems()) {
        for name in READ_BACK {
            let notation = Notation::named(name).unwrap();
            if let Ok(written) = export(&definition, notation) {
                let difference = read_back_difference(&definition, notation, &written.text);
                prop_assert_eq!(difference, None, "{}: {}", name, written.text);
            }
        }
        if !System::new(&definition).is_ok_and(|system| system.has_choices()) {
            check_inkscape("a random system", &definition);
        }
    }
}
