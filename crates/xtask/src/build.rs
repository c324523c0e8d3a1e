//! `cargo xtask build`: the page, the worker and the wasm in one folder that any static host can serve.

mod address;
mod stable;

use crate::esbuild::{Bundler as _, Esbuild};
use crate::one_file::Alone;
use crate::workspace::{Kind, Workspace};
use crate::{files, html, joined, notices, offline, one_file, split, steps_page, tools, wasms};
pub(crate) use address::Address;
use anyhow::{Context, Result, bail};
use fs_err as fs;
use std::path::Path;
use std::process::Command;
use std::thread;

/// The classic scripts of the pages.
const SCRIPTS: [&str; 5] = ["js/early.js", "js/exercise/lesson.js", PACKED, "l-system.js", "service-worker.js"];
/// The script of packages for learning systems, which stands in their page.
const PACKED: &str = "js/exercise/packed.js";
/// The files of the interpreter for programs in Python, in its package.
const INTERPRETER: [&str; 4] = ["pyodide.asm.mjs", "pyodide.asm.wasm", "pyodide.mjs", "python_stdlib.zip"];
/// The styles of the documents: those that they share with the playground, then their own.
const DOCUMENT_STYLES: [&str; 3] = ["css/base.css", "css/contrast.css", "css/docs.css"];

/// The options of the command.
#[derive(clap::Args)]
pub(crate) struct BuildOptions {
    /// Also make the pages of the gallery with their pictures, and name the public address everywhere: ADDRESS, or else
    /// `homepage` of Cargo.toml
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, default_missing_value = "")]
    site: Option<String>,
}

impl BuildOptions {
    /// The public address, if the site names it.
    pub(crate) fn address(&self) -> Result<Option<Address>> {
        self.site.as_deref().map(Address::new).transpose()
    }
}

/// Compiles the core, and builds the site, for a public address if it is known.
pub(crate) fn build(workspace: &Workspace, kind: Kind, address: Option<&Address>) -> Result<()> {
    thread::scope(|scope| {
        let core = scope.spawn(|| compile_core(workspace, kind));
        wasms::compile(workspace, kind)?;
        joined(core)
    })?;
    bundle(workspace, kind, address)
}

/// The page and its engine alone, as a draft: what a reader needs until all else has been built.
pub(crate) fn first(workspace: &Workspace) -> Result<()> {
    wasms::compile_first(workspace, Kind::Draft)?;
    in_new_folder(workspace, Kind::Draft, |site| {
        let (www, esbuild) = (workspace.www(), Esbuild::of(&workspace.www())?);
        page(&www, site)?;
        scripts(&esbuild, site)?;
        for words in files::list(&www.join("lang"), |path| path.extension().is_none() || path.ends_with("words.json"))?
        {
            files::write(&site.join(words.strip_prefix(&www)?), fs::read(&words)?)?;
        }
        wasms::write_first(workspace, Kind::Draft, &esbuild, site)?;
        split::split_core(workspace, Kind::Draft, site)?;
        joined::join(site, "index.html", &esbuild).map(drop)
    })
}

/// Makes a site in a new folder, and replaces the old one as a whole, so that readers find either the old site or the new
/// one.
fn in_new_folder(workspace: &Workspace, kind: Kind, make: impl FnOnce(&Path) -> Result<()>) -> Result<()> {
    let place = kind.folder(workspace);
    let parent = place.parent().context("a folder without a parent")?;
    let new = tempfile::Builder::new().prefix(".dist-").tempdir_in(parent)?;
    let site = new.path().join("site");
    make(&site)?;
    replace(&site, &place, &new.path().join("old"))
}

fn scripts(esbuild: &Esbuild, site: &Path) -> Result<()> {
    SCRIPTS.iter().try_for_each(|name| files::write(&site.join(name), esbuild.script(name)?))
}

/// Builds the site from the compiled core.
pub(crate) fn bundle(workspace: &Workspace, kind: Kind, address: Option<&Address>) -> Result<()> {
    in_new_folder(workspace, kind, |site| fill(workspace, kind, address, site))
}

/// Makes all files of the site.
fn fill(workspace: &Workspace, kind: Kind, address: Option<&Address>, site: &Path) -> Result<()> {
    let www = workspace.www();
    let esbuild = Esbuild::of(&www)?;
    page(&www, site)?;
    let folder = workspace.target.join(if kind == Kind::Draft { "draft" } else { "debug" });
    let core = folder.join("site").with_extension(std::env::consts::EXE_EXTENSION);
    let make = |what| workspace.run(Command::new(&core).arg(what).arg(&workspace.root).arg(site));
    thread::scope(|scope| {
        let scripts = scope.spawn(|| {
            scripts(&esbuild, site)?;
            make("systems")
        });
        wasms::write(workspace, kind, &esbuild, site)?;
        joined(scripts)
    })?;
    split::split_core(workspace, kind, site)?;
    split::split_tools(workspace, kind, site)?;
    let steps = steps_page::make(site, "course.html", |styles| esbuild.minified("styles.css", styles))?;
    files::write(&site.join(steps_page::NAME), steps)?;
    fs::remove_file(site.join(PACKED))?;
    let index = "index.html";
    let whole = fs::read_to_string(site.join(index))?;
    let include_index = |file: &Path| files::write(file, html::include(&fs::read_to_string(file)?, index, &whole)?);
    include_frames(site)?;
    // These pages become single files, with the files that they would fetch inside.
    let of = |name: &str| vec![format!("{name}.js"), format!("{name}.wasm")];
    let engine = || vec!["worker.js".to_owned(), "lsystem.wasm".to_owned(), split::REST.to_owned()];
    let all = [engine(), of("tools"), ["gallery.json", "exercises.json", "surprises.json"].map(str::to_owned).to_vec()]
        .concat();
    let marking = [engine(), of("course"), vec!["exercises.json".to_owned()]].concat();
    let (drawing, playing) = (engine(), of("film"));
    let maker = &one_file::Maker { site, bundler: &esbuild };
    let single = [
        (index, "playground.html", all, Alone::Always),
        ("embed.html", "embed.html", drawing, Alone::Elsewhere),
        ("exercise.html", "exercise.html", marking, Alone::Elsewhere),
        ("film.html", "film.html", playing.clone(), Alone::Elsewhere),
        ("program.html", "program.html", vec![], Alone::Running),
    ];
    thread::scope(|scope| {
        let threads =
            single.iter().map(|(page, _, carried, alone)| scope.spawn(move || maker.make(page, carried, *alone)));
        let threads: Vec<_> = threads.collect();
        // Written when all are made, since a page is made of its file.
        let texts = threads.into_iter().map(joined).collect::<Result<Vec<_>>>()?;
        single.iter().zip(texts).try_for_each(|((_, file, ..), text)| files::write(&site.join(file), text))
    })?;
    for name in INTERPRETER {
        files::write(&site.join("pyodide").join(name), fs::read(www.join("node_modules/pyodide").join(name))?)?;
    }
    // On the site, tools are in parts.
    let carried = wasms::ALONE.iter().flat_map(|tool| of(tool)).chain(["tools.wasm".to_owned()]);
    carried.into_iter().try_for_each(|name| fs::remove_file(site.join(name)))?;
    stable::write(site)?;
    make("documents")?;
    let documents = site.join("docs");
    if let Some(address) = address {
        let landing = ["landing".as_ref(), workspace.root.as_os_str(), site.as_os_str(), address.as_str().as_ref()];
        workspace.run(Command::new(&core).args(landing))?;
        address.name(site)?;
    }
    [&documents, &site.join("gallery")].into_iter().try_for_each(|folder| {
        let pages = files::list(folder, |path| path.extension().is_some_and(|ending| ending == "html"))?;
        pages.iter().try_for_each(|file| include_index(file))
    })?;
    files::write(&documents.join("docs.css"), esbuild.styles(&DOCUMENT_STYLES.map(str::to_owned))?)?;
    let scripts = joined::join(site, index, &esbuild)?;
    make("words")?;
    let carried = notices::notices(workspace, &wasms::PACKAGES, tools::WASM_TARGET, true)?;
    files::write(&site.join(notices::FILE), carried)?;
    offline::list_files(site, &scripts)
}

/// Puts what pages share into those for frames: `embed.html` has it from `index.html`, and the others from both.
fn include_frames(site: &Path) -> Result<()> {
    let all = [("embed", "index"), ("exercise", "embed"), ("film", "embed"), ("exercise", "index"), ("film", "index")];
    for (page, from) in all {
        let [page, other] = [page, from].map(|name| site.join(name).with_extension("html"));
        let text = html::include(&fs::read_to_string(&page)?, &format!("{from}.html"), &fs::read_to_string(other)?)?;
        files::write(&page, text)?;
    }
    Ok(())
}

/// The result of a thread.
pub(crate) fn joined<T>(thread: thread::ScopedJoinHandle<'_, Result<T>>) -> Result<T> {
    thread.join().unwrap_or_else(|_| bail!("a thread of the build has panicked"))
}

/// Compiles the program `site`, which makes what needs the core: a draft's in the draft's profile, so that less is
/// compiled; else as the tests do, which share its libraries.
fn compile_core(workspace: &Workspace, kind: Kind) -> Result<()> {
    let profile = if kind == Kind::Draft { "--profile=draft" } else { "--profile=dev" };
    // All crates are named, so that the same features are chosen.
    workspace.run(&mut workspace.cargo(["build", "--quiet", profile, "--workspace", "--exclude=bench", "--bin=site"]))
}

/// Copies the files of `www` that are shipped unchanged.
fn page(www: &Path, site: &Path) -> Result<()> {
    for file in files::list(www, is_shipped)? {
        files::write(&site.join(file.strip_prefix(www)?), fs::read(&file)?)?;
    }
    Ok(())
}

/// Whether a file or folder of `www` is shipped unchanged: pages, icons, the manifest, `llms.txt`, the schema of files.
fn is_shipped(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let is_folder = path.extension().is_none();
    if is_folder {
        ["icons", "schema", "v1"].contains(&&*name)
    } else {
        ["html", "svg", "png", "webmanifest", "txt"].iter().any(|end| name.ends_with(end))
            || path.ends_with("v1/system.json")
    }
}

/// Moves the folder at `place` to `old`, and `new` to `place`.
fn replace(new: &Path, place: &Path, old: &Path) -> Result<()> {
    if place.exists() {
        fs::rename(place, old)?;
    }
    Ok(fs::rename(new, place)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ships_the_page_and_nothing_of_its_development() {
        let schema = ["schema/v1", "schema/v1/system.json", "llms.txt"];
        for path in
            ["index.html", "icons", "icons/leaf.svg", "icons/leaf.png", "manifest.webmanifest"].iter().chain(&schema)
        {
            assert!(is_shipped(Path::new(path)), "{path}");
        }
        for path in [
            ".npmrc",
            "node_modules",
            "test",
            "package.json",
            "tsconfig.worker.json",
            "worker",
            "css",
            "a.d.ts",
            "lang",
        ] {
            assert!(!is_shipped(Path::new(path)), "{path}");
        }
    }

    /// A page that needs another policy is told here.
    #[test]
    fn pages_have_one_policy() -> Result<()> {
        let (www, site) = (Workspace::find()?.www(), tempfile::tempdir()?);
        page(&www, site.path())?;
        include_frames(site.path())?;
        let policies = |text: &str| {
            let found = text.split("<meta http-equiv=\"Content-Security-Policy\" content=\"").skip(1);
            found.map(|rest| rest.split('"').next().unwrap_or_default().to_owned()).collect::<Vec<_>>()
        };
        let shared = policies(&fs::read_to_string(www.join("index.html"))?);
        assert_eq!(shared.len(), 1);
        for file in files::list(&www, |path| !path.ends_with("node_modules") && !path.ends_with("js"))? {
            let name = file.strip_prefix(&www)?;
            let built = site.path().join(name);
            let own = match name.to_str() {
                _ if name.extension().is_none_or(|ending| ending != "html") => continue,
                // Examples for pages of others, which have the policies of their sites.
                Some("course.html" | "simple.html") => vec![],
                // The frame of programs has a script in the page.
                Some("program.html") => {
                    vec![
                        shared[0].replace("'wasm-unsafe-eval'", &format!("'wasm-unsafe-eval' blob: '{}'", boot(&www)?)),
                    ]
                }
                // Documents run no scripts and show drawings in frames.
                Some("docs/page.html") => vec![
                    "default-src 'self'; script-src 'none'; frame-src 'self'; object-src 'none'; base-uri 'none'; \
                     form-action 'none'"
                        .to_owned(),
                ],
                _ => shared.clone(),
            };
            assert_eq!(
                policies(&fs::read_to_string(if built.exists() { built } else { file.clone() })?),
                own,
                "{name:?}"
            );
        }
        Ok(())
    }

    /// The hash that the frame of programs names for its script.
    fn boot(www: &Path) -> Result<String> {
        let script = fs::read_to_string(www.join("js/programs/frame.js"))?;
        let begun = script.split_once("BOOT = `").context("the frame has no script")?.1;
        let text = begun.split('`').next().unwrap_or_default();
        let hash = one_file::hash(text).trim_matches('\'').to_owned();
        anyhow::ensure!(script.contains(&format!("HASH = '{hash}'")), "the hash of the frame's script is {hash}");
        Ok(hash)
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
