//! Converting files of other programs to files of this one.

use crate::pending::Pending;
use crate::print;
use crate::{CommandFailure, input};
use lsystem::files::{Entry, import};
use lsystem::write_json;
use std::collections::HashSet;

use std::path::{Path, PathBuf};

/// Converts the systems of files, and of the files in folders, to JSON files in `folder`, and prints a report. A file
/// that cannot be read does not stop the others.
///
/// # Errors
/// [`CommandFailure::Said`] if a file holds no system, or a system is refused.
pub(crate) fn convert(files: &[PathBuf], folder: &Path) -> Result<(), CommandFailure> {
    std::fs::create_dir_all(folder).map_err(|error| CommandFailure::io(folder.display().to_string(), &error))?;
    let mut names = HashSet::new();
    let [mut written, mut refused] = [0_usize; 2];
    for file in files.iter().flat_map(|file| files_in(file)) {
        let shown = file.display().to_string();
        let report = match systems(&file) {
            Ok((notation, entries)) => {
                let mut report = format!("{shown}: {notation}\n");
                for entry in entries {
                    report.push_str(&one(&entry, &file, folder, &mut names, [&mut written, &mut refused]));
                }
                report
            }
            Err(words) => {
                refused += 1;
                format!("{shown}: {words}\n")
            }
        };
        print(|out| out.write_all(report.as_bytes()))?;
    }
    print(|out| writeln!(out, "{written} written, {refused} refused"))?;
    if refused > 0 { Err(CommandFailure::Said) } else { Ok(()) }
}

/// The file itself, or the files in a folder by name.
fn files_in(path: &Path) -> Vec<PathBuf> {
    let Ok(folder) = std::fs::read_dir(path) else { return vec![path.to_owned()] };
    let mut files: Vec<PathBuf> = folder.flatten().map(|entry| entry.path()).filter(|path| path.is_file()).collect();
    files.sort();
    files
}

/// The systems of a file, with the name of their notation.
fn systems(file: &Path) -> Result<(&'static str, Vec<Entry>), String> {
    let bytes = input::bytes_of(file).map_err(|error| error.to_string())?;
    let text = String::from_utf8_lossy(&bytes);
    if let Some(imported) = import(&text) {
        return Ok((imported.notation, imported.entries));
    }
    match lsystem::read_file(&bytes).definition {
        Some(definition) => {
            let name = definition.label().to_owned();
            Ok(("JSON", vec![Entry { name, definition: Some(definition), remarks: Vec::new() }]))
        }
        None => Err("no known notation".to_owned()),
    }
}

/// Writes one system, and reports it.
fn one(entry: &Entry, file: &Path, folder: &Path, names: &mut HashSet<String>, counts: [&mut usize; 2]) -> String {
    let [written, refused] = counts;
    let mut report = String::new();
    match &entry.definition {
        Some(definition) => {
            let name = free_name(&entry.name, file, names);
            let path = folder.join(format!("{name}.json"));
            let json = write_json(definition);
            let result = Pending::write(&path, |out| out.write_all(json.as_bytes())).and_then(Pending::commit);
            match result {
                Ok(()) => {
                    *written += 1;
                    report.push_str(&format!("  {} -> {name}.json\n", entry.name));
                }
                Err(error) => {
                    *refused += 1;
                    report.push_str(&format!("  {}: {error}\n", entry.name));
                }
            }
        }
        None => {
            *refused += 1;
            report.push_str(&format!("  {}: refused\n", entry.name));
        }
    }
    for remark in &entry.remarks {
        report.push_str(&format!("    line {}: {}\n", remark.line, remark.message));
    }
    report
}

/// A file name that no other system has: the system's name, or else the file's, with plain characters only.
fn free_name(name: &str, file: &Path, names: &mut HashSet<String>) -> String {
    let plain = |name: &str| -> String {
        let plain: String =
            name.chars().map(|ch| if ch.is_ascii_alphanumeric() { ch.to_ascii_lowercase() } else { '-' }).collect();
        plain.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-").chars().take(80).collect()
    };
    let own = plain(name);
    let stem = || plain(&file.file_stem().unwrap_or_default().to_string_lossy());
    let base = if own.is_empty() { stem() } else { own };
    let base = if base.is_empty() { "system".to_owned() } else { base };
    let mut name = base.clone();
    let mut number = 2;
    while !names.insert(name.clone()) {
        name = format!("{base}-{number}");
        number += 1;
    }
    name
}
