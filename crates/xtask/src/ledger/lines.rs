//! Lines of code: without blank lines, comments and tests.

use super::Measured;
use crate::files;
use crate::workspace::Workspace;
use anyhow::Result;
use fs_err as fs;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Folders of a crate that are not shipped with it.
const LEFT_OUT: [&str; 4] = ["tests", "benches", "examples", "node_modules"];
/// Crates that only developers run.
const TOOLS: [&str; 7] = ["bench", "fuzz", "outside", "site", "test-effort", "wasm-test-runner", "xtask"];
/// Scripts of the page.
const SCRIPTS: [&str; 2] = ["www/js", "www/worker"];

/// The lines of each crate that is shipped.
pub(super) fn shipped(workspace: &Workspace) -> Result<Measured> {
    crates(workspace, |name| !TOOLS.contains(&name))
}

/// The lines of each crate that only developers run.
pub(super) fn tools(workspace: &Workspace) -> Result<Measured> {
    crates(workspace, |name| TOOLS.contains(&name))
}

fn crates(workspace: &Workspace, is_wanted: impl Fn(&str) -> bool) -> Result<Measured> {
    let mut rows = Measured::new();
    for entry in fs::read_dir(workspace.root.join("crates"))? {
        let folder = entry?.path();
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if is_wanted(&name) {
            rows.insert(name, count(&folder, "rs")?);
        }
    }
    Ok(rows)
}

/// The lines of the page's scripts.
pub(super) fn scripts(workspace: &Workspace) -> Result<Measured> {
    let mut rows = Measured::new();
    for name in SCRIPTS {
        rows.insert(name.to_owned(), count(&workspace.root.join(name), "js")?);
    }
    // They have a section of their own.
    if let Some(page) = rows.get_mut("www/js") {
        *page -= count(&workspace.www().join("js/programs"), "js")?;
    }
    Ok(rows)
}

pub(super) fn count(folder: &Path, ending: &str) -> Result<f64> {
    let mut texts = BTreeMap::new();
    for file in files::list(folder, |path| !LEFT_OUT.iter().any(|name| path.ends_with(name)))? {
        if file.extension().is_some_and(|its| its == ending) {
            texts.insert(file.clone(), fs::read_to_string(file)?);
        }
    }
    let tests: Vec<PathBuf> = texts.iter().flat_map(|(file, text)| of_tests(file, text)).collect();
    Ok(texts.iter().filter(|(file, _)| !tests.contains(file)).map(|(_, text)| code(text)).sum::<usize>() as f64)
}

/// The files of modules that only tests have.
fn of_tests<'a>(file: &'a Path, text: &'a str) -> impl Iterator<Item = PathBuf> + 'a {
    let is_root = ["lib", "main", "mod"].iter().any(|stem| file.file_stem() == Some(stem.as_ref()));
    let folder = if is_root { file.with_file_name("") } else { file.with_extension("") };
    let declared = text.split("#[cfg(test)]\nmod ").skip(1).filter_map(|rest| rest.lines().next()?.strip_suffix(';'));
    declared.map(move |name| folder.join(name).with_extension("rs"))
}

/// The lines of code of a file. What follows `#[cfg(test)]` and a module's brace is a test.
fn code(text: &str) -> usize {
    let (mut sum, mut is_comment) = (0, false);
    let mut lines = text.lines().map(str::trim).peekable();
    while let Some(line) = lines.next() {
        if line == "#[cfg(test)]" && lines.peek().is_some_and(|next| next.starts_with("mod ") && next.ends_with('{')) {
            break;
        }
        is_comment |= line.starts_with("/*");
        sum += usize::from(!is_comment && !line.is_empty() && !line.starts_with("//"));
        is_comment &= !line.ends_with("*/");
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_code_only() {
        let text = "//! Why.\n\nfn a() {\n    // no\n    b() // yes\n}\n#[cfg(test)]\nuse x;\n\n#[cfg(test)]\nmod tests {\n    c\n}\n";
        assert_eq!(code(text), 5);
        let tests = |file| of_tests(Path::new(file), "mod a;\n#[cfg(test)]\nmod b;\n").collect::<Vec<_>>();
        assert_eq!(tests("src/c.rs"), [Path::new("src/c/b.rs")]);
        assert_eq!(tests("src/mod.rs"), [Path::new("src/b.rs")]);
        assert_eq!(code("/**\n * no\n */\nlet a; /* yes */\n/** @type {x} */\nlet b;\n"), 2);
    }
}
