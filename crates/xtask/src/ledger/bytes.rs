//! The bytes of the built site, as a host sends them: compressed by brotli at its highest level, which Node.js has.

use super::Measured;
use crate::workspace::{Kind, Workspace, output};
use crate::{files, tools};
use anyhow::{Context, Result};
use fs_err as fs;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Prints the compressed size of each file below a folder: a line of the path, a tab and the number.
const SCRIPT: &str = "
    const { readdirSync, readFileSync, statSync } = require('node:fs');
    const { brotliCompressSync } = require('node:zlib');
    const folder = process.argv[1];
    for (const path of readdirSync(folder, { recursive: true })) {
        if (!statSync(`${folder}/${path}`).isFile()) continue;
        console.log(`${path}\\t${brotliCompressSync(readFileSync(`${folder}/${path}`)).length}`);
    }";

/// The bytes of every file, by its path. Kept beside the build, since the highest level is slow.
fn compressed(workspace: &Workspace) -> Result<BTreeMap<String, f64>> {
    let site = Kind::Shipped.folder(workspace);
    if !site.is_dir() {
        return Ok(BTreeMap::new());
    }
    let (kept, build) = (workspace.target.join("test/brotli.txt"), workspace.target.join("test/brotli.of"));
    files::once(&[&site.join("service-worker.js")], &build, || {
        files::write(&kept, output(Command::new(tools::node()?).args(["-e", SCRIPT]).arg(&site))?)
    })?;
    let text = fs::read_to_string(&kept)?;
    let rows = text.lines().map(|line| {
        let (path, bytes) = line.split_once('\t').context("a file without a size")?;
        Ok((path.replace('\\', "/"), bytes.parse()?))
    });
    rows.collect()
}

/// Pages that are kept, packed and sent as single files. What they carry is compressed inside.
const SINGLE: [&str; 5] = ["embed.html", "exercise.html", "film.html", "package.html", "playground.html"];

/// The bytes of the site. Files in folders and parts of the page are summed, because they are many and small.
pub(super) fn site(workspace: &Workspace) -> Result<Measured> {
    let mut rows = Measured::new();
    for (path, bytes) in compressed(workspace)? {
        if !SINGLE.contains(&path.as_str()) && !is_of_programs(&path) {
            *rows.entry(row_of(&path)).or_default() += bytes;
        }
    }
    Ok(rows)
}

/// Whether a file is only for exercises whose answer is a program.
fn is_of_programs(path: &str) -> bool {
    path.starts_with("pyodide/") || path.ends_with("programs.json") || path == "program.html"
}

/// What exercises whose answer is a program cost: the interpreter, own code with the editor, words, and lines.
pub(super) fn programs(workspace: &Workspace) -> Result<Measured> {
    let mut rows = Measured::new();
    for (path, bytes) in compressed(workspace)?.into_iter().filter(|(path, _)| is_of_programs(path)) {
        let row = match path.rsplit('.').next() {
            Some("html") => "bytes of the page, with its editor",
            Some("json") => "bytes of its words",
            _ => "bytes of the interpreter",
        };
        *rows.entry(row.to_owned()).or_default() += bytes;
    }
    if !rows.is_empty() {
        rows.insert("lines of JavaScript".to_owned(), super::lines::count(&workspace.www().join("js/programs"), "js")?);
    }
    Ok(rows)
}

/// The bytes of pages in single files, as they are.
pub(super) fn single(workspace: &Workspace) -> Result<Measured> {
    let site = Kind::Shipped.folder(workspace);
    let files = SINGLE.iter().map(|name| (name, site.join(name))).filter(|(_, file)| file.is_file());
    files.map(|(name, file)| Ok(((*name).to_owned(), fs::metadata(file)?.len() as f64))).collect()
}

/// The row of a file: its folder; for a part of the page, whose name ends in a hash, all parts; else itself.
fn row_of(path: &str) -> String {
    if let Some((folder, _)) = path.split_once('/') {
        return format!("{folder}/");
    }
    let stem = Path::new(path).file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    let is_part = path.ends_with(".js") && stem.rsplit_once('-').is_some_and(|(_, hash)| is_hash(hash));
    if is_part { "parts of the page".to_owned() } else { path.to_owned() }
}

/// Whether a word is one of esbuild's hashes.
fn is_hash(word: &str) -> bool {
    word.len() == 8 && word.chars().all(|letter| letter.is_ascii_uppercase() || letter.is_ascii_digit())
}

/// The bytes of what the page loads before its first picture, as the service worker lists it: the engine, and all else.
pub(super) fn first(workspace: &Workspace) -> Result<Measured> {
    let all = compressed(workspace)?;
    if all.is_empty() {
        return Ok(Measured::new());
    }
    let worker = fs::read_to_string(Kind::Shipped.folder(workspace).join("service-worker.js"))?;
    let list = worker.lines().find_map(|line| line.strip_prefix("const FIRST = ")?.strip_suffix(';'));
    let names: Vec<String> = serde_json::from_str(list.context("the service worker lists no first screen")?)?;
    let mut rows = Measured::new();
    for name in names {
        let path = if name.is_empty() { "index.html" } else { &name };
        let bytes = all.get(path).with_context(|| format!("{path} is not in the site"))?;
        let row = if path.ends_with(".wasm") { "engine" } else { "scripts, styles, page" };
        *rows.entry(row.to_owned()).or_default() += bytes;
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_and_folders_are_summed() {
        for (path, row) in [
            ("lsystem.wasm", "lsystem.wasm"),
            ("docs/lesson.html", "docs/"),
            ("gallery-SKFO3VQ2.js", "parts of the page"),
            ("service-worker.js", "service-worker.js"),
        ] {
            assert_eq!(row_of(path), row);
        }
    }
}
