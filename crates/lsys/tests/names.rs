//! Names mean one thing: public types and files of all shipped crates, constants, and the glossary of ARCHITECTURE.md.

use crate::program::root;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use syn::{Item, Visibility};

/// Crates of the developer, which are not shipped.
const DEVELOPMENT: [&str; 7] = ["bench", "fuzz", "outside", "site", "test-effort", "wasm-test-runner", "xtask"];
/// The most files with one name: a concept may have a file in the rooms for definitions, drawings, pictures and files.
const MAX_NAMESAKES: usize = 5;
/// Names of files that say their place, not their concept.
const PLACES: [&str; 4] = ["lib.rs", "main.rs", "mod.rs", "tests.rs"];

/// By name: the places where it stands.
type Places = BTreeMap<String, Vec<String>>;

#[test]
fn public_types_have_one_meaning() {
    let (types, constants) = names();
    assert!(types.len() > 300, "{}", types.len());
    assert_eq!(with_more_than(1, types), Places::new());
    let most = constants.into_iter().filter(|(name, _)| name.starts_with("MOST"));
    assert_eq!(most.collect::<Places>(), Places::new(), "limits begin with MAX");
}

#[test]
fn few_files_have_the_same_name() {
    let mut files = Places::new();
    for path in sources() {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if !PLACES.contains(&name.as_str()) {
            files.entry(name).or_default().push(path.display().to_string());
        }
    }
    assert_eq!(with_more_than(MAX_NAMESAKES, files), Places::new());
}

#[test]
fn the_glossary_names_public_types() {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let glossary = text.split_once("\n## Words\n").unwrap().1.split("\n## ").next().unwrap();
    let rows = glossary.lines().filter_map(|line| line.strip_prefix("| ")).skip(2);
    let (types, _) = names();
    let mut words = Places::new();
    for row in rows {
        let cells: Vec<&str> = row.split(" | ").collect();
        let name = cells.last().unwrap().trim_end_matches([' ', '|']).trim_matches('`');
        assert!(name.is_empty() || types.contains_key(name), "{row}: no public type");
        words.entry(cells[0].to_owned()).or_default().push(row.to_owned());
    }
    assert!(words.len() >= 60, "{}", words.len());
    assert_eq!(with_more_than(1, words), Places::new());
}

fn with_more_than(count: usize, names: Places) -> Places {
    names.into_iter().filter(|(_, places)| places.len() > count).collect()
}

/// The public types and all constants of the shipped crates, without their tests.
fn names() -> (Places, Places) {
    let (mut types, mut constants) = (Places::new(), Places::new());
    for path in sources() {
        let file = syn::parse_file(&fs::read_to_string(&path).unwrap()).unwrap();
        let place = path.display().to_string();
        collect(&file.items, &place, &mut types, &mut constants);
    }
    (types, constants)
}

fn collect(items: &[Item], place: &str, types: &mut Places, constants: &mut Places) {
    for item in items {
        let (vis, ident) = match item {
            Item::Enum(item) => (&item.vis, &item.ident),
            Item::Struct(item) => (&item.vis, &item.ident),
            Item::Trait(item) => (&item.vis, &item.ident),
            Item::Type(item) => (&item.vis, &item.ident),
            Item::Const(item) => {
                constants.entry(item.ident.to_string()).or_default().push(place.to_owned());
                continue;
            }
            Item::Mod(item) if !item.attrs.iter().any(|attribute| attribute.path().is_ident("cfg")) => {
                let inside = item.content.as_ref().map_or(&[][..], |(_, items)| items);
                collect(inside, place, types, constants);
                continue;
            }
            _ => continue,
        };
        if matches!(vis, Visibility::Public(_)) {
            types.entry(ident.to_string()).or_default().push(place.to_owned());
        }
    }
}

/// The sources of all shipped crates.
fn sources() -> Vec<PathBuf> {
    let mut found = vec![];
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        let name = folder.file_name().unwrap().to_string_lossy().into_owned();
        if !DEVELOPMENT.contains(&name.as_str()) {
            add(&folder.join("src"), &mut found);
        }
    }
    found.sort();
    found
}

fn add(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            add(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}
