//! Files of the built page that the core makes. A program of its own, so that `cargo xtask` starts without compiling
//! the core, and the core is compiled natively while it is compiled for the page.
//!
//! - `site systems ROOT SITE` reads the repository ROOT, writes `gallery.json` and `exercises.json` into the folder
//!   SITE, and completes links to exercises in `course.html` there.
//! - `site documents ROOT SITE [LANGUAGE]` writes the pages of `docs/`, in English or in a language of `www/lang`. All other pages must be in SITE, because documents link to
//!   them.
//! - `site landing ROOT SITE ADDRESS [LANGUAGE]` writes the pages of the gallery for a site with this address, first those
//!   in English.

mod docs;
mod exercises;
mod gallery;
mod landing;
mod words;

use anyhow::{Context, Result, bail};
use fs_err as fs;
use std::path::{Path, PathBuf};

fn main() -> Result<()> {
    let words: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    match words.as_slice() {
        [what, root, site] if what == Path::new("systems") => systems(root, site),
        [what, root, site] if what == Path::new("documents") => documents(root, site, None),
        [what, root, site, language] if what == Path::new("documents") => {
            let folder = root.join("www/lang").join(language);
            words::choose(&folder)?;
            documents(root, site, Some(&folder.join("docs")))
        }
        [what, root, site, address, language @ ..] if what == Path::new("landing") => {
            let address = address.to_str().context("an address that is not UTF-8")?;
            let folder = &root.join("www/lang");
            if let Some(language) = language.first() {
                words::choose(&folder.join(language))?;
            }
            let languages = &lsystem_catalogue::languages(folder)?;
            println!("{}", landing::write(&landing::Sources { root, site, address, languages })?);
            Ok(())
        }
        _ => bail!(
            "usage: site systems ROOT SITE, site documents ROOT SITE [LANGUAGE], or site landing ROOT SITE ADDRESS [LANGUAGE]"
        ),
    }
}

fn documents(root: &Path, site: &Path, told: Option<&Path>) -> Result<()> {
    let (docs, template) = (&root.join("docs"), &root.join("www/docs/page.html"));
    docs::write_pages(&docs::Folders { docs, told, template, site })
}

fn systems(root: &Path, site: &Path) -> Result<()> {
    let gallery = gallery::gallery(&root.join("data_in"))?;
    fs::write(site.join("gallery.json"), gallery.to_string())?;
    let exercises = exercises::exercises(&root.join("www/exercises.json"), &gallery)?;
    fs::write(site.join("exercises.json"), serde_json::to_string(&exercises)?)?;
    let lesson = site.join("course.html");
    Ok(fs::write(&lesson, exercises::named(&fs::read_to_string(&lesson)?, &exercises)?)?)
}
