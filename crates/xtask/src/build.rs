//! `cargo xtask build`: the page, the worker and the wasm in one folder that any static host can serve.

use crate::workspace::{Workspace, run};
use crate::{bindgen, bundle, files, gallery, include, joined, offline, one_file, tools};
use anyhow::{Context, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// The boundary crate's library, and what is generated for it.
const NAME: &str = "lsystem_wasm";

/// A wasm with its worker: the page starts with a small one, and takes the full one when it needs more.
struct Kit {
    /// Cargo's options.
    features: &'static [&'static str],
    /// Of Cargo's.
    profile: &'static str,
    /// Of `www`, joined to the worker.
    scripts: &'static [&'static str],
    worker: &'static str,
    wasm: &'static str,
}

const FIRST: Kit = Kit {
    features: &["--no-default-features"],
    profile: "first",
    scripts: &["worker.js"],
    worker: "worker.js",
    wasm: "lsystem.wasm",
};
const FULL: Kit = Kit {
    features: &[],
    profile: "release",
    scripts: &["sharing.js", "worker.js"],
    worker: "worker-full.js",
    wasm: "lsystem-full.wasm",
};

/// A single file made of a page, with a kit and the other files that the page would fetch.
struct Whole {
    page: &'static str,
    file: &'static str,
    kit: &'static Kit,
    more: &'static [&'static str],
}

const WHOLE: [Whole; 2] = [
    Whole { page: "index.html", file: "playground.html", kit: &FULL, more: &["gallery.json"] },
    Whole { page: "embed.html", file: "embed.html", kit: &FULL, more: &[] },
];

/// Builds everything and puts it in place of `dist/` at once: whoever reads `dist/` finds the old site or the new one.
pub(crate) fn build(workspace: &Workspace) -> Result<()> {
    let new = tempfile::Builder::new().prefix(".dist-").tempdir_in(&workspace.root)?;
    let site = new.path().join("site");
    page(&workspace.www(), &site)?;
    // The full one last: its types are left for the page's check.
    for kit in [FIRST, FULL] {
        let generated = wasm(workspace, &kit)?;
        worker(&workspace.www(), kit.scripts, &generated, &site.join(kit.worker))?;
        fs::copy(generated.join(format!("{NAME}_bg.wasm")), site.join(kit.wasm))?;
    }
    let gallery = gallery::gallery(&workspace.root.join("data_in"))?;
    files::write(&site.join("gallery.json"), gallery.to_string())?;
    let (index, embed) = ("index.html", site.join("embed.html"));
    files::write(&embed, include::include(&files::read_text(&embed)?, index, &files::read_text(&site.join(index))?)?)?;
    for Whole { page, file, kit, more } in WHOLE {
        let carried = [&[kit.worker, kit.wasm], more].concat();
        let text = one_file::one_file(&site, page, &carried)?;
        files::write(&site.join(file), text)?;
    }
    joined::join(&site, index)?;
    offline::list_files(&site)?;
    replace(&site, &workspace.dist(), &new.path().join("old"))
}

/// Compiles the boundary crate and generates its JavaScript; returns the folder it is in.
fn wasm(workspace: &Workspace, kit: &Kit) -> Result<PathBuf> {
    tools::wasm_target()?;
    let target = tools::WASM_TARGET;
    let words = ["build", "--profile", kit.profile, "--lib", "--package=lsystem-wasm", "--target", target];
    run(&mut workspace.cargo(words.iter().chain(kit.features).copied()))?;
    // The page's type check reads the generated types here: www/tsconfig.worker.json.
    let out = workspace.root.join("target/wasm-bindgen");
    let wasm = workspace.target.join(target).join(kit.profile).join(format!("{NAME}.wasm"));
    bindgen::generate(&wasm, &out, NAME)?;
    Ok(out)
}

/// Copies what is shipped of `www`.
fn page(www: &Path, site: &Path) -> Result<()> {
    for file in files::list(www, is_shipped)? {
        files::write(&site.join(file.strip_prefix(www)?), files::read(&file)?)?;
    }
    Ok(())
}

/// Whether a file or folder of `www` belongs to the page, rather than to its development. `worker.js` and
/// `sharing.js` are shipped as parts of others.
fn is_shipped(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let development = ["node_modules", "test", "package.json", "package-lock.json", "worker.js", "sharing.js"];
    let at_the_top = path.components().count() == 1;
    !(name.starts_with('.')
        || name.ends_with(".d.ts")
        || name.ends_with(".md")
        || at_the_top && (development.contains(&&*name) || name.starts_with("tsconfig")))
}

/// One classic script from the generated JavaScript and ours: module workers and imports fail in sandboxed frames and
/// from files, one script handed over as text does not.
fn worker(www: &Path, scripts: &[&str], generated: &Path, script: &Path) -> Result<()> {
    let mut text = files::read_text(&generated.join(format!("{NAME}.js")))?;
    for name in scripts {
        text.push('\n');
        text.push_str(&files::read_text(&www.join(name))?);
    }
    files::write(script, bundle::squeezed(&text)?)
}

/// Puts `new` where `place` is, moving what is there to `old`.
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
        for path in
            ["index.html", "view/canvas.js", "icons/leaf.svg", "manifest.webmanifest", "view/test.js", "test.js"]
        {
            assert!(is_shipped(Path::new(path)), "{path}");
        }
        for path in [".npmrc", "node_modules", "test", "package.json", "tsconfig.worker.json", "worker.js", "a/b.d.ts"]
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

    #[test]
    fn joins_the_worker() -> Result<()> {
        let folder = tempfile::tempdir()?;
        let [www, generated, script] = ["www", "generated", "script.js"].map(|name| folder.path().join(name));
        files::write(&www.join("worker.js"), "use(glue)")?;
        files::write(&generated.join("lsystem_wasm.js"), "let glue = 1;")?;
        files::write(&www.join("more.js"), "let more = 2;")?;
        worker(&www, &["more.js", "worker.js"], &generated, &script)?;
        assert_eq!(files::read_text(&script)?, "let glue = 1;\nlet more = 2;\nuse(glue)\n");
        Ok(())
    }
}
