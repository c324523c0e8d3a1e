//! `cargo xtask package`: the npm package, and the check that the crates can be published.

use crate::workspace::{Kind, Workspace, output};
use crate::{bindgen, files, notices, page, tools, wasms};
use anyhow::{Context, Result};
use fs_err as fs;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The version of cargo-semver-checks. It must know the documentation that the compiler in use writes as JSON.
const SEMVER_CHECKS: &str = "0.51.0";
/// The boundary crate of the npm package.
pub(crate) const LIBRARY: &str = "lsystem-library-wasm";
/// Tests of the package, which are not part of it.
const TESTS: [&str; 2] = ["test.mjs", "types.test.mts"];

/// The options of the command.
#[derive(clap::Args)]
pub(crate) struct PackageOptions {
    /// The git revision with which the crates' interfaces are compared; the last tag `v*` if none is named
    #[arg(long)]
    baseline: Option<String>,
    /// Only the npm package
    #[arg(long)]
    npm: bool,
}

/// Makes and tests the npm package, and packs, compares and documents the crates.
pub(crate) fn package(workspace: &Workspace, options: &PackageOptions) -> Result<()> {
    compile(workspace, Kind::Shipped)?;
    npm(workspace, Kind::Shipped)?;
    if options.npm {
        println!("npm package: {}", folder(workspace).display());
        return Ok(());
    }
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

/// Compiles the wasm of the npm package.
pub(crate) fn compile(workspace: &Workspace, kind: Kind) -> Result<()> {
    tools::wasm_target()?;
    wasms::compile_one(workspace, kind, LIBRARY, &[wasms::ONCE])
}

/// The compiled wasm of the npm package.
pub(crate) fn compiled(workspace: &Workspace, kind: Kind) -> PathBuf {
    let folder = workspace.target.join(tools::WASM_TARGET).join(wasms::profile(kind));
    folder.join(format!("{}.wasm", LIBRARY.replace('-', "_")))
}

/// Makes the npm package from the compiled wasm, and tests it in a project of its own, as its users have it.
pub(crate) fn npm(workspace: &Workspace, kind: Kind) -> Result<()> {
    let source = workspace.root.join("crates").join(LIBRARY).join("npm");
    make(workspace, kind, &source)?;
    let project = tempfile::tempdir()?;
    let npm = |words: &[&str], folder: &Path| {
        workspace.run(Command::new(tools::npm()?).args(words).args(["--offline", "--silent"]).current_dir(folder))
    };
    let destination = project.path().to_string_lossy();
    npm(&["pack", "--pack-destination", &destination], &folder(workspace))?;
    files::write(&project.path().join("package.json"), "{ \"private\": true, \"type\": \"module\" }\n")?;
    let packed = format!("./lsystem-{}.tgz", env!("CARGO_PKG_VERSION"));
    npm(&["install", "--no-audit", "--no-fund", &packed], project.path())?;
    for test in TESTS {
        copy(&source.join(test), &project.path().join(test))?;
    }
    let www = workspace.www();
    page::packages(&www)?;
    let (node, words) =
        (tools::node()?, ["--noEmit", "--strict", "--module", "nodenext", "--target", "es2023", TESTS[1]]);
    let compiler = www.join("node_modules/typescript/bin/tsc");
    workspace.run(Command::new(&node).arg(compiler).args(words).current_dir(project.path()))?;
    let mut test = Command::new(node);
    test.args(["--test", TESTS[0]]).current_dir(project.path());
    workspace.run(test.env("CHROMIUM", tools::browser()?.chromium))
}

/// Makes the folder of the npm package.
fn make(workspace: &Workspace, kind: Kind, source: &Path) -> Result<()> {
    let package = folder(workspace);
    if package.is_dir() {
        fs::remove_dir_all(&package)?;
    }
    bindgen::generate_module(&compiled(workspace, kind), &package, "lsystem")?;
    for path in files::list(source, |path| !TESTS.iter().any(|name| path.ends_with(name)))? {
        copy(&path, &package.join(path.strip_prefix(source)?))?;
    }
    for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
        copy(&workspace.root.join(licence), &package.join(licence))?;
    }
    let carried = notices::notices(workspace, &[LIBRARY], tools::WASM_TARGET, false)?;
    files::write(&package.join(notices::FILE), carried)?;
    let list = package.join("package.json");
    // As text, because the order of conditions in `exports` counts. Provenance needs the repository.
    let version = format!(
        "\"version\": \"{}\",\n  \"homepage\": \"{}\",\n  \"repository\": {{ \"type\": \"git\", \"url\": \"git+{}.git\" }}",
        env!("CARGO_PKG_VERSION"),
        env!("CARGO_PKG_HOMEPAGE"),
        env!("CARGO_PKG_REPOSITORY"),
    );
    files::write(&list, fs::read_to_string(&list)?.replacen("\"version\": \"0.0.0\"", &version, 1))
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
    catalogues(workspace)?;
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

/// Puts the page's catalogues beside the program, whose package carries them.
fn catalogues(workspace: &Workspace) -> Result<()> {
    let page = workspace.www().join("lang");
    let words = files::list(&page, |path| path.extension().is_none() || path.ends_with("words.json"))?;
    let own = workspace.root.join("crates/lsys/lang");
    words.iter().try_for_each(|file| copy(file, &own.join(file.strip_prefix(&page)?)))
}

fn copy(from: &Path, to: &Path) -> Result<()> {
    files::write(to, fs::read(from)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_citation_names_this_version_and_its_addresses() {
        let text = fs::read_to_string(Workspace::find().unwrap().root.join("CITATION.cff")).unwrap();
        for line in [
            concat!("version: ", env!("CARGO_PKG_VERSION")),
            concat!("repository-code: ", env!("CARGO_PKG_REPOSITORY")),
            concat!("url: ", env!("CARGO_PKG_HOMEPAGE")),
        ] {
            assert!(text.lines().any(|own| own == line), "{line}");
        }
        let readme = fs::read_to_string(Workspace::find().unwrap().root.join("README.md")).unwrap();
        let start: String = readme.lines().take(3).collect();
        assert!(start.contains(concat!("](", env!("CARGO_PKG_HOMEPAGE"))), "{start}");
    }

    #[test]
    fn the_package_of_the_program_carries_the_languages() {
        let workspace = Workspace::find().unwrap();
        catalogues(&workspace).unwrap();
        let words = ["package", "--package=lsystem-cli", "--list", "--allow-dirty", "--offline"];
        let packed = output(&mut workspace.cargo(words)).unwrap();
        for language in ["de", "fr"] {
            assert!(packed.lines().any(|file| file == format!("lang/{language}/words.json")), "{packed}");
        }
    }

    #[test]
    fn every_crate_for_others_is_published() {
        let crates = published(&Workspace::find().unwrap()).unwrap();
        let names: Vec<_> = crates.iter().map(|package| package.name.as_str()).collect();
        let development = ["bench", "fuzz", "outside", "site", "test-effort", "wasm-test-runner", "xtask"];
        for entry in fs::read_dir(Workspace::find().unwrap().root.join("crates")).unwrap() {
            let folder = entry.unwrap();
            let name = folder.file_name().into_string().unwrap();
            let ours = ["-js", "-wasm", "-python"].iter().any(|ending| name.ends_with(ending));
            let is_inner = ours || development.contains(&name.as_str());
            let manifest = fs::read_to_string(folder.path().join("Cargo.toml")).unwrap();
            let is_published = names.iter().any(|name| manifest.contains(&format!("[package]\nname = \"{name}\"\n")));
            assert_ne!(is_inner, is_published, "{name}");
        }
        assert_eq!(crates.iter().filter(|package| !package.is_library).count(), 1);
    }
}
