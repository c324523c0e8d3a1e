//! Files of the built page that the core makes. A program of its own, so that `cargo xtask` starts without compiling
//! the core, and the core is compiled natively while it is compiled for the page.
//!
//! - `site systems ROOT SITE` reads the repository ROOT, writes the JSON files of systems into the folder SITE,
//!   and completes links to exercises in `course.html` there.
//! - `site words ROOT SITE` writes the catalogues of the languages into SITE, without the texts that the pages there
//!   do not show. All other files must be in SITE.
//! - `site documents ROOT SITE` writes the pages of `docs/`, in English and in the languages of `www/lang`. All other
//!   pages must be in SITE, because documents link to them.
//! - `site landing ROOT SITE ADDRESS` writes the pages of the gallery in all languages, for a site with this address.

mod docs;
mod exercises;
mod gallery;
mod landing;
mod language;

use anyhow::{Context, Result, bail};
use fs_err as fs;
use lsystem::{course::words_in, invent};
use std::path::{Path, PathBuf};
use walkdir::{DirEntry, WalkDir};

fn main() -> Result<()> {
    let words: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    match words.as_slice() {
        [what, root, site] if what == Path::new("systems") => systems(root, site),
        [what, root, site] if what == Path::new("words") => catalogues(root, site),
        [what, root, site] if what == Path::new("documents") => {
            let (docs, template) = (&root.join("docs"), &root.join("www/docs/page.html"));
            in_all_languages(root, |told| docs::write_pages(&docs::Folders { docs, told, template, site }))
        }
        [what, root, site, address] if what == Path::new("landing") => {
            let address = address.to_str().context("an address that is not UTF-8")?;
            let languages = &lsystem_catalogue::languages(&root.join("www/lang"))?;
            in_all_languages(root, |_| {
                println!("{}", landing::write(&landing::Sources { root, site, address, languages })?);
                Ok(())
            })
        }
        _ => bail!(
            "usage: site systems ROOT SITE, site words ROOT SITE, site documents ROOT SITE, or site landing ROOT SITE ADDRESS"
        ),
    }
}

/// Makes pages in English, then in each language of `www/lang`, with the folder of its documents.
fn in_all_languages(root: &Path, make: impl Fn(Option<&Path>) -> Result<()>) -> Result<()> {
    make(None)?;
    let folder = root.join("www/lang");
    lsystem_catalogue::languages(&folder)?.iter().try_for_each(|language| {
        language::choose(&folder.join(language))?;
        make(Some(&folder.join(language).join("docs")))
    })
}

fn catalogues(root: &Path, site: &Path) -> Result<()> {
    let of_page = |entry: &DirEntry| {
        !["lang", "docs", "gallery", "icons", "schema", "pyodide", "program.html"]
            .iter()
            .any(|name| entry.path() == site.join(name))
    };
    let files = WalkDir::new(site).into_iter().filter_entry(of_page).collect::<walkdir::Result<Vec<_>>>()?;
    let files = files.iter().filter(|entry| entry.file_type().is_file()).map(|entry| fs::read(entry.path()));
    // Links have the texts of exercises, and not as they are.
    let files = files.chain([fs::read(root.join("www/exercises.json"))]).collect::<std::io::Result<Vec<_>>>()?;
    let files: Vec<_> = files.iter().map(Vec::as_slice).collect();
    // Few visits need the words of programs.
    let program = fs::read(site.join("program.html"))?;
    for language in lsystem_catalogue::languages(&root.join("www/lang"))? {
        let folder = format!("lang/{language}");
        let whole = fs::read_to_string(root.join("www").join(&folder).join("words.json"))?;
        fs::create_dir_all(site.join(&folder))?;
        for (name, files) in [("words.json", &files), ("programs.json", &vec![&*program])] {
            let words = words_in(&whole, files).with_context(|| format!("{folder}/{name}"))?;
            fs::write(site.join(&folder).join(name), words)?;
        }
    }
    Ok(())
}

fn systems(root: &Path, site: &Path) -> Result<()> {
    let gallery = gallery::gallery(&root.join("data_in"))?;
    fs::write(site.join("gallery.json"), gallery.to_string())?;
    let surprises = invent::READY.map(|seed| invent::surprise(seed).0);
    fs::write(site.join("surprises.json"), serde_json::to_string(&surprises[..])?)?;
    let exercises = exercises::exercises(&root.join("www/exercises.json"), &gallery)?;
    fs::write(site.join("exercises.json"), serde_json::to_string(&exercises)?)?;
    let lesson = site.join("course.html");
    Ok(fs::write(&lesson, exercises::named(&fs::read_to_string(&lesson)?, &exercises)?)?)
}
