//! `cargo xtask package`: the npm package, and the check that the crates can be published.

use crate::build::Kind;
use crate::workspace::Workspace;
use crate::{bindgen, files, tools, wasms};
use anyhow::Result;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The crates for others, each after those that it uses.
const CRATES: [&str; 13] = [
    "lsystem-base",
    "lsystem-syntax",
    "lsystem-derive",
    "lsystem-drawing",
    "lsystem-render",
    "lsystem-plot",
    "lsystem-files",
    "lsystem-import",
    "lsystem-film",
    "lsystem-course",
    "lsystem-find",
    "lsystem-playground",
    "lsystem-cli",
];
/// The boundary crate and its library.
const BOUNDARY: (&str, &str) = ("lsystem-wasm", "lsystem_wasm");

/// Makes and tests the npm package, and packs and documents the crates.
pub(crate) fn package(workspace: &Workspace) -> Result<()> {
    tools::wasm_target()?;
    wasms::compile_one(workspace, Kind::Shipped, BOUNDARY.0, None)?;
    npm(workspace)?;
    crates(workspace)?;
    println!("npm package: {}", folder(workspace).display());
    println!("crates: {}", workspace.target.join("package").display());
    Ok(())
}

fn folder(workspace: &Workspace) -> PathBuf {
    workspace.target.join("npm/node_modules/lsystem")
}

/// Makes the npm package from the compiled wasm, and runs its test, which imports it as any program does.
pub(crate) fn npm(workspace: &Workspace) -> Result<()> {
    let source = workspace.root.join("crates/lsystem-wasm/npm");
    let package = folder(workspace);
    if package.is_dir() {
        fs::remove_dir_all(&package)?;
    }
    let compiled = workspace.target.join(tools::WASM_TARGET).join("wasm").join(format!("{}.wasm", BOUNDARY.1));
    bindgen::generate_module(&compiled, &package, "lsystem")?;
    for path in files::list(&source, |path| !path.ends_with("test.mjs"))? {
        copy(&path, &package.join(path.strip_prefix(&source)?))?;
    }
    for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
        copy(&workspace.root.join(licence), &package.join(licence))?;
    }
    let list = package.join("package.json");
    // As text, because the order of conditions in `exports` counts.
    let version = format!("\"version\": \"{}\"", env!("CARGO_PKG_VERSION"));
    files::write(&list, files::read_text(&list)?.replacen("\"version\": \"0.0.0\"", &version, 1))?;
    let test = workspace.target.join("npm/test.mjs");
    copy(&source.join("test.mjs"), &test)?;
    workspace.run(Command::new(tools::node()?).arg("--test").arg(&test))
}

/// Packs the crates as for the registry, and makes their documentation as docs.rs does.
fn crates(workspace: &Workspace) -> Result<()> {
    let names = || CRATES.iter().flat_map(|name| ["--package", name]);
    // The crates use each other, and none is in the registry yet: packing finds the others in the workspace. Other crates are in
    // the cache, because this workspace has been built.
    workspace.run(
        &mut workspace.cargo(["package", "--offline", "--allow-dirty", "--no-verify"].into_iter().chain(names())),
    )?;
    workspace.run(workspace.cargo(["doc", "--no-deps"].into_iter().chain(names())).env("RUSTDOCFLAGS", "-D warnings"))
}

fn copy(from: &Path, to: &Path) -> Result<()> {
    files::write(to, files::read(from)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_crate_for_others_is_packed() {
        let workspace = Workspace::find().unwrap();
        let development = ["bench", "fuzz", "site", "test-effort", "xtask"];
        for entry in fs::read_dir(workspace.root.join("crates")).unwrap() {
            let folder = entry.unwrap();
            let name = folder.file_name().into_string().unwrap();
            let is_inner = development.contains(&name.as_str()) || name.ends_with("-wasm");
            let manifest = fs::read_to_string(folder.path().join("Cargo.toml")).unwrap();
            let is_packed = |name: &&str| manifest.contains(&format!("[package]\nname = \"{name}\"\n"));
            assert!(is_inner || CRATES.iter().any(is_packed), "{name}");
        }
    }
}
