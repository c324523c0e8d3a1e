//! Texts as people write and paste them, with what they must give: the cases of `foreign-cases.json`, and more by kind.

use lsystem_base::Limits;
use lsystem_drawing::{Plane, System, draw, expand};
use lsystem_import::{Entry, Fate, import};
use lsystem_syntax::Definition;
use serde_json::Value;

/// The segments of a system as `(x0, y0, x1, y1)`, seen from the front.
fn segments(definition: &Definition, n: u32) -> Vec<[f64; 4]> {
    let system = System::new(definition).unwrap();
    let drawing = draw::<Plane>(&system, n, &Limits::default()).unwrap();
    drawing.segments().map(|segment| [segment.from[0], segment.from[1], segment.to[0], segment.to[1]]).collect()
}

fn string(definition: &Definition, n: u32) -> String {
    expand(&System::new(definition).unwrap(), n, &Limits::default()).unwrap()
}

/// Segments moved and scaled so that the first one begins at the origin and has length 1.
fn placed(segments: &[[f64; 4]]) -> Vec<[f64; 4]> {
    let [x, y, ..] = segments[0];
    let [dx, dy] = [segments[0][2] - x, segments[0][3] - y];
    let scale = (dx * dx + dy * dy).sqrt();
    segments.iter().map(|s| [(s[0] - x) / scale, (s[1] - y) / scale, (s[2] - x) / scale, (s[3] - y) / scale]).collect()
}

/// Why a case is not as it should be.
pub(crate) fn problem(case: &Value) -> Option<String> {
    let text = case["text"].as_str().unwrap();
    let want = &case["want"];
    let found = import(text);
    if want["none"] == true {
        return found.map(|found| format!("recognised: {found:#?}"));
    }
    let Some(imported) = found else { return Some("not recognised".to_owned()) };
    let entries = &imported.entries;
    let refused = |entry: &Entry| entry.definition.is_none();
    if want["refuse"] == true {
        return (!entries.iter().all(refused)).then(|| format!("not refused: {entries:#?}"));
    }
    if case["refusal_is_right_too"] == true && entries.iter().any(refused) {
        return None;
    }
    if let Some(systems) = want["systems"].as_u64()
        && entries.len() as u64 != systems
    {
        return Some(format!("{} systems: {entries:#?}", entries.len()));
    }
    if let Some(each) = want["each"].as_array() {
        return (each.len() != entries.len())
            .then(|| format!("{} systems: {entries:#?}", entries.len()))
            .or_else(|| each.iter().zip(entries).find_map(|(want, entry)| differs(want, entry)));
    }
    let entry = &entries[0];
    let Some(definition) = &entry.definition else { return Some(format!("refused: {entry:#?}")) };
    let shown = || format!("{imported:#?}");
    for (n, count) in want["segs"].as_object().into_iter().flatten() {
        let n: u32 = n.parse().unwrap();
        let system = System::new(definition).unwrap();
        let found = lsystem_drawing::Figure::draw(&system, n, &Limits::default()).unwrap().segment_count();
        if found != u128::from(count.as_u64().unwrap()) {
            return Some(format!("{found} segments after {n}: {}", shown()));
        }
    }
    if let Some(angle) = want["angle"].as_f64()
        && (definition.angle - angle).abs() > 1e-6
    {
        return Some(format!("angle {}", definition.angle));
    }
    if let Some(angles) = want["angles"].as_array() {
        let found = [definition.angle, definition.right_angle.unwrap_or(definition.angle)];
        if angles.iter().zip(found).any(|(angle, found)| angle.as_f64() != Some(found)) {
            return Some(format!("angles {found:?}"));
        }
    }
    if let Some(n) = want["n"].as_u64()
        && u64::from(definition.iterations) != n
    {
        return Some(format!("n {}", definition.iterations));
    }
    if let Some(word) = want["word"].as_str() {
        let found = string(definition, want["word_n"].as_u64().unwrap_or(1) as u32);
        if found.replace(' ', "") != word {
            return Some(format!("string {found}: {}", shown()));
        }
    }
    if let Some(word) = want["noword"].as_str()
        && definition.rules.lines().any(|line| line.split(" : ").next().unwrap_or(line).contains(word))
    {
        return Some(format!("rules {}", definition.rules));
    }
    if let Some(shape) = want["shape"].as_array() {
        let wanted: Vec<[f64; 4]> =
            shape.iter().map(|one| core::array::from_fn(|at| one[at].as_f64().unwrap())).collect();
        let system = System::new(definition).unwrap();
        if !system.is_solid() {
            let found = placed(&segments(definition, definition.iterations));
            let near = |(a, b): (&[f64; 4], &[f64; 4])| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
            if found.len() != wanted.len() || !found.iter().zip(&placed(&wanted)).all(near) {
                return Some(format!("shape {found:?}: {}", shown()));
            }
        }
    }
    if let Some(weights) = want["weights"].as_array() {
        let found: Vec<_> =
            definition.rules.lines().filter_map(|line| line.rsplit_once(" : ")?.1.parse::<f64>().ok()).collect();
        if !weights.iter().filter_map(Value::as_f64).eq(found.iter().copied()) {
            return Some(format!("weights {found:?}"));
        }
    }
    if let Some([rule, angle]) = want["right"].as_array().map(Vec::as_slice) {
        let turns = |d: &Definition| {
            d.rules == *rule && angle.as_f64() == Some(d.angle) && d.overrides.contains("+: turn right")
        };
        if !entries.iter().filter_map(|entry| entry.definition.as_ref()).any(turns) {
            return Some(format!("no turn to the right: {}", shown()));
        }
    }
    if let Some(words) = want["remark"].as_str()
        && !entry.remarks.iter().any(|remark| words.split('|').any(|word| remark.message.contains(word)))
    {
        return Some(format!("no remark: {}", shown()));
    }
    None
}

/// How a system is another one than a case wants.
fn differs(want: &Value, entry: &Entry) -> Option<String> {
    let Some(d) = &entry.definition else { return Some(format!("refused: {entry:#?}")) };
    let other = |what: &str, found: String| Some(format!("{what} {found}: {entry:#?}"));
    if want["axiom"].as_str().is_some_and(|axiom| axiom != d.axiom) {
        return other("axiom", d.axiom.clone());
    }
    if want["rules"].as_array().is_some_and(|rules| !rules.iter().filter_map(Value::as_str).eq(d.rules.lines())) {
        return other("rules", d.rules.clone());
    }
    let numbers = [("angle", d.angle), ("heading", d.heading), ("n", f64::from(d.iterations))];
    for (key, found) in numbers {
        if want[key].as_f64().is_some_and(|wanted| (wanted - found).abs() > 1e-6) {
            return other(key, found.to_string());
        }
    }
    if want["do"].as_str().is_some_and(|wanted| wanted != d.overrides) {
        return other("custom symbols", d.overrides.clone());
    }
    let variations = [d.angle_variation, d.length_variation];
    if want["variations"].as_array().is_some_and(|wanted| !wanted.iter().filter_map(Value::as_f64).eq(variations)) {
        return other("variations", format!("{variations:?}"));
    }
    let n = want["at"].as_u64()? as u32;
    let drawn = segments(d, n);
    let [x, y] = drawn.last().map_or([0.0; 2], |last| [last[2], last[3]]);
    let near = |at: usize, found: f64| (want["end"][at].as_f64().unwrap() - found / d.step).abs() < 1e-3;
    if Some(drawn.len() as u64) != want["count"].as_u64() || !near(0, x) || !near(1, y) {
        return other("drawn", format!("{} segments to {x}, {y}", drawn.len()));
    }
    None
}

#[test]
fn cases_of_others() {
    let cases: Value = serde_json::from_str(include_str!("foreign-cases.json")).unwrap();
    let cases = cases["cases"].as_array().unwrap();
    let wrong: Vec<String> =
        cases.iter().filter_map(|case| Some(format!("{}: {}", case["id"], problem(case)?))).collect();
    assert!(cases.len() >= 40);
    assert!(wrong.is_empty(), "{} wrong\n{}", wrong.len(), wrong.join("\n"));
}

/// A text, with what its first system must be: axiom, rules, angle, and n if it is given.
fn check(text: &str, axiom: &str, rules: &[&str], angle: f64, n: Option<u32>) -> Option<String> {
    let Some(imported) = import(text) else { return Some(format!("not recognised: {text}")) };
    let entry = &imported.entries[0];
    let Some(d) = &entry.definition else { return Some(format!("refused: {text}\n{entry:#?}")) };
    let found: Vec<&str> = d.rules.lines().collect();
    let same =
        d.axiom == axiom && found == rules && (d.angle - angle).abs() < 1e-3 && n.is_none_or(|n| n == d.iterations);
    (!same)
        .then(|| format!("{text}\n-> {} | {found:?} | {} | {}\n{:#?}", d.axiom, d.angle, d.iterations, entry.remarks))
}

#[test]
fn kinds_of_texts() {
    let koch = &["F -> F+F-F-F+F"][..];
    let all = [
        check("axiom: F\nangle: 30\nn = 1\nF -> F[&F][^F]", "F", &["F -> F[&F][^F]"], 30.0, Some(1)),
        check("axiom: A\nangle: 30\nn = 1\nA -> A[+$A]F", "A", &["A -> A[+$A]F"], 30.0, Some(1)),
        check("axiom: F\nangle: 45\nn = 1\nF -> F[\\\\+F]F", "F", &["F -> F[\\\\+F]F"], 45.0, Some(1)),
        check("axiom: F\nangle: 90\nn = 1\nF -> F[+(30)F]-(20)F", "F", &["F -> F[+(30)F]-(20)F"], 90.0, Some(1)),
        check("axiom: F\nangle: 90\nF -> F+F // turn once", "F", &["F -> F+F"], 90.0, None),
        check(
            "The axiom is F and the rule is F -> F+F--F+F. The angle is 60 degrees.",
            "F",
            &["F -> F+F--F+F"],
            60.0,
            None,
        ),
        check("Axiom: F Rules: F → F+F Angle: 45 n: 1", "F", &["F -> F+F"], 45.0, Some(1)),
        check(
            "Axiom: F\nF -> F[+F]F : 0.9\nF -> F[-F]F : 0.1\nangle 20",
            "F",
            &["F -> F[+F]F : 0.9", "F -> F[-F]F : 0.1"],
            20.0,
            None,
        ),
        check(
            "Axiom: F\nF -> F[+F]F (90 %)\nF -> F[-F]F (10 %)\nangle 20",
            "F",
            &["F -> F[+F]F : 0.9", "F -> F[-F]F : 0.1"],
            20.0,
            None,
        ),
        check(
            "Axiom: F\n0.9: F -> F[+F]F\n0.1: F -> F[-F]F\nangle 20",
            "F",
            &["F -> F[+F]F : 0.9", "F -> F[-F]F : 0.1"],
            20.0,
            None,
        ),
        check(
            "Axiom: F\nF (0.9) → F[+F]F\nF (0.1) → F[-F]F\nangle 20",
            "F",
            &["F -> F[+F]F : 0.9", "F -> F[-F]F : 0.1"],
            20.0,
            None,
        ),
        check(
            "Axiom: F\nF →.9 F[+F]F\nF →.1 F[-F]F\nangle 20",
            "F",
            &["F -> F[+F]F : 0.9", "F -> F[-F]F : 0.1"],
            20.0,
            None,
        ),
        check("Axiom: F\nF -> F+F\nAngle: 360/7", "F", &["F -> F+F"], 51.428_571, None),
        check("Axiom: F\nF -> F+F\ntheta = 2π/5", "F", &["F -> F+F"], 72.0, None),
        check("Axiom: F\nF -> F+F\nangle: 1.047 rad", "F", &["F -> F+F"], 59.988_68, None),
        check("Axiom: F\nF -> F+F\nangle: 25,7", "F", &["F -> F+F"], 25.7, None),
        check("Axiom: A\nA -> \nF -> FF\nangle: 60\nn = 2", "A", &["A -> *", "F -> FF"], 60.0, Some(2)),
        check("Axiom: XF\nX → ε\nF -> FF\nangle: 60", "XF", &["X -> *", "F -> FF"], 60.0, None),
        check(
            "Axiom: 1F\n1 → (eliminated at each iteration)\nF -> FF\nangle: 60",
            "1F",
            &["1 -> *", "F -> FF"],
            60.0,
            None,
        ),
        check("axiom: A\nA -> AB\nangle: 60\nn = 0 : A\nn = 1 : AB\nn = 2 : ABB", "A", &["A -> AB"], 60.0, None),
        check("Each angle is sharp.\naxiom: F\nF -> F+F\nangle: 60", "F", &["F -> F+F"], 60.0, None),
        check("In order to draw it\naxiom: F\nF -> F+F\nangle: 60\nn = 3", "F", &["F -> F+F"], 60.0, Some(3)),
        check("axiom: X; rules: X -> F+X; angle: 60", "X", &["X -> F+X"], 60.0, None),
        check("Axiom: (X)\nRules: X -> F+X\nAngle: 60", "X", &["X -> F+X"], 60.0, None),
        check("**Axiom:** `F`\n**Rules:** `F -> F+F`\n**Angle:** 60", "F", &["F -> F+F"], 60.0, None),
        check("• Axiom: “F-F”\n• Rule: F → F+F\n• Angle: 60°", "F-F", &["F -> F+F"], 60.0, None),
        check(
            "ω : A(1)\nA(s) : * → F(s)[+A(s/2)][-A(s/2)]\nangle: 60",
            "A(1)",
            &["A(s) -> F(s)[+A(s/2)][-A(s/2)]"],
            60.0,
            None,
        ),
        check("Axiom: F\nF = F+F-F-F+F\nAngle: 90", "F", koch, 90.0, None),
        check("Axiom: F\nF : F+F-F-F+F\nAngle: 90", "F", koch, 90.0, None),
        check("Axiom: F\nF := F+F-F-F+F\nAngle: 90", "F", koch, 90.0, None),
        check("Axiom: F\nF ::= F+F-F-F+F\nAngle: 90", "F", koch, 90.0, None),
        check("Axiom: F\nF > F+F-F-F+F\nAngle: 90", "F", koch, 90.0, None),
        check("Startwort: F\nRegeln: F → F+F-F-F+F\nWinkel: 90°\nIterationen: 3", "F", koch, 90.0, Some(3)),
        check("axiome : F\nrègles : F → F+F-F-F+F\nangle : 90\nprofondeur : 3", "F", koch, 90.0, Some(3)),
        check("axiom: X\nX -> XFX-F>X->\nangle: 60", "X", &["X -> XFX-F>X->"], 60.0, None),
        check(
            "var axiom = \"X\";\nvar rules = [];\nrules[0] = {a: \"X\", b: \"F[+X]F[-X]+X\"};\nrules[1] = {a: \"F\", b: \"FF\"};",
            "X",
            &["X -> F[+X]F[-X]+X", "F -> FF"],
            90.0,
            None,
        ),
        check("{axiom:'F', replace:{F:'F+G',G:'F-G'}, angle:90}", "F", &["F -> F+G", "G -> F-G"], 90.0, None),
        check(
            "return {axiom=\"FA\", rules_a=\"[&F][+F]\", angle=30, iterations=1}",
            "FA",
            &["A -> [&F][+F]"],
            30.0,
            Some(1),
        ),
        check("(def koch {:axiom \"F\" :rules {\"F\" \"F+F-F-F+F\"} :angle 90})", "F", koch, 90.0, None),
        check(
            "lsys = Dict('F' => \"F+F-F-F+F\")\naxiom = \"F\"\nrules = Dict('F' => \"F+F-F-F+F\")\nangle = 90",
            "F",
            koch,
            90.0,
            None,
        ),
        check("axiom = \"F\"\nangle = math.radians(90)\nrules = {'F': 'F+F-F-F+F'}\n", "F", koch, 90.0, None),
        check(
            "let axiom = String::from(\"F\");\nlet mut rules = HashMap::new();\nrules.insert('F', \"F+F-F-F+F\".to_string());\nlet angle = 90.0_f64.to_radians();",
            "F",
            koch,
            90.0,
            None,
        ),
        check(
            "String axiom = \"F\";\nfloat angle = PI/2;\nMap<Character, String> rules = Map.of('F', \"F+F-F-F+F\");",
            "F",
            koch,
            90.0,
            None,
        ),
        check(
            "axiom = 'F'\ndef step(s):\n  out = ''\n  for c in s:\n    if c == 'F':\n      out += 'F+F-F-F+F'\n    else:\n      out += c\nangle = 90 # L-system",
            "F",
            koch,
            90.0,
            None,
        ),
    ];
    let wrong: Vec<String> = all.into_iter().flatten().collect();
    assert!(wrong.is_empty(), "{} wrong\n{}", wrong.len(), wrong.join("\n\n"));
}

/// A document with a system in a block opens as that system.
#[test]
fn systems_in_blocks_of_documents() {
    let imported = import(include_str!("../../../docs/embedding.md")).unwrap();
    let [entry] = &imported.entries[..] else { panic!("{:#?}", imported.entries) };
    let definition = entry.definition.as_ref().unwrap();
    let facts = (&*definition.axiom, &*definition.rules, definition.angle, definition.iterations);
    assert_eq!(facts, ("F", "F -> F[+F]F[-F]F", 25.0, 4));
}

#[test]
fn meanings_in_words() {
    let draw = |text: &str| {
        let imported = import(text).unwrap_or_else(|| panic!("not recognised: {text}"));
        let definition = imported.entries[0].definition.clone().unwrap_or_else(|| panic!("{imported:#?}"));
        segments(&definition, definition.iterations)
    };
    // + turns right.
    let right = draw("axiom: F\nF -> F+F\nangle: 60\nn = 1\n+ means turn right and - means turn left.");
    assert!((right[1][2] - 0.866).abs() < 1e-3 && (right[1][3] - 1.5).abs() < 1e-3, "{right:?}");
    // B moves.
    let gaps = draw("start : A\n(A → ABA), (B → BBB)\nn = 2\nA mean draw forward and B mean move forward");
    assert_eq!(gaps.iter().map(|s| s[1].round() as i64).collect::<Vec<_>>(), [0, 2, 6, 8], "{gaps:?}");
    // The binary tree of an encyclopedia.
    let tree = draw(
        "variables : 0, 1\nconstants: \"[\", \"]\"\naxiom : 0\nrules : (1 → 11), (0 → 1[0]0)\nn = 2\n\
         0: draw a line segment ending in a leaf\n1: draw a line segment\n\
         [: push position and angle, turn left 45 degrees\n]: pop position and angle, turn right 45 degrees",
    );
    assert_eq!(tree.len(), 8, "{tree:?}");
    let x = tree.iter().flat_map(|s| [s[0], s[2]]).fold(0.0, f64::max);
    assert!((x - 1.7071).abs() < 1e-3, "{tree:?}");
    let meanings = draw("axiom: F\nF -> F+F\nn = 1\nMeanings: F → draw 80%, + → turn right 60°");
    assert!((meanings[1][2] - 0.866).abs() < 1e-3, "{meanings:?}");
    let factor = draw("axiom: F\nF -> F>F<F\nlength factor = 1.36\nangle: 90\nn = 1");
    let lengths: Vec<f64> = factor.iter().map(|s| (s[3] - s[1]).abs()).collect();
    assert!((lengths[1] / lengths[0] - 1.36).abs() < 1e-9 && (lengths[2] - lengths[0]).abs() < 1e-9, "{lengths:?}");
    let two = draw("Axiom: F\nF -> F+F-F\nLeft angle: 45\nRight angle: 60\nOrder: 1");
    assert!((two[2][2] + 0.4483).abs() < 1e-3 && (two[2][3] - 2.6730).abs() < 1e-3, "{two:?}");
    let images = import("axiom: A\nA -> AB\ndraw:\nA -> F+\nangle: 90\nn = 2").unwrap();
    let definition = images.entries[0].definition.clone().unwrap();
    assert_eq!(string(&definition, 2), "ABB", "{definition:#?}");
}

/// The account covers every text without gaps and overlaps, and nothing inside a system is passed over but white space,
/// marks and comments.
#[test]
fn the_account_covers_the_text() {
    let cases: Value = serde_json::from_str(include_str!("foreign-cases.json")).unwrap();
    for case in cases["cases"].as_array().unwrap() {
        let text = case["text"].as_str().unwrap();
        let Some(imported) = import(text) else { continue };
        let mut at = 0;
        for part in &imported.account {
            assert_eq!(part.span.start, at, "{text}");
            assert!(part.span.end > at && text.is_char_boundary(part.span.end), "{text}");
            at = part.span.end;
        }
        assert_eq!(at, text.len(), "{text}");
        assert!(imported.account.iter().any(|part| part.fate != Fate::Passed), "{text}");
    }
}

#[test]
fn systems_one_after_the_other() {
    for (text, names, angles) in [
        (
            "Koch\naxiom: F\nF -> F+F\nangle: 60\n\nDragon\naxiom: F\nF -> F-F\nangle: 90",
            ["Koch", "Dragon"],
            [60.0, 90.0],
        ),
        ("axiom='F'\nrules={'F':'F+F'}\nangle=60\naxiom='F'\nrules={'F':'F-F'}\nangle=90", ["", ""], [60.0, 90.0]),
        (
            "| Name | Axiom | Rules | Angle |\n|---|---|---|---|\n| A | F | F -> F+F | 60 |\n| B | F | F -> F-F | 90 |",
            ["A", "B"],
            [60.0, 90.0],
        ),
    ] {
        let imported = import(text).unwrap();
        let found: Vec<(&str, f64)> =
            imported.entries.iter().map(|entry| (&*entry.name, entry.definition.as_ref().unwrap().angle)).collect();
        assert_eq!(found, names.into_iter().zip(angles).collect::<Vec<_>>(), "{text}");
    }
    // Two angles of one system contradict each other.
    let imported = import("axiom: F\nF -> F+F\nangle: 60\nangle: 90").unwrap();
    assert_eq!(imported.entries[0].definition, None);
    assert_eq!(imported.entries[0].remarks.iter().filter(|remark| remark.refused).count(), 2);
}

#[test]
fn prose_and_code_without_a_system_are_passed() {
    for text in [
        "The start of the story is long. Rules are rules -> and so on. It takes 3 steps.",
        "start = \"hello\"\nrules = {\"a\": \"b\"}\n",
        "const initial = 'A';\nconst map = {B: 'C'};\n",
        "# Readme\n\nRun `cargo test` -> see the output. Order: 3\n",
        "fn main() { let start = \"x\"; match c { 'a' => \"b\", _ => \"c\" } }",
        "grammar S -> NP VP\nNP -> Det N\nstart: S",
    ] {
        assert_eq!(import(text).map(|found| format!("{found:#?}")), None, "{text}");
    }
}

/// Files of this repository without a system: programs, tables and documents that speak of L-systems.
#[test]
fn files_without_a_system_are_passed() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let found: Vec<String> = [
        "crates/lsystem-base/src/limits.rs",
        "crates/lsystem-base/src/meter.rs",
        "crates/lsystem-derive/src/counts.rs",
        "crates/lsystem-derive/src/walk.rs",
        "crates/lsystem-drawing/src/rotation.rs",
        "crates/lsystem-render/src/vantage.rs",
        "crates/lsystem-plot/src/order.rs",
        "crates/lsystem-files/src/pen.rs",
        "crates/lsystem-files/src/csv.rs",
        "crates/lsystem-film/src/easing.rs",
        "crates/lsystem-find/src/lattice.rs",
        "crates/lsystem-syntax/src/diagnostic.rs",
        "crates/lsystem-import/src/vocabulary.rs",
        "crates/lsys/src/cli.rs",
        "crates/xtask/src/main.rs",
        "www/js/view/refusal.js",
        "www/js/course/maker.js",
        "www/js/tables.js",
        "www/js/state/state.js",
        "www/js/main.js",
        "www/worker/drawing.js",
        "docs/about.md",
        "docs/films.md",
        "docs/find.md",
        "docs/growth.md",
        "docs/meshes.md",
        "docs/plotting.md",
        "docs/scale.md",
        "docs/security.md",
        "docs/worker.md",
        "ARCHITECTURE.md",
        "CHANGELOG.md",
    ]
    .into_iter()
    .filter_map(|file| {
        let text = std::fs::read_to_string(root.join(file)).unwrap();
        import(&text).map(|found| format!("{file}: {}: {:#?}", found.notation, found.entries))
    })
    .collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}
