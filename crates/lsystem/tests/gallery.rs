//! Every file of `data_in` is fit for the gallery.

use lsystem::{Limits, System, draw, read_json, write_json};
use std::collections::BTreeSet;
use std::path::Path;

/// Systems that are there for their strings.
const DRAWS_NOTHING: [&str; 2] = ["LRI (prose rule only)", "README S->SS"];

/// Folder, file name and text of every file.
fn files() -> Vec<(String, String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in");
    let list = |path: &Path| std::fs::read_dir(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let folders = list(&root).map(|entry| entry.expect("readable"));
    let files = folders.flat_map(|folder| {
        let name = folder.file_name().display().to_string();
        list(&folder.path()).map(move |file| {
            let path = file.expect("readable").path();
            let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            (name.clone(), path.file_name().map_or_else(String::new, |name| name.display().to_string()), text)
        })
    });
    files.collect()
}

#[test]
fn files_read_without_a_doubt_and_draw() {
    let mut names = BTreeSet::new();
    for (folder, file, text) in files() {
        let what = format!("{folder}/{file}");
        assert!(file.ends_with(".json"), "{what}");
        let (definition, diagnostics) = read_json(&text);
        assert_eq!(diagnostics, [], "{what}");
        let definition = definition.unwrap_or_else(|| panic!("{what}"));
        for words in [&definition.name, &definition.title, &definition.source] {
            assert!(!words.trim().is_empty(), "{what}");
        }
        let (system, diagnostics) = System::new(&definition);
        assert_eq!(diagnostics, [], "{what}");
        let system = system.unwrap_or_else(|| panic!("{what}"));
        let drawing = draw(&system, definition.iterations, &Limits::default());
        let drawing = drawing.unwrap_or_else(|limit| panic!("{what}: {limit:?}"));
        assert_eq!(drawing.bounds().is_none(), DRAWS_NOTHING.contains(&definition.name.as_str()), "{what}");
        assert!(names.insert((folder, definition.name)), "{what}: its name is taken");
    }
    assert!(names.len() >= 80, "{}", names.len());
}

#[test]
fn files_survive_being_written() {
    for (folder, file, text) in files() {
        let (definition, _) = read_json(&text);
        let definition = definition.unwrap_or_else(|| panic!("{folder}/{file}"));
        let (again, diagnostics) = read_json(&write_json(&definition));
        assert_eq!((again.as_ref(), diagnostics.as_slice()), (Some(&definition), [].as_slice()), "{folder}/{file}");
    }
}
