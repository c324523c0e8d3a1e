//! `cargo xtask build`: the page, the worker and the wasm in one folder that any static host can serve.

use crate::esbuild::Esbuild;
use crate::workspace::Workspace;
use crate::{docs, exercises, files, gallery, include, joined, offline, one_file, wasms};
use anyhow::{Context, Result};
use std::fs;
use std::path::Path;

/// The classic scripts of the pages.
const SCRIPTS: [&str; 3] = ["js/theme-early.js", "l-system.js", "service-worker.js"];

/// Builds the site and replaces `dist/` as a whole, so that readers of `dist/` find either the old site or the new one.
pub(crate) fn build(workspace: &Workspace) -> Result<()> {
    let new = tempfile::Builder::new().prefix(".dist-").tempdir_in(&workspace.root)?;
    let (www, site) = (workspace.www(), new.path().join("site"));
    let esbuild = Esbuild::of(&www)?;
    page(&www, &site)?;
    for name in SCRIPTS {
        files::write(&site.join(name), esbuild.script(name)?)?;
    }
    wasms::write(workspace, &esbuild, &site)?;
    let gallery = gallery::gallery(&workspace.root.join("data_in"))?;
    files::write(&site.join("gallery.json"), gallery.to_string())?;
    let exercises = exercises::exercises(&www.join("exercises.json"), &gallery)?;
    files::write(&site.join("exercises.json"), serde_json::to_string(&exercises)?)?;
    let lesson = site.join("course.html");
    files::write(&lesson, exercises::named(&files::read_text(&lesson)?, &exercises)?)?;
    let (index, embed) = ("index.html", site.join("embed.html"));
    let whole = files::read_text(&site.join(index))?;
    let exercise = site.join("exercise.html");
    let text = include::include(&files::read_text(&exercise)?, "embed.html", &files::read_text(&embed)?)?;
    files::write(&exercise, include::include(&text, index, &whole)?)?;
    let film = site.join("film.html");
    files::write(&film, include::include(&files::read_text(&film)?, index, &whole)?)?;
    files::write(&embed, include::include(&files::read_text(&embed)?, index, &whole)?)?;
    // These pages become single files, with the files that they would fetch inside.
    let all: Vec<_> = wasms::WASMS
        .iter()
        .flat_map(|wasm| [wasm.script, wasm.file])
        .chain(["gallery.json", "exercises.json"])
        .collect();
    let of = |package: &'static str| {
        wasms::WASMS.iter().filter(move |wasm| wasm.package.contains(package)).flat_map(|wasm| [wasm.script, wasm.file])
    };
    let drawing: Vec<_> = of("lsystem-wasm").collect();
    let marking: Vec<_> = of("lsystem-wasm").chain(of("course")).collect();
    for (page, file, carried) in [
        (index, "playground.html", all),
        ("embed.html", "embed.html", drawing),
        ("exercise.html", "exercise.html", marking),
        ("film.html", "film.html", of("film").collect()),
    ] {
        let carried = &carried;
        let text = one_file::one_file(&site, page, carried, &esbuild)?;
        files::write(&site.join(file), text)?;
    }
    docs::write_pages(&workspace.root.join("docs"), &www, &site, &esbuild)?;
    joined::join(&site, index, &esbuild)?;
    joined::write_licence(&www, &site)?;
    offline::list_files(&site)?;
    replace(&site, &workspace.dist(), &new.path().join("old"))
}

/// Copies the files of `www` that are shipped unchanged.
fn page(www: &Path, site: &Path) -> Result<()> {
    for file in files::list(www, is_shipped)? {
        files::write(&site.join(file.strip_prefix(www)?), files::read(&file)?)?;
    }
    Ok(())
}

/// Whether a file or folder of `www` is shipped unchanged: pages, icons, the manifest.
fn is_shipped(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let is_folder = path.extension().is_none();
    if is_folder {
        name == "icons"
    } else {
        ["html", "svg", "png", "webmanifest"].iter().any(|end| name.ends_with(end))
    }
}

/// Moves the folder at `place` to `old`, and `new` to `place`.
fn replace(new: &Path, place: &Path, old: &Path) -> Result<()> {
    if place.exists() {
        fs::rename(place, old).with_context(|| format!("moving {} out of the way", place.display()))?;
    }
    fs::rename(new, place).with_context(|| format!("putting {} in place", place.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ships_the_page_and_nothing_of_its_development() {
        for path in ["index.html", "icons", "icons/leaf.svg", "icons/leaf.png", "manifest.webmanifest"] {
            assert!(is_shipped(Path::new(path)), "{path}");
        }
        for path in
            [".npmrc", "node_modules", "test", "package.json", "tsconfig.worker.json", "worker", "css", "a.d.ts"]
        {
            assert!(!is_shipped(Path::new(path)), "{path}");
        }
    }

    #[test]
    fn replaces_a_folder_whole() -> Result<()> {
        let folder = tempfile::tempdir()?;
        let [new, place, old] = ["new", "place", "old"].map(|name| folder.path().join(name));
        files::write(&place.join("gone"), "1")?;
        files::write(&new.join("here"), "2")?;
        replace(&new, &place, &old)?;
        assert_eq!(files::list(&place, |_| true)?, [place.join("here")]);
        Ok(())
    }
}
