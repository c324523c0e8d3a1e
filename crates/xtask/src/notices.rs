//! The notices of other people's work that is shipped: compiled into a wasm or the program, or bundled with the page.

use crate::workspace::Workspace;
use anyhow::{Context, Result};
use fs_err as fs;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};

/// The file of the notices, on the site and in packages.
pub(crate) const FILE: &str = "notices.txt";

/// What other people made and the page carries, in `node_modules`.
const BUNDLED: [&str; 2] = ["mediabunny", "pyodide"];

/// What MIT asks for, for the few who publish the name of the licence only.
const MIT: &str = include_str!("../../../LICENSE-MIT");

/// Names, versions and licences of what these packages consist of, then the texts of the licences, each once.
pub(crate) fn notices(workspace: &Workspace, roots: &[&str], target: &str, with_page: bool) -> Result<String> {
    let mut texts: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut names = BTreeSet::new();
    for part in [compiled(workspace, roots, target)?, if with_page { bundled(workspace)? } else { vec![] }].concat() {
        names.insert(format!("{} ({})", part.name, part.licence));
        for text in part.texts {
            texts.entry(text).or_default().insert(part.name.clone());
        }
    }
    let mut out = "This product contains work of other people, with thanks:\n\n".to_owned();
    names.iter().for_each(|name| out += &format!("{name}\n"));
    for (text, holders) in texts {
        let holders: Vec<String> = holders.into_iter().collect();
        out += &format!("\n\n{}\n{}\n\n{}\n", "-".repeat(72), holders.join(", "), text.trim());
    }
    Ok(out)
}

/// A package of other people.
#[derive(Clone)]
struct Part {
    name: String,
    licence: String,
    texts: Vec<String>,
}

/// The crates that packages of the workspace are compiled from, and Rust's own library.
fn compiled(workspace: &Workspace, roots: &[&str], target: &str) -> Result<Vec<Part>> {
    let words = ["metadata", "--format-version=1", "--locked", "--filter-platform", target];
    let metadata: Value = serde_json::from_str(&workspace.output(&mut workspace.cargo(words))?)?;
    let list = |of: &'static str, value: &Value| value[of].as_array().cloned().unwrap_or_default();
    let packages: HashMap<String, Value> =
        list("packages", &metadata).into_iter().map(|package| (text(&package, "id"), package)).collect();
    let nodes: HashMap<String, Value> =
        list("nodes", &metadata["resolve"]).into_iter().map(|node| (text(&node, "id"), node)).collect();
    let is_root = |package: &&Value| roots.contains(&text(package, "name").as_str());
    let mut next: Vec<String> = packages.values().filter(is_root).map(|package| text(package, "id")).collect();
    anyhow::ensure!(next.len() == roots.len(), "not all of {roots:?} are in the workspace");
    let mut seen: BTreeSet<String> = next.iter().cloned().collect();
    let mut parts = vec![rust()];
    while let Some(id) = next.pop() {
        let package = &packages[&id];
        // Macros run while compiling, and are not shipped.
        if list("targets", package).iter().any(|target| target["kind"][0] == "proc-macro") {
            continue;
        }
        if !package["source"].is_null() {
            parts.push(part(package)?);
        }
        for dependency in list("deps", &nodes[&id]) {
            let is_normal = list("dep_kinds", &dependency).iter().any(|kind| kind["kind"].is_null());
            let id = text(&dependency, "pkg");
            if is_normal && seen.insert(id.clone()) {
                next.push(id);
            }
        }
    }
    Ok(parts)
}

fn text(value: &Value, key: &str) -> String {
    value[key].as_str().unwrap_or_default().to_owned()
}

/// A crate with the texts of its licence.
fn part(package: &Value) -> Result<Part> {
    let name = format!("{} {}", text(package, "name"), text(package, "version"));
    let licence = text(package, "license");
    let manifest = PathBuf::from(text(package, "manifest_path"));
    let mut texts = licences_in(manifest.parent().context("a manifest without a folder")?)?;
    if texts.is_empty() {
        anyhow::ensure!(licence.contains("MIT"), "{name} has no text of its licence ({licence})");
        let authors = package["authors"].as_array().into_iter().flatten().filter_map(Value::as_str);
        texts.push(mit(&authors.collect::<Vec<_>>().join(", ")));
    }
    Ok(Part { name, licence, texts })
}

/// The licence MIT in the name of authors.
fn mit(authors: &str) -> String {
    let lines = MIT.lines().map(|line| match line.starts_with("Copyright") {
        true => format!("Copyright (c) {authors}\n"),
        false => format!("{line}\n"),
    });
    lines.collect()
}

/// The library that comes with the compiler. Its texts are not on every machine.
fn rust() -> Part {
    let licence = "MIT OR Apache-2.0".to_owned();
    Part { name: "the Rust standard library".to_owned(), licence, texts: vec![mit("The Rust Project contributors")] }
}

/// The texts of licences in a folder: of a choice, the shortest, which is MIT.
fn licences_in(folder: &Path) -> Result<Vec<String>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
        if path.is_file()
            && ["LICENSE", "LICENCE", "COPYING", "NOTICE", "UNLICENSE"].iter().any(|is| name.starts_with(is))
        {
            files.push((name.contains("MIT"), path));
        }
    }
    let is_chosen = files.iter().any(|(is_mit, _)| *is_mit);
    files.sort();
    files.iter().filter(|(is_mit, _)| *is_mit || !is_chosen).map(|(_, path)| Ok(fs::read_to_string(path)?)).collect()
}

fn bundled(workspace: &Workspace) -> Result<Vec<Part>> {
    let part = |name: &str| {
        let folder = workspace.www().join("node_modules").join(name);
        let package: Value = serde_json::from_str(&fs::read_to_string(folder.join("package.json"))?)?;
        let name = format!("{name} {}, {}", text(&package, "version"), text(&package, "homepage"));
        Ok(Part { name, licence: text(&package, "license"), texts: licences_in(&folder)? })
    };
    BUNDLED.iter().map(|name| part(name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_crate_of_the_wasm_has_its_notice() -> Result<()> {
        let workspace = Workspace::find()?;
        let roots = ["lsystem-wasm", "lsystem-tools-wasm"];
        let notices = notices(&workspace, &roots, crate::tools::WASM_TARGET, false)?;
        for name in ["wasm-bindgen ", "js-sys ", "serde ", "libm ", "qrcodegen ", "the Rust standard library"] {
            let at = |text: &str| text.lines().filter(|line| line.contains(name)).count();
            assert!(at(&notices) >= 2, "{name} is named, and has a text");
        }
        assert!(!notices.contains("lsystem") && !notices.contains("serde_derive"));
        assert!(mit("A, B").contains("Copyright (c) A, B"));
        Ok(())
    }
}
