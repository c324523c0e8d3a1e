//! Cases shared by all readers, and the summary of a result.

mod drawn;

use crate::{Entry, Imported, import};
use expect_test::Expect;
use lsystem_base::number::number;

/// A result as text: one block for each entry.
pub(super) fn summary(text: &str) -> String {
    let Some(Imported { notation, entries, .. }) = import(text) else { return "not recognised".to_owned() };
    let entries: Vec<String> = entries.iter().map(entry).collect();
    format!("{notation}\n{}", entries.join("\n"))
}

fn entry(entry: &Entry) -> String {
    let mut lines = vec![format!("[{}]", entry.name)];
    if let Some(d) = &entry.definition {
        let mut facts = vec![format!("n {}", d.iterations), format!("angle {}", number(d.angle))];
        facts.extend(d.right_angle.map(|angle| format!("right {}", number(angle))));
        facts.push(format!("heading {}", number(d.heading)));
        facts.push(d.dialect.name().to_owned());
        if d.step != 1.0 {
            facts.push(format!("step {}", number(d.step)));
        }
        if d.seed != 0 {
            facts.push(format!("seed {}", d.seed));
        }
        lines.push(facts.join(", "));
        lines.push(format!("  {}", d.axiom));
        lines.extend(d.rules.lines().map(|line| format!("  {line}")));
        lines.extend(d.overrides.lines().map(|line| format!("  | {line}")));
    }
    for remark in &entry.remarks {
        let (mark, at, text) = (if remark.refused { "refused" } else { "note" }, remark.line, &remark.text);
        lines.push(format!("{mark} {at} {text:?}: {}", remark.message));
    }
    lines.join("\n")
}

/// Compares the summary of a text with the expected one.
#[track_caller]
#[expect(clippy::needless_pass_by_value, reason = "the macro `expect!` makes a value")]
pub(super) fn check(text: &str, expected: Expect) {
    expected.assert_eq(&summary(text));
}

#[test]
fn ordinary_texts_and_single_lines_are_not_recognised() {
    for text in [
        "",
        "F -> FF",
        "F -> F[+F]F\nX -> F",
        "F=FF",
        "A < B > C -> D",
        "r = 0.9\nA(l) : l > 0.1 -> F(l)A(l*r)",
        "The axiom of choice is a statement { about sets }.",
        "{}",
        "[1, 2, 3]",
        "F++F++F",
        "ignore: +-\nA < B -> C",
        "p1: F -> FF",
        "Angle of attack",
        "const f = (x) => { return x; };",
    ] {
        assert_eq!(import(text), None, "{text}");
    }
}
