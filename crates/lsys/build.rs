//! Hands the pages that the program carries to the compiler: those in `pages/`, which `cargo xtask program` writes.
//!
//! Only release builds carry pages, so that builds for tests do not depend on whether the page has been built. A page
//! that is not there becomes an empty file, and the program says so when the page is asked for.
//!
//! The translations, which are those of the page, become a table of the program. Its package has a copy of them in
//! `lang/`, which `cargo xtask package` makes.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?);
    let from = root.join("pages");
    let to = env::var("OUT_DIR").map_err(io::Error::other)?;
    let is_release = env::var("PROFILE").is_ok_and(|profile| profile == "release");
    for name in ["playground.html.gz", "exercise.html.gz", "package.html.gz"] {
        let page = Some(from.join(name)).filter(|page| is_release && page.is_file());
        fs::write(Path::new(&to).join(name), page.map(fs::read).transpose()?.unwrap_or_default())?;
    }
    let catalogues = [root.join("../../www/lang"), root.join("lang")].into_iter().find(|folder| folder.is_dir());
    let catalogues = catalogues.ok_or_else(|| io::Error::other("a package without lang/"))?;
    fs::write(Path::new(&to).join("languages.rs"), languages(&catalogues)?)?;
    println!("cargo::rerun-if-changed=build.rs");
    // A path that does not exist would run this at every build.
    if from.is_dir() {
        println!("cargo::rerun-if-changed=pages");
    }
    Ok(())
}

/// The table of the codes of languages and their catalogues, as Rust.
fn languages(catalogues: &Path) -> io::Result<String> {
    let mut folders = fs::read_dir(catalogues)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
    folders.sort();
    let row = |folder: &PathBuf| {
        let file = folder.join("words.json");
        println!("cargo::rerun-if-changed={}", file.display());
        Some(format!("({:?}, include_str!({:?})),", folder.file_name()?.to_str()?, file.to_str()?))
    };
    Ok(format!("[{}]", folders.iter().filter_map(row).collect::<String>()))
}
