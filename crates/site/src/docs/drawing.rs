//! Drawings in documents: fenced blocks of the language `lsystem`, with the keys of docs/links.md.
//!
//! ```text
//! title: Koch curve
//! axiom: F
//! rules: F -> F+F--F+F
//! n: 3
//! angle: 60
//! controls: n,angle
//! ```
//!
//! A repeated key adds a line to its value.

use super::markdown::escape;
use anyhow::{Context, Result, bail, ensure};
use lsystem::syntax::{FIELDS, Value};
use lsystem::{Definition, System, render_diagnostic};
use std::fmt::Write as _;

/// The key of an embedded drawing that is not a field of a definition.
const CONTROLS: &str = "controls";

/// The frame that shows the drawing of a block.
pub(super) fn frame(block: &str) -> Result<String> {
    let values = read(block)?;
    check(&values)?;
    let title = values.iter().find(|(key, _)| key == "title").context("the drawing has no title")?;
    let mut hash = "#v=1".to_owned();
    for (key, value) in &values {
        write!(hash, "&{key}={}", encode(value))?;
    }
    // A frame with the rules needs more room on a phone, where they are below the picture.
    let class =
        if values.iter().any(|(key, value)| key == CONTROLS && value.contains("rules")) { " with-rules" } else { "" };
    Ok(format!(
        "<iframe class=\"drawing{class}\" title=\"Drawing: {}\" loading=\"lazy\" src=\"../embed.html{}\"></iframe>\n",
        escape(&title.1),
        escape(&hash)
    ))
}

/// The keys and values of a block.
fn read(block: &str) -> Result<Vec<(String, String)>> {
    let mut values: Vec<(String, String)> = vec![];
    for line in block.lines().filter(|line| !line.trim().is_empty()) {
        let (key, value) = line.split_once(':').with_context(|| format!("`{line}` is not `key: value`"))?;
        let (key, value) = (key.trim(), value.trim());
        ensure!(key == CONTROLS || FIELDS.iter().any(|field| field.link == key), "drawings have no key `{key}`");
        match values.iter_mut().find(|(each, _)| each == key) {
            Some((_, text)) => write!(text, "\n{value}")?,
            None => values.push((key.to_owned(), value.to_owned())),
        }
    }
    Ok(values)
}

/// Fails if the system has a problem, so that no document shows a broken drawing.
fn check(values: &[(String, String)]) -> Result<()> {
    let mut definition = Definition::default();
    for (key, text) in values {
        let Some(spec) = FIELDS.iter().find(|field| field.link == key) else { continue };
        // Links write lists without brackets; the drawing depends only on texts and numbers.
        if text.contains(',') && spec.link != "rules" {
            continue;
        }
        let value = match serde_json::from_str(text) {
            Ok(value) if spec.expected.takes(&value) => value,
            _ => Value::Text(text.clone()),
        };
        if spec.is_defined() && matches!(value, Value::Number(_) | Value::Text(_)) && spec.admits(&value) {
            spec.set(&mut definition, &value);
        }
    }
    if let Some(problem) = System::problems(&definition).first() {
        let text = definition.text(problem.field).unwrap_or_default();
        bail!("the drawing has a problem\n{}", render_diagnostic(problem, "drawing", text));
    }
    ensure!(!definition.axiom.is_empty(), "the drawing has no system");
    Ok(())
}

/// A value in a link, with the characters of docs/links.md unescaped.
fn encode(value: &str) -> String {
    value.bytes().fold(String::new(), |mut text, byte| {
        if byte.is_ascii_alphanumeric() || b"-._~!*',;:@/=+".contains(&byte) {
            text.push(char::from(byte));
        } else {
            _ = write!(text, "%{byte:02X}");
        }
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLANT: &str = "title: Plant \"1\"\naxiom: X\nrules: X -> F[+X]X\nrules: F -> FF\nn: 5\npalette: 1b4965\n";

    #[test]
    fn becomes_a_frame() {
        let html = frame(&format!("{PLANT}controls: n,rules\n")).unwrap();
        assert_eq!(
            html,
            "<iframe class=\"drawing with-rules\" title=\"Drawing: Plant &quot;1&quot;\" loading=\"lazy\" \
             src=\"../embed.html#v=1&amp;title=Plant%20%221%22&amp;axiom=X\
             &amp;rules=X%20-%3E%20F%5B+X%5DX%0AF%20-%3E%20FF&amp;n=5&amp;palette=1b4965&amp;controls=n,rules\"></iframe>\n"
        );
    }

    #[test]
    fn refuses_broken_drawings() {
        frame(PLANT).unwrap();
        for wrong in [
            "axiom: F",
            "title: a",
            "title: a\naxiom: F\nrule: F",
            "title: a\naxiom",
            "title: a\naxiom: F\nrules: F -> -> F",
        ] {
            assert!(frame(wrong).is_err(), "{wrong}");
        }
    }
}
