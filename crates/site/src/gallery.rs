//! The gallery: every system of `data_in` in one file, read by the core at build time.

use anyhow::{Context, Result, bail};
use fs_err as fs;
use lsystem::drawing::kind;
use lsystem::syntax::Field;
use lsystem::{Definition, Diagnostic, Figure, Limits, System, read_json, render_diagnostic};
use serde_json::{Value, json};
use std::path::Path;

/// A system of the gallery.
pub(crate) struct Entry {
    /// The file's path below `data_in`, with slashes.
    pub(crate) path: String,
    pub(crate) definition: Definition,
    pub(crate) system: System,
    pub(crate) figure: Figure,
}

/// An array of `{path, kinds, solid, definition}` for the JSON files below `folder`, sorted by path. The shelves stand in
/// `www/js/shelves.json`.
pub(crate) fn gallery(folder: &Path) -> Result<Value> {
    let entry = |entry: Entry| {
        json!({
            "path": entry.path,
            "kinds": kind(&entry.system).split(", ").collect::<Vec<_>>(),
            "solid": entry.figure.is_solid(),
            "definition": entry.definition,
        })
    };
    systems(folder)?.map(|found| found.map(entry)).collect()
}

/// The systems of the JSON files below `folder`, sorted by path, each drawn when it is its turn.
pub(crate) fn systems(folder: &Path) -> Result<impl Iterator<Item = Result<Entry>>> {
    let mut files = walkdir::WalkDir::new(folder).into_iter().collect::<Result<Vec<_>, _>>()?;
    files.retain(|file| file.path().extension().is_some_and(|ending| ending == "json"));
    files.sort_by(|a, b| a.path().cmp(b.path()));
    Ok(files.into_iter().map(move |file| {
        let path = file.path().strip_prefix(folder)?.to_str().context("a name that is not UTF-8")?.replace('\\', "/");
        let (definition, system) = read(&path, &fs::read_to_string(file.path())?)?;
        let Ok(figure) = Figure::draw(&system, definition.iterations, &Limits::default()) else {
            bail!("{path} grows too large for the gallery");
        };
        Ok(Entry { path, definition, system, figure })
    }))
}

/// Reads one file. A system with errors fails the build.
fn read(path: &str, text: &str) -> Result<(Definition, System)> {
    let (definition, diagnostics) = read_json(text);
    refuse(path, &diagnostics, |_| text)?;
    let definition = definition.with_context(|| format!("{path} has no system"))?;
    refuse(path, &System::problems(&definition), |field| definition.text(field).unwrap_or_default())?;
    let system = System::new(&definition)?;
    Ok((definition, system))
}

/// Fails if a diagnostic is an error.
fn refuse<'a>(path: &str, diagnostics: &[Diagnostic], text: impl Fn(Field) -> &'a str) -> Result<()> {
    let errors: Vec<_> = diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).collect();
    if errors.is_empty() {
        return Ok(());
    }
    let shown: Vec<_> = errors.iter().map(|error| render_diagnostic(error, path, text(error.field))).collect();
    bail!("{path} cannot be shown in the gallery\n{}", shown.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gathers_systems_by_path() {
        let folder = tempfile::tempdir().unwrap();
        for (path, axiom) in [("b/two.json", "F"), ("a/deep/one.json", "X"), ("a/note.txt", "")] {
            let text = format!(r#"{{"name": "{path}", "initial": "{axiom}", "rules": {{"F": "FF"}}}}"#);
            let file = folder.path().join(path);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, text).unwrap();
        }
        let gallery = gallery(folder.path()).unwrap();
        assert_eq!(gallery.as_array().unwrap().len(), 2);
        assert_eq!(gallery[0]["path"], "a/deep/one.json");
        assert_eq!(gallery[0]["definition"]["axiom"], "X");
        assert_eq!(gallery[1]["path"], "b/two.json");
        assert_eq!(gallery[1]["kinds"], json!(["deterministic"]));
        assert_eq!(gallery[1]["solid"], false);
    }

    #[test]
    fn refuses_what_cannot_be_shown() {
        let error = read("a/b.json", r#"{"initial": "F", "rules": ["F = FF"]}"#).unwrap_err().to_string();
        assert!(error.contains("a/b.json") && error.contains("error: "), "{error}");
        assert!(read("c.json", "{").unwrap_err().to_string().contains("c.json"));
    }
}
