//! The list of files that the page keeps for offline use. The list becomes the head of the service worker.

use crate::files::{self, hex};
use crate::split;
use anyhow::{Context, Result, ensure};
use fs_err as fs;
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};
use std::path::Path;

const WORKER: &str = "service-worker.js";
/// Files that are useless offline or that repeat the others, and an example for those who build pages.
const LEFT_OUT: [&str; 7] =
    [WORKER, "playground.html", "sitemap.xml", "llms.txt", "simple.html", "core.js", "program.html"];
/// How the paths of such files begin: pages for those who do not know the playground yet, pictures for installers,
/// and the interpreter, of which few have a use.
const BEGINNINGS_LEFT_OUT: [&str; 5] =
    ["gallery/", "icons/screen-", "pyodide/", "lang/de/programs", "lang/fr/programs"];

/// What the first screen needs, besides the page and its scripts.
const FIRST: [&str; 6] =
    ["page.css", "js/early.js", "worker.js", "lsystem.wasm", "icons/icon.svg", "manifest.webmanifest"];

/// What the page fetches after the first picture, without being asked.
const SOON: [&str; 2] = [split::REST, "surprises.json"];

/// Completes the service worker in the folder of the site. All other files must be in place. `scripts` are those that the
/// page runs from the start.
pub(crate) fn list_files(site: &Path, scripts: &[String]) -> Result<()> {
    let (mut hashes, mut sizes) = (Map::new(), Map::new());
    for file in files::list(site, |_| true)? {
        let path = file.strip_prefix(site)?.to_str().context("a name that is not UTF-8")?.replace('\\', "/");
        if LEFT_OUT.contains(&&*path) || BEGINNINGS_LEFT_OUT.iter().any(|start| path.starts_with(start)) {
            continue;
        }
        // Some hosts serve the first page only at the folder's address.
        let path = if path == "index.html" { String::new() } else { path };
        sizes.insert(path.clone(), fs::metadata(&file)?.len().into());
        hashes.insert(path, files::fingerprint(&file)?.into());
    }
    let first: Vec<&str> = [""].into_iter().chain(FIRST).chain(scripts.iter().map(String::as_str)).collect();
    for path in first.iter().chain(&SOON) {
        ensure!(hashes.contains_key(*path), "the first screen needs `{path}`, which is not there");
    }
    let (list, sizes, first, soon) =
        (Value::Object(hashes).to_string(), Value::Object(sizes), json!(first), json!(SOON));
    let worker = site.join(WORKER);
    let text = fs::read_to_string(&worker)?;
    // A change of the worker itself makes a new version, too.
    let build = &hex(&Sha256::digest(format!("{list}{text}")))[..16];
    let head = format!(
        "const BUILD = \"{build}\";\nconst FILES = {list};\nconst SIZES = {sizes};\nconst FIRST = {first};\nconst SOON = {soon};\n"
    );
    files::write(&worker, head + &text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_all_files_by_their_hashes() {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path();
        for (name, text) in [
            ("index.html", ""),
            ("page.js", "abc"),
            ("playground.html", "x"),
            ("gallery/a.png", "x"),
            (WORKER, "work()"),
        ] {
            files::write(&site.join(name), text).unwrap();
        }
        let list_files = |site: &Path| list_files(site, &["page.js".to_owned()]);
        assert!(list_files(site).is_err(), "what the first screen needs is missing");
        FIRST.iter().chain(&SOON).for_each(|name| files::write(&site.join(name), "").unwrap());
        list_files(site).unwrap();
        let worker = fs::read_to_string(site.join(WORKER)).unwrap();
        // The first two are published examples of SHA-256.
        assert!(worker.starts_with("const BUILD = \"") && worker.ends_with(";\nwork()"), "{worker}");
        for part in [
            "const FILES = {\"\":\"e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855\",",
            "\"page.js\":\"ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad\"",
            "const SIZES = {\"\":0,",
            "\"page.js\":3",
            "const FIRST = [\"\",\"page.css\",",
            "\"page.js\"];\nconst SOON = [\"lsystem-rest.wasm\",\"surprises.json\"];\n",
        ] {
            assert!(worker.contains(part), "{part}: {worker}");
        }
        assert!(!worker.contains("playground") && !worker.contains("gallery"), "{worker}");
        files::write(&site.join(WORKER), "work()").unwrap();
        files::write(&site.join("page.js"), "abd").unwrap();
        list_files(site).unwrap();
        assert_ne!(fs::read_to_string(site.join(WORKER)).unwrap()[..40], worker[..40]);
    }
}
