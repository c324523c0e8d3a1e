//! The exercises of the gallery and of the lesson: `www/exercises.json`, veiled as in links.

use anyhow::{Context, Result, bail};
use fs_err as fs;
use lsystem::Diagnostic;
use lsystem::course::{Asks, Exercise, Marker};
use serde_json::{Value, json};
use std::path::Path;

/// The most bytes of a string on a card.
const MAX_TEXT: usize = 60;

/// An array of `{id, shelf, title, text, x}` for the exercises in `file`. Their targets are systems of the `gallery`, or
/// systems of their own. An exercise that its own target does not solve fails.
pub(crate) fn exercises(file: &Path, gallery: &Value) -> Result<Vec<Value>> {
    let entries: Vec<Value> = serde_json::from_str(&fs::read_to_string(file)?)?;
    entries
        .into_iter()
        .map(|mut entry| {
            let id = entry["id"].as_str().context("an exercise without id")?.to_owned();
            if let Some(path) = entry["system"].as_str() {
                let path = format!("{path}.json");
                let found = gallery.as_array().into_iter().flatten().find(|system| system["path"] == path);
                entry["target"] =
                    found.with_context(|| format!("{id}: there is no system {path}"))?["definition"].clone();
            }
            let shelf = entry["shelf"].clone();
            let exercise: Exercise = serde_json::from_value(entry).with_context(|| format!("in exercise {id}"))?;
            let text = try_out(&exercise).with_context(|| format!("in exercise {id}"))?;
            Ok(json!({ "id": id, "shelf": shelf, "title": exercise.title, "text": text, "x": exercise.write() }))
        })
        .collect()
}

/// Marks the target as an answer to its own exercise, and the start. Returns the string to derive, if it is asked for.
pub(crate) fn try_out(exercise: &Exercise) -> Result<Option<String>> {
    let words =
        |errors: Vec<Diagnostic>| errors.iter().map(|problem| problem.message.clone()).collect::<Vec<_>>().join(" ");
    let mut marker = Marker::new(exercise.clone()).map_err(|errors| anyhow::anyhow!(words(errors)))?;
    let mut answer = exercise.target.clone();
    answer.rules = exercise.own_rules(&answer.rules);
    let mark = marker.mark(&answer);
    if !mark.is_solved && exercise.asks != Asks::Program {
        bail!("the target does not solve it: {} {}", mark.words, words(mark.errors));
    }
    if marker.mark(&exercise.start()).is_solved {
        bail!("the start solves it already");
    }
    Ok(marker.text(MAX_TEXT).map(str::to_owned))
}

/// Replaces the names of exercises in links of a page, as in `x=@koch`, by the exercises.
pub(crate) fn named(page: &str, exercises: &[Value]) -> Result<String> {
    let mut parts = page.split("x=@");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|c: char| !c.is_ascii_alphanumeric() && c != '-').unwrap_or(part.len());
        let found = exercises.iter().find(|exercise| exercise["id"] == part[..end]);
        let found = found.with_context(|| format!("there is no exercise {}", &part[..end]))?;
        text.push_str("x=");
        text.push_str(found["x"].as_str().unwrap_or_default());
        text.push_str(&part[end..]);
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exercises_are_veiled_and_named() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("exercises.json");
        let gallery =
            json!([{ "path": "a/koch.json", "definition": { "axiom": "F", "rules": "F -> F+F--F+F", "angle": 60 } }]);
        fs::write(&file, r#"[{"id": "one-rule", "shelf": "rising", "title": "One rule", "system": "a/koch"}]"#)
            .unwrap();
        let found = exercises(&file, &gallery).unwrap();
        let x = found[0]["x"].as_str().unwrap();
        assert_eq!(Exercise::read(x).unwrap().target.rules, "F -> F+F--F+F");
        assert_eq!(named("a x=@one-rule\" b", &found).unwrap(), format!("a x={x}\" b"));
        assert!(named("x=@other", &found).is_err());
        fs::write(&file, r#"[{"id": "a", "system": "a/koch", "first": {"rules": "F -> F+F--F+F"}}]"#).unwrap();
        assert!(format!("{:#}", exercises(&file, &gallery).unwrap_err()).contains("the start solves it"));
    }
}
