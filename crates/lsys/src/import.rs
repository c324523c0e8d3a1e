//! `lsys import`: files of other programs to JSON files.

use crate::input::{self, bytes_of, remark_line};
use crate::pending::Pending;
use crate::{CommandFailure, print, say};
use lsystem::base::MAX_TEXT;
use lsystem::base::counted;
use lsystem::files::FileContent;
use lsystem::import::{Entry, Imported, OWN_JSON, Remark, import_file};
use lsystem::syntax::visible;
use lsystem::{Definition, System, read_file, write_json};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The numbers of a report.
#[derive(Debug, Default)]
struct Totals {
    files: usize,
    failed_files: usize,
    converted: usize,
    refused: usize,
}

/// Converts every system in `files` to a JSON file in the folder `to`, and prints a report. A bad file does not stop
/// the others.
///
/// # Errors
/// [`CommandFailure::Said`] if a file or a system is not converted; [`CommandFailure::Words`] if `to` is no folder.
pub(crate) fn import(files: &[PathBuf], to: &Path) -> Result<(), CommandFailure> {
    std::fs::create_dir_all(to).map_err(|error| CommandFailure::io(to.display(), &error))?;
    let (mut totals, mut taken) = (Totals::default(), BTreeSet::new());
    let files: Vec<PathBuf> = files.iter().flat_map(|file| listed(file, 0)).collect();
    // No output of a file replaces a later one.
    files.iter().for_each(|file| input::keep(file));
    let beside: BTreeSet<&PathBuf> = files.iter().flat_map(|file| companions(file, &files)).collect();
    for file in files.iter().filter(|file| !beside.contains(file)) {
        import_one(file, &files, to, &mut taken, &mut totals);
    }
    let Totals { files, failed_files, converted, refused } = totals;
    print(|out| {
        let files = counted!(files, "{} file read", "{} files read");
        let rest = say!("{} without a system; {} converted, {} refused", failed_files, converted, refused);
        writeln!(out, "{files}, {rest}")
    })?;
    if failed_files + refused == 0 { Ok(()) } else { Err(CommandFailure::Said) }
}

/// The files in a folder and its folders, sorted by name; or the file itself.
fn listed(path: &Path, depth: usize) -> Vec<PathBuf> {
    const DEEPEST: usize = 16;
    // Links may lead in circles, and pipes in a folder have no end.
    let is_skipped = depth > 0 && (path.is_symlink() || !path.is_dir() && !path.is_file());
    if is_skipped || !path.is_dir() {
        return if is_skipped { Vec::new() } else { vec![path.to_owned()] };
    }
    let Ok(folder) = std::fs::read_dir(path) else { return vec![path.to_owned()] };
    let mut inside: Vec<PathBuf> = folder.filter_map(|entry| Some(entry.ok()?.path())).collect();
    inside.sort();
    if depth >= DEEPEST {
        return Vec::new();
    }
    inside.iter().flat_map(|path| listed(path, depth + 1)).collect()
}

/// The files that a file of cpfg may name: view files, surfaces and functions in its folder.
fn companions<'f>(file: &Path, files: &'f [PathBuf]) -> impl Iterator<Item = &'f PathBuf> {
    let ending = |path: &Path| path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let is_system = ending(file).as_deref() == Some("l");
    let folder = file.parent().map(Path::to_owned);
    files.iter().filter(move |other| {
        is_system
            && other.parent().map(Path::to_owned) == folder
            && matches!(ending(other).as_deref(), Some("v" | "s" | "func" | "fset"))
    })
}

/// The bytes of a file of cpfg with those of its companions behind, each below a line with its name.
fn with_companions(file: &Path, bytes: Vec<u8>, files: &[PathBuf]) -> std::io::Result<Vec<u8>> {
    let mut all = bytes;
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    for other in companions(file, files) {
        all.extend_from_slice(format!("\n==> {} <==\n", name(other)).as_bytes());
        all.extend(bytes_of(other)?);
    }
    Ok(all)
}

/// Converts the systems of one file.
fn import_one(file: &Path, files: &[PathBuf], to: &Path, taken: &mut BTreeSet<String>, totals: &mut Totals) {
    let name = file.display().to_string();
    totals.files += 1;
    let bytes = bytes_of(file).and_then(|bytes| with_companions(file, bytes, files));
    let entries = match bytes.map_err(|error| error.to_string()).and_then(|bytes| entries_of(&bytes)) {
        Ok(entries) => entries,
        Err(words) => {
            say(&format!("{}\n", visible(&say!("error: {}", format!("{name}: {words}")))));
            totals.failed_files += 1;
            return;
        }
    };
    for entry in entries {
        let title = if entry.name.is_empty() { String::new() } else { format!(" ({})", entry.name) };
        for remark in &entry.remarks {
            say(&remark_line(&format!("{name}{title}"), remark));
        }
        let Some(mut definition) = entry.definition else {
            totals.refused += 1;
            continue;
        };
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        let base = unique(&safe(if entry.name.is_empty() { &stem } else { &entry.name }), taken);
        if definition.name.is_empty() {
            definition.name.clone_from(&base);
        }
        match write(&definition, &to.join(format!("{base}.json"))) {
            Ok(()) => totals.converted += 1,
            Err(words) => {
                say(&format!("{}\n", visible(&say!("error: {}", words))));
                totals.refused += 1;
            }
        }
    }
}

/// The systems in a file of any notation, or the reason why there are none.
fn entries_of(bytes: &[u8]) -> Result<Vec<Entry>, String> {
    if let Some(Imported { entries, .. }) = import_file(bytes).filter(|imported| imported.notation != OWN_JSON) {
        return Ok(entries);
    }
    let FileContent { definition, mut diagnostics, .. } = read_file(bytes);
    // Other notations begin with a brace too, so only JSON that has parts of a system is reported as wrong.
    let is_json = definition.is_some() || bytes.windows(9).any(|part| part == b"\"initial\"");
    if let Some(definition) = &definition {
        diagnostics.extend(System::problems(definition));
    }
    match (definition, diagnostics.iter().find(|diagnostic| diagnostic.is_error())) {
        (Some(definition), None) => Ok(vec![Entry {
            name: definition.name.clone(),
            definition: Some(definition),
            remarks: Vec::<Remark>::new(),
        }]),
        (_, Some(error)) if is_json => Err(error.message.clone()),
        _ if bytes.len() > MAX_TEXT => Err(say!("longer than {} KiB, which is not read", MAX_TEXT >> 10)),
        _ => Err(say!("no L-system in a known notation")),
    }
}

/// Writes a system as JSON. An error has the path.
pub(crate) fn write(definition: &Definition, path: &Path) -> Result<(), String> {
    let text = write_json(definition);
    let pending = Pending::write(path, |out| out.write_all(text.as_bytes()));
    pending.and_then(Pending::commit).map_err(|error| format!("{}: {error}", path.display()))
}

/// A file name from any text: ASCII letters, digits, `-`, `_` and `.`, which every system accepts.
fn safe(name: &str) -> String {
    const LONGEST: usize = 80;
    let kept = |c: char| if c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.') { c } else { '-' };
    let name: String = name.chars().map(kept).take(LONGEST).collect();
    let name = name.trim_matches(['-', '.']);
    // Windows reserves these names.
    let stem = name.split('.').next().unwrap_or_default().to_ascii_lowercase();
    let numbered = |device: &str| stem.strip_prefix(device).is_some_and(|rest| rest.len() == 1);
    let reserved = matches!(stem.as_str(), "con" | "prn" | "aux" | "nul") || numbered("com") || numbered("lpt");
    if name.is_empty() || reserved {
        format!("system-{name}").trim_end_matches('-').to_owned()
    } else {
        name.to_owned()
    }
}

/// A name that is not taken yet, also where case does not matter.
fn unique(name: &str, taken: &mut BTreeSet<String>) -> String {
    let mut found = name.to_owned();
    let mut number = 1;
    while !taken.insert(found.to_ascii_lowercase()) {
        number += 1;
        found = format!("{name}-{number}");
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_safe_and_unique() {
        for (name, expected) in [
            ("Koch 1", "Koch-1"),
            ("../../x", "x"),
            ("", "system"),
            ("con.l", "system-con.l"),
            ("ä/ö", "system"),
            ("a.b", "a.b"),
        ] {
            assert_eq!(safe(name), expected, "{name}");
        }
        let mut taken = BTreeSet::new();
        assert_eq!(["A", "a", "A"].map(|name| unique(name, &mut taken)), ["A", "a-2", "A-3"]);
    }
}
