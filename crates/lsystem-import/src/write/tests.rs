//! What is written reads back as a system that draws the same, or is refused with a reason.

use super::compare::difference;
use super::{NOTATIONS, Notation, Refusal, export};
use crate::import;
use lsystem_files::read_json;
use lsystem_syntax::Definition;
use std::collections::BTreeMap;
use std::path::Path;

/// The notations that the readers of this library read. TikZ's reader leaves out the rotation of the picture.
const READ_BACK: [&str; 8] = ["text", "tikz", "js", "fractint", "houdini", "cpfg", "lpy", "anvaka"];

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
    }
    for ((notation, reason), count) in reasons {
        println!("{notation}: {count} x {reason}");
    }
    assert!(wrong.is_empty(), "{} differ\n{}", wrong.len(), wrong.join("\n"));
}
