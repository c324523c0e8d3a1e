//! `cargo xtask package`: the npm package, and the check that the crates can be published.

use crate::build::Kind;
use crate::workspace::{Workspace, output};
use crate::{bindgen, files, notices, tools, wasms};
use anyhow::{Context, Result};
use fs_err as fs;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The version of cargo-semver-checks. It must know the documentation that the compiler in use writes as JSON.
const SEMVER_CHECKS: &str = "0.51.0";
/// The boundary crate and its library.
const BOUNDARY: (&str, &str) = ("lsystem-wasm", "lsystem_wasm");

/// The options of the command.
#[derive(clap::Args)]
pub(crate) struct PackageOptions {
    /// The git revision with which the crates' interfaces are compared; the last tag `v*` if none is named
    #[arg(long)]
    baseline: Option<String>,
}

/// Makes and tests the npm package, and packs, compares and documents the crates.
pub(crate) fn package(workspace: &Workspace, options: &PackageOptions) -> Result<()> {
    tools::wasm_target()?;
    wasms::compile_one(workspace, Kind::Shipped, BOUNDARY.0, None)?;
    npm(workspace)?;
    let crates = published(workspace)?;
    dry_run(workspace)?;
    semver(workspace, options, &crates)?;
    documentation(workspace, &crates)?;
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
    let carried = notices::notices(workspace, &[BOUNDARY.0], tools::WASM_TARGET, false)?;
    files::write(&package.join(notices::FILE), carried)?;
    let list = package.join("package.json");
    // As text, because the order of conditions in `exports` counts.
    let version = format!("\"version\": \"{}\"", env!("CARGO_PKG_VERSION"));
    files::write(&list, fs::read_to_string(&list)?.replacen("\"version\": \"0.0.0\"", &version, 1))?;
    let test = workspace.target.join("npm/test.mjs");
    copy(&source.join("test.mjs"), &test)?;
    workspace.run(Command::new(tools::node()?).arg("--test").arg(&test))
}

/// A crate for others.
struct Published {
    name: String,
    is_library: bool,
}

/// All crates but those with `publish = false`.
fn published(workspace: &Workspace) -> Result<Vec<Published>> {
    let metadata = workspace.metadata()?;
    let packages = metadata["packages"].as_array().into_iter().flatten().filter(|package| package["publish"].is_null());
    let read = |package: &Value| {
        let mut targets = package["targets"].as_array().into_iter().flatten();
        let is_library = targets.any(|target| target["kind"][0] == "lib");
        Ok(Published { name: package["name"].as_str().context("a crate without a name")?.to_owned(), is_library })
    };
    packages.map(read).collect()
}

/// Packs the crates and does all that publishing does before it uploads. Crates of this workspace that use each other
/// are found here. They are not compiled once more from their packages.
fn dry_run(workspace: &Workspace) -> Result<()> {
    let words = ["publish", "--dry-run", "--no-verify", "--allow-dirty", "--workspace"];
    workspace.run(&mut workspace.cargo(words))
}

/// Compares the interfaces of the libraries with those of an older revision.
fn semver(workspace: &Workspace, options: &PackageOptions, crates: &[Published]) -> Result<()> {
    let mut describe = Command::new("git");
    describe.args(["describe", "--tags", "--abbrev=0", "--match=v*"]).current_dir(&workspace.root);
    let tag = || Some(output(&mut describe).ok()?.trim().to_owned());
    let Some(baseline) = options.baseline.clone().or_else(tag) else {
        println!("SKIPPED: comparing interfaces: no version has a tag; name a git revision with --baseline");
        return Ok(());
    };
    let mut command = Command::new(tools::cargo_tool(workspace, "semver-checks", SEMVER_CHECKS)?);
    let names = crates.iter().filter(|package| package.is_library).flat_map(|package| ["--package", &package.name]);
    command.args(["semver-checks", "check-release", "--baseline-rev", &baseline]).args(names);
    println!("comparing interfaces with {baseline}; no version is published yet");
    workspace.run(command.current_dir(&workspace.root))
}

/// Makes the documentation as docs.rs does: with all features, by the nightly compiler where it is installed.
fn documentation(workspace: &Workspace, crates: &[Published]) -> Result<()> {
    let mut nightly = Command::new("rustup");
    nightly.args(["run", "nightly", "cargo"]).current_dir(&workspace.root);
    let has_nightly = output(Command::new("rustup").args(["run", "nightly", "cargo", "--version"])).is_ok();
    let mut command = if has_nightly { nightly } else { workspace.cargo([]) };
    let names = crates.iter().flat_map(|package| ["--package", &package.name]);
    command.args(["doc", "--no-deps", "--all-features"]).args(names);
    workspace.run(command.env("RUSTDOCFLAGS", "--cfg docsrs -D warnings"))
}

fn copy(from: &Path, to: &Path) -> Result<()> {
    files::write(to, fs::read(from)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_crate_for_others_is_published() {
        let crates = published(&Workspace::find().unwrap()).unwrap();
        let names: Vec<_> = crates.iter().map(|package| package.name.as_str()).collect();
        let development = ["bench", "fuzz", "outside", "site", "test-effort", "xtask"];
        for entry in fs::read_dir(Workspace::find().unwrap().root.join("crates")).unwrap() {
            let folder = entry.unwrap();
            let name = folder.file_name().into_string().unwrap();
            let is_inner = development.contains(&name.as_str()) || name.ends_with("-wasm") || name.ends_with("-python");
            let manifest = fs::read_to_string(folder.path().join("Cargo.toml")).unwrap();
            let is_published = names.iter().any(|name| manifest.contains(&format!("[package]\nname = \"{name}\"\n")));
            assert_ne!(is_inner, is_published, "{name}");
        }
        assert_eq!(crates.iter().filter(|package| !package.is_library).count(), 1);
    }
}
